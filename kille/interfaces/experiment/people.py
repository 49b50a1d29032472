"""Whether somebody at this terminal takes part in a study, and who then plays it."""

from __future__ import annotations

from kille.studies.log import RunError
from kille.studies.running import Crew, alone, crew
from kille.studies.study import PERSON, Study

__all__ = ["crew_for", "has_people"]


def has_people(study: Study) -> bool:
    """Whether a person types what a tutor or the robot says."""
    tutors = any(it.kind == "keyboard" for it in study.tutors.values())
    return tutors or any(it.mode == PERSON for it in study.theories.values())


def crew_for(study: Study, workers: int | None, scheduler: str) -> Crew:
    """Those who play a study: with a person, the process in front of them alone.

    RunError where others were asked for that cannot be had.
    """
    if not has_people(study):
        return crew(workers, scheduler)
    if scheduler or workers not in (None, 1):
        raise RunError(
            "a person takes part in this study, whom only one process can ask: play it "
            "with --workers 1"
        )
    return alone
