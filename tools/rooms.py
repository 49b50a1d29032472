"""Run the tests of one room of the house: its doctests, its tests, and its laws.

    make test ROOM=dialogue
    python tools/rooms.py dialogue -x -k naming

Rooms, and what tests them, are listed in pyproject.toml, in [tool.kille.rooms]. Tests
marked as slow are left out; `make test` runs them all. What follows the room's name is
for pytest.
"""

from __future__ import annotations

import difflib
import os
import sys
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypedDict

ROOT = Path(__file__).resolve().parent.parent
PARALLEL = ("-n", "auto", "--dist", "worksteal")
QUICK = ("-m", "not deep and not slow")


class TestRoom(TypedDict):
    """Patterns of paths below the project: what is in the room, and what tests it."""

    sources: list[str]
    tests: list[str]


def read_rooms() -> Mapping[str, TestRoom]:
    """The rooms by name, as pyproject.toml lists them."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    rooms: Mapping[str, TestRoom] = settings["tool"]["kille"]["rooms"]
    return rooms


def paths_of(patterns: Sequence[str]) -> list[str]:
    """The files and folders that match, each once, as paths below the project."""
    found = (path for pattern in patterns for path in sorted(ROOT.glob(pattern)))
    return list(dict.fromkeys(path.relative_to(ROOT).as_posix() for path in found))


def complaint(name: str, rooms: Mapping[str, TestRoom]) -> str:
    """One line for a name that no room has, with the name that may be meant."""
    like = difflib.get_close_matches(name, rooms, n=1)
    hint = f"did you mean {like[0]}?" if like else f"rooms are {', '.join(rooms)}"
    return f"there is no room {name!r}: {hint}"


def main(arguments: Sequence[str]) -> str | None:
    """Becomes pytest on the room's tests; a line if there is no such room."""
    rooms = read_rooms()
    if not arguments:
        return f"name a room: {', '.join(rooms)}"
    name, *options = arguments
    if name not in rooms:
        return complaint(name, rooms)
    os.chdir(ROOT)
    tests = paths_of(rooms[name]["tests"])
    command = [sys.executable, "-m", "pytest", *PARALLEL, *QUICK, *options, *tests]
    os.execv(command[0], command)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
