"""Answers that need no thought: a greeting, thanks, help, OK, farewell, say again."""

from __future__ import annotations

from kille.dialogue.meanings import DialogueTypes, set_to
from kille.dialogue.rules import reply, rule
from ttr import Record, replace
from ttr.updates import first


@rule(answers="AskRepeat")
def repeat(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor did not hear it: it says the same again, and does nothing anew."""
    if not s.private.last:
        return None
    said = types.record_type("Said")
    done = {label: said[label] @ () for label in ("teaches", "forgets", "drops")}
    again = tuple(set_to(move, **done) for move in s.private.last)
    return replace(s, {"private.agenda": again})


REPEATING = repeat
COURTESY = first(
    repeat,
    reply("AskRepeat", "NothingSaid", "It has said nothing that it could say again."),
    reply("AskHelp", "GiveHelp", "It says what it understands."),
    reply("Greet", "GreetBack", "A greeting is returned."),
    reply("Thank", "Welcome", "Thanks are acknowledged."),
    reply("Okay", "Noted", "The tutor has taken something in, or lets it be."),
    reply("AskDeed", "TellAbilities", "What it cannot do it says, and what it can."),
    reply("Remark", "TakeAsRemark", "What is said of no thing in view is a remark."),
    reply("Leave", "Part", "The tutor takes leave, and so does the robot."),
)
