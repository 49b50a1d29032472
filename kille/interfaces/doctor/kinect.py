"""Whether a Kinect is there and may be opened."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from kille.interfaces.doctor.finding import Finding, failed

if TYPE_CHECKING:
    from kille.sensors.kinect.devices import Kinect
    from kille.sensors.kinect.transport import Bus

__all__ = ["kinect", "plugged_in"]


def kinect() -> Iterator[Finding]:
    """What is plugged into this computer's USB, and whether it can be had."""
    from kille.sensors.kinect.transport import TransportError
    from kille.sensors.kinect.usb import UsbBus

    try:
        yield from plugged_in(UsbBus())
    except TransportError as error:
        yield _refused("Kinect", error)


def plugged_in(bus: Bus) -> Iterator[Finding]:
    """One finding for each Kinect on the bus, or why there is none."""
    from kille.sensors.kinect.devices import chosen, kinects
    from kille.sensors.sensor import SensorError

    devices = bus.devices()
    try:
        chosen(devices, None)
    except SensorError as error:
        yield failed("Kinect", False, error)
        return
    for each in kinects(devices):
        yield _opened(bus, each)


def _opened(bus: Bus, found: Kinect) -> Finding:
    """Whether this one can be opened: found out by doing it."""
    from kille.sensors.kinect.transport import TransportError

    part = f"Kinect {found.model.value}"
    try:
        bus.open(found.camera, found.model.alternate).close()
    except TransportError as error:
        return _refused(part, error)
    named = f":{found.serial}" if found.serial else ""
    tilts = "" if found.motor else " (its head is turned by hand)"
    state = f"try kille talk --sensor kinect{named}{tilts}"
    return Finding(part, True, False, state)


def _refused(part: str, error: Exception) -> Finding:
    from kille.sensors.kinect.troubles import trouble

    state, remedy = trouble(error)
    return Finding(part, False, False, state, remedy)
