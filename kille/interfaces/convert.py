"""`kille convert`: convert a recording to another format."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

from kille.interfaces.amounts import in_bytes, in_frames, why_unwritten
from kille.interfaces.terminal import FAILED, FINE, complain, console, labelled_bar
from kille.sensors.recordings.conversion import Format, convert, estimate, format_of
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.output_paths import check_file, check_other, home, whole
from kille.sensors.recordings.playback import Recording
from kille.sensors.sensor import SensorError


def convert_recording(
    source: str, out: Path, named: str | None, may_write: Callable[[Path], None]
) -> int:
    """Write the recording of this name to `out`; returns the exit code.

    `may_write` raises SensorError if `out` must be left as it is.
    """
    try:
        into = format_of(out, named)
        check_other(source, out)
        may_write(out)
        if into.suffix:
            check_file(out)
        recording = _open_recording(source)
    except SensorError as error:
        return complain(error)
    except OSError as error:
        return complain(why_unwritten(out, error), FAILED)
    try:
        return _convert(recording, out, into, may_write)
    except SensorError as error:
        return complain(error, FAILED)
    except OSError as error:
        return complain(why_unwritten(out, error), FAILED)
    finally:
        recording.close()


def _open_recording(source: str) -> Recording:
    sensor = open_recording(source)
    if not isinstance(sensor, Recording):
        raise SensorError(
            f"{source}: holds stills, no recording; name one of them, such as "
            f"{source.rstrip('/')}/NAME"
        )
    return sensor


def _convert(
    recording: Recording, out: Path, into: Format, may_write: Callable[[Path], None]
) -> int:
    needed = estimate(recording, into)
    free = shutil.disk_usage(home(out)).free
    if free < needed.bytes:
        return complain(
            f"{out}: up to {in_bytes(needed.bytes)} are needed, "
            f"and {in_bytes(free)} are free on the disk",
            FAILED,
        )
    screen = console()
    with labelled_bar(screen) as bar, whole(out, may_write) as draft:
        task = bar.add_task(str(out), total=needed.frames)
        convert(recording, draft, into, lambda: bar.advance(task))
    rest = recording.rest
    seconds = rest[-1].time - rest[0].time
    screen.print(
        f"{out}: {in_frames(needed.frames)}, {seconds:.1f} s, as a {into.title}, "
        f"{in_bytes(_size_on_disk(out))}",
        markup=False,
    )
    if rest[0].read().outlines and into.title != "capture folder":
        screen.print(
            "The outlines of the things are lost: only capture folders keep them."
        )
    return FINE


def _size_on_disk(out: Path) -> int:
    """The size in bytes of a file, or of all files in a folder."""
    files = out.rglob("*") if out.is_dir() else [out]
    return sum(it.stat().st_size for it in files if it.is_file())
