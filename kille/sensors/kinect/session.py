"""One Kinect, opened and streaming, until it is closed or lost."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Mapping
from contextlib import ExitStack, suppress

from kille.sensors.kinect.camera import Camera, Feed
from kille.sensors.kinect.commands import BadReply
from kille.sensors.kinect.devices import Kinect
from kille.sensors.kinect.packets import Counts, RawFrame
from kille.sensors.kinect.pairing import Pair, first_pair
from kille.sensors.kinect.streams import DEPTH_11, Mode
from kille.sensors.kinect.transport import Bus, Connection, TransportError
from kille.sensors.kinect.troubles import no_pictures

_KEPT = 4
"""Frames of each kind that wait, for who is slow now and then."""

_LOOK_UP = 0.05
"""Seconds after which a wait looks whether a stream has ended."""


class Session:
    """Both streams of a Kinect; `colour` is the mode of the one beside depth.

    A TransportError or BadReply where the Kinect cannot be opened or started.
    """

    def __init__(self, bus: Bus, kinect: Kinect, colour: Mode) -> None:
        self.kinect = kinect
        self._bus = bus
        self._came = threading.Condition()
        self._colours: deque[RawFrame] = deque(maxlen=_KEPT)
        self._depths: deque[RawFrame] = deque(maxlen=_KEPT)
        self._feeds: list[Feed] = []
        self._motor: Connection | None = None
        self._camera = Camera(bus.open(kinect.camera, kinect.model.alternate))
        try:
            self._camera.rest()
            self.calibration = self._camera.calibration()
            self._start(DEPTH_11, self._depths)
            self._start(colour, self._colours)
        except BaseException:
            self.close()
            raise

    @property
    def counts(self) -> Mapping[str, Counts]:
        """What came through each stream."""
        return {feed.mode.name: feed.counts for feed in self._feeds}

    def pair(self, seconds: float) -> Pair:
        """The next pair; TransportError if none comes in that time.

        Who asks late misses pairs: it is one of the latest few.
        """
        deadline = time.monotonic() + seconds
        with self._came:
            while True:
                # First, or a Ctrl-C would wait as long as there are frames.
                self._check()
                found = first_pair(self._colours, self._depths)
                if found is not None:
                    _leave_out(self._colours, found.colour)
                    _leave_out(self._depths, found.depth)
                    return found
                if time.monotonic() > deadline:
                    break
                self._came.wait(_LOOK_UP)
        failures = (feed.failure for feed in self._feeds)
        raise TransportError(
            no_pictures(list(self.counts.values()), filter(None, failures))
        )

    def motor(self) -> Connection | None:
        """The motor, opened when it is asked for; None if there is none to drive."""
        if self._motor is None and self.kinect.motor is not None:
            self._motor = self._bus.open(self.kinect.motor, 0)
        return self._motor

    def close(self) -> None:
        """Stop the streams and let go of all; a second call does nothing."""
        with ExitStack() as stack:
            if self._motor is not None:
                stack.callback(self._motor.close)
            stack.callback(self._camera.close)
            stack.callback(self._feeds.clear)
            # It may be gone, or not listen: then closing has to be enough.
            stack.enter_context(suppress(TransportError, BadReply))
            for feed in self._feeds:
                self._camera.stop(feed)

    def _start(self, mode: Mode, frames: deque[RawFrame]) -> None:
        def take(frame: RawFrame) -> None:
            with self._came:
                frames.append(frame)
                self._came.notify_all()

        self._feeds.append(self._camera.start(mode, take))

    def _check(self) -> None:
        for feed in self._feeds:
            if feed.ended is not None:
                raise feed.ended


def _leave_out(frames: deque[RawFrame], given: RawFrame) -> None:
    """All up to the one that is given."""
    while frames and frames.popleft() is not given:
        continue
