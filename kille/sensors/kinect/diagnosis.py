"""What went wrong, in one line that says what to do about it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from kille.sensors.kinect.commands import BadReplyError
from kille.sensors.kinect.devices import Kinect, KinectModel
from kille.sensors.kinect.packets import StreamCounts
from kille.sensors.kinect.transport import (
    AccessDeniedError,
    DeviceBusyError,
    DeviceGoneError,
    KernelDriverError,
    NoLibraryError,
    StalledError,
)

KERNEL_DRIVER = "gspca_kinect"

UDEV_RULE = (
    'SUBSYSTEM=="usb", ATTR{idVendor}=="045e", '
    'ATTR{idProduct}=="02ae|02ad|02b0|02bb|02be|02bf|02c3", MODE="0666"'
)
ALLOW = (
    f"echo '{UDEV_RULE}' | sudo tee /etc/udev/rules.d/51-kinect.rules "
    "&& sudo udevadm control --reload && sudo udevadm trigger"
)
"""Lets every user of this computer open a Kinect."""

_TOO_BUSY = 0.1
"""The share of microframes that were missed from which that is what is the matter."""

_LOSSY = 0.01
"""The share of packets that were lost from which that is what is the matter."""

GET_LIBRARY = "pip install 'kille[usb]'"
UNLOAD = f"sudo modprobe -r {KERNEL_DRIVER}"


class Diagnosis(NamedTuple):
    """What is the matter, and the command or the step that mends it, if any does."""

    state: str
    remedy: str = ""


def explain_error(name: str, error: Exception) -> str:
    """The line for an error of opening, asking or streaming.

    >>> explain_error("kinect", DeviceGoneError("No such device"))
    'kinect: it was unplugged; plug it in again'
    """
    return f"{name}: {'; '.join(filter(None, trouble(error)))}"


def trouble(error: Exception) -> Diagnosis:
    """What an error of opening, asking or streaming means."""
    match error:
        case NoLibraryError():
            return Diagnosis("there is no libusb to talk to it", GET_LIBRARY)
        case AccessDeniedError():
            return Diagnosis("there is no permission to open it", ALLOW)
        case KernelDriverError() if driver_loaded():
            return Diagnosis(f"the kernel's driver {KERNEL_DRIVER} has it", UNLOAD)
        case DeviceBusyError():
            return Diagnosis("another program has it", "close that program")
        case DeviceGoneError():
            return Diagnosis("it was unplugged", "plug it in again")
        case StalledError():
            return Diagnosis("it does not answer", "unplug it and plug it in again")
        case BadReplyError():
            state = f"it answers nonsense ({error})"
            return Diagnosis(state, "unplug it and plug it in again")
        case _:
            return Diagnosis(" ".join(str(error).split()))


def no_pictures(counts: Sequence[StreamCounts], failures: Iterable[Exception]) -> str:
    """Why no pair of pictures came in some time, by what came in it.

    >>> no_pictures([StreamCounts(packets=900), StreamCounts()], ())
    'one of its two cameras sends nothing; unplug it and plug it in again'
    """
    for failure in failures:
        return f"its frames cannot be taken: {failure!r}"
    packets = sum(it.packets for it in counts)
    if all(it.packets == 0 for it in counts):
        return (
            "it answers but sends no pictures; plug it into another USB port, a USB 2 "
            "one if there is any, with no hub between"
        )
    if any(it.packets == 0 for it in counts):
        return "one of its two cameras sends nothing; unplug it and plug it in again"
    missed = max(it.missed / (it.missed + it.packets) for it in counts)
    if missed > _TOO_BUSY:
        return (
            f"this computer was too busy to read {missed:.0%} of what it sent; "
            "close other programs, or let them do less"
        )
    lost = sum(it.lost for it in counts)
    if all(it.frames for it in counts) and lost <= _LOSSY * (packets + lost):
        return (
            "pictures and depth come, but their clocks differ, so that none belong "
            "together; unplug it and plug it in again"
        )
    whole = (
        "pictures are seldom whole"
        if any(it.frames for it in counts)
        else ("no picture is whole")
    )
    return (
        f"{whole}, {lost} of {packets + lost} packets were lost; plug it "
        "into a USB port that it shares with no other camera or disk"
    )


def no_motor(kinect: Kinect) -> str:
    """Why its head cannot be turned nor its light set."""
    if kinect.model is KinectModel.XBOX_1414:
        return "its motor is not found; plug in the Kinect's own power supply"
    return (
        f"the motor and light of a Kinect {kinect.model.value} are behind its audio "
        "device, which needs a program of Microsoft's; turn its head by hand"
    )


def driver_loaded() -> bool:
    """Whether the kernel has its own driver for the camera."""
    try:
        modules = Path("/proc/modules").read_text()
    except OSError:
        return False
    return any(line.startswith(f"{KERNEL_DRIVER} ") for line in modules.splitlines())
