"""A Kinect that is recorded: what the recording holds is what the device saw."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kille.sensors.kinect import sensor as driver
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import KinectCapture
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.playback import RawRecording
from kille.sensors.recordings.recorder import (
    Disk,
    Limits,
    RecordingEnd,
    RecordingProgress,
    record,
)
from kille.sensors.sensor import SensorError
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect

TICKS_OF_A_FRAME = 2_000_000


class Witness:
    """Remembers all that a Kinect gave."""

    def __init__(self, sensor: KinectSensor) -> None:
        self._sensor = sensor
        self.seen: list[KinectCapture] = []

    @property
    def calibration(self) -> Calibration:
        return self._sensor.calibration

    def capture(self) -> KinectCapture:
        self.seen.append(self._sensor.capture())
        return self.seen[-1]


def played(folder: Path) -> RawRecording:
    recording = open_recording(str(folder))
    assert isinstance(recording, RawRecording)
    return recording


def test_a_kinect_is_recorded_bit_for_bit(
    kinect: Kinect, sensor: KinectSensor, tmp_path: Path
) -> None:
    source = Witness(sensor)
    done = record(source, tmp_path / "walk", Limits(15), Disk.real(), lambda told: None)
    assert (done.frames, done.end) == (15, RecordingEnd.ASKED)
    recording = played(tmp_path / "walk")
    assert recording.calibration == sensor.calibration
    assert len(recording.rest) == 15
    shown = [view.depth for view in kinect.show.views]
    began = source.seen[0].time
    for given in source.seen:
        capture = recording.capture()
        assert any(np.array_equal(capture.depth, depth) for depth in shown)
        assert np.array_equal(capture.depth, given.depth)
        assert np.array_equal(capture.colour, given.colour)
        assert capture.tilt == given.tilt == sensor.posture()
        assert capture.ticks_depth == given.ticks_depth
        assert capture.ticks_colour == given.ticks_colour
        assert capture.time == pytest.approx(given.time - began, abs=2e-6)
    ticks = [it.ticks_depth for it in source.seen]
    frames = np.diff(ticks) / TICKS_OF_A_FRAME
    assert np.array_equal(frames, np.rint(frames))
    assert frames.min() >= 1


def test_a_kinect_that_is_unplugged_leaves_what_was_seen(
    bus: InsideBus,
    kinect: Kinect,
    sensor: KinectSensor,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told: list[RecordingProgress] = []

    def tell(progress: RecordingProgress) -> None:
        told.append(progress)
        if progress.frames == 4:
            bus.unplug(kinect)
            monkeypatch.setattr(driver, "PATIENCE", 0.4)
            monkeypatch.setattr(driver, "_SILENCE", 0.25)

    with pytest.raises(SensorError, match="kinect: "):
        record(sensor, tmp_path / "walk", Limits(), Disk.real(), tell)
    assert len(played(tmp_path / "walk").rest) == told[-1].frames >= 4
