"""Saying which thing is meant: the shortest description that no other thing fits.

A description is a phrase of words that the robot knows. It is good if the robot's own
resolver finds that thing by it and no other: so it cannot say what it would not
understand.

Source: Roy 2002 (the context score: how much better the thing fits than any other).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product
from typing import NamedTuple

from kille.dialogue.meanings import DialogueTypes, packaged_types, word_of
from kille.dialogue.reference import PhraseJudge, fits_well, front_of, meant_by, said_by
from kille.dialogue.reference.resolving import phrase_judge
from ttr import Model, Record, RecordType

__all__ = ["Description", "describe"]

_NOUNS, _RELATIONS, _NEARBY = 2, 2, 12
"""How many nouns of a thing, relations to another, and places are tried."""

Signs = tuple[Record, ...]


class Description(NamedTuple):
    """A phrase that is true of one thing only, and its words.

    >>> from kille.dialogue.meanings import adjective, noun
    >>> from kille.dialogue.reference import meant_by
    >>> words = (adjective("red"), noun("cup"))
    >>> [it.form for it in Description(meant_by(words), words).signs]
    ['red', 'cup']
    """

    phrase: RecordType
    signs: tuple[Record, ...]


def describe(
    s: Record,
    model: Model,
    x: str,
    *,
    among: Sequence[str] = (),
    nouns: Sequence[Record] = (),
    types: DialogueTypes | None = None,
) -> Description | None:
    """The shortest description of x that the resolver finds x by, if there is one.

    It tells x from everything in view, or only from the things `among` which x is. Its
    noun is one of `nouns`, or what the robot would call x. Among the shortest ones the
    highest context score decides. A description that only just holds is given if no
    longer one is clear.

    >>> from kille.lab.worlds.games import simulated_game
    >>> from kille.lab.worlds.worlds import Thing, World
    >>> things = [Thing("cup", "red", place=(2, 3)), Thing("cup", "blue", place=(7, 3))]
    >>> game = simulated_game(World(tuple(things), focus=1))
    >>> run = game.take(game.begin(), game.hear("This is a cup.")).run
    >>> found = describe(run.state, run.model, "o1")
    >>> [it.form for it in found.signs]
    ['red', 'cup']
    """
    types = types or packaged_types()
    describing = _Describing(
        s, model, x, tuple(among) or tuple(s.view.things), types=types
    )
    shortest: Signs | None = None
    for tried in describing.by_length(nouns):
        scored = [(describing.context_score(words), words) for words in tried]
        score, best = max(scored, key=lambda it: it[0], default=(0.0, ()))
        if score > 0.0 and describing.is_clear(best):
            return Description(meant_by(best, types=types), best)
        if score > 0.0 and shortest is None:
            shortest = best
    return (
        None
        if shortest is None
        else Description(meant_by(shortest, types=types), shortest)
    )


@dataclass(frozen=True)
class _Describing:
    """Descriptions of one thing in view, which tell it from the things around it."""

    s: Record
    model: Model
    x: str
    among: tuple[str, ...]
    types: DialogueTypes

    @cached_property
    def judge(self) -> PhraseJudge:
        """The judgements that are made for it, each once."""
        return phrase_judge(self.s, self.model, types=self.types)

    def context_score(self, words: Signs) -> float:
        """How much more probably they are true of x than of any other thing.

        It is not positive where the resolver would not take x, or not x alone.
        """
        fits = self.judge.fits_part(said_by(words, types=self.types), self.among)
        if fits_well(self.s, fits) != [self.x]:
            return 0.0
        rivals = (fit.p for x, fit in fits.items() if x != self.x)
        return fits[self.x].p - max(rivals, default=0.0)

    def is_clear(self, words: Signs) -> bool:
        """Whether they would lead to x in another look as well, with other noise.

        Each word is well above what is likely, and every other thing is less than half
        as near as it would have to be to be considered.
        """
        bands = self.s.private.strategy.bands
        fits = self.judge.fits_part(said_by(words, types=self.types), self.among)
        fit = fits.pop(self.x)
        near = any(it.p > bands.sure / 2 * fit.p for it in fits.values())
        return bool(fit.weakest >= (bands.likely + bands.sure) / 2) and not near

    def by_length(self, nouns: Sequence[Record]) -> Iterator[Iterable[Signs]]:
        """Descriptions of x by words that are true of it, the shortest ones first.

        Without a noun it is "the red one".
        """
        nouns = nouns or self.nouns(self.x)
        heads: list[Signs] = [(noun,) for noun in nouns] or [()]
        qualities = self._true(self.s.private.adjectives, self.x)
        described = [(one, *head) for head, one in product(heads, qualities)]
        nearby = self._nearby()
        yield heads if nouns else []
        yield described
        yield [head + where for head, where in product(heads, nearby)]
        yield [(*both, *head) for head in heads for both in combinations(qualities, 2)]
        yield [one + where for one, where in product(described, nearby)]
        yield [head + where for head, where in product(heads, self._nearby(1))]

    def nouns(self, x: str) -> Signs:
        """What the robot would call a thing, the likeliest first."""
        return self._true(self.s.private.nouns, x)[:_NOUNS]

    def _nearby(self, adjectives: int = 0) -> list[Signs]:
        """How x stands to other things, and what these are called, the likeliest first.

        Each is called by a noun, with so many adjectives.
        """
        found = []
        for y in self.s.view.placed:
            if y == self.x:
                continue
            qualities = self._true(self.s.private.adjectives, y)
            called = [
                (*some, noun)
                for noun in self.nouns(y)[:1]
                for some in combinations(qualities, adjectives)
            ]
            stands = self._true(self.s.private.relations, self.x, y)[:_RELATIONS]
            found += [(where, *words) for where, words in product(stands, called)]
        return found[:_NEARBY]

    def _true(self, signs: Iterable[Record], *things: str) -> Signs:
        """The words that are likely true of a thing, or of two, the likeliest first."""
        look, likely = self.s.view.look, self.s.private.strategy.bands.likely
        front = [front_of(self.s, y) for y in things[1:]]
        degrees = {
            sign: self.judge.degree(word_of(sign), *things, look, *front)
            for sign in signs
        }
        true = [sign for sign, p in degrees.items() if p >= likely]
        return tuple(sorted(true, key=lambda sign: (-degrees[sign], sign.form)))
