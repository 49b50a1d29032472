"""`kille record`: what a sensor gives, as a folder that libfreenect plays too."""

from __future__ import annotations

import shlex
import time
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.status import Status

from kille.interfaces.amounts import in_bytes, in_frames, why_unwritten
from kille.interfaces.terminal import FAILED, FINE, complain, console
from kille.sensors.kinect.capture import RawSource
from kille.sensors.recordings.output_paths import check_other, home, set_aside
from kille.sensors.recordings.raw_frames import raw_source
from kille.sensors.recordings.recorder import (
    Disk,
    Limits,
    NoRoomError,
    RecordingEnd,
    RecordingProgress,
    check_room,
    record,
)
from kille.sensors.sensor import SensorError
from kille.sensors.sources import open_sensor

_TOLD_EVERY = 0.1


def record_sensor(
    name: str, out: Path, limits: Limits, may_write: Callable[[Path], None]
) -> int:
    """Records the sensor of that name into the folder `out`; the exit code.

    `may_write` raises SensorError if `out` must be left as it is.
    """
    disk = Disk.real()
    try:
        check_other(name, out)
        may_write(out)
        check_room(home(out), limits, disk)
        sensor = open_sensor(name)
    except SensorError as error:
        return complain(error)
    except NoRoomError as error:
        return complain(
            f"{out}: {in_bytes(error.needed)} are needed, and {in_bytes(error.free)} "
            "are free on the disk",
            FAILED,
        )
    except OSError as error:
        return complain(why_unwritten(out, error), FAILED)
    try:
        source = raw_source(sensor)
        # While the sensor was opened, something may have got there.
        may_write(out)
        return _record(source, out, limits, disk)
    except SensorError as error:
        return complain(error, FAILED)
    except OSError as error:
        return complain(why_unwritten(out, error), FAILED)
    finally:
        sensor.close()


def _record(source: RawSource, out: Path, limits: Limits, disk: Disk) -> int:
    screen = console()
    with set_aside(out), screen.status("waiting for the first frame") as status:
        line = _Line(status)
        try:
            progress = record(source, out, limits, disk, line.tell)
        except SensorError as error:
            kept = f"; what came before is in {out}" if line.frames else ""
            raise SensorError(f"{error}{kept}") from error
    if progress.frames:
        _tell(screen, out, progress, line.seconds)
    else:
        screen.print("Nothing was recorded.")
    if progress.end is RecordingEnd.FULL:
        left = in_bytes(disk.free(home(out)))
        return complain(f"the disk is full, {left} are left: it ended there", FAILED)
    return FINE if progress.frames else FAILED


def _tell(screen: Console, out: Path, progress: RecordingProgress, took: float) -> None:
    screen.print(
        f"{out}: {in_frames(progress.frames)}, {progress.seconds:.1f} s, "
        f"{in_bytes(progress.bytes)}, written in {took:.1f} s; "
        f"play it with --sensor {shlex.quote(str(out))}",
        markup=False,
    )


class _Line:
    """The line on the screen, which is kept true ten times a second."""

    def __init__(self, status: Status) -> None:
        self.frames = 0
        self._status = status
        self._began = self._told = time.monotonic()

    @property
    def seconds(self) -> float:
        """How long it has been there."""
        return time.monotonic() - self._began

    def tell(self, progress: RecordingProgress) -> None:
        """Say how far it is, unless that was just said."""
        self.frames = progress.frames
        now = time.monotonic()
        if now - self._told < _TOLD_EVERY:
            return
        self._told = now
        self._status.update(
            f"{progress.seconds:.1f} s, {in_frames(progress.frames)}, "
            f"{progress.frames / self.seconds:.1f} a second, "
            f"{in_bytes(progress.bytes)}, {in_bytes(progress.free)} free; "
            "Ctrl-C ends it"
        )
