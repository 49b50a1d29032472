"""From a move of the robot's to its sentence, by the wordings of the lexicon."""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from ttr import PType, Record, RecordType

__all__ = ["Lexicon", "english"]

_NEAR = 0.6
"""Share of characters in common, in their order, that makes two sentences alike."""


@dataclass(frozen=True)
class Lexicon:
    """Wordings, bands of certainty and articles of a language, from its file."""

    says: Mapping[str, str]
    bands: Mapping[str, float]
    articles: Mapping[str, list[str]]
    examples: tuple[str, ...]
    not_understood: str

    def say(self, move: Record, act: str, forms: Mapping[str, str]) -> str:
        """The sentence for a move: its act's wording with the words of its content.

        `act` is the name of the move's predicate; `forms` gives the form of each
        predicate that is a word.
        """
        slots = dict(self._slots(move.content, forms, ""))
        slots |= dict(self._slots(move.rival, forms, "rival"))
        sentence = self.says[act].format_map(slots)
        if act == "give_help":
            return "\n  ".join([sentence, *self.examples])
        return sentence

    def _slots(
        self, content: RecordType, forms: Mapping[str, str], prefix: str
    ) -> Iterator[tuple[str, str]]:
        """The slots that a content fills: {word}, {target}, {relation} …"""
        for label, form in _words(content, forms):
            if label == "c":
                yield prefix or "word", form
                yield f"a_{prefix or 'word'}", self.with_article(form)
            else:
                yield "_".join(filter(None, (prefix, label))), form

    def with_article(self, noun: str) -> str:
        """The noun with its indefinite article.

        >>> lexicon = english()
        >>> lexicon.with_article("apple"), lexicon.with_article("unicorn")
        ('an apple', 'a unicorn')
        """
        sounds_open = noun[0] in "aeiou" and not noun.startswith(
            tuple(self.articles["a"])
        )
        if sounds_open or noun.startswith(tuple(self.articles["an"])):
            return f"an {noun}"
        return f"a {noun}"

    def did_not_understand(self, text: str) -> str:
        """One sentence: that it was not understood, and what could be said instead.

        It is the example that is near to the text, or else the first.

        >>> print(english().did_not_understand("Where is teh book?"))
        Sorry, I did not understand "Where is teh book?". You could say
        "Where is the book?"; ...
        """
        shown = re.sub(r"\s+", " ", text).strip()
        shown = "".join(c if c.isprintable() else "�" for c in shown)
        shown = shown if len(shown) <= 60 else shown[:57] + "…"
        near = difflib.get_close_matches(shown, self.examples, n=1, cutoff=_NEAR)
        nearest = near[0] if near else self.examples[0]
        return self.not_understood.format(text=shown, nearest=nearest)


def _words(content: RecordType, forms: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """The words in a content: (label of the part or field, form)."""
    for label, field in content.fields:
        if isinstance(field, PType) and field.pred.name in forms:
            yield "relation" if label == "rel" else label, forms[field.pred.name]
        if isinstance(field, RecordType):
            for _, form in _words(field, forms):
                yield label, form


@cache
def english() -> Lexicon:
    """The packaged English lexicon."""
    source = files("kille.grammars").joinpath("lexicon.en.toml")
    data = tomllib.loads(source.read_text(encoding="utf-8"))
    understands = data["understands"]
    return Lexicon(
        says=data["says"],
        bands=data["bands"],
        articles=data["articles"],
        examples=tuple(understands["examples"]),
        not_understood=understands["not_understood"],
    )
