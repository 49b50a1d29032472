"""fakenect folders: all bits are kept, what is cut short plays, also after a kill."""

from __future__ import annotations

import errno
import json
import logging
import os
import signal
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from kille.scene import Intrinsics
from kille.sensors.kinect.calibration import IDENTITY, Calibration
from kille.sensors.kinect.capture import (
    COLOUR_CAMERA,
    KinectCapture,
    RawSource,
    frame_of,
)
from kille.sensors.kinect.motor import Tilt
from kille.sensors.recordings.fakenect import parse_index_line
from kille.sensors.recordings.fakenect_writing import CAPTURE_BYTES, FakenectWriter
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.playback import RawRecording, Recording
from kille.sensors.recordings.raw_frames import RawFrameSource, raw_source
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

NOWHERE = Intrinsics(510.0, 511.0, 312.5, 251.25)
ROOMY = Disk(lambda folder: 10**12)


def captures(count: int) -> Iterator[KinectCapture]:
    """Readings of all numbers, whose ticks and times differ between the two cameras."""
    rng = np.random.default_rng(7)
    for number in range(count):
        yield KinectCapture(
            time=number / 30,
            colour=rng.integers(0, 256, (480, 640, 3), np.uint8),
            depth=rng.integers(0, 2048, (480, 640), np.uint16),
            ticks_colour=4_294_000_000 + 2000 * number & 0xFFFF_FFFF,
            ticks_depth=number,
            tilt=Tilt(-1, 819, 300 - number // 2, -7, 4) if number else None,
        )


def written(
    folder: Path, count: int = 3, calibration: Calibration = IDENTITY
) -> list[KinectCapture]:
    given = list(captures(count))
    with FakenectWriter(folder, calibration, COLOUR_CAMERA, 1000.0) as writer:
        for capture in given:
            writer.write(capture)
    return given


def played(folder: Path | str) -> RawRecording:
    recording = open_recording(str(folder))
    assert isinstance(recording, RawRecording)
    return recording


def same(one: KinectCapture, other: KinectCapture) -> bool:
    return (
        np.array_equal(one.colour, other.colour)
        and np.array_equal(one.depth, other.depth)
        and one.time == pytest.approx(other.time, abs=2e-6)
        and (one.ticks_colour, one.ticks_depth, one.tilt)
        == (other.ticks_colour, other.ticks_depth, other.tilt)
    )


# --- bits ----------------------------------------------------------------------------


def test_captures_come_back_bit_for_bit(tmp_path: Path) -> None:
    given = written(tmp_path / "walk", 5)
    recording = played(tmp_path / "walk")
    assert all(same(it, recording.capture()) for it in given)
    again = recording.capture()
    assert np.array_equal(again.depth, given[0].depth)
    assert again.time == pytest.approx(5 / 30, abs=1e-5)


def test_frames_are_what_the_sensor_itself_would_have_given(tmp_path: Path) -> None:
    given = written(tmp_path / "walk", 2, Calibration.typical())
    recording = played(tmp_path / "walk")
    assert recording.calibration == Calibration.typical()
    for capture in given:
        expected = frame_of(capture, Calibration.typical())
        frame = recording.frame()
        assert np.array_equal(frame.colour, expected.colour)
        assert expected.depth is not None
        assert frame.depth is not None
        assert np.array_equal(frame.depth, expected.depth, equal_nan=True)
        assert frame.intrinsics == expected.intrinsics


def test_files_are_those_of_libfreenect(tmp_path: Path) -> None:
    (given,) = written(tmp_path / "walk", 1)
    names = (tmp_path / "walk" / "INDEX.txt").read_text().splitlines()
    assert names == ["r-1000.000000-4294000000.ppm", "d-1000.000000-0.pgm"]
    colour, depth = ((tmp_path / "walk" / name).read_bytes() for name in names)
    assert colour == b"P6 640 480 255\n" + given.colour.tobytes()
    low, high = depth[17], depth[18]
    assert depth.startswith(b"P5 640 480 65535\n")
    assert low + 256 * high == given.depth[0, 0]
    assert len(depth) == 17 + 640 * 480 * 2


def test_the_accelerometer_is_written_when_it_changes(tmp_path: Path) -> None:
    written(tmp_path / "walk", 5)
    told = sorted((tmp_path / "walk").glob("a-*.dump"))
    assert len(told) == 3
    assert struct.unpack("<hhhbxi", told[0].read_bytes()) == (-1, 819, 300, -7, 4)


def test_another_lens_is_kept(tmp_path: Path) -> None:
    with FakenectWriter(tmp_path / "walk", IDENTITY, NOWHERE, 0.0) as writer:
        writer.write(next(captures(1)))
    described = json.loads((tmp_path / "walk" / "device.json").read_text())
    assert described["intrinsics"] == [510.0, 511.0, 312.5, 251.25]
    assert played(tmp_path / "walk").frame().intrinsics == NOWHERE
    other = played(f"{tmp_path / 'walk'}?intrinsics=1,2,3,4").frame()
    assert other.intrinsics == Intrinsics(1, 2, 3, 4)


def test_without_device_json_it_is_a_usual_kinect(tmp_path: Path) -> None:
    written(tmp_path / "walk")
    (tmp_path / "walk" / "device.json").unlink()
    assert played(tmp_path / "walk").calibration == Calibration.typical()


def test_streams_apart_are_paired_by_time(tmp_path: Path) -> None:
    """As libfreenect records them: colour and depth never at the same time."""
    folder = tmp_path / "walk"
    given = written(folder, 4)
    lines = []
    for number, capture in enumerate(given):
        for kind, late in (("d", 0.0), ("r", 0.011)):
            ticks = capture.ticks_depth if kind == "d" else capture.ticks_colour
            (old,) = folder.glob(f"{kind}-*-{ticks}.*")
            new = old.with_name(f"{kind}-{5 + number / 30 + late:.6f}-{ticks}.x")
            old.rename(new)
            lines.append(new.name)
    lines.remove(next(line for line in lines if line.startswith("r-5.04")))
    (folder / "INDEX.txt").write_text("\n".join(lines) + "\n")
    recording = played(folder)
    found = [recording.capture() for _ in recording.rest]
    assert [it.ticks_depth for it in found] == [0, 2, 3]
    assert all(np.array_equal(it.colour, given[it.ticks_depth].colour) for it in found)


def test_colour_alone_is_a_recording_without_depth(tmp_path: Path) -> None:
    written(tmp_path / "walk")
    index = tmp_path / "walk" / "INDEX.txt"
    kept = [it for it in index.read_text().splitlines(True) if it.startswith("r")]
    index.write_text("".join(kept))
    recording = open_recording(str(tmp_path / "walk"))
    assert isinstance(recording, Recording)
    assert not isinstance(recording, RawSource)
    assert recording.frame().depth is None


@pytest.mark.parametrize(
    "line", ["", "x-1.0-2.ppm", "r-1.0.ppm", "r-1.0-2.ppm/..", "r"]
)
def test_a_line_that_names_no_event(line: str) -> None:
    assert parse_index_line(line) is None


@pytest.mark.parametrize("began", [0.0, 0.1234565, 1_795_301_729.5832339])
def test_every_frame_can_be_gone_to_by_its_time(tmp_path: Path, began: float) -> None:
    with FakenectWriter(tmp_path / "walk", IDENTITY, COLOUR_CAMERA, began) as writer:
        for capture in captures(4):
            writer.write(capture)
    recording = played(tmp_path / "walk")
    for number in range(4):
        recording.seek(number / 30)
        assert recording.capture().ticks_depth == number


# --- damage --------------------------------------------------------------------------


def remark(folder: Path, caplog: pytest.LogCaptureFixture) -> str:
    """What is told, once, of a recording that plays."""
    with caplog.at_level(logging.WARNING):
        played(folder).frame()
    (told,) = caplog.messages
    return told


def test_a_whole_recording_needs_no_remark(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    written(tmp_path / "walk")
    played(tmp_path / "walk")
    assert caplog.messages == []


def test_a_recording_cut_short_plays_what_is_whole(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    given = written(tmp_path / "walk")
    last = sorted((tmp_path / "walk").glob("d-*"))[-1]
    os.truncate(last, 1000)
    told = remark(tmp_path / "walk", caplog)
    assert "walk: cut short: 1 of 8 files is missing or not whole" in told
    assert last.name in told
    recording = played(tmp_path / "walk")
    assert len(recording.reel.moments) == 2
    assert same(given[1], [recording.capture() for _ in range(2)][1])


def test_a_missing_file_is_told_and_the_rest_is_played(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    given = written(tmp_path / "walk")
    next((tmp_path / "walk").glob("r-1000.0333*")).unlink()
    assert "r-1000.033333" in remark(tmp_path / "walk", caplog)
    recording = played(tmp_path / "walk")
    found = [recording.capture() for _ in range(2)]
    assert [it.ticks_depth for it in found] == [0, 2]
    assert np.array_equal(found[1].colour, given[2].colour)


def test_a_line_cut_short_is_left_out(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    written(tmp_path / "walk")
    with (tmp_path / "walk" / "INDEX.txt").open("a") as index:
        index.write("r-1000.1")
    assert "(r-1000.1)" in remark(tmp_path / "walk", caplog)


def complaint(folder: Path) -> str:
    with pytest.raises(SensorError) as caught:
        open_sensor(str(folder)).frame()
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_an_empty_recording(tmp_path: Path) -> None:
    written(tmp_path / "walk", 0)
    assert "the recording is empty: INDEX.txt names no file" in complaint(
        tmp_path / "walk"
    )


def test_depth_alone(tmp_path: Path) -> None:
    written(tmp_path / "walk")
    for picture in (tmp_path / "walk").glob("r-*"):
        picture.unlink()
    assert "names no colour picture that is whole" in complaint(tmp_path / "walk")


def test_depth_that_is_not_raw_names_the_file(tmp_path: Path) -> None:
    written(tmp_path / "walk", 1)
    (path,) = (tmp_path / "walk").glob("d-*")
    path.write_bytes(b"P5 640 480 65535\n" + b"\xff\x7f" * (640 * 480))
    text = complaint(tmp_path / "walk")
    assert path.name in text
    assert "no raw depth of 11 bits; a number in it is 32767" in text


def test_another_head_names_the_file(tmp_path: Path) -> None:
    written(tmp_path / "walk", 1)
    (path,) = (tmp_path / "walk").glob("r-*")
    path.write_bytes(b"P6 480 640 255\n" + path.read_bytes()[15:])
    assert f"{path.name}: is damaged; expected `P6 640 480 255`" in complaint(
        tmp_path / "walk"
    )


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("{", "is not JSON"),
        ("{}", "has no reg_info"),
        *(
            (json.dumps(json.loads(IDENTITY.to_json()) | {"intrinsics": it}), "fx, fy")
            for it in ([1], [0, 0, 1, 1], [1, 1, 1, float("nan")], 3, [10**400] * 4)
        ),
    ],
)
def test_a_device_json_that_is_wrong(tmp_path: Path, text: str, told: str) -> None:
    written(tmp_path / "walk", 1)
    (tmp_path / "walk" / "device.json").write_text(text)
    assert "device.json: " in complaint(tmp_path / "walk")
    assert told in complaint(tmp_path / "walk")


# --- any sensor ----------------------------------------------------------------------


def test_a_simulated_kinect_is_recorded_as_a_kinect_reads(tmp_path: Path) -> None:
    sensor = open_sensor("synthetic:desk?seed=7")
    done = record(raw_source(sensor), tmp_path / "walk", Limits(3), ROOMY, told_nobody)
    assert (done.frames, done.end) == (3, RecordingEnd.ASKED)
    again = open_sensor("synthetic:desk?seed=7")
    recording = played(tmp_path / "walk")
    for _ in range(3):
        frame, expected = recording.frame(), again.frame()
        assert np.array_equal(frame.colour, expected.colour)
        assert frame.depth is not None
        assert expected.depth is not None
        off = np.abs(frame.depth - expected.depth) / expected.depth**2
        assert np.nanmax(off) < 0.004
        assert frame.time == pytest.approx(expected.time, abs=1e-5)
        assert frame.intrinsics == expected.intrinsics


def test_a_recording_is_recorded_bit_for_bit(tmp_path: Path) -> None:
    given = written(tmp_path / "one", 4, Calibration.typical())
    source = raw_source(open_sensor(f"{tmp_path / 'one'}?loop=no"))
    assert not isinstance(source, RawFrameSource)
    done = record(source, tmp_path / "two", Limits(), ROOMY, told_nobody)
    assert (done.frames, done.end) == (4, RecordingEnd.OVER)
    recording = played(tmp_path / "two")
    assert recording.calibration == Calibration.typical()
    assert all(same(it, recording.capture()) for it in given)


def test_what_has_no_depth_cannot_be_recorded_so(tmp_path: Path) -> None:
    import cv2

    cv2.imwrite(str(tmp_path / "cup.png"), np.zeros((480, 640, 3), np.uint8))
    with pytest.raises(
        SensorError, match=r"cup\.png: gives no depth, .* other formats"
    ):
        raw_source(open_sensor(str(tmp_path / "cup.png")))


# --- limits and the disk -------------------------------------------------------------


def told_nobody(progress: RecordingProgress) -> None:
    """Nobody wants to know."""


def source(tmp_path: Path) -> RawSource:
    """A recording of three frames at 30 a second, over and over."""
    written(tmp_path / "source")
    return played(tmp_path / "source")


@pytest.mark.parametrize(
    ("limits", "frames"),
    [(Limits(1), 1), (Limits(5), 5), (Limits(seconds=0.1), 3), (Limits(seconds=1), 30)],
)
def test_it_is_as_long_as_asked(tmp_path: Path, limits: Limits, frames: int) -> None:
    told: list[RecordingProgress] = []
    done = record(source(tmp_path), tmp_path / "walk", limits, ROOMY, told.append)
    assert [it.frames for it in told] == list(range(1, frames + 1))
    assert (done.frames, done.end) == (frames, RecordingEnd.ASKED)
    assert len(played(tmp_path / "walk").reel.moments) == frames


def test_ctrl_c_ends_it_and_what_is_there_is_whole(tmp_path: Path) -> None:
    def interrupt(progress: RecordingProgress) -> None:
        if progress.frames == 2:
            raise KeyboardInterrupt

    done = record(source(tmp_path), tmp_path / "walk", Limits(), ROOMY, interrupt)
    assert (done.frames, done.end) == (2, RecordingEnd.STOPPED)
    assert len(played(tmp_path / "walk").reel.moments) == 2


def test_it_ends_before_the_disk_is_full(tmp_path: Path) -> None:
    free = iter(range(10 * CAPTURE_BYTES, 0, -CAPTURE_BYTES))
    disk = Disk(lambda folder: next(free), reserve=5 * CAPTURE_BYTES)
    done = record(source(tmp_path), tmp_path / "walk", Limits(), disk, told_nobody)
    assert done.end is RecordingEnd.FULL
    assert done.frames == 7
    assert len(played(tmp_path / "walk").reel.moments) == 7


def test_what_does_not_fit_is_not_begun(tmp_path: Path) -> None:
    disk = Disk(lambda folder: 1_000_000_000)
    check_room(tmp_path, Limits(), disk)
    check_room(tmp_path, Limits(seconds=17), disk)
    for limits in (Limits(600), Limits(seconds=20)):
        with pytest.raises(NoRoomError) as caught:
            check_room(tmp_path, limits, disk)
        assert caught.value.needed == 600 * CAPTURE_BYTES + 200_000_000


def limited(folder: Path, largest: int) -> subprocess.CompletedProcess[str]:
    """Records in a program that may not write files of more than so many bytes."""
    code = (
        "import resource, signal, sys\n"
        "from kille.interfaces.cli import main\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({largest}, {largest}))\n"
        "sys.exit(main(sys.argv[1:]))\n"
    )
    words = ["record", str(folder), "--sensor", "synthetic:empty", "--frames", "3"]
    return subprocess.run(
        [sys.executable, "-c", code, *words],
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_disk_that_fails_is_one_line_and_leaves_no_half_file(tmp_path: Path) -> None:
    done = limited(tmp_path / "walk", 700_000)
    assert done.returncode == 1
    assert (
        done.stderr == f"kille: {tmp_path / 'walk'} cannot be written: file too large\n"
    )
    assert not (tmp_path / "walk").exists()


class _FullAfter(FakenectWriter):
    """A writer whose disk is full after so many captures."""

    room = 2

    def write(self, capture: KinectCapture) -> None:
        if not self.room:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        self.room -= 1
        super().write(capture)


def test_a_full_disk_ends_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("kille.sensors.recordings.recorder.FakenectWriter", _FullAfter)
    done = record(source(tmp_path), tmp_path / "walk", Limits(), ROOMY, told_nobody)
    assert (done.frames, done.end) == (2, RecordingEnd.FULL)
    assert done.seconds == pytest.approx(1 / 30, abs=2e-6)
    assert len(played(tmp_path / "walk").reel.moments) == 2


class _Broken(FakenectWriter):
    """A writer with a mistake in it."""

    def write(self, capture: KinectCapture) -> None:
        raise ValueError("a mistake")


def test_a_writer_that_fails_in_any_way_does_not_hang(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kille.sensors.recordings.recorder.FakenectWriter", _Broken)
    with pytest.raises(ValueError, match="a mistake"):
        record(source(tmp_path), tmp_path / "walk", Limits(), ROOMY, told_nobody)
    assert not (tmp_path / "walk").exists()


def test_what_is_there_is_not_recorded_into(tmp_path: Path) -> None:
    other = source(tmp_path)
    (tmp_path / "walk").mkdir()
    (tmp_path / "walk" / "thesis.tex").write_text("all of it")
    with pytest.raises(FileExistsError):
        record(other, tmp_path / "walk", Limits(1), ROOMY, told_nobody)
    assert (tmp_path / "walk" / "thesis.tex").read_text() == "all of it"


def test_a_disk_that_cannot_be_asked_ends_it(tmp_path: Path) -> None:
    def gone(folder: Path) -> int:
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))

    with pytest.raises(FileNotFoundError):
        record(source(tmp_path), tmp_path / "walk", Limits(), Disk(gone), told_nobody)
    assert not [it for it in threading.enumerate() if it.name == "recorder"]


def test_a_sensor_that_fails_leaves_what_was_seen(tmp_path: Path) -> None:
    other = source(tmp_path)
    for path in (tmp_path / "source").glob("r-1000.066*"):
        os.truncate(path, 5)
    with pytest.raises(SensorError, match=r"r-1000\.066667-.*is damaged"):
        record(other, tmp_path / "walk", Limits(), ROOMY, told_nobody)
    assert len(played(tmp_path / "walk").reel.moments) == 2


@pytest.mark.parametrize("after", [0.05, 0.2, 0.41])
def test_who_is_killed_leaves_a_recording_that_plays(
    tmp_path: Path, after: float, caplog: pytest.LogCaptureFixture
) -> None:
    written(tmp_path / "source")
    words = ["record", str(tmp_path / "walk"), "--sensor", str(tmp_path / "source")]
    program = subprocess.Popen([sys.executable, "-m", "kille.interfaces.cli", *words])
    index = tmp_path / "walk" / "INDEX.txt"
    while program.poll() is None and not (
        index.exists() and "\nd-" in index.read_text()
    ):
        time.sleep(0.005)
    assert program.poll() is None
    time.sleep(after)
    program.send_signal(signal.SIGKILL)
    program.wait()
    recording = played(tmp_path / "walk")
    for _ in recording.rest:
        recording.capture()
    assert caplog.messages == []
    named = set(index.read_text().split())
    there = {path.name for path in (tmp_path / "walk").iterdir()}
    assert named <= there
    assert len(there - named) <= 3  # the index, the device and what was being written
