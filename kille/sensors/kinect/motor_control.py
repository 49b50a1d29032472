"""The motor and light of a Kinect, found again whenever they come back."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from kille.sensors.kinect.devices import Kinect, KinectModel, kinects
from kille.sensors.kinect.diagnosis import no_motor
from kille.sensors.kinect.motor import GET_STATE, STATE_LENGTH
from kille.sensors.kinect.transport import (
    Connection,
    PluggedDevice,
    TransportBus,
    TransportError,
)
from kille.sensors.sensor import SensorError

_RARELY = 1.0
"""Seconds between two searches for a motor that nobody is waiting for."""

Result = TypeVar("Result")


class KinectMotor:
    """The motor of one Kinect.

    It is a USB device of its own, which may leave the bus and come back while the
    camera streams. A motor that came back is asked again for what was asked last.
    """

    def __init__(self, bus: TransportBus, kinect: Kinect) -> None:
        self._bus = bus
        self._kinect = kinect
        self._device = kinect.motor
        self._motor: Connection | None = None
        self._asked: dict[int, int] = {}
        self._undone: set[int] = set()
        self._search_at = 0.0

    def set(self, request: int, value: int) -> None:
        """Send a request, now and to every motor that comes back later.

        SensorError if there is no motor, TransportError if it cannot be had.
        """
        self._asked[request] = value
        self._undone.add(request)
        self._use(lambda motor: None)

    def state(self, at_once: bool = True) -> bytes:
        """The bytes of its state; the errors are those of `set`.

        Unless `at_once`, a motor that was not found is looked for once a second only.
        """
        if at_once:
            return self._use(_state_of)
        if self._motor is None and time.monotonic() < self._search_at:
            raise SensorError(no_motor(self._kinect))
        try:
            return self._use_once(_state_of)
        except TransportError:
            self._lose()
            raise

    def catch_up(self) -> None:
        """Do what could not be done yet, if the motor is back; look once a second."""
        if self._undone and time.monotonic() >= self._search_at:
            with suppress(TransportError, SensorError):
                self._use(lambda motor: None)

    def close(self) -> None:
        """Let go of the motor; it is opened again when it is asked for."""
        motor, self._motor = self._motor, None
        if motor is not None:
            motor.close()

    def _use(self, do: Callable[[Connection], Result]) -> Result:
        """Do it with the motor: if that fails, once more with the motor found anew."""
        try:
            return self._use_once(do)
        except TransportError:
            self._lose()
        try:
            return self._use_once(do)
        except BaseException:
            self._lose()
            raise

    def _lose(self) -> None:
        """Let go of a motor that fails: it may be another device when it is back."""
        self._device = None
        self._search_at = time.monotonic() + _RARELY
        self.close()

    def _use_once(self, do: Callable[[Connection], Result]) -> Result:
        if self._motor is None:
            self._device = self._device or self._find_motor()
            self._motor = self._bus.open(self._device, 0)
            self._undone |= self._asked.keys()
        for request in sorted(self._undone):
            self._motor.write(request, self._asked[request], 0, b"")
            self._undone.discard(request)
        return do(self._motor)

    def _find_motor(self) -> PluggedDevice:
        """The motor of this Kinect as it is plugged in now; SensorError without one."""
        if self._kinect.model is KinectModel.XBOX_1414:
            for kinect in kinects(self._bus.devices()):
                if kinect.camera.place == self._kinect.camera.place and kinect.motor:
                    return kinect.motor
        self._search_at = time.monotonic() + _RARELY
        raise SensorError(no_motor(self._kinect))


def _state_of(motor: Connection) -> bytes:
    return motor.read(GET_STATE, 0, 0, STATE_LENGTH)
