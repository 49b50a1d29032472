"""Recorded sources: captures in a row, and galleries of stills.

A *recording* gives its frames one after another and begins again after the last. A
*gallery* holds stills: `frame` gives the same picture until `show` moves on, so that a
look of ten frames is a look at one picture. What a path is, is found by its content.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

from kille.scene import Frame
from kille.sensors.captures import (
    DESCRIPTIONS,
    Shot,
    description_of,
    is_sequence,
    read_scenes,
    read_sequence,
)
from kille.sensors.pictures import is_picture
from kille.sensors.sensor import At, Beside, Sensor, SensorError

RATE = 30.0
"""Frames a second: the pace of the sensors that made the recordings."""

KNOWN = (
    "a folder of NAME_color.png and NAME_depth.png with scene.json or index.json, "
    "a folder of pictures, a folder of such folders, or one picture"
)

_KEPT_FRAMES = 16


class Recording:
    """The frames of one scene in order of time; after the last comes the first."""

    def __init__(self, name: str, shots: Sequence[Shot]) -> None:
        self._name = name
        self._shots = tuple(shots)
        self._read = _reader()
        self._read(self._shots[0])
        self._given = 0

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    def frame(self) -> Frame:
        """The next frame; SensorError if its files cannot be read."""
        frame = self._read(self._shots[self._given % len(self._shots)])
        self._given += 1
        return replace(frame, time=(self._given - 1) / RATE)

    def close(self) -> None:
        """Let go of the source; a second call does nothing."""


class Gallery:
    """Stills by name: `frame` repeats the current one, `show` goes to the next.

    A name may have several pictures, as a category has: each `show` of it goes to its
    next picture, and after the last to its first. Before any `show` the very first
    picture is in view, which does not count as shown.
    """

    def __init__(self, name: str, shots: Mapping[str, Sequence[Shot]]) -> None:
        self._name = name
        self._shots = {thing: tuple(some) for thing, some in shots.items()}
        self._shown = dict.fromkeys(self._shots, 0)
        self._current = next(iter(self._shots.values()))[0]
        self._read = _reader()
        self._read(self._current)
        self._given = 0

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    def frame(self) -> Frame:
        """The current picture; SensorError if its files cannot be read."""
        frame = self._read(self._current)
        self._given += 1
        return replace(frame, time=(self._given - 1) / RATE)

    def close(self) -> None:
        """Let go of the source; a second call does nothing."""

    def things(self) -> tuple[str, ...]:
        """The names that can be shown."""
        return tuple(self._shots)

    def show(self, name: str) -> None:
        """Go to the next picture of that name; SensorError if there is no such name."""
        thing = self._thing(name)
        pictures = self._shots[thing]
        self._current = pictures[self._shown[thing] % len(pictures)]
        self._shown[thing] += 1

    def place(self, name: str, spot: At | Beside) -> None:
        """SensorError: a picture is as it was taken."""
        raise SensorError(f"{self._name}: {name} cannot be moved in a recorded picture")

    def remove(self, name: str) -> None:
        """SensorError: a picture is as it was taken."""
        raise SensorError(
            f"{self._name}: {name} cannot be taken out of a recorded picture"
        )

    def _thing(self, name: str) -> str:
        spoken = {_spoken(thing): thing for thing in self._shots}
        if _spoken(name) in spoken:
            return spoken[_spoken(name)]
        raise SensorError(
            f"{self._name} has no {name}{_meant(_spoken(name), list(spoken))}; "
            f"it has {_some(list(self._shots))}"
        )


def open_recording(name: str) -> Sensor:
    """The recording at this path; its format is found by its content.

    `FOLDER/SCENE` names one scene of a folder of scenes. SensorError if nothing is
    there, it cannot be read, is empty or of no known format, or its first frame fails.
    """
    path = Path(name).expanduser()
    try:
        return _open(name, path)
    except OSError as error:
        raise SensorError(f"{name}: cannot be read ({error.strerror})") from error


def _open(name: str, path: Path) -> Sensor:
    if path.is_dir():
        return _open_folder(name, path)
    if path.is_file() and is_picture(path):
        return Recording(name, [Shot(path.stem, path)])
    if path.exists():
        raise SensorError(f"{name}: unknown format; known are {KNOWN}")
    return _open_scene(name, path)


def _open_scene(name: str, path: Path) -> Sensor:
    description = description_of(path.parent)
    if description is None:
        raise _not_there(name, path, [it.name for it in _entries(path.parent)])
    shots = {shot.name: shot for shot in _captures(description)}
    if path.name not in shots:
        raise _not_there(name, path, list(shots))
    return Recording(name, [shots[path.name]])


def _open_folder(name: str, folder: Path) -> Sensor:
    description = description_of(folder)
    if description is not None and is_sequence(description):
        return Recording(name, read_sequence(description))
    if description is not None:
        return Gallery(name, {it.name: [it] for it in read_scenes(description)})
    if any(folder.glob("*_color.png")) and any(folder.glob("*_depth.png")):
        raise SensorError(
            f"{name}: has depth pictures but none of {', '.join(DESCRIPTIONS)} "
            "to say the camera's intrinsics and the unit of depth"
        )
    if pictures := _pictures(folder):
        each = {shot.name: [shot] for shot in pictures}
        return Gallery(name, {folder.resolve().name: pictures} | each)
    return _open_categories(name, folder)


def _open_categories(name: str, folder: Path) -> Sensor:
    inner = [it for it in _entries(folder) if it.is_dir()]
    scenes = [it.name for it in inner if description_of(it) is not None]
    if scenes:
        raise SensorError(
            f"{name}: holds several recordings, name one of them: "
            + ", ".join(f"{name.rstrip('/')}/{scene}" for scene in scenes)
        )
    categories: dict[str, list[Shot]] = {}
    for it in inner:
        categories.setdefault(it.name.replace("_", " "), []).extend(_pictures(it))
    shown = {thing: pictures for thing, pictures in categories.items() if pictures}
    if shown:
        return Gallery(name, shown)
    if not any(folder.iterdir()):
        raise SensorError(f"{name}: the folder is empty; expected {KNOWN}")
    raise SensorError(f"{name}: unknown format; known are {KNOWN}")


def _captures(description: Path) -> tuple[Shot, ...]:
    if is_sequence(description):
        return read_sequence(description)
    return read_scenes(description)


def _pictures(folder: Path) -> list[Shot]:
    return [Shot(path.stem, path) for path in _entries(folder) if is_picture(path)]


def _entries(folder: Path) -> list[Path]:
    """What is in the folder in the order people count: cup2 before cup10."""
    if not folder.is_dir():
        return []
    return sorted(folder.iterdir(), key=lambda path: counting(path.name))


def counting(name: str) -> list[tuple[int, str]]:
    """A key for the order of names in which numbers count as numbers.

    >>> sorted(["cup10", "cup2", "cap"], key=counting)
    ['cap', 'cup2', 'cup10']
    """
    parts = re.findall(r"\d+|\D+", name)
    return [(int(part), "") if part.isdigit() else (-1, part) for part in parts]


def _not_there(name: str, path: Path, near: Sequence[str]) -> SensorError:
    return SensorError(f"{name}: there is no such folder{_meant(path.name, near)}")


def _meant(name: str, known: Sequence[str]) -> str:
    close = difflib.get_close_matches(name, known, n=3, cutoff=0.6)
    return f" (did you mean {' or '.join(close)}?)" if close else ""


def _some(names: Sequence[str]) -> str:
    few = ", ".join(names[:12])
    return few if len(names) <= 12 else f"{few} and {len(names) - 12} more"


def _spoken(name: str) -> str:
    return name.replace("_", " ").casefold()


def _reader() -> Callable[[Shot], Frame]:
    """Reading with a short memory: looks come back to the same files."""
    return lru_cache(maxsize=_KEPT_FRAMES)(Shot.read)
