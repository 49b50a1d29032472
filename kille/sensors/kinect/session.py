"""One Kinect, opened and streaming, until it is closed or lost."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Mapping
from contextlib import ExitStack, suppress
from dataclasses import replace

from kille.scene import Frame
from kille.sensors.kinect.camera import FrameStream, KinectCamera
from kille.sensors.kinect.capture import KinectCapture, frame_of
from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.devices import Kinect
from kille.sensors.kinect.diagnosis import no_pictures
from kille.sensors.kinect.frame_decoding import calibration_for, capture_of
from kille.sensors.kinect.motor import Tilt
from kille.sensors.kinect.motor_control import KinectMotor
from kille.sensors.kinect.packets import RawFrame, StreamCounts
from kille.sensors.kinect.pairing import Pair, first_pair
from kille.sensors.kinect.streams import DEPTH_11, Mode
from kille.sensors.kinect.transport import TransportBus, TransportError
from kille.sensors.sensor import SensorError

_KEPT = 4
"""Frames of each kind that wait, for who is slow now and then."""

_LOOK_UP = 0.05
"""Seconds after which a wait looks whether a stream has ended."""


class StreamSession:
    """Both streams of a Kinect; `colour` is the mode of the one beside depth.

    A TransportError or BadReplyError where the Kinect cannot be opened or started.
    """

    def __init__(self, bus: TransportBus, kinect: Kinect, colour: Mode) -> None:
        self.kinect = kinect
        self.colour = colour
        self._came = threading.Condition()
        self._colours: deque[RawFrame] = deque(maxlen=_KEPT)
        self._depths: deque[RawFrame] = deque(maxlen=_KEPT)
        self._feeds: list[FrameStream] = []
        self._counts_at_last_pair: Mapping[str, StreamCounts] = {}
        self._head = KinectMotor(bus, kinect)
        self._camera = KinectCamera(bus.open(kinect.camera, kinect.model.alternate))
        try:
            self._camera.rest()
            self.calibration = self._camera.calibration()
            self._start(DEPTH_11, self._depths)
            self._start(colour, self._colours)
        except BaseException:
            self.close()
            raise

    @property
    def counts(self) -> Mapping[str, StreamCounts]:
        """What came through each stream."""
        return {feed.mode.name: feed.counts for feed in self._feeds}

    def frame(self, seconds: float) -> Frame:
        """The next frame; TransportError if none comes in that time."""
        calibration = calibration_for(self.calibration, self.colour)
        return frame_of(capture_of(self.pair(seconds), self.colour), calibration)

    def capture(self, seconds: float) -> KinectCapture:
        """The next capture, with the tilt if the motor tells it; else as `frame`."""
        capture = capture_of(self.pair(seconds), self.colour)
        return replace(capture, tilt=self.tilt_if_known())

    def tilt_if_known(self) -> Tilt | None:
        """How the Kinect stands; a lost motor is looked for once a second only."""
        try:
            return Tilt.from_reply(self._head.state(at_once=False))
        except (TransportError, BadReplyError, SensorError):
            return None

    def pair(self, seconds: float) -> Pair:
        """The next pair; TransportError if none comes in that time.

        Who asks late misses pairs: it is one of the latest few.
        """
        found = self.wait_for_pair(seconds)
        if found is None:
            raise self.why_no_pair()
        return found

    def wait_for_pair(self, seconds: float) -> Pair | None:
        """The next pair, or None if none comes in that time."""
        self._head.catch_up()
        deadline = time.monotonic() + seconds
        with self._came:
            while True:
                # First, or a Ctrl-C would wait as long as there are frames.
                self._check()
                found = first_pair(self._colours, self._depths)
                if found is not None:
                    _leave_out(self._colours, found.colour)
                    _leave_out(self._depths, found.depth)
                    self._counts_at_last_pair = self.counts
                    return found
                if time.monotonic() > deadline:
                    return None
                self._came.wait(_LOOK_UP)

    def why_no_pair(self) -> TransportError:
        """Why no pair came since the last one, as far as the packets tell."""
        before = self._counts_at_last_pair
        since = [
            it - before.get(name, StreamCounts()) for name, it in self.counts.items()
        ]
        failures = (feed.failure for feed in self._feeds)
        return TransportError(no_pictures(since, filter(None, failures)))

    def set_motor(self, request: int, value: int) -> None:
        """Ask the motor for a tilt or a light, now and whenever it comes back.

        SensorError if there is no motor, TransportError if it cannot be had.
        """
        self._head.set(request, value)

    def motor_state(self) -> bytes:
        """The bytes of the motor's state; the errors are those of `set_motor`."""
        return self._head.state()

    def close(self) -> None:
        """Stop the streams and let go of all; a second call does nothing."""
        with ExitStack() as stack:
            stack.callback(self._feeds.clear)
            for feed in self._feeds:
                stack.callback(feed.end)
            # All transfers are waited for at once, and so not longer than for one.
            stack.callback(self._camera.close)
            stack.callback(self._head.close)
            # It may be gone, or not listen: then closing has to be enough.
            stack.enter_context(suppress(TransportError, BadReplyError))
            for feed in self._feeds:
                self._camera.switch_off(feed.mode)

    def _start(self, mode: Mode, frames: deque[RawFrame]) -> None:
        def take(frame: RawFrame) -> None:
            with self._came:
                frames.append(frame)
                self._came.notify_all()

        self._feeds.append(self._camera.start(mode, take))

    def _check(self) -> None:
        for feed in self._feeds:
            ended = feed.ended
            if ended is not None:
                # A new one: the feed's own would hold on to whoever catches it.
                raise type(ended)(*ended.args)


def _leave_out(frames: deque[RawFrame], given: RawFrame) -> None:
    """All up to the one that is given."""
    while frames and frames.popleft() is not given:
        continue
