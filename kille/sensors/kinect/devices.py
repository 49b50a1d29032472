"""Which of the devices on a bus make a Kinect, and of what model it is.

Inside a Kinect is a hub, on which hang a camera, an audio device and, in model 1414, a
motor; so they are neighbours on the bus. Without its own power supply only some of them
show up.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import takewhile

from kille.sensors.kinect.transport import Plugged
from kille.sensors.sensor import SensorError

MICROSOFT = 0x045E
CAMERA, WINDOWS_CAMERA = 0x02AE, 0x02BF
MOTOR = 0x02B0
AUDIO = (0x02AD, 0x02BB, 0x02BE, 0x02C3)
SECOND = (0x02D9, 0x02C4)
"""Kinect v2, a different camera altogether."""

_RELEASE_OF_1414 = 0x010B


class Model(Enum):
    """The kinds of Kinect v1, by the number on their label."""

    XBOX_1414 = "1414"
    XBOX_1473 = "1473"
    WINDOWS = "for Windows"

    @property
    def alternate(self) -> int:
        """The setting of the camera's interface in which it streams."""
        return 1 if self is Model.WINDOWS else 0


@dataclass(frozen=True)
class Kinect:
    """What belongs to one Kinect; the motor only where it can be driven."""

    model: Model
    serial: str
    camera: Plugged
    motor: Plugged | None


def kinects(devices: Iterable[Plugged]) -> tuple[Kinect, ...]:
    """All Kinects with a camera, in the order of their places."""
    parts = [it for it in devices if it.vendor == MICROSOFT]
    cameras = [it for it in parts if it.product in (CAMERA, WINDOWS_CAMERA)]
    return tuple(
        _around(camera, [it for it in parts if _nearest(it, cameras) is camera])
        for camera in cameras
    )


def chosen(devices: Sequence[Plugged], serial: str | None) -> Kinect:
    """The Kinect of that serial number, or the first; SensorError if there is none."""
    found = kinects(devices)
    if not found:
        raise SensorError(_why_none(devices))
    if serial is None:
        return found[0]
    for kinect in found:
        if kinect.serial == serial:
            return kinect
    hidden = "one whose number cannot be read (kille doctor says why)"
    known = " and ".join(kinect.serial or hidden for kinect in found)
    raise SensorError(f"no Kinect has the serial number {serial}; plugged in: {known}")


def _around(camera: Plugged, parts: Sequence[Plugged]) -> Kinect:
    """The camera with what is nearer to it than to any other."""
    audio = _nearest(camera, [it for it in parts if it.product in AUDIO])
    motor = _nearest(camera, [it for it in parts if it.product == MOTOR])
    # Later models send zeros; their audio device tells the number.
    own = camera.serial if camera.serial.strip("0") else ""
    return Kinect(_model(camera), own or (audio.serial if audio else ""), camera, motor)


def _nearest(device: Plugged, others: Sequence[Plugged]) -> Plugged | None:
    """The one with which the way from the computer is shared the longest."""
    return max(others, key=lambda it: _shared(it.place, device.place), default=None)


def _shared(one: tuple[int, ...], other: tuple[int, ...]) -> int:
    """How many places from the beginning are the same.

    >>> _shared((1, 2, 3), (1, 2, 4, 1))
    2
    """
    steps = zip(one, other, strict=False)
    return sum(1 for _ in takewhile(lambda step: step[0] == step[1], steps))


def _model(camera: Plugged) -> Model:
    if camera.product == WINDOWS_CAMERA:
        return Model.WINDOWS
    if camera.release == _RELEASE_OF_1414:
        return Model.XBOX_1414
    return Model.XBOX_1473


def _why_none(devices: Sequence[Plugged]) -> str:
    products = {it.product for it in devices if it.vendor == MICROSOFT}
    if products & {MOTOR, *AUDIO}:
        return (
            "a Kinect is plugged in, but its camera has no power; "
            "plug in the Kinect's own power supply"
        )
    if products & set(SECOND):
        return (
            "this is a Kinect v2, which cannot be used; it takes a Kinect v1, "
            "model 1414, 1473 or for Windows"
        )
    return "no Kinect is plugged in; plug in its USB cable and its power supply"
