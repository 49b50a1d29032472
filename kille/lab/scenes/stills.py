"""What is seen of a picture, and of a thing in a labelled frame, at one glance.

Galleries, labelled scenes and the theatre of the whole robot all see through these
functions, so that a protocol and a study are shown the same things.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from kille.perception.look import look
from kille.scene import Frame, Look, Mask, Percept, Region
from kille.sensors.pictures import read_colour, shrink_to_fit

Lesson = tuple[Percept, str]
"""A thing, and the right word for it: to be taught, or to be asked for."""

_LARGEST = (640, 480)


@dataclass(frozen=True)
class Still:
    """A sensor that always sees the same frame."""

    now: Frame
    name: str = "still"

    def frame(self) -> Frame:
        """The frame."""
        return self.now

    def close(self) -> None:
        """There is nothing to release."""


def look_at_picture(path: Path) -> Look:
    """A look at a picture; all of it is one thing where nothing is made out."""
    colour = shrink_to_fit(read_colour(path), _LARGEST)
    still = Still(Frame(colour, None, None, 0.0, {}))
    seen = look(still, scans=1)
    if seen.percepts:
        return seen
    return look(still, scans=1, pointed=np.ones(colour.shape[:2], bool))


def place_in_outline(regions: Sequence[Region], outline: Mask) -> int | None:
    """The place of the region that a finger on what is outlined would point at.

    It shares most pixels with the outline; None if none shares any.
    """
    shared = [int((it.mask & outline).sum()) for it in regions]
    return int(np.argmax(shared)) if any(shared) else None


def look_at_outlined(frame: Frame, name: str) -> Look:
    """A look at a labelled frame; the thing with this outline is the first percept."""
    return look(Still(frame), scans=1, pointed=frame.outlines[name])
