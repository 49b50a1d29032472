"""The Kinect v1 over USB: a pure protocol core, and transports behind one interface."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kille.sensors.kinect.sensor import KinectSensor

__all__ = ["open_kinect"]


def open_kinect(name: str) -> KinectSensor:
    """The Kinect of that name on this computer's USB; for names see `.address`.

    SensorError if it cannot be had: one line says what to do.
    """
    # USB and the thread that serves it are only for those who ask for them.
    from kille.sensors.kinect.sensor import KinectSensor
    from kille.sensors.kinect.transport import TransportError
    from kille.sensors.kinect.troubles import told
    from kille.sensors.kinect.usb import UsbBus
    from kille.sensors.sensor import SensorError

    try:
        bus = UsbBus()
    except TransportError as error:
        raise SensorError(told(name, error)) from error
    return KinectSensor(name, bus)
