"""The Kinect v1 over USB: a pure protocol core, and transports behind one interface."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kille.sensors.kinect.driver import Driver
    from kille.sensors.kinect.sensor import KinectSensor

__all__ = ["open_kinect"]


def open_kinect(name: str) -> KinectSensor:
    """The Kinect of that name on this computer's USB; for names see `.address`.

    It is read by a process of its own, where the system allows that. SensorError if it
    cannot be had: one line says what to do.

    >>> from kille.sensors.sensor import SensorError
    >>> try:
    ...     sensor = open_kinect("kinect:nowhere")
    ... except SensorError as missing:
    ...     print("there is no such Kinect")
    there is no such Kinect
    """
    # USB, and what serves it, are only for those who ask for them.
    from kille.sensors.kinect.diagnosis import explain_error
    from kille.sensors.kinect.sensor import KinectSensor
    from kille.sensors.kinect.transport import TransportError
    from kille.sensors.sensor import SensorError

    try:
        return KinectSensor(name, usb_driver())
    except TransportError as error:
        raise SensorError(explain_error(name, error)) from error


def usb_driver() -> Driver:
    """What finds and reads Kinects on this computer's USB.

    A TransportError, now or when it is used first, if there is no USB to be had.
    """
    from kille.sensors.kinect.process_driver import ProcessDriver, can_be_used

    if can_be_used():
        return ProcessDriver()
    from kille.sensors.kinect.driver import LocalDriver
    from kille.sensors.kinect.usb import UsbBus

    return LocalDriver(UsbBus())
