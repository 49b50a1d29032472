"""Recording from a sensor: captures go to the disk behind a queue, as they come."""

from __future__ import annotations

import errno
import math
import shutil
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from functools import partial
from pathlib import Path
from queue import Queue
from typing import Self

from kille.sensors.kinect.capture import KinectCapture, RawSource
from kille.sensors.recordings.fakenect_writing import CAPTURE_BYTES, FakenectWriter
from kille.sensors.recordings.output_paths import empty, home, is_empty
from kille.sensors.recordings.playback import RecordingOverError
from kille.sensors.recordings.raw_frames import lens_of

RESERVE = 200_000_000
"""Bytes that are left free on the disk."""

BACKLOG = 60
"""Captures that may wait for the disk: two seconds of a Kinect, 92 MB."""

SYNCED_EVERY = 1.0
"""Seconds between the times at which the disk is made to hold all there is."""

_FULL = (errno.ENOSPC, errno.EDQUOT)

_AGES = 1e12
"""Seconds."""


class RecordingEnd(Enum):
    """Why a recording ended."""

    ASKED = "as long as asked"
    OVER = "the source is over"
    STOPPED = "stopped"
    FULL = "the disk is full"


@dataclass(frozen=True)
class Limits:
    """How long to record; None is until something else ends it.

    `seconds` are those of the sensor: of a simulated one or a replay they pass faster.
    """

    frames: int | None = None
    seconds: float | None = None

    def are_reached(self, so_far: RecordingProgress) -> bool:
        """Whether it is enough."""
        enough = self.frames is not None and so_far.frames >= self.frames
        # A thirtieth of a second, thirty times, may be a hair less than a second.
        return enough or (
            self.seconds is not None and so_far.span >= self.seconds - 1e-6
        )

    @property
    def bytes(self) -> int:
        """What it will take on the disk, 0 if nobody knows."""
        # No disk has room for ages: as many as can be counted will do.
        frames = self.frames or round(min(self.seconds or 0.0, _AGES) * 30)
        return frames * CAPTURE_BYTES


@dataclass(frozen=True)
class RecordingProgress:
    """Frames and seconds recorded so far, and the bytes that are left free."""

    frames: int = 0
    seconds: float = 0.0
    free: int = 0
    end: RecordingEnd | None = None

    @property
    def bytes(self) -> int:
        """What the frames take on the disk."""
        return self.frames * CAPTURE_BYTES

    @property
    def span(self) -> float:
        """Seconds from the first frame to the end of the last."""
        gaps = self.frames - 1
        return self.seconds + (self.seconds / gaps if gaps > 0 else 0.0)


class NoRoomError(Exception):
    """The disk has no room for the recording: bytes needed and free."""

    def __init__(self, needed: int, free: int) -> None:
        super().__init__(needed, free)
        self.needed = needed
        self.free = free


@dataclass(frozen=True)
class Disk:
    """The free space on the disk of the recording, and how much must stay free."""

    free: Callable[[Path], int]
    reserve: int = RESERVE

    @classmethod
    def real(cls) -> Self:
        """The computer's own."""
        return cls(lambda folder: shutil.disk_usage(folder).free)


def check_room(folder: Path, limits: Limits, disk: Disk) -> None:
    """Raise NoRoomError if the recording will not fit, as far as its size is known."""
    free = disk.free(folder)
    needed = max(limits.bytes, CAPTURE_BYTES) + disk.reserve
    if free < needed:
        raise NoRoomError(needed, free)


def record(
    source: RawSource,
    folder: Path,
    limits: Limits,
    disk: Disk,
    tell: Callable[[RecordingProgress], None],
    began: float | None = None,
) -> RecordingProgress:
    """Record into a new or empty folder until something ends it; how far it came.

    `tell` is called after every capture. A full disk ends it, Ctrl-C ends it, and what
    is there then is whole; if nothing is, the folder is left as it was. SensorError if
    the source fails, OSError if the disk does. `began` is the time of the computer that
    the first capture gets, now without it.
    """
    was_there = folder.exists()
    if was_there and not is_empty(folder):
        raise FileExistsError(errno.EEXIST, "something is there already", str(folder))
    start = time.time() if began is None else began
    known = (source.calibration, lens_of(source), start)
    behind = _BackgroundWriter(partial(FakenectWriter, folder, *known))
    progress = RecordingProgress()
    try:
        for progress in _capture_all(source, behind, limits, disk, folder):
            tell(progress)
    except RecordingOverError:
        progress = replace(progress, end=RecordingEnd.OVER)
    except KeyboardInterrupt:
        progress = replace(progress, end=RecordingEnd.STOPPED)
    finally:
        behind.close()
        if not behind.written:
            _take_back(folder, was_there)
    if isinstance(behind.error, OSError) and behind.error.errno in _FULL:
        progress = replace(progress, end=RecordingEnd.FULL)
    elif behind.error is not None:
        raise behind.error
    return replace(progress, frames=behind.written, seconds=behind.seconds)


def _take_back(folder: Path, was_there: bool) -> None:
    """Leave a folder as it was, empty or not at all."""
    empty(folder)
    if folder.exists() and not was_there:
        folder.rmdir()


def _capture_all(
    source: RawSource,
    behind: _BackgroundWriter,
    limits: Limits,
    disk: Disk,
    folder: Path,
) -> Iterator[RecordingProgress]:
    """Hands captures on to be written, and says how far it is after each."""
    progress, first = RecordingProgress(), 0.0
    while progress.end is None and behind.error is None:
        capture = source.capture()
        behind.write(capture)
        if not progress.frames:
            first = capture.time
        frames, free = progress.frames + 1, disk.free(home(folder))
        progress = RecordingProgress(frames, capture.time - first, free)
        if limits.are_reached(progress):
            progress = replace(progress, end=RecordingEnd.ASKED)
        elif free < disk.reserve:
            progress = replace(progress, end=RecordingEnd.FULL)
        yield progress


class _BackgroundWriter:
    """A thread that writes and syncs, so that the sensor need not wait for the disk.

    `error` is why it could not go on; what comes after that is dropped. `seconds` are
    from the first of those written to the last.
    """

    def __init__(self, begun: Callable[[], FakenectWriter]) -> None:
        self.written, self.seconds = 0, 0.0
        self.error: Exception | None = None
        self._waiting: Queue[KinectCapture | None] = Queue(BACKLOG)
        # Who presses Ctrl-C once more, while the rest is written, need not wait for it.
        self._thread = threading.Thread(
            target=self._run, args=(begun,), name="recorder", daemon=True
        )
        self._thread.start()

    def write(self, capture: KinectCapture) -> None:
        """Have it written, as soon as there is room for it in the queue."""
        self._waiting.put(capture)

    def close(self) -> None:
        """Wait until all is written, and end the thread."""
        self._waiting.put(None)
        self._thread.join()

    def _run(self, begun: Callable[[], FakenectWriter]) -> None:
        captures = iter(self._waiting.get, None)
        try:
            with begun() as writer:
                self._write_all(writer, captures)
        except Exception as error:
            self.error = error
        for _ in captures:
            """Nobody is to wait for room in the queue."""

    def _write_all(
        self, writer: FakenectWriter, captures: Iterator[KinectCapture | None]
    ) -> None:
        first, synced = math.nan, time.monotonic()
        for capture in captures:
            assert capture is not None, "that is where it ends"
            writer.write(capture)
            first = first if self.written else capture.time
            self.written, self.seconds = self.written + 1, capture.time - first
            if time.monotonic() - synced >= SYNCED_EVERY:
                writer.sync()
                synced = time.monotonic()
