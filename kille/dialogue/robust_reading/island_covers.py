"""Covers: islands of a sentence that do not overlap, and the words between them.

The words that a cover leaves out are missed, unless they are harmless ones, such as
"well" and "you know". The best covers leave out little, are made of few islands, and
these fit what the talk is about.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from heapq import nlargest
from types import MappingProxyType
from typing import NamedTuple

from kille.dialogue.parsing import Grammar
from kille.dialogue.robust_reading.clause_words import Word
from kille.dialogue.robust_reading.island_kinds import FALLBACK, SINGLE
from kille.dialogue.robust_reading.islands import Island, Weigh, find_islands
from kille.dialogue.word_lists import WordLists

MISSED = 0.4
"""The factor for every word that a cover leaves out."""

APART = 0.8
"""The factor for every island: one long one is better than several short ones."""

COVERS = 12
"""How many covers of the rest of a sentence are kept: the best ones."""

BOUND = 4
"""How many of those that begin with an island that has to follow another."""

_MOST = 48
"""Words; what is longer is no sentence that a tutor says to a robot."""

Follows = Mapping[str, Set[str]]
"""The islands that make sense only right after others, by their rules: "and soft"."""


class Cover(NamedTuple):
    """Islands of a sentence from left to right, and the words that they leave out."""

    islands: tuple[Island, ...]
    missed: tuple[Word, ...]
    weight: float

    def missed_near(self, island: Island, words: Sequence[Word]) -> tuple[Word, ...]:
        """The words that are left out of the clauses in which an island stands."""
        clauses = {it.clause for it in words[island.first : island.after]}
        return tuple(it for it in self.missed if it.clause in clauses)

    def before(self, island: Island) -> tuple[Island, ...]:
        """The islands to the left of one."""
        return tuple(it for it in self.islands if it.first < island.first)

    def after(self, island: Island) -> tuple[Island, ...]:
        """The islands to the right of one."""
        return tuple(it for it in self.islands if it.first > island.first)


def best_covers(
    text: str,
    words: Sequence[Word],
    grammar: Grammar,
    weigh: Weigh,
    lists: WordLists,
    follows: Follows = MappingProxyType({}),
) -> list[Cover]:
    """The best covers of a text by the islands of a grammar, the best one first."""
    if not words or len(words) > _MOST:
        return []
    by_first: dict[int, list[Island]] = {}
    for island in find_islands(text, words, grammar, weigh, lists):
        by_first.setdefault(island.first, []).append(island)
    rest: list[list[Cover]] = [[] for _ in words] + [[Cover((), (), 1.0)]]
    for at in reversed(range(len(words))):
        here = by_first.get(at, ())
        rest[at] = _covers_from(at, words[at], here, rest, follows)
    return [it for it in rest[0] if it.islands and it.islands[0].rule not in follows]


def _covers_from(
    at: int,
    word: Word,
    islands: Iterable[Island],
    rest: Sequence[Sequence[Cover]],
    follows: Follows,
) -> list[Cover]:
    """The best covers of what stands from a word on, from those of what follows."""
    if word.is_harmless:
        found = list(rest[at + 1])
    else:
        found = [
            Cover(it.islands, (word, *it.missed), MISSED * it.weight)
            for it in rest[at + 1]
            if not it.islands or it.islands[0].rule not in follows
        ]
    for island in islands:
        found += [
            Cover(
                (island, *it.islands),
                it.missed,
                APART * island.weight * it.weight,
            )
            for it in rest[island.after]
            if not it.islands or _may_precede(island, it.islands[0], follows)
        ]
    best: dict[object, Cover] = {}
    for it in found:
        key = tuple(one[:3] for one in it.islands)
        if key not in best or best[key].weight < it.weight:
            best[key] = it
    bound = [it for it in best.values() if it.islands and it.islands[0].rule in follows]
    free = [it for it in best.values() if it not in bound]
    return [
        *nlargest(COVERS, free, key=lambda it: it.weight),
        *nlargest(BOUND, bound, key=lambda it: it.weight),
    ]


def _may_precede(island: Island, other: Island, follows: Follows) -> bool:
    """Whether an island may stand before another: a remark is all that is said."""
    if {island.rule, other.rule} & (FALLBACK | SINGLE):
        return False
    return island.rule in follows.get(other.rule, (island.rule,))
