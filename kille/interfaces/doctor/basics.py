"""Whether what everyone needs works here: Python, the simulated Kinect, the memory."""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable
from importlib.util import find_spec

from kille.interfaces.doctor.finding import Finding

__all__ = ["line_editing", "memory", "python", "synthetic"]


def python() -> Finding:
    """The version of Python."""
    found = platform.python_version()
    return Finding("Python", sys.version_info >= (3, 11), True, found)


def synthetic() -> Finding:
    """The simulated Kinect, by a look at an empty table."""
    return _tried("synthetic Kinect", _look_at_nothing)


def memory() -> Finding:
    """The memory that `kille talk` uses, by opening it to read."""
    return _tried("memory", _open_memory)


def line_editing() -> Finding:
    """Arrow keys and a history in the terminal."""
    if find_spec("readline") is not None:
        return Finding("line editing", True, False, "arrow keys and history")
    return Finding(
        "line editing",
        False,
        False,
        "this Python has no readline",
        "install a Python that was built with it",
    )


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
