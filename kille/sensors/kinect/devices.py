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

from kille.sensors.kinect.transport import PluggedDevice
from kille.sensors.sensor import SensorError

MICROSOFT = 0x045E
CAMERA, WINDOWS_CAMERA = 0x02AE, 0x02BF
MOTOR = 0x02B0
AUDIO = (0x02AD, 0x02BB, 0x02BE, 0x02C3)
SECOND = (0x02D9, 0x02C4)
"""Kinect v2, a different camera altogether."""

_RELEASE_OF_1414 = 0x010B


class KinectModel(Enum):
    """The kinds of Kinect v1, by the number on their label."""

    XBOX_1414 = "1414"
    XBOX_1473 = "1473"
    WINDOWS = "for Windows"

    @property
    def alternate(self) -> int:
        """The setting of the camera's interface in which it streams."""
        return 1 if self is KinectModel.WINDOWS else 0


@dataclass(frozen=True)
class Kinect:
    """The devices of one Kinect; the motor only if it can be driven."""

    model: KinectModel
    serial: str
    camera: PluggedDevice
    motor: PluggedDevice | None


def kinects(devices: Iterable[PluggedDevice]) -> tuple[Kinect, ...]:
    """All Kinects with a camera, in the order of their places."""
    parts = [it for it in devices if it.vendor == MICROSOFT]
    cameras = [it for it in parts if it.product in (CAMERA, WINDOWS_CAMERA)]
    return tuple(
        _around(camera, [it for it in parts if _only_nearest(it, cameras) is camera])
        for camera in cameras
    )


def choose_kinect(devices: Sequence[PluggedDevice], serial: str | None) -> Kinect:
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


def again(devices: Sequence[PluggedDevice], before: Kinect) -> Kinect:
    """The Kinect that was opened before; SensorError if it is not plugged in now.

    It is recognised by its serial number. If that could not be read, then or now, the
    one in the same place is returned: compare the calibrations.
    """
    found = kinects(devices)
    if not found:
        raise SensorError(_why_none(devices))
    if before.serial:
        for kinect in found:
            if kinect.serial == before.serial:
                return kinect
    for kinect in found:
        unknown = not (kinect.serial and before.serial)
        if unknown and kinect.camera.place == before.camera.place:
            return kinect
    others = " and ".join(kinect_name(kinect) for kinect in found)
    raise SensorError(
        f"the {kinect_name(before)} that was looked through is gone, and another is "
        f"plugged in: {others}; plug it in again where it was, or start again to use "
        "another"
    )


def kinect_name(kinect: Kinect) -> str:
    """A Kinect by its serial number, or by its place on the bus if it tells none.

    >>> DEVICE = PluggedDevice(0, 0, 0, "", (1, 2, 3))
    >>> kinect_name(Kinect(KinectModel.XBOX_1414, "", DEVICE, None))
    'Kinect without a serial number at USB 1-2.3'
    """
    if kinect.serial:
        return f"Kinect {kinect.serial}"
    bus, *ports = kinect.camera.place
    at = f"{bus}-{'.'.join(map(str, ports))}"
    return f"Kinect without a serial number at USB {at}"


def _around(camera: PluggedDevice, parts: Sequence[PluggedDevice]) -> Kinect:
    """The camera with the parts that belong to it and to no other camera.

    Parts of a Kinect hang on one hub, and the camera may hang on a hub below it. So a
    part of a Kinect whose camera is not there is not taken for that of another.
    """
    around = [it for it in parts if _same_hub(it, camera)]
    audio = _nearest(camera, [it for it in around if it.product in AUDIO])
    motor = _nearest(camera, [it for it in around if it.product == MOTOR])
    model = _model(camera)
    # Later models send zeros; their audio device tells the number.
    own = camera.serial if camera.serial.strip("0") else ""
    return Kinect(
        model,
        own or (audio.serial if audio else ""),
        camera,
        motor if model is KinectModel.XBOX_1414 else None,
    )


def _same_hub(part: PluggedDevice, camera: PluggedDevice) -> bool:
    """Whether the hub on which a part hangs is on the way to the camera."""
    hub = part.place[:-1]
    return camera.place[: len(hub)] == hub


def _nearest(
    device: PluggedDevice, others: Sequence[PluggedDevice]
) -> PluggedDevice | None:
    """The one with which the way from the computer is shared the longest."""
    return max(
        others, key=lambda it: _shared_length(it.place, device.place), default=None
    )


def _only_nearest(
    device: PluggedDevice, others: Sequence[PluggedDevice]
) -> PluggedDevice | None:
    """The nearest one, unless another is as near."""
    if device in others:
        return device
    ways = sorted(_shared_length(it.place, device.place) for it in others)
    return None if ways[-1:] == ways[-2:-1] else _nearest(device, others)


def _shared_length(one: tuple[int, ...], other: tuple[int, ...]) -> int:
    """How many places from the beginning are the same.

    >>> _shared_length((1, 2, 3), (1, 2, 4, 1))
    2
    """
    steps = zip(one, other, strict=False)
    return sum(1 for _ in takewhile(lambda step: step[0] == step[1], steps))


def _model(camera: PluggedDevice) -> KinectModel:
    if camera.product == WINDOWS_CAMERA:
        return KinectModel.WINDOWS
    if camera.release == _RELEASE_OF_1414:
        return KinectModel.XBOX_1414
    return KinectModel.XBOX_1473


def _why_none(devices: Sequence[PluggedDevice]) -> str:
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
