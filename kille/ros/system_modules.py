"""Finding the modules of ROS 1, also from a virtual environment.

ROS comes with the system, and a virtual environment does not see the system's modules.
To see all of them would be too much: an older NumPy or OpenCV could get in. So only the
modules of ROS itself are found there, after all others, in a process that asks for
them.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from importlib import import_module
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

from kille.bus import BusError

FOLDERS = ("/opt/ros/*/lib/python3/dist-packages", "/usr/lib/python3/dist-packages")
"""Where systems keep the modules of ROS: its own, and those packaged by Debian."""

NAMES = frozenset(
    (
        "catkin",
        "catkin_pkg",
        "dateutil",
        "distro",
        "genmsg",
        "genpy",
        "geometry_msgs",
        "pyparsing",
        "roscpp",
        "rosgraph",
        "rosgraph_msgs",
        "roslib",
        "rospkg",
        "rospy",
        "sensor_msgs",
        "std_msgs",
        "yaml",
    )
)
"""The modules of a node in Python, with those that they need."""

REMEDY = "sudo apt install ros-core python3-rospy python3-sensor-msgs"
"""The command by which Debian gets ROS."""

_MISSING = (
    "ROS 1 is not on this machine ({name} is missing): on Debian, `"
    + REMEDY
    + "`; elsewhere `source` the setup.bash of your ROS"
)


class Finder(MetaPathFinder):
    """Finds these modules in these folders."""

    def __init__(self, folders: Iterable[str], names: Iterable[str]) -> None:
        self.folders, self._names = tuple(folders), frozenset(names)

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        """A top-level module of that name; what is in packages is found as usual."""
        if path is not None or fullname not in self._names:
            return None
        return PathFinder.find_spec(fullname, list(self.folders), target)


def ros(name: str) -> ModuleType:
    """A module of ROS, such as `rospy`; BusError if ROS is not there."""
    _look_there_too()
    try:
        return import_module(name)
    except ImportError as error:
        raise BusError(_MISSING.format(name=error.name or name)) from error


def place_of(name: str) -> Path | None:
    """The folder in which a module of ROS lies, without importing it; None if nowhere.

    >>> place_of("nonesuch_msgs") is None
    True
    """
    _look_there_too()
    spec = find_spec(name)
    return None if spec is None or spec.origin is None else Path(spec.origin).parent


def _look_there_too() -> None:
    if not any(isinstance(it, Finder) for it in sys.meta_path):
        sys.meta_path.append(Finder(_present(FOLDERS), NAMES))


def _present(patterns: Iterable[str]) -> list[str]:
    """The folders of these patterns that are there."""
    root = Path("/")
    found = (sorted(root.glob(pattern.lstrip("/"))) for pattern in patterns)
    return [str(folder) for some in found for folder in some]
