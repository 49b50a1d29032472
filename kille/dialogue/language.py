"""From what the tutor says to a type: parsing is judging what kind of event it is.

The grammar says which words belong together, the theory what that means, and they meet
by name. A rule with a type of its name means that type merged with what its parts mean;
a rule without one is the label under which its part's meaning stands.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from typing import TYPE_CHECKING

from kille.dialogue.meanings import (
    named,
    noun,
    relation,
    set_to,
    spoken,
    theory,
    value_at,
)
from ttr import Rec, Record, RecordType, RecType, merge, rectype

if TYPE_CHECKING:
    from lark import Lark, Token, Tree

__all__ = ["NotUnderstood", "Utterance", "understand"]


_LONGEST = 400
"""Characters; no sentence of the grammar has more, and parsing slows down beyond."""

_REMEMBERED = 1024
"""Texts of which the reading is kept; parsing takes most of a turn's time."""


class NotUnderstood(Exception):
    """A text that is no utterance of the grammar."""


@dataclass(frozen=True)
class Utterance:
    """What was said: the text, and the type of the event of saying it."""

    text: str
    type: RecordType

    @property
    def content(self) -> RecordType:
        """What the utterance is about."""
        content = value_at(self.type, "content")
        if not isinstance(content, RecordType):
            raise TypeError(f"what is said is a record type, but found {content}")
        return content


@lru_cache(_REMEMBERED)
def understand(text: str) -> Utterance:
    """The utterance that a text is; raises `NotUnderstood`.

    Pure, and so remembered for the latest texts.

    >>> heard = understand("This is a cup.")
    >>> print(heard.type["content"])
    RecType@[look : Look, x : Ind, c : cup(x, look)]
    >>> understand("Colourless green ideas.")
    Traceback (most recent call last):
    kille.dialogue.language.NotUnderstood: Colourless green ideas.
    """
    from lark.exceptions import LarkError

    if len(text) > _LONGEST:
        raise NotUnderstood(text)
    try:
        tree = _grammar().parse(text)
    except LarkError:
        raise NotUnderstood(text) from None
    return Utterance(text, _heard(text, _parts(tree)[0]))


@cache
def _grammar() -> Lark:
    from lark import Lark

    source = files("kille.grammars").joinpath("tutor.en.lark")
    return Lark(source.read_text(encoding="utf-8"), parser="earley", start="start")


def _heard(text: str, move: Tree[Token]) -> RecordType:
    """The type of the event: who speaks to whom, the move, its signs, its content."""
    signs = tuple(_signs(move))
    content: RecordType = Rec
    for part in _parts(move):
        content = _merged(content, _meaning(part))
    return set_to(
        spoken("Heard", _type_name(move)),
        text=theory()["Text"] @ text,
        signs=named("Heard")["signs"] @ signs,
        content=RecType @ content,
    )


def _signs(tree: Tree[Token]) -> list[Record]:
    """The words in a tree, as signs, in the order in which they were said."""
    if tree.data in _WORDS:
        return [_WORDS[tree.data](" ".join(str(token) for token in tree.children))]
    return [sign for part in _parts(tree) for sign in _signs(part)]


_WORDS = {"noun": noun, "relation": relation}


def _meaning(tree: Tree[Token]) -> RecordType:
    """What a part of an utterance means, from what its own parts mean."""
    if tree.data in _WORDS:
        meaning: RecordType = _signs(tree)[0].meaning
        return meaning
    meaning = Rec
    for part in _parts(tree):
        meaning = _merged(meaning, _meaning(part))
    if _type_name(tree) in theory().names:
        return _merged(named(_type_name(tree)), meaning)
    return rectype({str(tree.data): meaning})


def _parts(tree: Tree[Token]) -> list[Tree[Token]]:
    from lark import Tree

    return [part for part in tree.children if isinstance(part, Tree)]


def _type_name(tree: Tree[Token]) -> str:
    """The name that a rule's type has in the theory: ask_name, AskName."""
    return "".join(part.capitalize() for part in str(tree.data).split("_"))


def _merged(S: RecordType, T: RecordType) -> RecordType:
    merged = merge(S, T)
    if not isinstance(merged, RecordType):
        raise TypeError(f"meanings of utterances are record types, but found {merged}")
    return merged
