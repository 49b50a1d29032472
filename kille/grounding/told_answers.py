"""What the tutor told after the robot had said what a thing is.

"What is this?" - "This is a cup." - "Yes.", or "No, it is a mug.": so it is told
whether the thing was one that the robot had a word for. Who tries out what they have
just taught says nothing of what else they will ask about: so it is not told by what was
said of the same thing in the same dialogue before. Which lessons were given in this way
follows from the turns that a memory keeps with them. So a robot that starts
again knows it as before, and what is forgotten was never told.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from kille.dialogue.answered_questions import NAMING_ACTS
from kille.memory import Lesson, Memory, Turn
from kille.perception.strangers import LATEST

_LOOKED_THROUGH = 60
"""So many of the latest lessons are looked through: what is taught makes what was told
before it old."""

_BEFORE = 5
"""Turns that may lie between an answer and the lesson: the answer is denied, and the
robot asks what the thing is, then."""

_PASSED_OVER = frozenset({"deny", "ask_again"})
_ACT = re.compile(r"\be : (\w+)\(")
_THING = re.compile(r"\btarget : \[[^\]]*?\bx = (\w+) : ")


def find_familiarity(memory: Memory) -> tuple[bool, ...]:
    """Whether the robot had a word for each of the latest things that it said the name
    of, or did not know, and the tutor then told; the latest last.
    """
    found: list[bool] = []
    lessons = memory.latest(_LOOKED_THROUGH)
    for lesson in reversed(lessons):
        if _is_told_of_answer(memory, lesson) and not _is_said_again(lesson, lessons):
            word = lesson.word
            found.append(memory.first_key_of(word.kind, word.name) != lesson.key)
        if len(found) == LATEST:
            break
    return tuple(reversed(found))


def _is_told_of_answer(memory: Memory, lesson: Lesson) -> bool:
    """Does a lesson say what a thing is of which the robot has just said that?"""
    if lesson.word.kind != "object" or not lesson.holds:
        return False
    if lesson.turn.speaker == "robot":  # its claim was confirmed
        return act_of(lesson.turn) in NAMING_ACTS
    before = memory.turns_before(lesson.turn, _BEFORE)
    return _last_act(before) in NAMING_ACTS


def _is_said_again(lesson: Lesson, lessons: Sequence[Lesson]) -> bool:
    """Was a thing called the same in the same dialogue before?"""
    turn, thing = lesson.turn, _thing_of(lesson.turn)
    return any(
        it.word == lesson.word
        and it.turn.dialogue == turn.dialogue
        and it.turn.number < turn.number
        and _thing_of(it.turn) == thing
        for it in lessons
    )


def _thing_of(turn: Turn) -> str:
    """The thing that a turn is about, as it was judged; nothing for none."""
    return next(iter(_THING.findall(turn.judgement)), "")


def _last_act(turns: Sequence[Turn]) -> str:
    """What was done last, besides denying it and asking again."""
    acts = [act_of(it) for it in turns]
    return next((it for it in reversed(acts) if it not in _PASSED_OVER), "")


def act_of(turn: Turn) -> str:
    """What is done in a turn, as it was judged; nothing if it was not understood.

    >>> judged = "{e = s1} : [spkr = robot : Ind, e : assert_name(spkr, addr)]   p = 1"
    >>> act_of(Turn(1, 2, "robot", "This is a cup.", judged, "2026-01-31T12:00:00"))
    'assert_name'
    """
    return next(iter(_ACT.findall(turn.judgement)[-1:]), "")
