"""One Kinect: its camera and motor, what it sees, and what is wrong with it."""

from __future__ import annotations

from kinect_emulator.calibration import LIKELY, Making
from kinect_emulator.camera import Camera, CommandError
from kinect_emulator.descriptors import MODEL_1414, NO_SERIAL, Model, Part, Role
from kinect_emulator.faults import NONE, Reply
from kinect_emulator.modes import DEPTH, MICROFRAMES_PER_SECOND, TICKS_PER_SECOND
from kinect_emulator.motor import Motor
from kinect_emulator.pictures import Show, patterns
from kinect_emulator.stream import Stream, Window

_TICKS_PER_MICROFRAME = TICKS_PER_SECOND // MICROFRAMES_PER_SECOND


class StalledError(Exception):
    """The device refuses the transfer."""


class Kinect:
    """A Kinect to plug into a host. `faults` and `show.views` may be changed at will.

    `ticks` is what the camera's clock, which all its streams share, says at first; if
    `apart` is not 0, depth has a clock that is ahead by so many ticks.
    """

    def __init__(
        self,
        show: Show | None = None,
        model: Model = MODEL_1414,
        serial: str = "B00361705021046B",
        making: Making = LIKELY,
        ticks: int = 4_000_000_000,
        apart: int = 0,
    ) -> None:
        self.show = show or patterns()
        self.model = model
        self.serial = serial
        self.camera = Camera(making, model.fixed_size)
        self.motor = Motor()
        self.faults = NONE
        self.streams: dict[int, Stream] = {}
        self._ticks = ticks
        self._apart = apart

    def serial_of(self, part: Part) -> str:
        """The serial number that part of it tells."""
        if part.role is Role.CAMERA and not self.model.camera_tells_serial:
            return NO_SERIAL
        return self.serial if part.role is Role.CAMERA else f"A{self.serial[1:]}"

    def power_cycle(self) -> None:
        """Forget all settings, as a device does that loses its power."""
        self.camera.registers.clear()
        self.streams.clear()

    def write(
        self, part: Part, request: int, value: int, data: bytes, microframe: int
    ) -> None:
        """A vendor control transfer to the device."""
        self._refuse_if_stalled()
        match part.role, request:
            case Role.CAMERA, 0:
                self._command(data, microframe)
            case Role.MOTOR, 0x31:
                self.motor.tilt_to(_signed(value), microframe / MICROFRAMES_PER_SECOND)
            case Role.MOTOR, 0x06:
                self.motor.light(value)
            case _:
                raise StalledError

    def read(self, part: Part, request: int, microframe: int) -> bytes:
        """A vendor control transfer from the device."""
        self._refuse_if_stalled()
        match part.role, request:
            case Role.CAMERA, 0:
                return self.camera.reply(microframe)
            case Role.MOTOR, 0x32:
                return self.motor.state(microframe / MICROFRAMES_PER_SECOND)
            case Role.MOTOR, 0x10:
                return b"\x22"
            case _:
                raise StalledError

    def window(self, endpoint: int, first: int, count: int) -> Window | None:
        """The packets at that endpoint, or nothing while no stream runs there."""
        stream = self.streams.get(endpoint)
        if stream is None:
            return None
        return stream.window(first, count, self.faults)

    def _refuse_if_stalled(self) -> None:
        if self.faults.stalled:
            raise StalledError

    def _command(self, message: bytes, microframe: int) -> None:
        try:
            lost = len(self.camera.heard) in self.faults.lost_replies
            reply = Reply.NEVER if lost else self.faults.reply
            self.camera.take(message, reply, microframe + self.faults.slow)
        except CommandError as error:
            raise StalledError from error
        modes = {mode.endpoint: mode for mode in self.camera.modes()}
        for endpoint in (0x81, 0x82):
            wanted, running = modes.get(endpoint), self.streams.get(endpoint)
            if wanted is None:
                self.streams.pop(endpoint, None)
            elif running is None or running.mode is not wanted:
                ticks = self._ticks + microframe * _TICKS_PER_MICROFRAME
                ticks += self._apart if endpoint == DEPTH else 0
                stream = Stream(wanted, self.show, microframe, ticks)
                self.streams[endpoint] = stream


def _signed(word: int) -> int:
    return word - 0x10000 if word & 0x8000 else word
