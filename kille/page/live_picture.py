"""The robot's sensor, whose frames are also shown while the robot has no use for them.

A thread reads a frame thirty times a second if somebody looks at the page and the robot
does not read. Who reads shows: a look of the robot's is seen while it is taken. Only
the newest frame is kept, as a JPEG, and none is made where nobody looks.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Condition, Lock, Thread
from time import monotonic
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.agent.attention import LookingSensor
from kille.perception.look import Sighting, look
from kille.scene import Colour, Frame, Look
from kille.sensors.sensor import (
    At,
    Beside,
    PlannedStage,
    Seekable,
    Sensor,
    SensorError,
    Stage,
    TablePlan,
)

RATE = 30.0
"""Frames a second, at most."""

QUALITY = 80
"""Of JPEG, in percent."""

_REST = 0.1
"""Seconds between two looks for somebody who watches."""

_RETRY = 1.0
"""Seconds after which a camera that failed is read again."""

_CHECK = 0.2
"""Seconds between two looks for a change of the scene."""

_CELL = 8
"""Pixels of a cell, of which the mean is compared."""

_OTHER, _CELLS = 24, 12
"""By so much the grey of a cell has changed, and so many cells at least: a thing has
come, gone or moved. Noise and light make less of a difference."""

_ON_ITS_OWN = ("synthetic", "kinect", "ros")
"""Sensors that have a new frame whether anybody reads it or not.

A recording is read by the robot alone, so that no part of it goes by unseen.
"""


class Watcher(NamedTuple):
    """Somebody who watches: what wakes them, and whether they can take a picture."""

    wake: Callable[[], object]
    can_take: Callable[[], bool] = lambda: True


class Glance(NamedTuple):
    """A look of the robot's, and what the tutor pointed at in it."""

    look: Look
    pointed: Sighting | None


class Picture(NamedTuple):
    """The newest picture, and how many there were: its number."""

    number: int
    jpeg: bytes


class LivePicture:
    """The newest frame of a sensor as a JPEG, while anybody watches it.

    `tell` is given what is wrong with the camera, and an empty text when it is well
    again. `on_check` is told now and then whether the scene is another than at the
    robot's latest look.
    """

    def __init__(self, tell: Callable[[str], object] = lambda _: None) -> None:
        self._tell = tell
        self.on_check: Callable[[bool], object] = lambda _: None
        self._check = 0.0  # when it is seen whether the scene has changed
        self._changed = Condition()
        self._newest: Frame | None = None
        self._due = 0.0  # when a frame is read that nobody asked for
        self._watchers: list[Watcher] = []
        self._picture: Picture | None = None
        self._colour: Colour | None = None
        self._sensor: SharedSensor | None = None
        self._closed = False
        self._trouble = ""
        self._thread = Thread(target=self._go_on, name="kille-picture", daemon=True)

    @property
    def newest(self) -> Picture | None:
        """The newest picture; None before the first."""
        return self._picture

    def share(self, sensor: Sensor) -> Sensor:
        """The sensor for the robot; what it reads is shown."""
        with self._changed:
            self._sensor = _shared_kind(sensor)(sensor, self)
            if not self._thread.is_alive():
                self._thread.start()
            return self._sensor

    def show(self, frame: Frame) -> None:
        """Take a frame to be shown, in no time: another thread encodes it."""
        with self._changed:
            self._newest, self._due = frame, monotonic() + 1 / RATE
            self._changed.notify()

    @contextmanager
    def watched_by(self, watcher: Watcher) -> Iterator[None]:
        """Have somebody woken for each new picture."""
        with self._changed:
            self._watchers.append(watcher)
            self._changed.notify()
        try:
            yield
        finally:
            with self._changed:
                self._watchers.remove(watcher)

    def go_on(self) -> None:
        """Somebody who watches can take a picture again."""
        with self._changed:
            self._changed.notify()

    def close(self) -> None:
        """Show no more."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        if self._thread.is_alive():
            self._thread.join(_RETRY)

    def _go_on(self) -> None:
        while True:
            with self._changed:
                if self._newest is None or not self._is_wanted:
                    self._changed.wait(self._pause())
                if self._closed:
                    return
                frame = None
                if self._is_wanted:
                    frame, self._newest = self._newest, None
                due, is_due = self._due, self._runs and monotonic() >= self._due
            wait = self._work(frame, self._sensor if is_due else None)
            if wait:
                with self._changed:
                    self._due = max(due + wait, monotonic())

    @property
    def _is_wanted(self) -> bool:
        """Whether anybody who watches can take a picture."""
        return any(it.can_take() for it in self._watchers)

    @property
    def _runs(self) -> bool:
        """Whether frames are read that nobody but a browser asks for."""
        sensor = self._sensor
        return sensor is not None and sensor.runs_by_itself and self._is_wanted

    def _pause(self) -> float:
        """Seconds until such a frame is due, or until somebody may watch."""
        return max(0.0, self._due - monotonic()) if self._runs else _REST

    def _work(self, frame: Frame | None, sensor: SharedSensor | None) -> float:
        """Encode a frame, and read one that nobody asked for, if either is given.

        Returns how long to wait before the next is read; 0 to leave that as it is.
        Whatever goes wrong is told in one line, and the thread goes on.
        """
        try:
            if frame is not None:
                self._encode(frame)
            if sensor is None:
                return 0.0
            self._check_scene(sensor, sensor.show_next())
        except Exception as error:
            if not self._closed:
                self._complain(_line_about(error))
            return _RETRY
        self._complain("")
        return 1 / RATE

    def _check_scene(self, sensor: SharedSensor, frame: Frame) -> None:
        if sensor.looked_at is None or monotonic() < self._check:
            return
        self._check = monotonic() + _CHECK
        self.on_check(is_another_scene(sensor.looked_at.colour, frame.colour))

    def _complain(self, trouble: str) -> None:
        """Tell of trouble with the camera once, and once that it is over."""
        if trouble != self._trouble:
            self._trouble = trouble
            self._tell(trouble)

    def _encode(self, frame: Frame) -> None:
        if frame.colour is self._colour:
            return
        self._colour = frame.colour
        number = 1 if self._picture is None else self._picture.number + 1
        self._picture = Picture(number, encode_jpeg(frame.colour))
        with self._changed:
            watchers = tuple(self._watchers)
        for it in watchers:
            it.wake()


def is_another_scene(before: Colour, after: Colour) -> bool:
    """Whether something is elsewhere in a picture than in an earlier one.

    That all of it is lighter or darker does not count.

    >>> import numpy as np
    >>> table = np.full((480, 640, 3), 200, np.uint8)
    >>> cup = table.copy()
    >>> cup[200:260, 300:350] = 20
    >>> is_another_scene(table, table - 40), is_another_scene(table, cup)
    (False, True)
    """
    if before.shape != after.shape:
        return True
    apart = _cells(after) - _cells(before)
    apart -= np.median(apart)
    return int(np.count_nonzero(np.abs(apart) > _OTHER)) >= _CELLS


def _cells(colour: Colour) -> NDArray[np.float32]:
    height, width = colour.shape[:2]
    size = max(1, width // _CELL), max(1, height // _CELL)
    small = cv2.resize(colour, size, interpolation=cv2.INTER_AREA)
    return cv2.cvtColor(small, cv2.COLOR_RGB2GRAY).astype(np.float32)


def _line_about(error: Exception) -> str:
    """What went wrong: a sensor says it itself."""
    if isinstance(error, SensorError):
        return str(error)
    return " ".join(f"there is no picture: {error or type(error).__name__}".split())


class SharedSensor:
    """A sensor that is read by one at a time, and shows what was read.

    `latest` is the frame that the robot has read last, `looked_at` that of its latest
    look; `keep_glance`, if it is set, is given each look of the robot's.
    """

    def __init__(self, sensor: Sensor, picture: LivePicture) -> None:
        self._sensor, self._picture = sensor, picture
        self._reading = Lock()
        self.latest: Frame | None = None
        self.looked_at: Frame | None = None
        self.keep_glance: Callable[[Glance], object] | None = None
        kind = re.split(r"[:?]", sensor.name, maxsplit=1)[0]
        self.runs_by_itself = kind in _ON_ITS_OWN

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._sensor.name

    def frame(self) -> Frame:
        """The next frame, for the robot. SensorError as the sensor raises it."""
        self.latest = self.show_next()
        return self.latest

    def show_next(self) -> Frame:
        """The next frame, to be shown alone. SensorError as the sensor raises it."""
        with self._reading:
            frame = self._sensor.frame()
        self._picture.show(frame)
        return frame

    def look(self, scans: int, pointed: Sighting | None) -> Look:
        """A look of the robot's. SensorError as the sensor raises it."""
        sensor = self._sensor
        if isinstance(sensor, LookingSensor):
            with self._reading:
                seen = sensor.look(scans, pointed)
            self.latest = seen.frame
            self._picture.show(seen.frame)
        else:
            seen = look(self, scans, pointed)
        self.looked_at = seen.frame
        if self.keep_glance is not None:
            self.keep_glance(Glance(seen, pointed))
        return seen

    def close(self) -> None:
        """Let go of the source."""
        with self._reading:
            self._sensor.close()


