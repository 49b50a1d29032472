"""Which devices make a Kinect."""

from __future__ import annotations

import pytest

from kille.sensors.kinect.devices import Kinect, KinectModel, choose_kinect, kinects
from kille.sensors.kinect.transport import PluggedDevice
from kille.sensors.sensor import SensorError

ZEROS = "0000000000000000"


def device(
    product: int, *place: int, serial: str = "", release: int = 0x010B
) -> PluggedDevice:
    return PluggedDevice(0x045E, product, release, serial, place)


OLD = (
    device(0x02B0, 1, 2, 1),
    device(0x02AD, 1, 2, 2, serial="A1"),
    device(0x02AE, 1, 2, 3, serial="B1"),
)
NEW = (
    device(0x02AD, 1, 4, 1, serial="A2"),
    device(0x02AE, 1, 4, 2, serial=ZEROS, release=0x0114),
)
FOR_WINDOWS = (
    device(0x02BE, 3, 1, 1, serial="A3"),
    device(0x02BF, 3, 1, 2, serial=ZEROS, release=0x0114),
)
MOUSE = PluggedDevice(0x046D, 0xC077, 1, "", (1, 1))


def test_each_camera_finds_its_own_motor_and_number() -> None:
    found = kinects((MOUSE, *OLD, *NEW, *FOR_WINDOWS))
    assert found == (
        Kinect(KinectModel.XBOX_1414, "B1", OLD[2], OLD[0]),
        Kinect(KinectModel.XBOX_1473, "A2", NEW[1], None),
        Kinect(KinectModel.WINDOWS, "A3", FOR_WINDOWS[1], None),
    )


def test_neighbours_need_not_hang_on_the_same_hub() -> None:
    deeper = (device(0x02B0, 1, 2, 1), device(0x02AE, 1, 2, 3, 1, serial="B1"))
    (found,) = kinects(deeper)
    assert found.motor is deeper[0]


def test_a_kinect_is_chosen_by_its_number_or_comes_first() -> None:
    devices = (*OLD, *NEW)
    assert choose_kinect(devices, None).serial == "B1"
    assert choose_kinect(devices, "A2").model is KinectModel.XBOX_1473
    with pytest.raises(SensorError, match="number C9; plugged in: B1 and A2"):
        choose_kinect(devices, "C9")
    with pytest.raises(SensorError, match="one whose number cannot be read"):
        choose_kinect((*OLD[:1], device(0x02AE, 1, 2, 3)), "B1")


@pytest.mark.parametrize(
    ("devices", "said"),
    [
        ((), "no Kinect is plugged in"),
        ((MOUSE,), "no Kinect is plugged in"),
        (OLD[:1], "its camera has no power"),
        (NEW[:1], "its camera has no power"),
        ((device(0x02C4, 2, 1),), "this is a Kinect v2"),
        ((device(0x02D9, 2, 1),), "this is a Kinect v2"),
    ],
)
def test_what_is_no_kinect_is_told(
    devices: tuple[PluggedDevice, ...], said: str
) -> None:
    with pytest.raises(SensorError, match=said):
        choose_kinect(devices, None)
