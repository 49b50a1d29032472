"""The product's sensors, seen through an emulated Kinect and its driver."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.recordings.recorder import Disk, Limits, record
from kille.sensors.sources import open_sensor
from kinect_emulator.host import Host
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import PATIENCE
from kinect_emulator.sources import making_of, plugged

NAME = "synthetic:desk?seed=7"


def test_the_driver_sees_what_the_sensor_shows() -> None:
    shown = open_sensor(NAME).frame()
    bus = InsideBus(Host(plugged(NAME, count=1), patience=PATIENCE))
    with bus.running(), closing(KinectSensor("kinect", bus)) as sensor:
        seen = sensor.frame()
    assert shown.depth is not None
    assert seen.depth is not None
    both = np.isfinite(shown.depth) & np.isfinite(seen.depth)
    assert both.mean() > 0.95 * np.isfinite(shown.depth).mean()
    # One raw number is 3 mm at one metre and 7 mm at one and a half.
    apart = (np.abs(shown.depth - seen.depth) / shown.depth)[both]
    assert np.percentile(apart, 95) < 0.01
    # Colour goes through a Bayer mosaic, which blurs fine patterns.
    blur = np.abs(shown.colour.astype(int) - seen.colour.astype(int))
    assert np.percentile(blur, 95) < 12


def test_the_recording_of_a_kinect_is_that_kinect(tmp_path: Path) -> None:
    kinect, folder = Kinect(), tmp_path / "recording"
    bus = InsideBus(Host(kinect, patience=PATIENCE))
    with bus.running(), closing(KinectSensor("kinect", bus)) as sensor:
        record(sensor, folder, Limits(frames=4), Disk.real(), lambda progress: None)
    again = plugged(str(folder), count=4)
    assert again.camera.making.registration == kinect.camera.making.registration
    assert again.camera.making.padding == kinect.camera.making.padding
    shown = [view.depth for view in kinect.show.views]
    for view in again.show.views:
        assert any(np.array_equal(view.depth, it) for it in shown)


def test_a_calibration_is_told_as_it_is() -> None:
    typical = Calibration.typical()
    making = making_of(typical)
    told = Calibration.from_replies(
        making.registration_reply(),
        making.padding_reply(),
        making.fixed_reply(322),
        making.shift_reply(),
    )
    assert told.registration == typical.registration
    assert told.zero_plane == pytest.approx(typical.zero_plane)
    assert told == Calibration.from_json(typical.to_json())
