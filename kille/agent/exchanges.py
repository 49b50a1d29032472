"""What passes between tutor and robot in one turn, as immutable values."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import datetime

from ttr.judging import Judgement
from ttr.showing import (
    Fold,
    NotebookValue,
    Part,
    Text,
    Value,
    below,
    count_of,
    table,
)
from ttr.updates import Step
from ttr.updates.running import trace_shown


@dataclass(frozen=True)
class RobotSentence:
    """A sentence of the robot's, and the judgement of which move it was.

    `judgement` is None if it only says that it did not understand, which is no move.
    """

    text: str
    judgement: Judgement | None


@dataclass(frozen=True)
class Exchange(NotebookValue):
    """What one turn did: what was heard, the rules that ran, what was said, and when.

    `heard` is the last move of the tutor's in it; None where the robot only looked, or
    did not understand. All of a turn has the time of the event that it begins with.
    """

    text: str
    heard: Judgement | None
    steps: tuple[Step, ...]
    said: tuple[RobotSentence, ...]
    time: datetime

    def then(
        self,
        heard: Judgement | None,
        steps: Iterable[Step],
        said: Iterable[RobotSentence],
    ) -> Exchange:
        """The turn continued: with these steps and sentences, too."""
        return Exchange(
            self.text,
            self.heard if heard is None else heard,
            (*self.steps, *steps),
            (*self.said, *said),
            self.time,
        )

    def _shown_as_(self) -> Part:
        return below(
            exchange_shown(self),
            Fold(count_of(len(self.steps), "rule"), trace_shown(self.steps)),
            Fold("the state after it", _state_shown(self)) if self.steps else None,
        )

    @property
    def answer(self) -> str:
        """What was said, one sentence a line; empty for silence."""
        return "\n".join(said.text for said in self.said)


def exchange_shown(exchange: Exchange) -> Part:
    """What was heard, and what was said to it, each with the move that it was."""
    told = [("U>", exchange.text or "(a look)", exchange.heard)]
    told += [("S>", it.text, it.judgement) for it in exchange.said]

    def row(line: tuple[str, str, Judgement | None]) -> tuple[Part, ...]:
        who, words, move = line
        what = Text("") if move is None else Fold("the move", Value(move))
        return Text(who, "quiet"), Text(words, "strong"), what

    return table(("", "", ""), told, row)


def _state_shown(exchange: Exchange) -> Part:
    return Value(exchange.steps[-1].after, before=exchange.steps[0].before)


class EventClock:
    """A clock that is read once for each event, and stands still while it happens.

    It gives whole milliseconds, as logs and memories keep them.
    """

    def __init__(self, now: Callable[[], datetime]) -> None:
        self._now = now
        self.go_on()

    def go_on(self) -> None:
        """Read what time it is now."""
        now = self._now()
        self._time = now.replace(microsecond=now.microsecond // 1000 * 1000)

    def __call__(self) -> datetime:
        """When the latest event happened."""
        return self._time


@dataclass(frozen=True)
class Event:
    """Something that happened to the robot, when, and what the robot said to it.

    `line` is the line of a story that lets it happen: `U> This is a cup.`, `@ look`.
    """

    time: datetime
    line: str
    said: tuple[str, ...] = ()
