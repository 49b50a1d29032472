"""The Kinect as a source of frames: opened, waited for, and found again."""

from __future__ import annotations

import atexit
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace

import cv2
import numpy as np

from kille.scene import Colour, Frame
from kille.sensors.kinect.address import parsed
from kille.sensors.kinect.bayer import colour_of
from kille.sensors.kinect.calibration import IDENTITY, Calibration
from kille.sensors.kinect.capture import Capture, frame_of
from kille.sensors.kinect.commands import BadReply
from kille.sensors.kinect.devices import chosen
from kille.sensors.kinect.motor import (
    GET_STATE,
    SET_LIGHT,
    SET_TILT,
    STATE_LENGTH,
    Light,
    Tilt,
    tilt_value,
)
from kille.sensors.kinect.packets import Counts, RawFrame
from kille.sensors.kinect.pairing import Pair
from kille.sensors.kinect.session import Session
from kille.sensors.kinect.streams import COLOUR, INFRARED
from kille.sensors.kinect.transport import Bus, Connection, Interrupted, TransportError
from kille.sensors.kinect.troubles import no_motor, told
from kille.sensors.kinect.unpacking import unpack_10, unpack_11
from kille.sensors.sensor import SensorError

PATIENCE = 6.0
"""Seconds in which a Kinect that fails may come back, before a frame fails.

They begin with the failure, and not when the frame was asked for: a program that is
stopped, by Ctrl-Z for one, does not see time pass.
"""

_SILENCE = 2.0
"""Seconds without a frame after which the Kinect is opened again."""

_AGAIN = 0.1


class KinectSensor:
    """A Kinect on a bus, streaming from the moment it is made.

    SensorError if there is none, or it cannot be had: one line says what to do.
    """

    def __init__(self, name: str, bus: Bus) -> None:
        self._name = name
        self._bus = bus
        self._address = parsed(name)
        self._infrared = self._address.picture == "infrared"
        self._serial = self._address.serial
        self._began = time.monotonic()
        self._session: Session | None = None
        with self._telling():
            self._calibration = self._settled().calibration

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    @property
    def calibration(self) -> Calibration:
        """What turns raw depth into metres on the picture."""
        if not self._infrared:
            return self._calibration
        # Depth is measured by the infrared camera: there is nothing to move.
        plane = self._calibration.zero_plane._replace(dcmos_rcmos_distance=0.0)
        return replace(IDENTITY, zero_plane=plane)

    @property
    def counts(self) -> Mapping[str, Counts]:
        """What came through each stream since it was last started."""
        return {} if self._session is None else self._session.counts

    def frame(self) -> Frame:
        """The next frame: not an earlier one than a tenth of a second ago or so.

        A Kinect that is gone is waited for, and the frames go on when it is plugged in
        again; SensorError if that takes longer than `PATIENCE`.
        """
        return frame_of(self._captured(), self.calibration)

    def capture(self) -> Capture:
        """As `frame`, but the depth as it came; and how the Kinect stands."""
        captured = self._captured()
        try:
            return replace(captured, tilt=self.posture())
        except SensorError:
            return captured

    def tilt(self, degrees: float) -> None:
        """Turn the head up or, if negative, down. SensorError if it cannot be."""
        with self._telling():
            _motor_of(self._settled()).write(SET_TILT, tilt_value(degrees), 0, b"")

    def light(self, light: Light) -> None:
        """Set the light at the front. SensorError if it cannot be."""
        with self._telling():
            _motor_of(self._settled()).write(SET_LIGHT, light, 0, b"")

    def posture(self) -> Tilt:
        """How the Kinect stands now. SensorError if it has no motor to ask."""
        with self._telling():
            motor = _motor_of(self._settled())
            return Tilt.from_reply(motor.read(GET_STATE, 0, 0, STATE_LENGTH))

    def close(self) -> None:
        """Stop the streams and let go of the device; a second call does nothing."""
        atexit.unregister(self.close)
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _captured(self) -> Capture:
        pair = self._pair()
        return Capture(
            pair.depth.time - self._began,
            self._picture(pair.colour),
            unpack_11(pair.depth.data),
            pair.colour.ticks,
            pair.depth.ticks,
        )

    def _picture(self, frame: RawFrame) -> Colour:
        if not self._infrared:
            return colour_of(frame.data.reshape(480, 640))
        grey = (unpack_10(frame.data)[:480] >> 2).astype(np.uint8)
        return np.asarray(cv2.cvtColor(grey, cv2.COLOR_GRAY2RGB), np.uint8)

    def _pair(self) -> Pair:
        """The next pair, of a Kinect that is opened again if need be."""
        deadline = None
        while True:
            try:
                with self._telling():
                    return self._settled().pair(_SILENCE)
            except SensorError:
                self.close()
                now = time.monotonic()
                deadline = now + PATIENCE if deadline is None else deadline
                if now + _AGAIN > deadline:
                    raise
            time.sleep(_AGAIN)

    def _settled(self) -> Session:
        """The session, begun if there is none."""
        if self._session is None:
            kinect = chosen(self._bus.devices(), self._serial)
            mode = INFRARED if self._infrared else COLOUR
            session = Session(self._bus, kinect, mode)
            try:
                self._set_up(session)
            except BaseException:
                session.close()
                raise
            # From now on it has to be this one, also if others are plugged in.
            self._serial = kinect.serial or None
            self._calibration = session.calibration
            self._session = session
            # A program may end without having closed it, on Ctrl-C for one.
            atexit.register(self.close)
        return self._session

    def _set_up(self, session: Session) -> None:
        """Tilt and light as the name asks for them."""
        if self._address.tilt is not None:
            value = tilt_value(self._address.tilt)
            _motor_of(session).write(SET_TILT, value, 0, b"")
        if self._address.light is not None:
            _motor_of(session).write(SET_LIGHT, self._address.light, 0, b"")

    @contextmanager
    def _telling(self) -> Iterator[None]:
        """Whatever goes wrong is a line that begins with the sensor's name."""
        try:
            yield
        except Interrupted as error:
            # The streams are begun again by whoever asks for a frame all the same.
            self.close()
            raise KeyboardInterrupt from error
        except (TransportError, BadReply, SensorError) as error:
            raise SensorError(told(self._name, error)) from error


def _motor_of(session: Session) -> Connection:
    """The motor; SensorError if there is none that could be driven."""
    motor = session.motor()
    if motor is None:
        raise SensorError(no_motor(session.kinect))
    return motor