class SharedStage(SharedSensor):
    """Such a sensor whose scene can be changed."""

    _sensor: Stage  # type: ignore[assignment]

    def things(self) -> tuple[str, ...]:
        """The names of all that can be shown."""
        return self._sensor.things()

    def show(self, name: str) -> None:
        """Show only this object."""
        with self._reading:
            self._sensor.show(name)

    def place(self, name: str, spot: At | Beside) -> None:
        """Put the object there and leave the others where they are."""
        with self._reading:
            self._sensor.place(name, spot)

    def remove(self, name: str) -> None:
        """Take the object away."""
        with self._reading:
            self._sensor.remove(name)


class SharedPlannedStage(SharedStage):
    """Such a stage that knows where everything stands."""

    _sensor: PlannedStage

    def plan(self) -> TablePlan:
        """The table as it is now."""
        return self._sensor.plan()


class SharedRecording(SharedSensor):
    """Such a recording in which one can go to any moment."""

    _sensor: Seekable  # type: ignore[assignment]

    @property
    def length(self) -> float:
        """Seconds from the first frame to the last."""
        return self._sensor.length

    @property
    def position(self) -> float:
        """Where the next frame is, in seconds since the first."""
        return self._sensor.position

    def seek(self, seconds: float) -> None:
        """Go to the first frame at or after so many seconds since the first."""
        with self._reading:
            self._sensor.seek(seconds)


def _shared_kind(sensor: Sensor) -> type[SharedSensor]:
    """What such a sensor is as a shared one: it can do the same."""
    match sensor:
        case PlannedStage():
            return SharedPlannedStage
        case Stage():
            return SharedStage
        case Seekable():
            return SharedRecording
    return SharedSensor


def encode_jpeg(colour: Colour) -> bytes:
    """A picture (H, W, 3) RGB as a JPEG."""
    _, encoded = cv2.imencode(
        ".jpg",
        cv2.cvtColor(colour, cv2.COLOR_RGB2BGR),
        [cv2.IMWRITE_JPEG_QUALITY, QUALITY],
    )
    return bytes(encoded.tobytes())
