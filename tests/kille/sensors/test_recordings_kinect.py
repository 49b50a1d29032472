"""A Kinect that is recorded: what the recording holds is what the device saw."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from kille.sensors.kinect import sensor as driver
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.recordings.opening import open_recording
from kille.sensors.recordings.playing import RawRecording
from kille.sensors.recordings.recorder import Disk, End, Limits, Progress, record
from kille.sensors.sensor import SensorError
from kinect_emulator.host import Host
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect


@pytest.fixture
def kinect() -> Kinect:
    return Kinect()


@pytest.fixture
def bus(kinect: Kinect) -> Iterator[InsideBus]:
    with InsideBus(Host(kinect)).running() as running:
        yield running


@pytest.fixture
def sensor(bus: InsideBus) -> Iterator[KinectSensor]:
    opened = KinectSensor("kinect", bus)
    yield opened
    opened.close()


def played(folder: Path) -> RawRecording:
    recording = open_recording(str(folder))
    assert isinstance(recording, RawRecording)
    return recording


def test_a_kinect_is_recorded_bit_for_bit(
    kinect: Kinect, sensor: KinectSensor, tmp_path: Path
) -> None:
    done = record(sensor, tmp_path / "walk", Limits(15), Disk.real(), lambda told: None)
    assert (done.frames, done.end) == (15, End.ASKED)
    recording = played(tmp_path / "walk")
    assert recording.calibration == sensor.calibration
    assert len(recording.rest) == 15
    seen = [view.depth for view in kinect.show.views]
    for _ in range(15):
        capture = recording.capture()
        assert any(np.array_equal(capture.depth, depth) for depth in seen)
        assert capture.tilt == sensor.posture()
    assert np.diff(recording.reel.times) == pytest.approx(1 / 30, abs=0.025)


def test_a_kinect_that_is_unplugged_leaves_what_was_seen(
    bus: InsideBus,
    kinect: Kinect,
    sensor: KinectSensor,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(driver, "PATIENCE", 0.4)
    monkeypatch.setattr(driver, "_SILENCE", 0.25)
    told: list[Progress] = []

    def tell(progress: Progress) -> None:
        told.append(progress)
        if progress.frames == 4:
            bus.unplug(kinect)

    with pytest.raises(SensorError, match="kinect: "):
        record(sensor, tmp_path / "walk", Limits(), Disk.real(), tell)
    assert len(played(tmp_path / "walk").rest) == told[-1].frames >= 4
