"""What the talk is about, by which the readings of a sentence are weighed."""

from __future__ import annotations

from typing import NamedTuple

from kille.dialogue.answered_questions import last_question
from kille.dialogue.meanings import predicate_at, values_at
from kille.dialogue.reference import things_in
from kille.dialogue.state import words
from ttr import Record

ASKING_NAME = frozenset({"admit_name", "ask_thing", "ask_again", "ask_which"})
"""What the robot says when it wants to be told what a thing is."""

ASKING_WHICH = ("AskReferent", "AskReferentAgain")
"""The questions which thing is meant."""


class Situation(NamedTuple):
    """What readings are weighed by: what the talk is about, and what is in view."""

    asks_name: bool = False
    """The robot has asked what a thing is."""
    asked: str = "AskName"
    """The question that the tutor has asked last."""
    asks_which: bool = False
    """It has asked which thing is meant."""
    asks_whether: bool = False
    """It has claimed something, or asked something that yes and no answer."""
    things: int = 0
    """How many things are in view."""
    known: frozenset[str] = frozenset()
    """The words that it knows."""
    qualities: frozenset[str] = frozenset()
    """Those of them that say how things are."""
    points: bool = False
    """The tutor points at something."""
    points_anew: bool = False
    """The tutor points at something else than what was just spoken of."""
    has_learned: bool = False
    """The last that the robot said is what it has just learned."""
    colours: frozenset[str] = frozenset()
    """Those of them that say of what colour things are."""


def situation_of(s: Record) -> Situation:
    """What the readings of a sentence are weighed by, in a state.

    >>> from kille.dialogue.state import initial
    >>> situation_of(initial()).things
    0
    """
    open_ = s.shared.qud[0].ask if s.shared.qud else ""
    said = {predicate_at(move, "e").name for move in s.private.last[-1:]}
    latest = s.shared.latest
    spoken_of = {*things_in(latest.content)} if "content" in latest else set()
    return Situation(
        asks_name=bool(said & ASKING_NAME),
        asked=last_question(s),
        asks_which=open_ in ASKING_WHICH,
        asks_whether=bool(s.shared.pending)
        or bool(open_ and open_ not in ASKING_WHICH),
        things=len(s.view.things),
        known=frozenset(it.form for it in words(s)),
        qualities=frozenset(it.form for it in s.private.adjectives),
        points=bool(s.view.pointed),
        points_anew=not {*s.view.pointed} <= spoken_of,
        has_learned=any(values_at(move, "teaches") for move in s.private.last[-1:]),
        colours=frozenset(it.form for it in s.private.colours),
    )
