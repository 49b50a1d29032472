"""How fast recordings are written and read: milliseconds a frame, the best of some.

A Kinect gives a frame every 33 ms. Frames are of the simulated Kinect, 640x480; times
of reading are from a disk's cache.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from kille.sensors.kinect.capture import KinectCapture
from kille.sensors.recordings.conversion import FORMATS, convert
from kille.sensors.recordings.fakenect_writing import FakenectWriter
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.playback import Recording
from kille.sensors.recordings.raw_frames import raw_source
from kille.sensors.recordings.recorder import Disk, Limits, record
from kille.sensors.sources import open_sensor

FRAMES = 30
ROUNDS = 5


def captures() -> list[KinectCapture]:
    source = raw_source(open_sensor("synthetic:desk?seed=7"))
    return [source.capture() for _ in range(FRAMES)]


def milliseconds(laps: Iterator[float]) -> tuple[float, float]:
    """The least and the greatest of some seconds, in milliseconds."""
    row = [1000 * lap for lap in laps]
    return min(row), max(row)


def write_laps(folder: Path, seen: list[KinectCapture]) -> Iterator[float]:
    """Seconds for each capture that is handed to the disk."""
    source = raw_source(open_sensor("synthetic:desk"))
    lens = open_sensor("synthetic:desk").frame().intrinsics
    assert lens is not None
    for lap in range(ROUNDS):
        with FakenectWriter(
            folder / f"w{lap}", source.calibration, lens, 0.0
        ) as writer:
            for capture in seen:
                began = time.perf_counter()
                writer.write(replace(capture, time=capture.time + lap))
                yield time.perf_counter() - began


def read_laps(recording: Recording) -> Iterator[float]:
    """Seconds for each frame, not read before."""
    for moment in recording.rest:
        began = time.perf_counter()
        moment.read()
        yield time.perf_counter() - began


def main() -> None:
    seen = captures()
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        least, most = milliseconds(write_laps(folder, seen))
        print(f"a capture handed to the disk     {least:6.2f} ms (at most {most:.2f})")
        source = open_recording(str(folder / "w0"))
        assert isinstance(source, Recording)
        began, spent = time.perf_counter(), time.process_time()
        raw = raw_source(source)
        record(raw, folder / "again", Limits(300), Disk.real(), lambda progress: None)
        took, spent = time.perf_counter() - began, time.process_time() - spent
        print(
            f"a recording read and recorded    {1000 * took / 300:6.2f} ms a frame, "
            f"disk and all; {1000 * spent / 300:.2f} ms of a core"
        )
        for name, into in FORMATS.items():
            out = folder / f"{name}{into.suffix}"
            began = time.perf_counter()
            convert(source, out, into, lambda: None)
            wrote = 1000 * (time.perf_counter() - began) / FRAMES
            began = time.perf_counter()
            recording = open_recording(str(out))
            assert isinstance(recording, Recording)
            opened = 1000 * (time.perf_counter() - began)
            least, most = milliseconds(read_laps(recording))
            recording.close()
            print(
                f"{name:<10} written {wrote:6.2f} ms a frame, opened {opened:6.1f} ms, "
                f"read {least:6.2f} ms a frame (at most {most:.2f})"
            )


if __name__ == "__main__":
    main()
