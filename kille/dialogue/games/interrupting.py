"""The tutor speaks over the robot: what it had not yet said is not said.

What it has learned it has learned. But a claim that was cut off cannot be confirmed,
and a question of which nothing was heard not be answered. "What did you say?" has it
say all of it again, and "Go on." what was cut off.

Source: Skantze and Hjalmarsson 2013; Traum 1994 for what counts as grounded.
"""

from __future__ import annotations

from kille.dialogue.games.taking_initiative import OWN_QUESTIONS
from kille.dialogue.meanings import DialogueTypes, predicate_at, set_to
from kille.dialogue.rules import rule
from ttr import Record, RecordType, record, replace
from ttr.updates import first


@rule(when="State", on="Interrupted")
def drop_unsaid(s: Record, event: Record, *, types: DialogueTypes) -> Record:
    """The robot is cut off: what it has not said is no longer under discussion."""
    unheard = event.unsaid[bool(event.uttered) :]
    asked = 1 if any(_asks(s, it, types=types) for it in unheard) else 0
    own = [it for it in unheard if predicate_at(it, "e").name in OWN_QUESTIONS]
    cut = record(
        moves=event.unsaid,
        uttered=event.uttered,
        pending=s.shared.pending,
        qud=s.shared.qud[:asked],
    )
    changes = {
        "shared.latest": event.latest,
        "shared.pending": (),
        "shared.qud": s.shared.qud[asked:],
        "shared.cut": (cut,),
        "private.asked": s.private.asked[: len(s.private.asked) - len(own)],
    }
    return replace(s, changes)


@rule(answers="ReleaseFloor")
def say_rest(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor lets it go on: it says what it was cut off in."""
    if not s.shared.cut:
        return None
    [cut] = s.shared.cut
    return replace(say_again(s, cut.moves, types=types), {"shared.floor": ()})


@rule(answers="AskRepeat")
def repeat(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor did not hear it: it says the same again, and does nothing anew."""
    if not s.private.last:
        return None
    return say_again(s, s.private.last, types=types)


def say_again(
    s: Record, moves: tuple[RecordType, ...], *, types: DialogueTypes
) -> Record:
    """The state in which it is about to say these again, and to do nothing anew.

    What was cut off in them is under discussion again.
    """
    said = types.record_type("Said")
    done = {label: said[label] @ () for label in ("teaches", "forgets", "drops")}
    again = {"private.agenda": tuple(set_to(move, **done) for move in moves)}
    if not s.shared.cut:
        return replace(s, again)
    [cut] = s.shared.cut
    restored = {
        "shared.pending": cut.pending,
        "shared.qud": (*cut.qud, *s.shared.qud),
        "shared.cut": (),
    }
    return replace(s, again | restored)


def _asks(s: Record, move: RecordType, *, types: DialogueTypes) -> bool:
    """Whether a move has put the question under discussion that is open now."""
    if not s.shared.qud:
        return False
    name = predicate_at(move, "e").name.title().replace("_", "")
    return bool(name == s.shared.qud[0].ask or move <= types["Questioning"])


REPEATING = first(repeat, say_rest)
