"""An emulated Kinect within the process, and the driver that looks through it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from kille.sensors.kinect.sensor import KinectSensor
from kinect_emulator.host import Host
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import PATIENCE


@pytest.fixture
def kinect() -> Kinect:
    return Kinect()


@pytest.fixture
def bus(kinect: Kinect) -> Iterator[InsideBus]:
    with InsideBus(Host(kinect, patience=PATIENCE)).running() as running:
        yield running


@pytest.fixture
def sensor(bus: InsideBus) -> Iterator[KinectSensor]:
    opened = KinectSensor("kinect", bus)
    yield opened
    opened.close()
