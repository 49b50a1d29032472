"""The camera's commands: registers written and read, parameters told."""

from __future__ import annotations

import struct
from collections import deque
from typing import NamedTuple

from kinect_emulator.calibration import Making
from kinect_emulator.faults import Reply
from kinect_emulator.modes import (
    BAYER,
    BAYER_LARGE,
    DEPTH_10,
    DEPTH_11,
    INFRARED,
    Mode,
)

READ, WRITE, FIXED, ALGORITHM, SENSOR = 0x02, 0x03, 0x04, 0x16, 0x95
VIDEO_SWITCH, DEPTH_SWITCH = 0x05, 0x06
_FULL_BUFFER = 0x200
_START = {0x0106: 0x4003, 0x0009: 0x0200}


class Heard(NamedTuple):
    """One command as it came: its number and the words of its payload."""

    command: int
    words: tuple[int, ...]


class CommandError(Exception):
    """A command that no camera would take; the transfer fails."""


class Camera:
    """The command side of one camera, with a log of all it heard."""

    def __init__(self, making: Making, fixed_size: int = 322) -> None:
        self.making = making
        self.heard: list[Heard] = []
        self.registers: dict[int, int] = {}
        self.sensor: dict[int, int] = dict(_START)
        self._fixed_size = fixed_size
        self._waiting: deque[bytes] = deque()
        self._ready = 0

    def written(self) -> list[tuple[int, int]]:
        """The registers written so far with their values, in order."""
        writes = (it.words for it in self.heard if it.command == WRITE)
        return [(register, value) for register, value in writes]

    def take(self, message: bytes, reply: Reply | None = None, ready: int = 0) -> None:
        """Carry out one command; its answer can be asked for from that time on."""
        if len(message) < 8 or message[:2] != b"GM":
            raise CommandError(f"not a command: {message[:8].hex()}")
        words, command, tag = struct.unpack_from("<3H", message, 2)
        payload = message[8:]
        if len(payload) != 2 * words:
            raise CommandError(f"{words} words announced, {len(payload)} bytes sent")
        arguments = struct.unpack(f"<{words}H", payload)
        self.heard.append(Heard(command, arguments))
        answer = self._answer(command, arguments)
        header = struct.pack("<2s3H", b"RB", len(answer) // 2, command, tag)
        if self._waiting and ready > self._ready:
            # It is still at work on the command before, whose answer comes first.
            self._waiting.extend(spoiled(header + answer, reply))
            return
        self._waiting = deque(spoiled(header + answer, reply))
        self._ready = ready

    def reply(self, now: int = 0) -> bytes:
        """What the camera answers when asked: nothing if it has nothing to say."""
        if not self._waiting or now < self._ready:
            return b""
        return self._waiting.popleft()

    def modes(self) -> tuple[Mode, ...]:
        """The streams that are switched on."""
        on = (self._depth(), self._video())
        return tuple(mode for mode in on if mode is not None)

    def _answer(self, command: int, words: tuple[int, ...]) -> bytes:
        match command, words:
            case (0x03, (register, value)):
                self.registers[register] = value
                return struct.pack("<H", 0)
            case (0x02, (register,)):
                return struct.pack("<2H", 0, self.registers.get(register, 0))
            case (0x95, (_, address, value)):
                return struct.pack("<3H", 1, address, self._sense(address, value))
            case (0x16, (0x40, *_)):
                return self.making.registration_reply()
            case (0x16, (0x41, *_)):
                return self.making.padding_reply()
            case (0x16, (0x00, *_)):
                return self.making.shift_reply()
            case (0x04, _):
                return self.making.fixed_reply(self._fixed_size)
            case _:
                raise CommandError(f"unknown command {command:#x} with {words}")

    def _sense(self, address: int, value: int) -> int:
        register = address & 0x7FFF
        if address & 0x8000:
            self.sensor[register] = value
        return self.sensor.get(register, 0)

    def _depth(self) -> Mode | None:
        if self.registers.get(DEPTH_SWITCH) != 2:
            return None
        return {3: DEPTH_11, 2: DEPTH_10}.get(self.registers.get(0x12, 3))

    def _video(self) -> Mode | None:
        match self.registers.get(VIDEO_SWITCH):
            case 1 if self.registers.get(0x0D) == 2:
                return BAYER_LARGE
            case 1:
                return BAYER
            case 3:
                return INFRARED
            case _:
                return None


def spoiled(reply: bytes, fault: Reply | None) -> tuple[bytes, ...]:
    """The reply as it is sent, poll by poll, under that fault."""
    match fault:
        case None:
            return (reply,)
        case Reply.MAGIC:
            return (b"X" + reply[1:],)
        case Reply.LENGTH:
            return (reply[:2] + b"\xff\x7f" + reply[4:],)
        case Reply.COMMAND:
            return (reply[:4] + b"\x99\x00" + reply[6:],)
        case Reply.TAG:
            return (reply[:6] + bytes(byte ^ 0x55 for byte in reply[6:8]) + reply[8:],)
        case Reply.SHORT:
            return (reply[:5],)
        case Reply.NEVER:
            return ()
        case Reply.LATE:
            return (b"", b"", bytes(_FULL_BUFFER), b"", reply)
