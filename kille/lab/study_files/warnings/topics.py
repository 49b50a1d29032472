"""What is talked about in a study, as far as its file says."""

from __future__ import annotations

from collections.abc import Collection

from kille.lab.scenes.occasions import KINDS
from kille.lab.study import Phase, Study
from kille.lab.study_files.named_words import SPEAKING
from kille.lab.tutors.simulated import BY

TEACHING = ("teach", "practise", "talk")
"""The phases in which words are taught."""


def is_plain(study: Study) -> bool:
    """Whether all tutors do what the phases say, and nothing else."""
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
