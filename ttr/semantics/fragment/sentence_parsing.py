"""From a sentence to its tree, by the grammar with the words of a lexicon."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import TYPE_CHECKING

from ttr.errors import TTRError, suggestion
from ttr.semantics.fragment.lexicon import Lexicon

if TYPE_CHECKING:
    from lark import Lark, Token, Tree

_LONGEST = 300
"""The most characters that a sentence may have."""


@dataclass(frozen=True)
class Phrase:
    """A node of the tree: a phrase by a rule of the grammar, or a word."""

    kind: str
    parts: tuple[Phrase, ...] = ()
    word: str = ""

    def below(self, kind: str) -> Iterator[Phrase]:
        """The phrases of a kind in this one, itself included, from left to right."""
        if self.kind == kind:
            yield self
        for part in self.parts:
            yield from part.below(kind)


class OutsideFragmentError(TTRError):
    """A sentence with a word or a construction that the fragment does not have.

    >>> from ttr.semantics.fragment import understand
    >>> understand("Every dog gavotted.")
    Traceback (most recent call last):
        ...
    ttr.semantics.fragment.sentence_parsing.OutsideFragmentError: the lexicon has no
    word 'gavotted'
    """


def parse_sentence(text: str, words: Lexicon) -> Phrase:
    """The tree of the sentence that a text is.

    Raises `OutsideFragmentError`, which names the word or construction that is not
    known.
    """
    from lark.exceptions import UnexpectedInput

    if not isinstance(text, str):
        raise OutsideFragmentError(f"a sentence is a text, found {text!r}")
    if not text.strip(" .,!?\t\r\n"):
        raise OutsideFragmentError("a sentence has words, but this text is empty")
    if len(text) > _LONGEST:
        raise OutsideFragmentError(f"a sentence has at most {_LONGEST} characters")
    plain = " ".join(text.replace("’", "'").split())
    grammar = _grammar(words)
    _check_words(plain, words)
    try:
        return _phrase(grammar.parse(plain))
    except UnexpectedInput as error:
        raise OutsideFragmentError(
            _describe_failure(plain, error.pos_in_stream)
        ) from None


def _phrase(found: Tree[Token] | Token) -> Phrase:
    if isinstance(found, str):
        return Phrase(found.type, (), str(found))
    return Phrase(str(found.data), tuple(map(_phrase, found.children)))


@lru_cache(maxsize=8)
def _grammar(words: Lexicon) -> Lark:
    """The grammar with a terminal for each class of words."""
    from lark import Lark

    rules = files("ttr.grammars").joinpath("fragment.en.lark").read_text("utf-8")
    terminals = [
        f"{terminal}: /({'|'.join(_patterns(forms)) or _NEVER})(?!\\w)/i"
        for terminal, forms in words.words.items()
    ]
    return Lark("\n".join([rules, *terminals]), parser="earley")


_NEVER = r"(?!)\w"
"""A pattern that matches nothing, for a class without words. It has a width, as Lark
refuses patterns of none."""


def _patterns(forms: Iterable[str]) -> list[str]:
    """Patterns for the forms of words, the longest form first."""
    found = sorted(forms, key=lambda form: (-len(form), form))
    return [_pattern(form) for form in found]


def _pattern(form: str) -> str:
    return r"\s+".join(re.escape(word).replace("/", r"\/") for word in form.split())


_FUNCTION_WORDS = frozenset(
    re.findall(
        r"\w+",
        """a all an and any are at be both case did do does each every everyone exactly
        few fewer he her him is it least less many more most neither no none not of one
        or she several some than that the them there they true was were which who whom
        will two three four five six seven eight nine ten eleven twelve""",
    )
)
"""The words that stand in the grammar itself."""


def _check_words(text: str, words: Lexicon) -> None:
    """Raise `OutsideFragmentError` for the first word that is in no lexicon."""
    known = {part for form in words.forms for part in form.split()}
    for word in re.findall(r"[\w'-]+", text):
        if word.lower() not in known | _FUNCTION_WORDS and not word.isdecimal():
            raise OutsideFragmentError(
                f"the lexicon has no word {word!r}",
                hint=suggestion(word.lower(), known),
            )


def _describe_failure(text: str, at: int | None) -> str:
    """The message that says where a sentence leaves the fragment."""
    if at is None or at < 0 or at >= len(text.rstrip(" .!?")):
        return f"the fragment has no sentence {text!r}: something is missing at its end"
    word = re.match(r"\W*(\w*)", text[at:])
    there = word[1] if word else text[at:]
    before = text[:at].strip() or "its beginning"
    return f"the fragment has no construction with {there!r} after {before!r}"
