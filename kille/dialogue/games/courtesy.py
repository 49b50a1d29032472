"""Answers that need no thought: a greeting, thanks, help, OK, farewell, say again."""

from __future__ import annotations

from kille.dialogue.meanings import named, set_to
from kille.dialogue.moves import answering, plan
from ttr import Record, replace
from ttr.updates import Rule, first, rule


def reply(move: str, act: str, doc: str) -> Rule:
    """The rule that answers every such move by this act."""

    def answer(s: Record) -> Record:
        return plan(s, act)

    answer.__name__ = f"{act} to {move}"
    answer.__doc__ = doc
    return rule(when=answering(move))(answer)


@rule(when=answering("AskRepeat"))
def repeat(s: Record) -> Record | None:
    """The tutor did not hear it: it says the same again, and does nothing anew."""
    if not s.private.last:
        return None
    said = named("Said")
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
    reply("Leave", "Part", "The tutor takes leave, and so does the robot."),
)
