"""Which phases repeat the same test, so that they show what was learned in between.

Answers of different tests are no points of the same curve: things that were taught are
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
"""Another order, or another number of questions, does not make it another test."""
_NAMED = 3
"""Up to this many phases are named one by one."""


def group_tests(phases: Iterable[Phase]) -> tuple[tuple[str, ...], ...]:
    """Group phases that do the same with the same things, in their order.

    >>> first = Phase("before", "ask", {"of": "new"})
    >>> other = Phase("after", "ask", {"of": "new", "what": "nouns"})
    >>> group_tests([first, Phase("lessons", "teach"), other])
    (('before', 'after'), ('lessons',))
    """
    found: dict[object, list[str]] = {}
    for phase in phases:
        set_ = fill_settings(phase.settings, SETTINGS[phase.do])
        settings = sorted((key, str(it)) for key, it in set_.items() if key not in _ANY)
        found.setdefault((phase.do, *settings), []).append(phase.name)
    return tuple(map(tuple, found.values()))


def title_of_test(test: Sequence[str]) -> str:
    """The name of a test: its phases.

    >>> title_of_test(["test 1", "test 2"]), title_of_test(["a", "b", "c", "d"])
    ('test 1, test 2', 'a to d')
    """
    return ", ".join(test) if len(test) <= _NAMED else f"{test[0]} to {test[-1]}"


# --- what is measured in them --------------------------------------------------------


def main_measure(measures: Iterable[Measure]) -> Measure | None:
    """The measure of how often the robot is right in words, or if none, in things."""
    known = {it.name: it for it in measures}
    return known.get(ACCURACY.name) or known.get(REFERENCES.name)


def is_counted(measure: Measure, answer: ScoredAnswer) -> bool:
    """Does an answer count for the main measure?"""
    return answer.is_word == (measure is ACCURACY)


def phases_of(theories: _Theories, measure: Measure) -> list[str]:
    """The phases with questions that count, in their order.

    A phase that the first dialogues lack comes after the one that precedes it.
    """
    found: list[str] = []
    for dialogue in chain.from_iterable(theories.values()):
        asked = (it.phase for it in dialogue.answers if is_counted(measure, it))
        place = 0
        for phase in dict.fromkeys(asked):
            if phase not in found:
                found.insert(place, phase)
            place = found.index(phase) + 1
    return found


def restrict_to_phase(theories: _Theories, measure: Measure, phase: str) -> _Theories:
    """The dialogues with only those answers that count in this phase."""

    def place(answer: ScoredAnswer) -> str:
        return answer.phase if is_counted(measure, answer) else ""

    return {
        name: split_dialogues(them, place).get(phase, [])
        for name, them in theories.items()
    }
