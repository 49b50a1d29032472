"""The process that reads a Kinect for another one; see `.process_driver`."""

from __future__ import annotations

import logging
import mmap
import os
import signal
import socket
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import FrameType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import KinectCapture, frame_of
from kille.sensors.kinect.channel import Channel
from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.devices import Kinect
from kille.sensors.kinect.frame_decoding import calibration_for, capture_of
from kille.sensors.kinect.packets import StreamCounts
from kille.sensors.kinect.process_driver import (
    PICTURE,
    ROOM,
    RequestResult,
    SharedPictures,
)
from kille.sensors.kinect.session import StreamSession
from kille.sensors.kinect.streams import COLOUR, INFRARED
from kille.sensors.kinect.transport import (
    DeviceGoneError,
    PluggedDevice,
    TransportBus,
    TransportError,
)
from kille.sensors.sensor import SensorError

_LOOK_UP = 1.0
"""Seconds between two looks whether the process that began this one lives.

When it ends its sockets are closed, and that is seen at once; unless a copy of it, made
by `fork`, has them too.
"""

_MODES = {mode.name: mode for mode in (COLOUR, INFRARED)}


def serve(connection: int, memory: int) -> None:
    """Answer all that is asked, until nobody is there to ask; then end this process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever asks ends this process
    signal.signal(signal.SIGTERM, _leave)
    try:
        _serve(Channel(socket.socket(fileno=connection)), mmap.mmap(memory, ROOM))
    finally:
        sys.stderr.flush()
        # libusb may wait for ever for a transfer that it does not give back.
        os._exit(0)


def _serve(channel: Channel, memory: mmap.mmap) -> None:
    remarks = _Remarks()
    logging.getLogger("kille").addHandler(remarks)
    parent = os.getppid()
    kinects: _Kinects | None = None
    try:
        kinects, error = _start_kinects(memory)
        channel.send(RequestResult(None, error, ()))
        while kinects is not None:
            try:
                what, given = channel.receive(_LOOK_UP)
            except TimeoutError:
                if os.getppid() != parent:
                    return
                continue
            value, error = _attempt(getattr(kinects, what), given)
            channel.send(RequestResult(value, error, remarks.take_all()))
    except (EOFError, OSError):
        return
    finally:
        if kinects is not None:
            kinects.stop()
        left = remarks.take_all()
        if left:
            # Imported here, as nothing else that this process does needs `ttr`.
            from ttr.escapes import terminal_line

            sys.stderr.writelines(f"{terminal_line(it)}\n" for it in left)


def _start_kinects(memory: mmap.mmap) -> tuple[_Kinects | None, Exception | None]:
    try:
        from kille.sensors.kinect.usb import UsbBus

        return _Kinects(UsbBus(), memory), None
    except Exception as error:
        return None, _sendable(error)


def _attempt(
    do: Callable[..., Any], given: tuple[Any, ...]
) -> tuple[Any, Exception | None]:
    """The value of a call, or the error that it raises."""
    try:
        return do(*given), None
    except Exception as error:
        return None, _sendable(error)


def _sendable(error: Exception) -> Exception:
    """The error as the other process knows it, without what it comes from."""
    if isinstance(error, TransportError | BadReplyError | SensorError | ImportError):
        return type(error)(*error.args)
    return TransportError(f"the process that reads it failed: {error!r}")


def _leave(sign: int, frame: FrameType | None) -> None:
    raise SystemExit


class _Kinects:
    """The requests that may be made: methods, called by their names."""

    def __init__(self, bus: TransportBus, memory: mmap.mmap) -> None:
        self._bus = bus
        self._memory = np.frombuffer(memory, np.uint8)
        self._known: dict[object, PluggedDevice] = {}
        self._tokens = 0
        self._session: StreamSession | None = None

    def devices(self) -> tuple[PluggedDevice, ...]:
        """What is plugged in; a number stands for what only this process has."""
        found = self._bus.devices()
        numbers = range(self._tokens, self._tokens + len(found))
        self._tokens += len(found)
        self._known = dict(zip(numbers, found, strict=True))
        return tuple(
            replace(device, key=number)
            for number, device in zip(numbers, found, strict=True)
        )

    def start(self, kinect: Kinect, colour: str) -> Calibration:
        """Open a Kinect and start its streams; those of before are stopped."""
        self.stop()
        motor = kinect.motor and self._known.get(kinect.motor.key)
        camera = self._known.get(kinect.camera.key)
        if camera is None:
            raise DeviceGoneError("the device is no longer plugged in")
        ours = replace(kinect, camera=camera, motor=motor)
        self._session = StreamSession(self._bus, ours, _MODES[colour])
        return self._session.calibration

    def counts(self) -> Mapping[str, StreamCounts]:
        """The counts of each stream."""
        return self._open_session().counts

    def frame(self, seconds: float) -> SharedPictures | None:
        """Put the next frame into the memory, if one comes in that time."""
        streams = self._open_session()
        pair = streams.wait_for_pair(seconds)
        if pair is None:
            return None
        capture = capture_of(pair, streams.colour)
        calibration = calibration_for(streams.calibration, streams.colour)
        return self._share(capture, frame_of(capture, calibration).depth)

    def capture(self, seconds: float) -> SharedPictures | None:
        """Put the next capture into the memory, if one comes in that time."""
        streams = self._open_session()
        pair = streams.wait_for_pair(seconds)
        if pair is None:
            return None
        capture = capture_of(pair, streams.colour)
        seen = self._share(capture, capture.depth)
        return seen._replace(tilt=streams.tilt_if_known())

    def why_no_pair(self) -> TransportError:
        """Why no pair came."""
        return self._open_session().why_no_pair()

    def set_motor(self, request: int, value: int) -> None:
        """Ask the motor for a tilt or a light."""
        self._open_session().set_motor(request, value)

    def motor_state(self) -> bytes:
        """The bytes of the motor's state."""
        return self._open_session().motor_state()

    def stop(self) -> None:
        """Stop the streams, if there are any."""
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _share(
        self, capture: KinectCapture, depth: NDArray[Any] | None
    ) -> SharedPictures:
        assert depth is not None
        data = depth.reshape(-1).view(np.uint8)
        self._memory[:PICTURE] = capture.colour.reshape(-1)
        self._memory[PICTURE : PICTURE + data.size] = data
        return SharedPictures(
            capture.time, capture.ticks_colour, capture.ticks_depth, capture.tilt
        )

    def _open_session(self) -> StreamSession:
        if self._session is None:
            raise DeviceGoneError("its streams have ended")
        return self._session


class _Remarks(logging.Handler):
    """Collects log records of this process for the log of the other one."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self._kept: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep it."""
        self._kept.append(record.getMessage())

    def take_all(self) -> tuple[str, ...]:
        """All that was kept since this was called last."""
        kept, self._kept = tuple(self._kept), []
        return kept
