"""A second robot beside the first, with another theory: it hears and sees the same.

It lives through the events of the first, one after another, as a story that is played
again; and what it looks at is what the first has looked at. So whatever differs comes
of the theories. It has a memory of its own.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Any, NamedTuple

import numpy as np

from kille.agent.agent import Agent
from kille.agent.attention import Attention
from kille.agent.exchanges import Event, Exchange
from kille.page.live_picture import Glance, SharedSensor
from kille.page.turn_reports import lessons_of, names_report
from kille.perception.look import Sighting, look
from kille.scene import Frame, Look
from kille.sensors.sensor import Sensor, SensorError
from ttr.dialogues.stories import Line, alternatives

Json = dict[str, Any]

MakeSecond = Callable[[Sensor, Callable[[], datetime]], Agent]
"""Makes the second robot of what it looks through, and of its clock."""

_ARRANGES = frozenset({"show", "place", "remove", "seek", "scene"})
"""Verbs of commands that change the scene, and have the robot look."""

_UNSEEN = "meanwhile"
"""The verb of a command that changes the scene without a look."""


class _Lived(NamedTuple):
    """An event of the first robot's, and its looks in it."""

    event: Event
    glances: tuple[Glance, ...]


class SecondHandSensor:
    """The sensor of the second robot: what the first has seen, and no more.

    A look is the first robot's. Where the two attend to different things, another look
    is taken at the frame of that.
    """

    def __init__(self, first: SharedSensor) -> None:
        self._first = first
        self._glances: deque[Glance] = deque()
        self._latest: Glance | None = None

    @property
    def name(self) -> str:
        """What the first robot looks through."""
        return self._first.name

    def expect(self, glances: Sequence[Glance]) -> None:
        """Have the next looks be these; after them, the last of them again."""
        self._glances = deque(glances)

    def frame(self) -> Frame:
        """The frame that the first robot has read last. SensorError before any."""
        if self._first.latest is None:
            raise SensorError(f"{self.name} has not been looked through yet")
        return self._first.latest

    def look(self, scans: int, pointed: Sighting | None) -> Look:
        """The next look of the first robot's; SensorError before any."""
        if self._glances:
            self._latest = self._glances.popleft()
        if self._latest is None:
            raise SensorError(f"{self.name} has not been looked through yet")
        if _is_same_sighting(self._latest.pointed, pointed):
            return self._latest.look
        return look(_Still(self.name, self._latest.look.frame), 1, pointed)

    def close(self) -> None:
        """Nothing is to be let go of: the sensor is the first robot's."""


class _Still(NamedTuple):
    """A frame as a sensor."""

    name: str
    seen: Frame

    def frame(self) -> Frame:
        return self.seen

    def close(self) -> None:
        pass


def _is_same_sighting(one: Sighting | None, other: Sighting | None) -> bool:
    if one is None or other is None:
        return one is other
    (frame, region), (frame2, region2) = one, other
    if frame is not frame2:
        return False
    return region is region2 or np.array_equal(region.mask, region2.mask)


class SecondRobot:
    """The second robot. `note` is given each event of the first after it has happened;
    `follow` has it live through them. Both are called in the first robot's thread."""

    def __init__(self, make: MakeSecond, first: Agent) -> None:
        sensor = first.gaze.sensor
        assert isinstance(sensor, SharedSensor)
        self._looks: list[Glance] = []
        sensor.keep_glance = self._looks.append
        self._lived: list[_Lived] = []
        self._sensor = SecondHandSensor(sensor)
        self._time = first.time
        self._turns: dict[int, tuple[int, int]] = {}
        self.robot = make(self._sensor, lambda: self._time)

    def note(self, event: Event) -> None:
        """Take in what has happened to the first robot, and what that saw of it."""
        self._lived.append(_Lived(event, tuple(self._looks)))
        self._looks.clear()

    def follow(self, turn: int) -> Json | None:
        """Live through what was noted, and tell what came of it in the turn of this
        number; None if it took no turn.

        Whatever its theory raises is its own trouble, which is told as `failed`.
        """
        lived, self._lived = self._lived, []
        self._looks.clear()
        begun = len(self.robot.exchanges)
        failed = ""
        for it in lived:
            try:
                self._live_through(it)
            except Exception as error:  # its rules are anybody's
                failed = " ".join(str(error).split()) or type(error).__name__
        turns = self.robot.exchanges[begun:]
        if not turns and not failed:
            return None
        self._turns[turn] = begun, begun + len(turns)
        try:
            names = names_report(self.robot)
        except Exception as error:  # so are its meanings
            names, failed = [], failed or " ".join(str(error).split())
        return {
            "said": "\n".join(filter(None, (it.answer for it in turns))),
            "lessons": lessons_of(turns),
            "names": names,
            "failed": failed,
        }

    def turns(self, turn: int) -> Sequence[Exchange]:
        """What it did in the turn of the first robot's that began with this number."""
        return self.robot.exchanges[slice(*self._turns.get(turn, (0, 0)))]

    def close(self) -> None:
        """Let go of its memory."""
        self.robot.close()

    def _live_through(self, lived: _Lived) -> None:
        event, robot = lived.event, self.robot
        self._time = event.time
        self._sensor.expect(lived.glances)
        mark, _, text = event.line.partition(" ")
        verb, _, rest = text.partition(" ")
        if mark == "U>":
            robot.hear(text)
        elif mark == "U~":
            perhaps = alternatives(Line("", 0, mark, text))
            robot.hear_perhaps(*((it.text, it.p) for it in perhaps))
        elif verb in _ARRANGES:
            robot.gaze.attention = Attention()
            robot.look()
        elif verb == "interrupt":
            self._cut_off(rest)
        elif verb != _UNSEEN:
            robot.change_scene(text)

    def _cut_off(self, uttered: str) -> None:
        """What the first robot did not utter, it has not said either, if it was to say
        the same: only the first is heard."""
        said = self.robot.exchanges[-1].answer if self.robot.exchanges else ""
        if " ".join(said.split()).startswith(uttered):
            self.robot.interrupt(uttered)
