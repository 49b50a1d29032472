"""Turns and views as JSON: all that the page knows of the robot."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from kille.agent.agent import Agent
from kille.agent.exchanges import Exchange
from kille.dialogue.games.clarifying import REFERENTS
from kille.dialogue.games.referring import differing_things
from kille.dialogue.language_files import plain
from kille.dialogue.meanings import is_denial, predicate_at
from kille.page.phrases import Phrases, phrases
from kille.perception.outlines import polygon_of
from kille.scene import Percept
from ttr import Record, RecordType
from ttr.escapes import terminal_text
from ttr.types.printing import notation

Json = dict[str, Any]

RIVALS = 3
"""How many names of a thing are shown: the best, and its rivals."""

YES_OR_NO = frozenset(
    {
        "AskBoth", "AskEvery", "AskForget", "AskForgetAll", "AskHeardOne", "AskHow",
        "AskKind", "AskKindStill", "AskMeant", "AskMeantToo", "AskNewName", "AskOnly",
        "AskSwapped", "OfferWord",
    }
)  # fmt: skip
"""The questions of the robot's that yes and no answer."""


def view_report(robot: Agent) -> Json:
    """What is in view: the outline of each thing, what it may be called, the focus."""
    view = robot.view
    if view is None:
        return {"size": None, "focus": None, "things": []}
    height, width = view.look.frame.colour.shape[:2]
    seen = zip(
        view.look.percepts, robot.names_in_view(), robot.beliefs_in_view(), strict=True
    )
    return {
        "size": [width, height],
        "focus": view.focus,
        "things": [
            _thing(number, *them, robot) for number, them in enumerate(seen, start=1)
        ],
    }


def names_report(robot: Agent) -> list[Json]:
    """What each thing in view may be called, by their numbers."""
    seen = zip(robot.names_in_view(), robot.beliefs_in_view(), strict=True)
    return [_names(*it, robot) for it in seen]


def _thing(
    number: int, percept: Percept, name: str, beliefs: Sequence[Record], robot: Agent
) -> Json:
    return {
        "number": number,
        "box": list(percept.region.box),
        "outline": polygon_of(percept.region.mask),
        **_names(name, beliefs, robot),
    }


def _names(name: str, beliefs: Sequence[Record], robot: Agent) -> Json:
    least = robot.state.private.strategy.bands.unlikely
    return {
        "name": name,
        "names": [
            {"word": it.sign.form, "degree": round(float(it.p), 3)}
            for it in beliefs[:RIVALS]
            if it.p >= least
        ],
    }


def turn_report(robot: Agent, turns: Iterable[Exchange]) -> Json:
    """What was said in these turns, what was learned, and what can be answered."""
    turns = tuple(turns)
    said = [it for turn in turns for it in turn.said]
    steps = [step for turn in turns for step in turn.steps]
    lessons = lessons_of(turns)
    text = phrases(plain(robot.language))
    return {
        "heard": terminal_text(" ".join(turn.text for turn in turns if turn.text)),
        "said": "\n".join(it.text for it in said),
        "lessons": lessons,
        "thing": _thing_talked_of(robot),
        "rules": [{"name": it.rule.name, "does": _first_line(it)} for it in steps],
        "answers": answers_to(robot),
        "words": len(robot.state.private.nouns),
        "undo": text.undo if any(it["learned"] for it in lessons) else "",
        "undo_last": text.undo_last if robot.state.private.lessons else "",
        "why": text.why if robot.state.shared.pending else "",
    }


def lessons_of(turns: Iterable[Exchange]) -> list[Json]:
    """What was learned and taken back in these turns."""
    steps = [step for turn in turns for step in turn.steps]
    if not steps:
        return []
    before, after = steps[0].before.private, steps[-1].after.private
    return [*_changed_lessons(before.lessons, after.lessons)]


def _first_line(step: Any) -> str:
    return str(step.rule.doc).split("\n")[0]


def _changed_lessons(
    before: Sequence[Record], after: Sequence[Record]
) -> Iterator[Json]:
    """The lessons that were learned, and those that were taken back.

    `holds` is whether a lesson says that its word is true of the thing, or is not.
    """
    for learned, ours, others in ((True, after, before), (False, before, after)):
        known = {str(it.key) for it in others}
        for lesson in ours:
            if str(lesson.key) not in known:
                yield {
                    "learned": learned,
                    "holds": not is_denial(lesson.content),
                    "word": lesson.sign.form,
                    "phrase": _with_article(lesson.sign),
                    "content": notation(lesson.content),
                }


def _thing_talked_of(robot: Agent) -> int | None:
    """The number of the thing that was just talked of, if it is in view."""
    s = robot.state
    talked = next((x for x in s.shared.topic if x in s.view.things), None)
    return None if talked is None else s.view.things.index(talked) + 1


def answers_to(robot: Agent) -> list[Json]:
    """What could be answered to what the robot has just asked or claimed.

    An answer has its text; that of a thing its number, and what it is called, too.
    """
    s, text = robot.state, phrases(plain(robot.language))
    if s.shared.qud:
        return [*_answers_to_question(robot, text)]
    claimed = [text.right, text.wrong] if s.shared.pending else []
    return [*_answers_to_own_question(robot, text), *({"says": it} for it in claimed)]


def _answers_to_question(robot: Agent, text: Phrases) -> Iterator[Json]:
    """The answers to what it asks about something that the tutor said."""
    s, names = robot.state, dict(enumerate(robot.names_in_view()))
    issue = s.shared.qud[0]
    if issue.ask in REFERENTS:
        for x in differing_things(issue.options)[1]:
            if x in s.view.things:
                n = s.view.things.index(x)
                yield {"says": f"#{n + 1}", "thing": n + 1, "name": names.get(n, "")}
    elif issue.ask in YES_OR_NO:
        yield {"says": text.yes}
        yield {"says": text.no}


def _answers_to_own_question(robot: Agent, text: Phrases) -> Iterator[Json]:
    """The answers to a question of its own between two names of a thing."""
    latest = robot.exchanges[-1:]
    for said in (it for turn in latest for it in turn.said):
        judgement = said.judgement
        if judgement is None or not isinstance(judgement.type, RecordType):
            continue
        if predicate_at(judgement.type, "e").name == "ask_which":
            for sign in judgement.sit.signs:
                yield {"says": text.call.format(a_word=_with_article(sign))}


def _with_article(sign: Record) -> str:
    """A word as it is called: "a cup", "red"."""
    return f"{sign.article} {sign.form}".strip()
