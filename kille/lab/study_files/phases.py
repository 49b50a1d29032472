"""The phases of a study: what they are about, and how many turns they take at least."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from kille.lab.protocols.phases import CHANGING, RESTING, length
from kille.lab.scenes import Scene
from kille.lab.scenes.scene import KINDS
from kille.lab.settings import Problem
from kille.lab.study import Phase, Study
from kille.lab.study_files.words import SPEAKING
from kille.lab.tutors.simulated import BY

TEACHING = ("teach", "practise", "talk")
"""The phases in which words are taught."""


def is_plain(study: Study) -> bool:
    """Whether all tutors do exactly what the phases say."""
    plain = (*SPEAKING, "several")
    return all(tutor.kind in plain for tutor in study.tutors.values())


def kind_of(phase: Phase) -> str:
    """The kind of words that a phase is about."""
    return KINDS[phase.settings.get("what", "nouns")]


def kinds_of(phase: Phase) -> Collection[str]:
    """The kinds of words that are said in a phase, of which it may be about several."""
    if phase.do == "find":
        return BY[phase.settings.get("by", "both")]
    return (kind_of(phase),)


def kinds_in(study: Study) -> Collection[str]:
    """The kinds of words that are talked about; where the robot has the floor, all."""
    if any(phase.do == "talk" for phase in study.phases):
        return KINDS.values()
    about = [it for it in study.phases if it.do in ("ask", "find", *TEACHING)]
    return {kind for phase in about for kind in kinds_of(phase)}


# --- how long dialogues are -----------------------------------------------------------


def unreached_phases(study: Study, opened: Mapping[str, Scene]) -> Iterator[Problem]:
    """The first phase that is never reached in front of a scene, and why."""
    for name, scene in opened.items():
        before = turns_before(study, scene)
        for number, phase in enumerate(study.phases):
            if before[number] >= study.turns:
                told = f"{phase.name} is never reached with {name}: what is done before"
                told += f" takes {before[number]} turns, and turns = {study.turns}"
                needed = f"write turns = {before[-1]} or more for the study"
                yield Problem(("phases", number), f"{told}: {needed}")
                break


def turns_before(study: Study, scene: Scene) -> list[int]:
    """The least number of turns before each phase, and in the end.

    0 where that is not known, as of tutors who may pass things over.
    """
    tutors = study.tutors.values()
    plain = is_plain(study) and not any(it.settings.get("vocabulary") for it in tutors)
    found = [0]
    for phase in study.phases:
        turns = _least_turns(phase) * length(phase, scene) if plain else 0
        found.append(found[-1] + turns)
    return found


def _least_turns(phase: Phase) -> int:
    """The least number of turns of a task: something is shown, and something said."""
    if phase.do in CHANGING:
        return 0
    return 1 if phase.do in (*RESTING, "forget", "align") else 2
