"""Who speaks: "Wait." keeps the floor with the tutor, "Go on." gives it back.

While the floor is kept the robot answers, and starts nothing by itself. What was under
discussion stays so.

Source: Sacks, Schegloff and Jefferson 1974; Skantze, Hjalmarsson and Oertel 2014.
"""

from __future__ import annotations

from kille.dialogue.games.breaking_silence import remark_on_news
from kille.dialogue.games.taking_initiative import ask_most_wanted
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.moves import plan
from kille.dialogue.rules import rule
from ttr import Model, Record, replace
from ttr.updates import first


@rule(answers="HoldFloor")
def hold_floor(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor keeps the floor: the robot starts nothing until they give it back."""
    planned = plan(s, "Wait", types=types)
    kept = {"shared.floor": (s.shared.latest.spkr,), "shared.pending": s.shared.pending}
    return replace(planned, kept)


@rule(answers="ReleaseFloor")
def take_floor(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor gives the floor to the robot: it says what is new, or asks."""
    if s.shared.qud:
        return None
    free = _free_floor(s)
    remarked = remark_on_news(free, model, types=types)
    return remarked or ask_most_wanted(free, model, types=types)


@rule(answers="ReleaseFloor")
def free_floor(s: Record, *, types: DialogueTypes) -> Record:
    """The robot may speak again, and has nothing to say."""
    planned = plan(s, "Noted", types=types)
    return replace(_free_floor(planned), {"shared.pending": s.shared.pending})


def _free_floor(s: Record) -> Record:
    return replace(s, {"shared.floor": ()}) if s.shared.floor else s


HOLDING_FLOOR = first(hold_floor, take_floor, free_floor)
