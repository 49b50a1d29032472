"""The table of rooms names what there is, and every test belongs to a room."""

from __future__ import annotations

import runpy
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
TOOL = ROOT / "tools" / "rooms.py"

tool = runpy.run_path(str(TOOL))
rooms = tool["read_rooms"]()


def files_of(patterns: list[str], name: str) -> set[Path]:
    """The files with such a name among what the patterns match, and below it."""
    found = {ROOT / path for path in tool["paths_of"](patterns)}
    below = {file for path in found if path.is_dir() for file in path.rglob(name)}
    return below | {path for path in found if path.is_file() and path.match(name)}


def of_all(what: str, name: str) -> set[Path]:
    """The files with such a name among the sources, or the tests, of all rooms."""
    return {file for room in rooms.values() for file in files_of(room[what], name)}


@pytest.mark.parametrize("name", rooms)
def test_every_path_of_a_room_exists(name: str) -> None:
    patterns = [*rooms[name]["sources"], *rooms[name]["tests"]]
    assert [it for it in patterns if not list(ROOT.glob(it))] == []


def test_every_test_belongs_to_a_room() -> None:
    assert (
        set((ROOT / "tests").rglob("test_*.py")) - of_all("tests", "test_*.py") == set()
    )


@pytest.mark.parametrize("package", ["ttr", "kille"])
def test_every_package_is_in_a_room(package: str) -> None:
    inside = of_all("sources", "*.py")
    packages = {it.parent for it in (ROOT / package).rglob("*/__init__.py")}
    homeless = {it for it in packages if not any(it in path.parents for path in inside)}
    assert homeless - {ROOT / package} == set()


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["dialoges"], "there is no room 'dialoges': did you mean dialogues?"),
        (["xyz"], "there is no room 'xyz': rooms are safety, types, "),
        ([], "name a room: safety, types, "),
    ],
)
def test_a_room_that_is_not_there_is_one_line(words: list[str], line: str) -> None:
    done = subprocess.run(
        [sys.executable, str(TOOL), *words], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith(line)
    assert done.stderr.count("\n") == 1


def test_pytest_is_given_the_tests_of_a_room(monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[str] = []
    monkeypatch.setattr("os.execv", lambda program, words: given.extend(words))
    monkeypatch.chdir(ROOT)
    assert tool["main"](["display", "--co"]) is None
    assert given[given.index("--co") + 1 :] == rooms["display"]["tests"]
    assert given[given.index("-m", 3) + 1] == "not deep and not slow"
