"""The Kinect as a source of frames: opened, waited for, and found again."""

from __future__ import annotations

import atexit
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import TypeVar

from kille.scene import Frame
from kille.sensors.kinect.address import parse_address
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import KinectCapture
from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.devices import Kinect, again, choose_kinect, kinect_name
from kille.sensors.kinect.diagnosis import explain_error
from kille.sensors.kinect.driver import Driver, Streams, driver_of
from kille.sensors.kinect.frame_decoding import calibration_for
from kille.sensors.kinect.motor import (
    SET_LIGHT,
    SET_TILT,
    Light,
    Tilt,
    light_value,
    tilt_value,
)
from kille.sensors.kinect.packets import StreamCounts
from kille.sensors.kinect.streams import COLOUR, INFRARED
from kille.sensors.kinect.transport import (
    DeviceGoneError,
    InterruptedTransferError,
    TransportBus,
    TransportError,
)
from kille.sensors.sensor import SensorError

Seen = TypeVar("Seen")

PATIENCE = 6.0
"""Seconds in which a Kinect that fails may come back, before a frame fails.

They begin with the failure, and not when the frame was asked for: a program that is
stopped, by Ctrl-Z for one, does not see time pass.
"""

_SILENCE = 2.0
"""Seconds without a frame after which the Kinect is opened again."""

_AGAIN = 0.1
_RETURNS = 2
"""How often a Kinect may vanish while it is opened for the first time."""


class KinectSensor:
    """A Kinect that streams from the moment it is made.

    It is found on a bus and read by this process, or by what a driver chooses.
    SensorError if there is none, or it cannot be had: one line says what to do.
    """

    def __init__(self, name: str, bus: TransportBus | Driver) -> None:
        self._name = name
        self._driver = driver_of(bus)
        self._began = time.monotonic()
        self._kinect: Kinect | None = None
        self._streams: Streams | None = None
        self._asked: dict[int, int] = {}
        try:
            with self._explain_errors():
                self._address = parse_address(name)
                infrared = self._address.picture == "infrared"
                self._colour = INFRARED if infrared else COLOUR
                if self._address.tilt is not None:
                    self._asked[SET_TILT] = tilt_value(self._address.tilt)
                if self._address.light is not None:
                    self._asked[SET_LIGHT] = light_value(self._address.light)
                self._calibration = self._first_streams().calibration
        except BaseException:
            self.close()
            raise

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    @property
    def calibration(self) -> Calibration:
        """What turns raw depth into metres on the picture."""
        return calibration_for(self._calibration, self._colour)

    @property
    def counts(self) -> Mapping[str, StreamCounts]:
        """What came through each stream since it was last started."""
        try:
            return {} if self._streams is None else self._streams.counts
        except TransportError:
            return {}

    def frame(self) -> Frame:
        """The next frame: not an earlier one than a tenth of a second ago or so.

        A Kinect that is gone is waited for, and the frames go on when it is plugged in
        again; SensorError if that takes longer than `PATIENCE`.
        """
        frame = self._look(lambda streams: streams.frame(_SILENCE))
        return replace(frame, time=frame.time - self._began)

    def capture(self) -> KinectCapture:
        """As `frame`, but the depth as it came; and how the Kinect stands."""
        capture = self._look(lambda streams: streams.capture(_SILENCE))
        return replace(capture, time=capture.time - self._began)

    def tilt(self, degrees: float) -> None:
        """Turn the head up or, if negative, down: from -31 to 31 degrees.

        SensorError if it cannot be. A motor that has left the bus is told when it is
        back; what was asked last counts.
        """
        with self._explain_errors():
            self._ask_motor(SET_TILT, tilt_value(degrees))

    def light(self, light: Light) -> None:
        """Set the light at the front. SensorError as for `tilt`."""
        with self._explain_errors():
            self._ask_motor(SET_LIGHT, light_value(light))

    def posture(self) -> Tilt:
        """How the Kinect stands now. SensorError if it has no motor to ask."""
        with self._explain_errors():
            return Tilt.from_reply(self._open_streams().motor_state())

    def close(self) -> None:
        """Stop the streams and let go of the device; a second call does nothing.

        It takes some seconds at most, also if the device does not answer; what did not
        end by then is a line in the log.
        """
        atexit.unregister(self.close)
        try:
            self._end_streams()
        finally:
            self._driver.close()

    def _ask_motor(self, request: int, value: int) -> None:
        streams = self._open_streams()
        self._asked[request] = value
        streams.set_motor(request, value)

    def _look(self, look: Callable[[Streams], Seen]) -> Seen:
        """What is seen by a Kinect that is opened again if need be."""
        deadline = None
        while True:
            try:
                with self._explain_errors():
                    return look(self._open_streams())
            except SensorError:
                self._end_streams()
                now = time.monotonic()
                deadline = now + PATIENCE if deadline is None else deadline
                if now + _AGAIN > deadline:
                    raise
            time.sleep(_AGAIN)

    def _first_streams(self) -> Streams:
        """The streams of a Kinect that may leave the bus and return as it is opened."""
        for _ in range(_RETURNS):
            try:
                return self._open_streams()
            except DeviceGoneError:
                continue
        return self._open_streams()

    def _open_streams(self) -> Streams:
        """The streams, started if there are none."""
        if self._streams is None:
            devices, before = self._driver.devices(), self._kinect
            # It has to be this one for ever, also if others are plugged in.
            kinect = (
                again(devices, before)
                if before
                else choose_kinect(devices, self._address.serial)
            )
            streams = self._driver.start(kinect, self._colour)
            try:
                if before:
                    self._compare(streams, before)
                self._ask_again(streams, first=before is None)
            except BaseException:
                streams.close()
                raise
            if not (before and before.serial):
                self._kinect = kinect
            self._calibration = streams.calibration
            self._streams = streams
            # A program may end without having closed it, on Ctrl-C for one.
            atexit.unregister(self.close)
            atexit.register(self.close)
        return self._streams

    def _compare(self, streams: Streams, before: Kinect) -> None:
        """SensorError if this is another Kinect than the one before.

        No two have the same calibration; it tells where serial numbers do not.
        """
        if before.serial and before.serial == streams.kinect.serial:
            return
        if streams.calibration != self._calibration:
            raise SensorError(
                f"another Kinect was plugged in where the {kinect_name(before)} was; "
                "plug in that one again, or start again to use the other"
            )

    def _ask_again(self, streams: Streams, first: bool) -> None:
        """Tilt and light, as they were asked for last.

        When it is opened first they must be had. Later, pictures do not fail for it:
        the streams ask the motor when it is back.
        """
        for request, value in self._asked.items():
            try:
                streams.set_motor(request, value)
            except (TransportError, SensorError):
                if first:
                    raise

    def _end_streams(self) -> None:
        streams, self._streams = self._streams, None
        if streams is not None:
            streams.close()

    @contextmanager
    def _explain_errors(self) -> Iterator[None]:
        """Whatever goes wrong is a line that begins with the sensor's name."""
        try:
            yield
        except InterruptedTransferError as error:
            # The streams are begun again by whoever asks for a frame all the same.
            self.close()
            raise KeyboardInterrupt from error
        except (TransportError, BadReplyError, SensorError) as error:
            raise SensorError(explain_error(self._name, error)) from error
