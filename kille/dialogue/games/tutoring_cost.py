"""What the dialogue costs the tutor: turns, words, corrections and questions to answer.

Source: Skočaj et al. 2011; Yu, Eshghi and Lemon 2017 (tutoring cost).
"""

from __future__ import annotations

from kille.dialogue.meanings import DialogueTypes, claims, is_denial
from kille.dialogue.rules import rule
from ttr import Model, Record, RecordType, rectype, replace


def _states_after_correction(types: DialogueTypes) -> RecordType:
    """The states in which the latest move corrects the robot."""
    return rectype(shared=rectype(latest=types["Correcting"]))


@rule(when=_states_after_correction)
def count_correction(s: Record, *, model: Model, types: DialogueTypes) -> Record | None:
    """The tutor has corrected the robot, which has failed at the nouns of its claim."""
    said = s.shared.latest
    if s.shared.qud and types.has(said, "Deny", model):
        return None  # a no to its question
    failed = [
        sign
        for sign in s.private.nouns
        if any(claims(it, sign) for it in s.shared.pending)
        and (is_denial(said.content) or not claims(said.content, sign))
    ]
    return _more(
        replace(s, {"private.failed": (*s.private.failed, *failed)}), "corrections"
    )


@rule(when="State", on="Questioning")
def count_question(s: Record, said: Record) -> Record:
    """The robot has asked the tutor something."""
    return _more(s, "questions")


def _more(s: Record, what: str) -> Record:
    return replace(s, {f"private.cost.{what}": s.private.cost[what] + 1.0})


CORRECTED = count_correction
ASKED = count_question
