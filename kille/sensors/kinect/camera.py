"""One opened camera: requests to it, and its streams."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from kille.sensors.kinect import commands
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.clock import DeviceClock, MissedMicroframes
from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.packets import Assembler, RawFrame, StreamCounts
from kille.sensors.kinect.streams import COLOUR, DEPTH_11, Mode, Script
from kille.sensors.kinect.transport import (
    Batch,
    Connection,
    IsochronousStream,
    StalledError,
    TransportError,
)

_PATIENCE = (0.3, 0.6, 1.2)
"""Seconds to wait for the answer to a command, each time that it is sent.

A reply may be lost, so that a command is sent again; and a camera may be slow, so that
it is given more time then.
"""

_PAUSE = 0.001


class KinectCamera:
    """The camera behind a connection.

    Every method but `close` may raise a TransportError, or BadReplyError if the camera
    answers nonsense three times in a row, or `StalledError` if it does not answer three
    times in a row.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._tag = 0

    def rest(self) -> None:
        """Switch off all streams: a program that ended badly may have left them on."""
        self._set(DEPTH_11.stop + COLOUR.stop)

    def calibration(self) -> Calibration:
        """The calibration of its depth."""
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

    def start(self, mode: Mode, take: Callable[[RawFrame], None]) -> FrameStream:
        """Start a stream; its whole frames are given to `take`, from another thread."""
        feed = FrameStream(mode, take)
        feed.stream = self._connection.stream(
            mode.endpoint, mode.packet_size, feed.receive
        )
        try:
            self._set(mode.start)
        except BaseException:
            feed.end()
            raise
        return feed

    def stop(self, feed: FrameStream) -> None:
        """Switch the stream off and wait for its end."""
        try:
            self._set(feed.mode.stop)
        finally:
            feed.end()

    def switch_off(self, mode: Mode) -> None:
        """Tell the camera, once only, to send no more of this stream."""
        self._set(mode.stop, _PATIENCE[:1])

    def close(self) -> None:
        """Stop all and let go; a second call does nothing."""
        self._connection.close()

    def _set(self, script: Script, patience: Sequence[float] = ()) -> None:
        for register, value in script:
            self._ask(commands.WRITE_REGISTER, (register, value), patience)

    def _ask(
        self,
        number: int,
        words: Sequence[int],
        patience: Sequence[float] = (),
    ) -> bytes:
        """The payload of the answer; what is no answer is asked for again."""
        first, (*early, last) = self._tag, patience or _PATIENCE
        for seconds in early:
            try:
                return self._ask_once(number, words, seconds, first)
            except (BadReplyError, StalledError):
                continue
        return self._ask_once(number, words, last, first)

    def _ask_once(
        self, number: int, words: Sequence[int], seconds: float, first: int
    ) -> bytes:
        """Send a command and wait for its answer, or for one to the tags since `first`.

        An answer to the same command that was sent earlier has only come late.
        """
        tag, self._tag = self._tag, (self._tag + 1) & 0xFFFF
        self._connection.write(0, 0, 0, commands.command(number, tag, words))
        deadline = time.monotonic() + seconds
        while True:
            reply = self._connection.read(0, 0, 0, commands.LONGEST_REPLY)
            # While it has nothing to say it sends nothing, or a buffer full of it.
            if len(reply) not in (0, commands.LONGEST_REPLY):
                return commands.payload(reply, number, tag, first)
            if time.monotonic() > deadline:
                raise StalledError(f"the camera does not answer command {number:#04x}")
            time.sleep(_PAUSE)


class FrameStream:
    """A stream whose packets are assembled into frames."""

    def __init__(self, mode: Mode, take: Callable[[RawFrame], None]) -> None:
        self.mode = mode
        self.stream: IsochronousStream | None = None
        self.failures = 0
        self.failure: Exception | None = None
        self._take = take
        self._assembler = Assembler(mode)
        self._clock = DeviceClock()
        self._misses = MissedMicroframes()
        self._ended: TransportError | None = None

    @property
    def counts(self) -> StreamCounts:
        """What came so far."""
        return replace(self._assembler.counts, missed=self._misses.count)

    @property
    def ended(self) -> TransportError | None:
        """Why the stream ended by itself, if it did."""
        return self._ended if self.stream is None else self.stream.ended

    def receive(self, batch: Batch) -> None:
        """Take packets. Whatever fails in taking frames is counted and kept."""
        frames = self._assembler.feed(batch)
        self._misses.count_read(len(batch.lengths))
        self._misses.reach(self._assembler.began)
        for frame in frames:
            taken = self._clock.at(frame.ticks, frame.time)
            try:
                self._take(frame._replace(time=taken))
            except Exception as error:
                self.failures += 1
                self.failure = error

    def end(self) -> None:
        """Take no more packets after this, and let go of the stream and of the taker.

        They have us, too: without this, all would be kept until a search for cycles.
        """
        stream, self.stream = self.stream, None
        self._take = _drop
        if stream is not None:
            stream.stop()
            self._ended = stream.ended


def _drop(frame: RawFrame) -> None:
    """Discard a frame that nobody takes any more."""
