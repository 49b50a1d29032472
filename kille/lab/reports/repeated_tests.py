"""Which phases are one test that is repeated: between them it shows what was learned.

Answers of other tests are no points of the same curve: things that were taught are
named more readily than others of their kinds.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain

from kille.lab.measures.measures import ACCURACY, REFERENCES, Measure
from kille.lab.measures.scored_dialogues import (
    ScoredAnswer,
    ScoredDialogue,
    split_dialogues,
)
from kille.lab.protocols.phases import SETTINGS
from kille.lab.settings import fill_settings
from kille.lab.study import Phase

Tests = Sequence[Sequence[str]]
"""The names of the phases, those together that ask alike."""

_Theories = Mapping[str, Sequence[ScoredDialogue]]

_ANY = ("order", "rounds", "turns")
"""In what order, and how often, does not make it another test."""
_NAMED = 3
"""So many phases are named one by one."""


def tests_of(phases: Iterable[Phase]) -> tuple[tuple[str, ...], ...]:
    """The phases that do the same with the same things, in their order.

    >>> first = Phase("before", "ask", {"of": "new"})
    >>> other = Phase("after", "ask", {"of": "new", "what": "nouns"})
    >>> tests_of([first, Phase("lessons", "teach"), other])
    (('before', 'after'), ('lessons',))
    """
    found: dict[object, list[str]] = {}
    for phase in phases:
        set_ = fill_settings(phase.settings, SETTINGS[phase.do])
        told = sorted((key, str(it)) for key, it in set_.items() if key not in _ANY)
        found.setdefault((phase.do, *told), []).append(phase.name)
    return tuple(map(tuple, found.values()))


def called(test: Sequence[str]) -> str:
    """What a test is called.

    >>> called(["test 1", "test 2"]), called(["a", "b", "c", "d"])
    ('test 1, test 2', 'a to d')
    """
    return ", ".join(test) if len(test) <= _NAMED else f"{test[0]} to {test[-1]}"


# --- what is measured in them --------------------------------------------------------


def main_of(measures: Iterable[Measure]) -> Measure | None:
    """How often it is right: in words, or where there are none, in things."""
    known = {it.name: it for it in measures}
    return known.get(ACCURACY.name) or known.get(REFERENCES.name)


def counts(measure: Measure, answer: ScoredAnswer) -> bool:
    """Whether an answer counts in what is the main measure."""
    return answer.is_word == (measure is ACCURACY)


def phases_of(theories: _Theories, measure: Measure) -> list[str]:
    """The phases in which something is asked that counts, in their order.

    One that the first dialogues lack has its place after that which comes before it.
    """
    found: list[str] = []
    for dialogue in chain.from_iterable(theories.values()):
        asked = (it.phase for it in dialogue.answers if counts(measure, it))
        place = 0
        for phase in dict.fromkeys(asked):
            if phase not in found:
                found.insert(place, phase)
            place = found.index(phase) + 1
    return found


def in_phase(theories: _Theories, measure: Measure, phase: str) -> _Theories:
    """The dialogues with those answers only that count in this phase."""

    def place(answer: ScoredAnswer) -> str:
        return answer.phase if counts(measure, answer) else ""

    return {
        name: split_dialogues(them, place).get(phase, [])
        for name, them in theories.items()
    }
