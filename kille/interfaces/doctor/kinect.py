"""Check whether a Kinect is plugged in and gives pictures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from kille.interfaces.doctor.findings import DoctorFinding, failed_part

if TYPE_CHECKING:
    from kille.sensors.kinect.devices import Kinect
    from kille.sensors.kinect.driver import Driver, Streams
    from kille.sensors.kinect.transport import TransportBus

_PATIENCE = 5.0
"""Seconds to wait for the first picture."""


def kinect() -> Iterator[DoctorFinding]:
    """The Kinects on this computer's USB, and whether they give pictures."""
    from kille.sensors.kinect import usb_driver
    from kille.sensors.kinect.transport import TransportError

    try:
        yield from kinect_findings(usb_driver())
    except TransportError as error:
        yield _failed_kinect("Kinect", error)


def kinect_findings(bus: TransportBus | Driver) -> Iterator[DoctorFinding]:
    """One finding for each Kinect on the bus, or why there is none."""
    from kille.sensors.kinect.devices import choose_kinect, kinects
    from kille.sensors.kinect.driver import driver_of
    from kille.sensors.sensor import SensorError

    driver = driver_of(bus)
    try:
        devices = driver.devices()
        choose_kinect(devices, None)
        for each in kinects(devices):
            yield _try_kinect(driver, each)
    except SensorError as error:
        yield failed_part("Kinect", False, error)
    finally:
        driver.close()


def _try_kinect(driver: Driver, found: Kinect) -> DoctorFinding:
    """Check whether this Kinect gives pictures, by looking as the robot would."""
    from kille.sensors.kinect.commands import BadReplyError
    from kille.sensors.kinect.devices import again
    from kille.sensors.kinect.streams import COLOUR
    from kille.sensors.kinect.transport import TransportError
    from kille.sensors.sensor import SensorError

    part = f"Kinect {found.model.value}"
    try:
        streams = driver.start(again(driver.devices(), found), COLOUR)
        try:
            streams.frame(_PATIENCE)
            head = _head(streams)
        finally:
            streams.close()
    except (TransportError, BadReplyError, SensorError) as error:
        return _failed_kinect(part, error)
    named = f":{found.serial}" if found.serial else ""
    return DoctorFinding(
        part, True, False, f"try kille talk --sensor kinect{named}{head}"
    )


def _head(streams: Streams) -> str:
    """A remark on its motor; empty if the motor answers."""
    from kille.sensors.kinect.commands import BadReplyError
    from kille.sensors.kinect.devices import KinectModel
    from kille.sensors.kinect.diagnosis import trouble
    from kille.sensors.kinect.motor import Tilt
    from kille.sensors.kinect.transport import TransportError
    from kille.sensors.sensor import SensorError

    if streams.kinect.model is not KinectModel.XBOX_1414:
        return " (its head is turned by hand)"
    try:
        Tilt.from_reply(streams.motor_state())
    except (TransportError, BadReplyError, SensorError) as error:
        return (
            f" (its head cannot be turned: {'; '.join(filter(None, trouble(error)))})"
        )
    return ""


def _failed_kinect(part: str, error: Exception) -> DoctorFinding:
    from kille.sensors.kinect.diagnosis import trouble

    state, remedy = trouble(error)
    return DoctorFinding(part, False, False, state, remedy)
