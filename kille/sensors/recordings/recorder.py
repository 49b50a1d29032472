"""Recording from a sensor: captures go to the disk behind a queue, as they come."""

from __future__ import annotations

import errno
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

from kille.sensors.kinect.capture import Capture, RawSource
from kille.sensors.recordings.developing import lens_of
from kille.sensors.recordings.playing import RecordingOver
from kille.sensors.recordings.replacing import remove
from kille.sensors.recordings.writing import CAPTURE_BYTES, FakenectWriter

RESERVE = 200_000_000
"""Bytes that are left free on the disk."""

BACKLOG = 60
"""Captures that may wait for the disk: two seconds of a Kinect, 92 MB."""

SYNCED_EVERY = 1.0
"""Seconds between the times at which the disk is made to hold all there is."""

_FULL = (errno.ENOSPC, errno.EDQUOT)


class End(Enum):
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

    def reached(self, so_far: Progress) -> bool:
        """Whether it is enough."""
        enough = self.frames is not None and so_far.frames >= self.frames
        # A thirtieth of a second, thirty times, may be a hair less than a second.
        return enough or (
            self.seconds is not None and so_far.span >= self.seconds - 1e-6
        )

    @property
    def bytes(self) -> int:
        """What it will take on the disk, 0 if nobody knows."""
        frames = self.frames or round((self.seconds or 0) * 30)
        return frames * CAPTURE_BYTES


@dataclass(frozen=True)
class Progress:
    """How far it is: frames, the sensor's seconds, and the bytes that are left free."""

    frames: int = 0
    seconds: float = 0.0
    free: int = 0
    end: End | None = None

    @property
    def bytes(self) -> int:
        """What the frames take on the disk."""
        return self.frames * CAPTURE_BYTES

    @property
    def span(self) -> float:
        """Seconds from the first frame to the end of the last."""
        gaps = self.frames - 1
        return self.seconds + (self.seconds / gaps if gaps > 0 else 0.0)


class NoRoom(Exception):
    """The disk has not room for what is to be recorded: needed and free, in bytes."""

    def __init__(self, needed: int, free: int) -> None:
        super().__init__(needed, free)
        self.needed = needed
        self.free = free


@dataclass(frozen=True)
class Disk:
    """What is free where the recording goes, and how much of it stays so."""

    free: Callable[[Path], int]
    reserve: int = RESERVE

    @classmethod
    def real(cls) -> Self:
        """The computer's own."""
        return cls(lambda folder: shutil.disk_usage(folder).free)


def check_room(folder: Path, limits: Limits, disk: Disk) -> None:
    """NoRoom if what is asked for does not fit, as far as it is known beforehand."""
    free = disk.free(folder)
    needed = max(limits.bytes, CAPTURE_BYTES) + disk.reserve
    if free < needed:
        raise NoRoom(needed, free)


def record(
    source: RawSource,
    folder: Path,
    limits: Limits,
    disk: Disk,
    tell: Callable[[Progress], None],
    began: float | None = None,
) -> Progress:
    """Record into a new or empty folder until something ends it; how far it came.

    `tell` is called after every capture. A full disk ends it, Ctrl-C ends it, and what
    is there then is whole. SensorError if the source fails, OSError if the disk does.
    `began` is the time of the computer that the first capture gets, now without it.
    """
    start = time.time() if began is None else began
    try:
        writer = FakenectWriter(folder, source.calibration, lens_of(source), start)
    except OSError:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    behind = _Behind(writer)
    progress = Progress(free=disk.free(folder))
    try:
        for progress in _captured(source, behind, limits, disk, folder):
            tell(progress)
    except RecordingOver:
        progress = replace(progress, end=End.OVER)
    except KeyboardInterrupt:
        progress = replace(progress, end=End.STOPPED)
    finally:
        behind.close()
        if not behind.written:
            remove(folder)
    if behind.error is not None:
        if behind.error.errno not in _FULL:
            raise behind.error
        progress = replace(progress, end=End.FULL)
    return replace(progress, frames=behind.written)


def _captured(
    source: RawSource, behind: _Behind, limits: Limits, disk: Disk, folder: Path
) -> Iterator[Progress]:
    """Hands captures on to be written, and says how far it is after each."""
    progress, first = Progress(), 0.0
    while progress.end is None and behind.error is None:
        capture = source.capture()
        behind.write(capture)
        if not progress.frames:
            first = capture.time
        frames, free = progress.frames + 1, disk.free(folder)
        progress = Progress(frames, capture.time - first, free)
        if limits.reached(progress):
            progress = replace(progress, end=End.ASKED)
        elif free < disk.reserve:
            progress = replace(progress, end=End.FULL)
        yield progress


class _Behind:
    """A thread that writes and syncs, so that the sensor need not wait for the disk.

    `error` is why it could not go on; what comes after that is dropped.
    """

    def __init__(self, writer: FakenectWriter) -> None:
        self.written = 0
        self.error: OSError | None = None
        self._writer = writer
        self._waiting: Queue[Capture | None] = Queue(BACKLOG)
        self._thread = threading.Thread(target=self._run, name="recorder")
        self._thread.start()

    def write(self, capture: Capture) -> None:
        """Have it written, as soon as there is room for it in the queue."""
        self._waiting.put(capture)

    def close(self) -> None:
        """Wait until all is written, and end the thread."""
        self._waiting.put(None)
        self._thread.join()

    def _run(self) -> None:
        synced = time.monotonic()
        while (capture := self._waiting.get()) is not None:
            self._attempt(partial(self._add, capture))
            if time.monotonic() - synced >= SYNCED_EVERY:
                self._attempt(self._writer.sync)
                synced = time.monotonic()
        self._attempt(self._writer.close)

    def _add(self, capture: Capture) -> None:
        self._writer.write(capture)
        self.written += 1

    def _attempt(self, step: Callable[[], None]) -> None:
        """Do it, unless something has failed before."""
        try:
            if self.error is None:
                step()
        except OSError as error:
            self.error = error
            self._writer.abandon()
