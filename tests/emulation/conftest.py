"""The driver's two ways to an emulated Kinect: in process, and through libusb."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

import pytest
import usb.backend.libusb1 as pyusb

from kille.sensors.kinect import libusb, sensor
from kille.sensors.kinect.transport import TransportBus
from kille.sensors.kinect.usb import UsbBus
from kinect_emulator.building import compiler, library
from kinect_emulator.host import Host
from kinect_emulator.inside import InsideBus
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import PATIENCE, patient

SPEED = 3.0
"""The Kinect's clock goes faster than the one on the wall, to save time."""


class Wire(NamedTuple):
    """A bus as the driver sees it, and the hand that plugs Kinects in and out."""

    bus: TransportBus
    plug: Callable[[Kinect], None]
    unplug: Callable[[Kinect], None]


Wiring = Callable[..., Wire]


@pytest.fixture(scope="session")
def loadable(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The fake libusb under a name of its own, or a skip that says why not."""
    if compiler() is None:
        pytest.skip("no C compiler for the fake libusb: apt-get install gcc")
    return library(tmp_path_factory.mktemp("libusb"), "libusb-emulated.so")


@pytest.fixture(autouse=True)
def unhurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sensor that does not take a busy machine for a silent Kinect."""
    monkeypatch.setattr(sensor, "PATIENCE", 120.0)
    monkeypatch.setattr(sensor, "_SILENCE", 60.0)


@pytest.fixture(params=["inside", pytest.param("libusb", marks=pytest.mark.deep)])
def wired(request: pytest.FixtureRequest) -> Wiring:
    """Plugs Kinects into a bus whose clock runs; through libusb in deep runs."""
    return request.getfixturevalue(request.param)


@pytest.fixture(params=["inside", "libusb"])
def wired_both(request: pytest.FixtureRequest) -> Wiring:
    """Plugs Kinects into a bus whose clock runs; once for each transport."""
    return request.getfixturevalue(request.param)


@pytest.fixture
def inside() -> Iterator[Wiring]:
    """The transport without any library in between."""
    with ExitStack() as stack:

        def start(*kinects: Kinect) -> Wire:
            bus = InsideBus(Host(*kinects, patience=PATIENCE))
            stack.enter_context(bus.running(SPEED))
            return Wire(bus, bus.plug, bus.unplug)

        yield start


@pytest.fixture(name="libusb")
def through_libusb(
    loadable: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Wiring]:
    """The driver's own transport, on the fake libusb loaded into this process."""
    path = tmp_path / "socket"
    monkeypatch.setenv("KINECT_EMULATOR", str(path))
    monkeypatch.setattr(libusb, "_library", lambda: str(loadable))
    monkeypatch.setattr(pyusb, "_lib", None)
    monkeypatch.setattr(pyusb, "_lib_object", None)
    with ExitStack() as stack:

        def start(*kinects: Kinect) -> Wire:
            server = patient(*kinects, path=path, speed=SPEED)
            stack.enter_context(server.running())
            return Wire(UsbBus(), server.plug, server.unplug)

        yield start
        # pyusb's objects call the library when they are collected: while it is there.
        pyusb._lib_object = None
        gc.collect()
