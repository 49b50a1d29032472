"""What a tutor may say that no wording of a move says: of which a part is understood.

The lexicon has it under `asides`, by what is worth trying in it, with slots for words.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from random import Random

from kille.dialogue.language import understand
from kille.dialogue.lexicon import Lexicon, lexicon
from kille.dialogue.phrases import noun_phrase
from kille.lab.worlds.vocabulary import Vocabulary
from ttr import Record

NOUNS = ("noun", "other", "third")
"""The nouns that an aside is about, by their slots."""

SOME = 6
"""How many times a wording is filled with words at most."""


@dataclass(frozen=True)
class Aside:
    """Something to be said in words of its own.

    >>> from kille.lab.worlds.vocabulary import vocabulary
    >>> Aside(vocabulary("en"), "Mug on the left, cup on the right.").is_read_whole
    False
    """

    words: Vocabulary
    text: str

    @property
    def is_read_whole(self) -> bool:
        """Whether it is one sentence that the grammar reads as a whole."""
        return _is_read_whole(self)


@lru_cache(4096)
def _is_read_whole(aside: Aside) -> bool:
    words = aside.words
    first, *others = understand(aside.text, words.language, types=words.types)
    return bool(first.readings) and not others


def aside_wordings(language: str, name: str = "") -> tuple[str, ...]:
    """The wordings of what is worth trying under a name, or under any.

    >>> aside_wordings("en", "reversed")
    ('The other way round.',)
    """
    sections = lexicon(language).sections.get("asides", {})
    found = sections.values() if not name else [sections.get(name, ())]
    each = ([it] if isinstance(it, str) else it for it in found)
    return tuple(wording for wordings in each for wording in wordings)


def asides(
    words: Vocabulary, name: str, known: Sequence[Record] = ()
) -> tuple[Aside, ...]:
    """What may be said to try something, mostly in nouns that are known.

    Each wording is there as often as any other.

    >>> from kille.lab.worlds.vocabulary import vocabulary
    >>> {it.text for it in asides(vocabulary("en"), "of_cue")}
    {'The colour does not matter.'}
    """
    return _asides(words, name, tuple(it for it in known if it.kind == "noun"))


@lru_cache(1024)
def _asides(
    words: Vocabulary, name: str, nouns: tuple[Record, ...]
) -> tuple[Aside, ...]:
    found = (
        Aside(words, wording.format_map(slots))
        for wording in aside_wordings(words.language, name)
        for slots in _fillings(words, wording, nouns)
    )
    return tuple(map(_capital, found))


def _capital(aside: Aside) -> Aside:
    return Aside(aside.words, aside.text[:1].upper() + aside.text[1:])


def _fillings(
    words: Vocabulary, wording: str, nouns: Sequence[Record]
) -> Iterator[dict[str, str]]:
    """The texts for the slots of a wording, some times over."""
    speaks, random = lexicon(words.language), Random(wording)
    others = [it for it in words.nouns.values() if it not in nouns]
    for number in range(SOME):
        some = [*nouns, *others] if number % 2 else [*words.nouns.values()]
        likely = some[: max(len(nouns), len(NOUNS))]
        slots = zip(NOUNS, random.sample(likely, len(NOUNS)), strict=True)
        form = random.choice(words.colours).form
        yield {
            "adjective": form,
            "weak_adjective": speaks.inflect(form, "WEAK"),
            **{
                slot: text
                for name, noun in slots
                for slot, text in _forms(speaks, name, noun)
            },
        }


def _forms(speaks: Lexicon, name: str, noun: Record) -> Iterator[tuple[str, str]]:
    """The forms of a noun, by the slots for them."""
    yield name, noun.form
    yield f"a_{name}", speaks.with_article(noun.form, noun.article)
    yield f"the_{name}", noun_phrase(speaks, noun, "definite")
    yield f"{name}s", speaks.inflect(noun.form, "PLURAL", speaks.article(noun))
