"""What is said in a dialogue, turn by turn, as a memory keeps it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import datetime

from kille.memory import Memory, Turn

_QUOTABLE = 16
"""How many of the tutor's latest texts can be quoted."""


class DialogueLog:
    """The turns of one dialogue, numbered from 1; `turn` is the present one.

    A look in which nothing is said or learned is not a turn. Errors of the memory are
    MemoryFileError.
    """

    def __init__(self, memory: Memory, now: Callable[[], datetime]) -> None:
        self._memory, self._now = memory, now
        self._dialogue = memory.begin_dialogue(self._time())
        self._turns = 0
        self._heard: dict[str, Turn] = {}
        self._quoted: Turn | None = None
        self._said: Turn | None = None
        self.turn = self._next("world", "")

    def begin_look(self) -> None:
        """Begin a turn in which the robot looks unasked."""
        self.turn = self._next("world", "")

    def record_heard(self, text: str) -> None:
        """Record what the tutor says."""
        self.turn = self._record(self._next("tutor", text))
        self._quoted = None
        self._heard[text] = self.turn
        for oldest in list(self._heard)[:-_QUOTABLE]:
            del self._heard[oldest]

    def quote(self, text: str) -> None:
        """Take what the tutor said before as the source of the lessons of this turn.

        So a lesson that the tutor has confirmed by "Yes." is kept in their own words.
        """
        self._quoted = self._heard.get(text)

    def quote_robot(self) -> None:
        """Take what the robot said last as the source of the lessons of this turn.

        So what the tutor has confirmed by "Yes." is kept as the robot has said it.
        """
        self._quoted = self._said

    def record_judgement(self, judgement: str) -> None:
        """Record as what the tutor's sentence was understood."""
        completed = dataclasses.replace(self.turn, judgement=judgement)
        self._memory.record_turn(completed)
        if self._heard.get(self.turn.text) == self.turn:
            self._heard[self.turn.text] = completed

    def record_said(self, text: str, judgement: str = "") -> None:
        """Record what the robot says."""
        self._said = self._record(self._next("robot", text, judgement))

    def record_source(self) -> Turn:
        """Record the turn in which a lesson was said, mostly this one; returns it."""
        return self._record(self.turn) if self._quoted is None else self._quoted

    @contextmanager
    def all_or_nothing(self) -> Iterator[None]:
        """Count the turns recorded inside, or none of them if anything fails."""
        turns = self._turns
        try:
            yield
        except BaseException:
            self._turns = turns
            raise

    def _next(self, speaker: str, text: str, judgement: str = "") -> Turn:
        number = self._turns + 1
        return Turn(self._dialogue, number, speaker, text, judgement, self._time())

    def _record(self, turn: Turn) -> Turn:
        self._memory.record_turn(turn)
        self._turns = max(self._turns, turn.number)
        return turn

    def _time(self) -> str:
        return self._now().isoformat(timespec="milliseconds")
