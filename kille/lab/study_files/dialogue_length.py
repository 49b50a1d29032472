"""How long dialogues are at least: phases that the last turn comes before."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from kille.lab.protocols.phases import CHANGING, RESTING, length
from kille.lab.scenes import Scene
from kille.lab.study import Phase, Study
from kille.lab.study_files.problems import Trouble

_PLAIN = ("simulated", "people", "several")
"""The tutors of whom it is known how many turns they take at least."""


def unreached(study: Study, opened: Mapping[str, Scene]) -> Iterator[Trouble]:
    """The first phase that is never reached in front of a scene, and why."""
    for name, scene in opened.items():
        before = begins(study, scene)
        for number, phase in enumerate(study.phases):
            if before[number] >= study.turns:
                told = f"{phase.name} is never reached with {name}: what is done before"
                told += f" takes {before[number]} turns, and turns = {study.turns}"
                needed = f"write turns = {before[-1]} or more for the study"
                yield Trouble(("phases", number), f"{told}: {needed}")
                break


def begins(study: Study, scene: Scene) -> list[int]:
    """How many turns there are at least before each phase, and in the end.

    0 where that is not known, as of tutors who may pass things over.
    """
    plain = all(
        it.kind in _PLAIN and not it.settings.get("vocabulary")
        for it in study.tutors.values()
    )
    found = [0]
    for phase in study.phases:
        turns = _least(phase) * length(phase, scene) if plain else 0
        found.append(found[-1] + turns)
    return found


def _least(phase: Phase) -> int:
    """How many turns a task takes at least: something is shown, and something said."""
    if phase.do in CHANGING:
        return 0
    return 1 if phase.do in (*RESTING, "forget", "align") else 2
