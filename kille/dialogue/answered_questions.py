"""What the robot was asked last, as its answer shows."""

from __future__ import annotations

from collections.abc import Mapping

from kille.dialogue.meanings import predicate_at
from ttr import Record

ANSWERING_ACTS: Mapping[str, frozenset[str]] = {
    "AskQuality": frozenset(
        {
            "assert_quality",
            "hedge_quality",
            "guess_quality",
            "doubt_quality",
            "admit_quality",
        }
    ),
    "AskPlace": frozenset(
        {
            "assert_place",
            "hedge_place",
            "guess_place",
            "doubt_place",
            "admit_place",
            "need_landmark",
            "need_depth",
        }
    ),
    "AskWhether": frozenset(
        {"say_yes", "say_no", "say_rather", "say_probably", "admit_whether"}
    ),
    "AskFind": frozenset({"point_out"}),
}
"""The questions, and what the robot says to them; else it was asked what a thing is."""


NAMING_ACTS = frozenset(
    {"assert_name", "hedge_name", "guess_name", "doubt_name", "admit_name", "ask_which"}
)
"""What the robot says where it was asked what a thing is."""


def last_act(s: Record) -> str:
    """The name of what the robot has said last; nothing at first."""
    for it in s.private.last[-1:]:
        return str(predicate_at(it, "e").name)
    return ""


def last_question(s: Record) -> str:
    """The name of the type of the question that the robot has answered last.

    >>> from kille.dialogue.state import initial
    >>> last_question(initial())
    'AskName'
    """
    act = last_act(s)
    return next(
        (asked for asked, them in ANSWERING_ACTS.items() if act in them), "AskName"
    )
