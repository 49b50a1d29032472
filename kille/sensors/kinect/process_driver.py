"""Runs the streams of a Kinect in a process of its own.

USB has to be answered thirty times a second, whatever else the robot's program does. A
thread of the same process has to share the interpreter's lock: two threads that compute
in Python make it lose half of the frames. So a second process, `.process_server`, has
libusb and puts frames together. Both talk over a pair of sockets without a name; frames
lie in memory that both have mapped. When the robot's process ends, however it does, the
sockets are closed, and the other process switches the camera off and ends too.
"""

from __future__ import annotations

import logging
import mmap
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any, NamedTuple

import numpy as np

from kille.scene import Colour, Frame
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture
from kille.sensors.kinect.channel import Channel
from kille.sensors.kinect.devices import Kinect
from kille.sensors.kinect.motor import Tilt
from kille.sensors.kinect.packets import StreamCounts
from kille.sensors.kinect.streams import Mode
from kille.sensors.kinect.transport import (
    DeviceGoneError,
    PluggedDevice,
    StalledError,
    TransportError,
)

PICTURE = 480 * 640 * 3
ROOM = PICTURE + 480 * 640 * 4
"""Bytes of memory that both processes have: a picture, and its depth in metres."""

_LIMIT = 30.0
"""Seconds in which any request is answered, also on a busy machine."""

_SLICE = 0.2
"""Seconds for which the other process waits for a pair before it answers."""

_FAREWELL = 3.0
"""Seconds in which the other process stops its streams; it needs one or two."""

_DEATH = 1.0
"""Seconds in which a process ends that was killed."""

_BEGIN = (
    "import sys; sys.path[:] = sys.argv[3:]; "
    "from kille.sensors.kinect.process_server import serve; "
    "serve(int(sys.argv[1]), int(sys.argv[2]))"
)
"""Imports what this process would import, and nothing of the folder it is run in."""

_log = logging.getLogger(__name__)


def can_be_used() -> bool:
    """Whether this system lets a process hand its sockets and memory to another."""
    return os.name == "posix" and bool(sys.executable)


class RequestResult(NamedTuple):
    """The result of a request: its value, or the error that was raised.

    `remarks` are lines for the log of whoever asked.
    """

    value: Any
    error: Exception | None
    remarks: tuple[str, ...]


class SharedPictures(NamedTuple):
    """What was seen; the picture, and behind it the depth, lie in the shared memory."""

    time: float
    ticks_colour: int
    ticks_depth: int
    tilt: Tilt | None


class ProcessDriver:
    """Runs one Kinect's streams in another process, which lives until `close`.

    Its methods may be called from any thread. A `TransportError`, `BadReplyError` or
    `SensorError` of the other process is raised here.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self._owner = os.getpid()
        self._process: subprocess.Popen[bytes] | None = None
        self._channel: Channel | None = None
        self._memory: mmap.mmap | None = None
        self._starts = 0

    def devices(self) -> tuple[PluggedDevice, ...]:
        """All of Microsoft's devices that are plugged in now, ordered by place."""
        found: tuple[PluggedDevice, ...] = self.ask("devices")
        return found

    def start(self, kinect: Kinect, colour: Mode) -> RemoteStreams:
        """Open that Kinect and start depth and the other stream."""
        with self.lock:
            calibration = self.ask("start", kinect, colour.name)
            self._starts += 1
            return RemoteStreams(self, self._starts, kinect, calibration)

    def stop(self) -> None:
        """Stop the streams and end the other process, within some seconds.

        With the process ends all that it has, also what libusb never gave back.
        """
        with self.lock, suppress(TransportError):
            if self._is_ours():
                self._answer_to("stop", (), _FAREWELL)
        self.close()

    def close(self) -> None:
        """End the other process, within some seconds; a second call does nothing."""
        with self.lock:
            self._end()

    def ask(self, what: str, *given: Any) -> Any:
        """What the other process answers; it is begun if there is none."""
        with self.lock:
            if not self._is_ours():
                self._begin()
            return self._answer_to(what, given, _LIMIT)

    def ask_of(self, start: int, what: str, *given: Any) -> Any:
        """The answer of the other process about the streams that it started then.

        Raises `DeviceGoneError` if it has ended.
        """
        with self.lock:
            if not self.has(start):
                raise DeviceGoneError("its streams have ended")
            return self.ask(what, *given)

    def has(self, start: int) -> bool:
        """Whether the streams that were started then are the other process's own."""
        return self._is_ours() and start == self._starts

    def memory(self, begin: int, end: int) -> bytearray:
        """A copy of that part of the memory, as the last answer left it."""
        assert self._memory is not None
        # Others do not get the interpreter's lock meanwhile, as with NumPy's copies.
        return bytearray(memoryview(self._memory)[begin:end])

    def _is_ours(self) -> bool:
        """Whether there is another process, and not that of which this is a copy."""
        return self._channel is not None and self._owner == os.getpid()

    def _begin(self) -> None:
        """Begin the process and wait until it is ready."""
        self._end()
        try:
            self._process = self._begin_process()
        except OSError as error:
            self._end()
            raise TransportError(f"no process can be begun for it: {error}") from error
        self._owner = os.getpid()
        self._starts += 1
        try:
            self._answer(_LIMIT)
        except Exception:
            self._end()
            raise

    def _begin_process(self) -> subprocess.Popen[bytes]:
        ours, theirs = socket.socketpair()
        memory = _shared_memory(ROOM)
        try:
            self._memory = mmap.mmap(memory, ROOM)
            self._channel = Channel(ours)
            ends = [theirs.fileno(), memory]
            return subprocess.Popen(
                [sys.executable, "-c", _BEGIN, *map(str, ends), *sys.path],
                pass_fds=ends,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                # A Ctrl-C or Ctrl-Z in the terminal is for this process alone.
                start_new_session=True,
            )
        finally:
            theirs.close()
            os.close(memory)

    def _answer_to(self, what: str, given: tuple[Any, ...], limit: float) -> Any:
        assert self._channel is not None
        with self._whole():
            self._channel.send((what, given))
        return self._answer(limit)

    def _answer(self, limit: float) -> Any:
        assert self._channel is not None
        with self._whole():
            answer: RequestResult = self._channel.receive(limit)
        for remark in answer.remarks:
            _log.warning("%s", remark)
        if answer.error is not None:
            raise answer.error
        return answer.value

    @contextmanager
    def _whole(self) -> Iterator[None]:
        """End the process if anything interrupts the block, such as Ctrl-C."""
        try:
            yield
        except TimeoutError as error:
            self._end(at_once=True)
            raise StalledError("the process that reads it does not answer") from error
        except (EOFError, OSError) as error:
            self._end()
            raise TransportError("the process that reads it has ended") from error
        except BaseException:
            self._end()
            raise

    def _end(self, at_once: bool = False) -> None:
        """Close the connection, so that the process ends, and make sure that it does.

        If a Ctrl-C interrupts this, the next call completes it.
        """
        channel, self._channel = self._channel, None
        if channel is not None:
            channel.close()
        memory, self._memory = self._memory, None
        if memory is not None:
            memory.close()
        if self._process is None:
            return
        # In a copy of this process, that other process is none of its own.
        if self._owner == os.getpid() and not _ends_within(
            self._process, 0.0 if at_once else _FAREWELL
        ):
            self._process.kill()
            _log.warning(
                "kinect: the process that reads it did not stop in time and was killed"
            )
            _ends_within(self._process, _DEATH)
        self._process = None


