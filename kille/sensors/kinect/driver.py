"""Who runs the streams of a Kinect for its sensor: this process, or another one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol, runtime_checkable

from kille.scene import Frame
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import KinectCapture
from kille.sensors.kinect.devices import Kinect
from kille.sensors.kinect.packets import StreamCounts
from kille.sensors.kinect.session import StreamSession
from kille.sensors.kinect.streams import Mode
from kille.sensors.kinect.transport import PluggedDevice, TransportBus


class Streams(Protocol):
    """One Kinect that streams; see `kille.sensors.kinect.session.Session`.

    Every method but `close` may raise a TransportError, BadReplyError or SensorError.
    """

    @property
    def kinect(self) -> Kinect:
        """The Kinect that streams."""
        ...

    @property
    def calibration(self) -> Calibration:
        """The calibration of its depth, as the device reports it."""
        ...

    @property
    def counts(self) -> Mapping[str, StreamCounts]:
        """The counts of each stream."""
        ...

    def frame(self, seconds: float) -> Frame:
        """The next frame; TransportError if none comes in that time."""
        ...

    def capture(self, seconds: float) -> KinectCapture:
        """The next capture, with the tilt if the motor tells it; else as `frame`."""
        ...

    def set_motor(self, request: int, value: int) -> None:
        """Ask the motor for a tilt or a light, now and whenever it comes back."""
        ...

    def motor_state(self) -> bytes:
        """The bytes of the motor's state."""
        ...

    def close(self) -> None:
        """Stop the streams and let go of the Kinect; a second call does nothing."""
        ...


@runtime_checkable
class Driver(Protocol):
    """Finds Kinects and starts their streams, one Kinect at a time."""

    def devices(self) -> tuple[PluggedDevice, ...]:
        """All of Microsoft's devices that are plugged in now, ordered by place."""
        ...

    def start(self, kinect: Kinect, colour: Mode) -> Streams:
        """Open that Kinect and start depth and the other stream."""
        ...

    def close(self) -> None:
        """Free all that it has; when it is used again it begins again."""
        ...


class LocalDriver:
    """Runs the streams in this process, on a bus.

    Their threads share the interpreter's lock with the rest of the program: while
    others compute in Python, packets are lost.
    """

    def __init__(self, bus: TransportBus) -> None:
        self._bus = bus

    def devices(self) -> tuple[PluggedDevice, ...]:
        """All of Microsoft's devices that are plugged in now, ordered by place."""
        return self._bus.devices()

    def start(self, kinect: Kinect, colour: Mode) -> StreamSession:
        """Open that Kinect and start depth and the other stream."""
        return StreamSession(self._bus, kinect, colour)

    def close(self) -> None:
        """Nothing is left to be freed."""


def driver_of(bus: TransportBus | Driver) -> Driver:
    """The driver itself, or one that runs the streams of a bus in this process."""
    return bus if isinstance(bus, Driver) else LocalDriver(bus)
