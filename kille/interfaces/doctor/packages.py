"""Check the packages that this distribution and its extras require."""

from __future__ import annotations

import re
import shlex
import shutil
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, metadata, requires, version
from operator import eq, ge, gt, le, lt, ne
from pathlib import Path

from kille.interfaces.doctor.findings import DoctorFinding

_USES = {
    "plots": "figures in reports",
    "usb": "a libusb, where the system has none",
    "record": "recordings as bags of ROS",
    "speech": "hearing what is said",
    "ros2": "nodes that speak to ROS 2",
    "faiss": "a faster search in a large memory",
    "embedding": "another way to tell things apart",
    "experiments": "measuring and comparing, as studies and kille evaluate do",
    "page": "the robot in a browser",
    "browser": "the page's tests in a real browser",
    "test": "property tests of types and rules",
    "dev": "work on kille itself",
    "senses": "its tests of recordings, speech and ROS",
}
"""What each extra is for."""


def packages() -> Iterator[DoctorFinding]:
    """The packages that are always needed: those that are missing, or all."""
    wanted = {_name(requirement): requirement for requirement in _requirements("")}
    found = {name: _installed_version(name) for name in wanted}
    for name, requirement in wanted.items():
        if found[name] is None:
            yield DoctorFinding(name, False, True, "not installed", pip(requirement))
    if all(found.values()):
        told = ", ".join(f"{name} {number}" for name, number in found.items())
        yield DoctorFinding("packages", True, True, told)


def extras() -> Iterator[DoctorFinding]:
    """The packages that only some uses need, such as drawing or testing."""
    for extra in metadata("kille").get_all("Provides-Extra") or ():
        yield _extra(extra)


def pip(wanted: str) -> str:
    """The command that installs a package for the Python that is running.

    That is another one than plain `pip` serves where no environment is activated.
    """
    found = shutil.which("pip")
    python = Path(sys.executable)
    own = found is not None and Path(found).parent == python.parent
    program = "pip" if own else f"{shlex.quote(str(python))} -m pip"
    return f"{program} install '{wanted}'"


def _extra(extra: str) -> DoctorFinding:
    part, use = f"extra [{extra}]", _USES.get(extra, "")
    wanted = [_name(it) for it in _requirements(extra)]
    missing = [it for it in wanted if _installed_version(it) is None]
    if not missing:
        return DoctorFinding(part, True, False, _describe_use(use, ", ".join(wanted)))
    state = _describe_use(use, f"lacks {', '.join(missing)}")
    return DoctorFinding(part, False, False, state, pip(f"kille[{extra}]"))


def _describe_use(use: str, packages: str) -> str:
    return f"{use} ({packages})" if use else packages


def _requirements(extra: str) -> list[str]:
    """The requirements of this distribution, or of one of its extras, as pip writes
    them, without those for other versions of Python.
    """
    parted = [line.partition(";") for line in requires("kille") or ()]
    return [
        unfolded
        for requirement, _, marker in parted
        if re.findall(r"extra == ['\"](\w+)['\"]", marker) == ([extra] if extra else [])
        if _is_for_this_python(marker)
        for unfolded in _unfold(requirement.strip())
    ]


_COMPARED = {"<": lt, "<=": le, "==": eq, "!=": ne, ">=": ge, ">": gt}


def _is_for_this_python(marker: str) -> bool:
    """Whether all that a marker says of the version of Python holds."""
    said = re.findall(r"python_version\s*([<>=!]+)\s*['\"](\d+)\.(\d+)['\"]", marker)
    return all(
        _COMPARED[sign](sys.version_info[:2], (int(major), int(minor)))
        for sign, major, minor in said
    )


def _unfold(requirement: str) -> list[str]:
    """Replace a requirement of another extra of ours by that extra's requirements."""
    if _name(requirement) != "kille":
        return [requirement]
    others = re.findall(r"\w+", requirement.partition("[")[2])
    return [required for extra in others for required in _requirements(extra)]


def _name(requirement: str) -> str:
    return re.split(r"[^\w.-]", requirement, maxsplit=1)[0]


def _installed_version(name: str) -> str | None:
    """The version of an installed package, or None."""
    try:
        return version(name)
    except PackageNotFoundError:
        return None