class RemoteStreams:
    """One Kinect that streams in the other process."""

    def __init__(
        self,
        driver: ProcessDriver,
        start: int,
        kinect: Kinect,
        calibration: Calibration,
    ) -> None:
        self.kinect = kinect
        self.calibration = calibration
        self._driver = driver
        self._start = start

    @property
    def counts(self) -> Mapping[str, StreamCounts]:
        """The counts of each stream."""
        counts: Mapping[str, StreamCounts] = self._ask("counts")
        return counts

    def frame(self, seconds: float) -> Frame:
        """The next frame; TransportError if none comes in that time."""
        seen, colour, depth = self._look("frame", seconds)
        metres = np.frombuffer(depth, np.float32).reshape(480, 640)
        return Frame(colour, metres, COLOUR_CAMERA, seen.time, {})

    def capture(self, seconds: float) -> KinectCapture:
        """The next capture, with the tilt if the motor tells it; else as `frame`."""
        seen, colour, depth = self._look("capture", seconds)
        raw = np.frombuffer(depth, np.uint16).reshape(480, 640)
        ticks = seen.ticks_colour, seen.ticks_depth
        return KinectCapture(seen.time, colour, raw, *ticks, seen.tilt)

    def set_motor(self, request: int, value: int) -> None:
        """Ask the motor for a tilt or a light, now and whenever it comes back."""
        self._ask("set_motor", request, value)

    def motor_state(self) -> bytes:
        """The bytes of the motor's state."""
        state: bytes = self._ask("motor_state")
        return state

    def close(self) -> None:
        """Stop the streams and let go of the Kinect; a second call does nothing."""
        if self._driver.has(self._start):
            self._driver.stop()

    def _look(
        self, what: str, seconds: float
    ) -> tuple[SharedPictures, Colour, bytearray]:
        """What is seen next, its picture, and the bytes of its depth."""
        deadline = time.monotonic() + seconds
        while True:
            with self._driver.lock:
                seen: SharedPictures | None = self._ask(what, min(_SLICE, seconds))
                if seen is not None:
                    picture = np.frombuffer(self._driver.memory(0, PICTURE), np.uint8)
                    end = ROOM if what == "frame" else PICTURE + 480 * 640 * 2
                    depth = self._driver.memory(PICTURE, end)
                    return seen, picture.reshape(480, 640, 3), depth
            if time.monotonic() > deadline:
                raise self._ask("why_no_pair")

    def _ask(self, what: str, *given: Any) -> Any:
        return self._driver.ask_of(self._start, what, *given)


def _ends_within(process: subprocess.Popen[bytes], seconds: float) -> bool:
    """Whether the process ends in that time."""
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def _shared_memory(size: int) -> int:
    """A descriptor of memory that has no name, and ends with those who have it."""
    if hasattr(os, "memfd_create"):
        memory = os.memfd_create("kinect")
    else:
        with tempfile.TemporaryFile() as file:
            memory = os.dup(file.fileno())
    os.truncate(memory, size)
    return memory
