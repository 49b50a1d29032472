"""Folders of pictures by category, `category/picture`, as things to teach and to ask.

Pictures are seen through the same eyes as all else. What is seen of one, its features
and its traits, is worked out once and kept while the gallery is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from kille.lab.progress import Steps
from kille.lab.results import ExperimentError, Progress
from kille.lab.scenes.stills import Lesson, look_at_picture
from kille.scene import Percept
from kille.sensors.captures import description_of
from kille.sensors.pictures import is_picture, read_colour
from kille.sensors.recordings.name_suggestions import natural_order
from kille.sensors.sensor import SensorError

LOOKING = 0.3
"""The share of the time that goes into seeing rather than into words."""

Categories = Mapping[str, Sequence[Path]]
"""Pictures by category."""


@dataclass(frozen=True, eq=False)
class Gallery:
    """The pictures of each category in the order people count.

    `unread` tells of the pictures that were left out since they do not open.
    """

    name: str
    categories: Mapping[str, tuple[Path, ...]]
    unread: tuple[str, ...]
    seen: dict[Path, Percept] = field(default_factory=dict)

    @property
    def least(self) -> int:
        """The number of pictures in the smallest category."""
        return min(map(len, self.categories.values()))

    @property
    def note(self) -> str:
        """A sentence on what was left out, or nothing."""
        if not self.unread:
            return ""
        return f"Left out, since they do not open: {', '.join(self.unread)}."

    def percept(self, path: Path) -> Percept:
        """The one thing that a picture shows, as it is seen in one scan."""
        if path not in self.seen:
            self.seen[path] = look_at_picture(path).percepts[0]
        return self.seen[path]

    def lessons(self, chosen: Categories) -> list[Lesson]:
        """What is seen of the chosen pictures, each with its category."""
        return [
            (self.percept(it), word) for word, them in chosen.items() for it in them
        ]

    def look(self, progress: Progress, end: float) -> None:
        """See every picture that was not seen yet, up to this share of the work."""
        count = sum(map(len, self.categories.values()))
        steps = Steps(progress, count, 0, end)
        for paths in self.categories.values():
            for path in paths:
                self.percept(path)
                steps("looking at the pictures")


def is_gallery(folder: Path) -> bool:
    """Whether the folder holds folders that hold pictures, and no captures."""
    inner = [it for it in folder.iterdir() if it.is_dir()]
    captures = any(description_of(it) is not None for it in inner)
    return not captures and any(_pictures(it) for it in inner)


def open_gallery(folder: Path, name: str) -> Gallery:
    """Open a gallery; ExperimentError if it has fewer than two categories.

    The name is what it is called where it is told of.
    """
    unread: list[str] = []
    categories: dict[str, tuple[Path, ...]] = {}
    for inner in sorted(it for it in folder.iterdir() if it.is_dir()):
        opening = {path: _opens(path) for path in _pictures(inner)}
        unread += [
            f"{inner.name}/{it.name}" for it, opens in opening.items() if not opens
        ]
        if kept := tuple(path for path, opens in opening.items() if opens):
            word = inner.name.replace("_", " ")
            categories[word] = (*categories.get(word, ()), *kept)
    if len(categories) < 2:
        found = f"only {', '.join(categories)}" if categories else "none that opens"
        raise ExperimentError(
            f"{name}: it takes pictures of two categories at least, in folders "
            f"category/picture.png; there is {found}"
        )
    return Gallery(name, categories, tuple(unread))


def _pictures(folder: Path) -> list[Path]:
    found = (it for it in folder.iterdir() if is_picture(it))
    return sorted(found, key=lambda path: natural_order(path.name))


def _opens(path: Path) -> bool:
    try:
        read_colour(path)
    except SensorError:
        return False
    return True
