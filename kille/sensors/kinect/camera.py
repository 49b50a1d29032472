"""One opened camera: what it is asked, and its streams."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from kille.sensors.kinect import commands
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.clock import Clock
from kille.sensors.kinect.commands import BadReply
from kille.sensors.kinect.packets import Assembler, Counts, RawFrame
from kille.sensors.kinect.streams import COLOUR, DEPTH_11, Mode, Script
from kille.sensors.kinect.transport import (
    Batch,
    Connection,
    Stalled,
    Stream,
    TransportError,
)

_PATIENCE = 1.0
"""Seconds within which the camera has answered a command."""

_PAUSE = 0.001
_ATTEMPTS = 3


class Camera:
    """The camera behind a connection.

    Every method but `close` may raise a TransportError, or BadReply if the camera
    answers nonsense three times in a row.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._tag = 0

    def rest(self) -> None:
        """Switch off all streams: a program that ended badly may have left them on."""
        self._set(DEPTH_11.stop + COLOUR.stop)

    def calibration(self) -> Calibration:
        """What the camera knows of its own depth."""
        registration, padding, const_shift = (
            self._ask(commands.ALGORITHM_PARAMETERS, commands.parameters(which))
            for which in (
                commands.REGISTRATION,
                commands.PADDING,
                commands.CONST_SHIFT,
            )
        )
        fixed = self._ask(commands.FIXED_PARAMETERS, [0] * 5)
        return Calibration.from_replies(registration, padding, fixed, const_shift)

    def register(self, number: int) -> int:
        """The value of a register."""
        reply = self._ask(commands.READ_REGISTER, (number,))
        return commands.register_value(reply, number)

    def start(self, mode: Mode, take: Callable[[RawFrame], None]) -> Feed:
        """Start a stream; its whole frames are given to `take`, from another thread."""
        feed = Feed(mode, take)
        feed.stream = self._connection.stream(
            mode.endpoint, mode.packet_size, feed.receive
        )
        self._set(mode.start)
        return feed

    def stop(self, feed: Feed) -> None:
        """Switch the stream off and wait for its end."""
        try:
            self._set(feed.mode.stop)
        finally:
            feed.end()

    def close(self) -> None:
        """Stop all and let go; a second call does nothing."""
        self._connection.close()

    def _set(self, script: Script) -> None:
        for register, value in script:
            self._ask(commands.WRITE_REGISTER, (register, value))

    def _ask(self, number: int, words: Sequence[int]) -> bytes:
        """The payload of the answer; what is no answer is asked for again."""
        for _ in range(_ATTEMPTS - 1):
            try:
                return self._ask_once(number, words)
            except BadReply:
                continue
        return self._ask_once(number, words)

    def _ask_once(self, number: int, words: Sequence[int]) -> bytes:
        tag, self._tag = self._tag, (self._tag + 1) & 0xFFFF
        self._connection.write(0, 0, 0, commands.command(number, tag, words))
        deadline = time.monotonic() + _PATIENCE
        while True:
            reply = self._connection.read(0, 0, 0, commands.LONGEST_REPLY)
            # While it has nothing to say it sends nothing, or a buffer full of it.
            if len(reply) not in (0, commands.LONGEST_REPLY):
                return commands.payload(reply, number, tag)
            if time.monotonic() > deadline:
                raise Stalled(f"the camera does not answer command {number:#04x}")
            time.sleep(_PAUSE)


class Feed:
    """A stream that is put together into frames."""

    def __init__(self, mode: Mode, take: Callable[[RawFrame], None]) -> None:
        self.mode = mode
        self.stream: Stream | None = None
        self.failures = 0
        self.failure: Exception | None = None
        self._take = take
        self._assembler = Assembler(mode)
        self._clock = Clock()

    @property
    def counts(self) -> Counts:
        """What came so far."""
        return self._assembler.counts

    @property
    def ended(self) -> TransportError | None:
        """Why the stream ended by itself, if it did."""
        return None if self.stream is None else self.stream.ended

    def receive(self, batch: Batch) -> None:
        """Take packets. Whatever fails in taking frames is counted and kept."""
        for frame in self._assembler.feed(batch):
            taken = self._clock.at(frame.ticks, frame.time)
            try:
                self._take(frame._replace(time=taken))
            except Exception as error:
                self.failures += 1
                self.failure = error

    def end(self) -> None:
        """No more packets after this."""
        if self.stream is not None:
            self.stream.stop()
