"""`kille doctor`: what works on this machine, what is missing, and how to get it."""

from __future__ import annotations

import json
import platform
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, metadata, requires, version
from importlib.util import find_spec

from kille.interfaces.terminal import FAILED, FINE, console, hanging

__all__ = ["Finding", "as_json", "as_text", "doctor"]

KINECT_VENDOR, KINECT_CAMERAS = 0x045E, (0x02AE, 0x02BF)


@dataclass(frozen=True)
class Finding:
    """The state of one part; `remedy` is the command or step that mends it."""

    part: str
    works: bool
    needed: bool
    state: str
    remedy: str = ""


Report = Callable[[Sequence[Finding]], None]
"""How findings are printed."""


def doctor(report: Report) -> int:
    """Prints the findings; the exit code is 1 if a needed part does not work."""
    findings = list(_findings())
    report(findings)
    broken = any(finding.needed and not finding.works for finding in findings)
    return FAILED if broken else FINE


def as_json(findings: Sequence[Finding]) -> None:
    """The findings as a list of objects, for machines."""
    console().print_json(json.dumps([asdict(finding) for finding in findings]))


def as_text(findings: Sequence[Finding]) -> None:
    """A line for each finding, for people."""
    width = max(len(finding.part) for finding in findings)
    out = console()
    for finding in findings:
        mark, style = _mark(finding)
        state = ": ".join(filter(None, (finding.state, finding.remedy)))
        out.print(f"{mark:>7}", style=style, end="")
        line = hanging(f"{'':7}  {finding.part:<{width}}  ", state)
        out.print(line[7:], markup=False)


def _mark(finding: Finding) -> tuple[str, str]:
    """The word for how it is, and its colour."""
    if finding.works:
        return "ok", "green"
    return ("MISSING", "red") if finding.needed else ("absent", "yellow")


def _findings() -> Iterator[Finding]:
    yield _python()
    for requirement in _required(""):
        yield _package(requirement)
    yield _tried("synthetic Kinect", _look_at_nothing)
    yield _tried("memory", _open_memory)
    yield _kinect()
    yield _line_editing()
    for extra in metadata("kille").get_all("Provides-Extra") or ():
        yield _extra(extra)


def _python() -> Finding:
    found = platform.python_version()
    return Finding("Python", sys.version_info >= (3, 11), True, found)


def _required(extra: str) -> list[str]:
    """What this distribution requires, plainly or for an extra, as pip writes it."""
    parted = [line.partition(";") for line in requires("kille") or ()]
    return [
        requirement.strip()
        for requirement, _, marker in parted
        if re.findall(r"extra == ['\"](\w+)['\"]", marker) == ([extra] if extra else [])
    ]


def _package(requirement: str) -> Finding:
    name = _name(requirement)
    found = _installed(name)
    if found is None:
        remedy = f"pip install '{requirement}'"
        return Finding(name, False, True, "not installed", remedy)
    return Finding(name, True, True, found)


def _extra(extra: str) -> Finding:
    """The packages that only some uses need, such as drawing or testing."""
    part = f"extra [{extra}]"
    wanted = [it for it in _required(extra) if _name(it) != "kille"]
    missing = [it for it in wanted if _installed(_name(it)) is None]
    if not missing:
        return Finding(part, True, False, ", ".join(map(_name, wanted)))
    state = f"not installed are {', '.join(map(_name, missing))}"
    return Finding(part, False, False, state, f"pip install {_quoted(missing)}")


def _quoted(words: Iterable[str]) -> str:
    return " ".join(f"'{word}'" for word in words)


def _name(requirement: str) -> str:
    return re.split(r"[^\w.-]", requirement, maxsplit=1)[0]


def _installed(name: str) -> str | None:
    """The version of a package, or None."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _tried(part: str, attempt: Callable[[], str]) -> Finding:
    """A needed part, found working or not by using it."""
    try:
        return Finding(part, True, True, attempt())
    except Exception as error:
        return Finding(part, False, True, " ".join(str(error).split()))


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


def _line_editing() -> Finding:
    if find_spec("readline") is not None:
        return Finding("line editing", True, False, "arrow keys and history")
    return Finding(
        "line editing",
        False,
        False,
        "this Python has no readline",
        "install a Python that was built with it",
    )


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
