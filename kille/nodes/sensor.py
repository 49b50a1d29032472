"""The sensor node: it sends what a sensor sees, frame after frame."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping
from threading import Event, Lock, Thread
from typing import Any

from kille.bus import Bus, BusError, Camera, Facts, Image, Text, serve
from kille.nodes.topics import FRAMES, PROBLEMS, STAGE
from kille.scene import Frame
from kille.sensors.bus_sensor import Feed
from kille.sensors.sensor import Sensor, SensorError, Stage
from kille.sensors.stage_commands import perform
from ttr.aliases import former_names

__getattr__ = former_names(__name__, {"Sensing": "SensorNode"})

RATE = 30.0
"""Frames in a second: those of a Kinect."""

_logger = logging.getLogger("kille.nodes")

_FAULT = "by a fault of its own; the log of its node says why"

_AGAIN = 1.0
"""Seconds after which a sensor that failed is tried again."""


class SensorNode:
    """Sends the frames of a sensor, and changes its scene when it is asked to.

    `now` gives nanoseconds. The answer to a change of the scene says from which moment
    on frames show it. The sensor is read only while somebody listens.
    """

    def __init__(
        self,
        bus: Bus,
        sensor: Sensor,
        *,
        rate: float = RATE,
        feed: Feed = FRAMES,
        now: Callable[[], int] = time.time_ns,
    ) -> None:
        self._sensor, self._pause, self._now = sensor, 1 / rate, now
        self._colour = bus.publisher(feed.colour)
        self._camera = bus.publisher(feed.camera)
        self._depth = None if feed.depth is None else bus.publisher(feed.depth)
        frames = (self._colour, self._camera, self._depth)
        self._sending = tuple(it for it in frames if it is not None)
        self._problems = bus.publisher(PROBLEMS)
        self._one = Lock()
        self._trouble = ""
        self._ending = Event()
        self._serving = serve(bus, STAGE, self._change)
        self._thread = Thread(target=self._run, name="sensing", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Send no more; the sensor stays open."""
        self._ending.set()
        self._thread.join()
        self._serving.close()
        for it in (*self._sending, self._problems):
            it.close()

    # --- frames ----------------------------------------------------------------------

    def _run(self) -> None:
        due = time.monotonic()
        while not self._ending.wait(max(0.0, due - time.monotonic())):
            due = max(due + self._pause, time.monotonic())
            if not any(it.listeners for it in self._sending):
                continue
            try:
                self._send_next()
            except SensorError as error:
                self._tell(str(error))
            except Exception:
                _logger.exception("sensing")
                self._tell(f"{self._sensor.name} failed, {_FAULT}")
            else:
                self._trouble = ""
                continue
            due = time.monotonic() + _AGAIN

    def _send_next(self) -> None:
        with self._one:
            frame, stamp = self._sensor.frame(), self._now()
        self._send(frame, stamp)

    def _tell(self, trouble: str) -> None:
        """Publish what is wrong with the sensor, once for each problem."""
        if trouble != self._trouble:
            self._trouble = trouble
            self._problems.publish(Text(trouble))

    def _send(self, frame: Frame, stamp: int) -> None:
        height, width = frame.colour.shape[:2]
        lens = frame.intrinsics
        if lens is not None:
            fx, fy, cx, cy = lens.fx, lens.fy, lens.cx, lens.cy
            self._camera.publish(Camera(fx, fy, cx, cy, width, height, stamp))
        self._colour.publish(Image(frame.colour, stamp))
        if self._depth is not None and frame.depth is not None:
            self._depth.publish(Image(frame.depth, stamp))

    # --- changes of the scene --------------------------------------------------------

    def _change(self, asked: Mapping[str, Any]) -> Facts:
        """Do a command of `kille.sensors.stage_commands`, or say what can be shown."""
        try:
            return self._perform(str(asked.get("command", "")))
        except SensorError as error:
            raise BusError(str(error)) from error

    def _perform(self, command: str) -> Facts:
        if command == "things" and isinstance(self._sensor, Stage):
            return Facts({"things": list(self._sensor.things())})
        with self._one:
            perform(self._sensor, command)
            return Facts({"after": self._now()})
