"""For how long nobody has spoken, and what is in view has been still."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime

from kille.agent.attention import is_same_thing
from kille.grounding.witness_functions import thing_name
from kille.scene import Look
from ttr import Record


@dataclass(frozen=True, eq=False)
class Silence:
    """A silence by the times of events: since when, and what was seen in it last.

    `asked` says whether the robot has thought of asking something in it.
    """

    since: datetime
    now: datetime
    still_since: datetime
    seen: Look | None = None
    asked: bool = False

    @classmethod
    def begin(cls, time: datetime) -> Silence:
        """The silence after something that was said or done at this time."""
        return cls(time, time, time)

    @property
    def seconds(self) -> float:
        """How long it has lasted."""
        return (self.now - self.since).total_seconds()

    @property
    def still(self) -> float:
        """For how long nothing has moved."""
        return (self.now - self.still_since).total_seconds()

    def after(self, seen: Look, time: datetime) -> Silence:
        """The silence at a later look: what has moved is not still."""
        before = self.seen
        is_still = before is not None and not (
            missing_things(before, seen) or missing_things(seen, before)
        )
        moved = self.still_since if is_still else time
        return replace(self, now=time, seen=seen, still_since=moved)

    def ends_with_remark(self, s: Record, view_changed: bool) -> bool:
        """Whether it is long enough to say that something has changed, if it has."""
        patience = s.private.strategy.turns.remark
        if not 0.0 < patience <= min(self.seconds, self.still):
            return False
        return view_changed or bool(s.private.news and not s.shared.floor)

    def ends_with_question(self, s: Record) -> bool:
        """Whether it is long enough to ask something, for the first time in it."""
        turns = s.private.strategy.turns
        if self.asked or s.shared.floor or not 0.0 < turns.ask <= self.seconds:
            return False
        return bool(self.still >= turns.remark)


def missing_things(one: Look, other: Look) -> tuple[str, ...]:
    """The names of the things in a look that stand nowhere in another one."""
    return tuple(
        thing_name(number)
        for number, it in enumerate(one.percepts, start=1)
        if not any(is_same_thing(it, to) for to in other.percepts)
    )
