"""`kille doctor`: what works on this machine, what is missing, and how to get it."""

from __future__ import annotations

import json
import platform
import sys
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version

from kille.interfaces.terminal import FAILED, FINE, console

__all__ = ["doctor"]

KINECT_VENDOR, KINECT_CAMERAS = 0x045E, (0x02AE, 0x02BF)


@dataclass(frozen=True)
class Finding:
    """The state of one part; `remedy` is the command or step that mends it."""

    part: str
    works: bool
    needed: bool
    state: str
    remedy: str = ""


def doctor(*, as_json: bool) -> int:
    """Prints the findings; the exit code is 1 if a needed part does not work."""
    findings = list(_findings())
    if as_json:
        console().print_json(json.dumps([asdict(finding) for finding in findings]))
    else:
        for finding in findings:
            _tell(finding)
    broken = any(finding.needed and not finding.works for finding in findings)
    return FAILED if broken else FINE


def _tell(finding: Finding) -> None:
    mark = "ok" if finding.works else ("MISSING" if finding.needed else "absent")
    style = "green" if finding.works else ("red" if finding.needed else "yellow")
    remedy = f"; {finding.remedy}" if finding.remedy else ""
    out = console()
    out.print(f"{mark:>7}", style=style, end="  ")
    out.print(f"{finding.part:<16} {finding.state}{remedy}", markup=False)


def _findings() -> Iterator[Finding]:
    yield _python()
    for package in ("numpy", "opencv-contrib-python-headless", "scikit-learn", "lark"):
        yield _package(package)
    yield _tried("synthetic Kinect", _look_at_nothing, needed=True)
    yield _tried("memory", _open_memory, needed=True)
    yield _kinect()


def _python() -> Finding:
    found = platform.python_version()
    return Finding("Python", sys.version_info >= (3, 11), True, found)


def _package(name: str) -> Finding:
    try:
        return Finding(name, True, True, version(name))
    except PackageNotFoundError:
        return Finding(name, False, True, "not installed", f"pip install {name}")


def _tried(part: str, attempt: Callable[[], str], *, needed: bool) -> Finding:
    try:
        return Finding(part, True, needed, attempt())
    except Exception as error:
        return Finding(part, False, needed, " ".join(str(error).split()))


def _look_at_nothing() -> str:
    from kille.sensors.sources import open_sensor

    sensor = open_sensor("synthetic:empty")
    height, width = sensor.frame().colour.shape[:2]
    sensor.close()
    return f"{width}x{height} frames"


def _open_memory() -> str:
    from kille.memory import Memory, default_path

    path = default_path()
    if not path.exists():
        return f"none yet; it will be {path}"
    with Memory.reading(path) as memory:
        words = len(memory.words())
    return f"{words} word{'s' * (words != 1)} in {path}"


def _kinect() -> Finding:
    import usb.core

    try:
        found = [
            device
            for product in KINECT_CAMERAS
            for device in usb.core.find(
                find_all=True, idVendor=KINECT_VENDOR, idProduct=product
            )
        ]
    except usb.core.NoBackendError:
        return Finding(
            "Kinect", False, False, "no libusb found", "apt install libusb-1.0-0"
        )
    except usb.core.USBError as error:
        return Finding("Kinect", False, False, f"USB cannot be read: {error}")
    if not found:
        return Finding("Kinect", False, False, "none is plugged in")
    return Finding(
        "Kinect",
        False,
        False,
        f"{len(found)} plugged in",
        "its driver is not part of this version: record with another program, "
        "then kille talk --sensor PATH",
    )
