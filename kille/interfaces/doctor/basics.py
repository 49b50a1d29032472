"""Check what everyone needs: Python, the simulated Kinect, and the memory."""

from __future__ import annotations

import os
import platform
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

from kille.interfaces.doctor.findings import DoctorFinding, failed_part


def python() -> Iterator[DoctorFinding]:
    """The version of Python."""
    found = platform.python_version()
    yield DoctorFinding("Python", sys.version_info >= (3, 11), True, found)


def synthetic() -> Iterator[DoctorFinding]:
    """The simulated Kinect, checked by a look at an empty table."""
    from kille.sensors.sources import open_sensor

    sensor = open_sensor("synthetic:empty")
    height, width = sensor.frame().colour.shape[:2]
    sensor.close()
    yield DoctorFinding("synthetic Kinect", True, True, f"{width}x{height} frames")


def memory() -> Iterator[DoctorFinding]:
    """The memory that `kille talk` uses: can it be read, or made, and written?"""
    from kille.memory import Memory, MemoryFileError, default_path

    path = default_path()
    if not os.path.exists(path):
        yield _to_be_made(path)
        return
    try:
        with Memory.open_to_read(path) as opened:
            words = len(opened.words())
    except MemoryFileError as error:
        yield failed_part("memory", True, error)
        return
    state = f"{words} word{'s' * (words != 1)} in {path}"
    if _writable(path) and _writable(path.parent):
        yield DoctorFinding("memory", True, True, state)
    else:
        remedy = "make the file and its folder writable, or set KILLE_MEMORY to another"
        state = f"{state}, where nothing can be added"
        yield DoctorFinding("memory", False, True, state, remedy)


def line_editing() -> Iterator[DoctorFinding]:
    """Arrow keys and a history in the terminal."""
    if find_spec("readline") is not None:
        yield DoctorFinding("line editing", True, False, "arrow keys and history")
        return
    yield DoctorFinding(
        "line editing",
        False,
        False,
        "this Python has no readline",
        "install a Python that was built with it",
    )


def _to_be_made(path: Path) -> DoctorFinding:
    """A memory that does not exist yet, in folders that may not exist yet."""
    there = next(it for it in path.absolute().parents if os.path.exists(it))
    if there.is_dir() and _writable(there):
        return DoctorFinding("memory", True, True, f"none yet; it will be {path}")
    state = f"none yet, and {path} cannot be made in {there}"
    return DoctorFinding(
        "memory", False, True, state, "set KILLE_MEMORY to a file elsewhere"
    )


def _writable(path: Path) -> bool:
    return os.access(path, os.W_OK)
