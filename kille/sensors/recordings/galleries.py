"""Stills by name: pictures that have nothing to do with time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from kille.scene import Frame
from kille.sensors.captures import RATE, Shot
from kille.sensors.recordings.name_suggestions import (
    comparable_name,
    first_names,
    suggest_name,
)
from kille.sensors.sensor import At, Beside, SensorError

_KEPT_FRAMES = 16


class Gallery:
    """Stills by name: `frame` repeats the current one, `show` goes to the next.

    A name may have several pictures, as a category has: each `show` of it goes to its
    next picture, and after the last to its first. Before any `show` the very first
    picture is in view, which does not count as shown.

    >>> import tempfile
    >>> import cv2
    >>> import numpy as np
    >>> from pathlib import Path
    >>> from kille.sensors.recordings import open_recording
    >>> black = cv2.imencode(".png", np.zeros((8, 8, 3), np.uint8))[1].tobytes()
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for name in ("cup", "book"):
    ...         Path(folder, name).mkdir()
    ...         _ = Path(folder, name, "1.png").write_bytes(black)
    ...     gallery = open_recording(folder)
    >>> isinstance(gallery, Gallery), sorted(gallery.things())
    (True, ['book', 'cup'])
    """

    def __init__(self, name: str, shots: Mapping[str, Sequence[Shot]]) -> None:
        self._name = name
        self._shots = {thing: tuple(pictures) for thing, pictures in shots.items()}
        self._shown = dict.fromkeys(self._shots, 0)
        self._current = next(iter(self._shots.values()))[0]
        self._read = lru_cache(maxsize=_KEPT_FRAMES)(Shot.read)
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
        known = {comparable_name(thing): thing for thing in self._shots}
        if comparable_name(name) in known:
            return known[comparable_name(name)]
        raise SensorError(
            f"{self._name} has no {name}"
            f"{suggest_name(comparable_name(name), list(known))}; "
            f"it has {first_names(list(self._shots))}"
        )
