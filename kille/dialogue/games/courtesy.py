"""Answers that need no thought: a greeting, thanks, help, OK, farewell, say again."""

from __future__ import annotations

from kille.dialogue.games.interrupting import repeat
from kille.dialogue.rules import reply
from ttr.updates import first

COURTESY = first(
    repeat,
    reply("AskRepeat", "NothingSaid", "It has said nothing that it could say again."),
    reply("AskHelp", "GiveHelp", "It says what it understands."),
    reply("Greet", "GreetBack", "A greeting is returned."),
    reply("Thank", "Welcome", "Thanks are acknowledged."),
    reply("Okay", "Noted", "The tutor has taken something in, or lets it be."),
    reply("AskSelf", "Introduce", "Asked who it is, it says what it does."),
    reply("AskDeed", "TellAbilities", "What it cannot do it says, and what it can."),
    reply("AskBeyond", "AdmitBeyond", "Of what is beyond the table it knows nothing."),
    reply("Define", "NeedExample", "It learns words from examples, not definitions."),
    reply("Remark", "TakeAsRemark", "What is said of no thing in view is a remark."),
    reply("TellUse", "TellScope", "What things are for it cannot see, and says so."),
    reply("NameOne", "TellNames", "It learns words for kinds, not names of one thing."),
    reply("Leave", "Part", "The tutor takes leave, and so does the robot."),
)
