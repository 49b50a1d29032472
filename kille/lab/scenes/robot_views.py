"""What the whole robot is shown: views, and the looks at them.

What is to be seen is named by a value, a view, from which the look follows: looks are
worked out once and kept, for all dialogues of a process, and never depend on what was
seen before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from kille.agent.attention import Attention, NumberedLook
from kille.lab.errors import StudyError
from kille.lab.scenes.scene import Occasion
from kille.lab.scenes.stills import (
    look_at_outlined,
    look_at_picture,
    place_in_outline,
)
from kille.perception.look import Sighting
from kille.perception.segment import overlap
from kille.scene import Frame, Look
from kille.sensors.captures import Shot, description_of, read_sequence
from kille.sensors.sensor import At
from kille.sensors.synthetic import Synthetic, open_synthetic

PICTURES, FRAMES = 400, 60
"""How many looks are kept: those at pictures are small, and those at frames are not."""


class PictureView(NamedTuple):
    """A picture of one thing."""

    path: Path

    def __str__(self) -> str:
        return f"{self.path.parent.name}/{self.path.name}"


class CaptureView(NamedTuple):
    """A labelled frame of a scene, and the thing in it that is pointed at."""

    folder: Path
    number: int
    name: str

    def __str__(self) -> str:
        return f"{self.folder.name}, frame {self.number}: {self.name}"


class Stand(NamedTuple):
    """Where a thing stands on the rendered table: metres, and degrees."""

    name: str
    right: float
    away: float
    turn: float

    def __str__(self) -> str:
        return f"{self.name} at {self.right:.3f} {self.away:.3f} turned {self.turn:.0f}"


class TableView(NamedTuple):
    """A rendered table: what stands on it, of which the last is pointed at."""

    source: str
    stands: tuple[Stand, ...]

    def __str__(self) -> str:
        return f"{self.source}: {'; '.join(map(str, self.stands))}"


class Theatre:
    """A sensor that shows what the occasion says, and looks by itself."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._view: object = None

    @property
    def name(self) -> str:
        """The name of what is shown."""
        return self._name

    def turn_to(self, occasion: Occasion) -> None:
        """Show this from now on."""
        self._view = occasion.view

    def frame(self) -> Frame:
        """The frame that is shown."""
        return _look_at(self._view).frame

    def look(self, scans: int, pointed: Any) -> Look:
        """The look at what is shown; what is pointed at comes first."""
        seen = _look_at(self._view)
        if not isinstance(pointed, tuple) or not isinstance(pointed[0], Frame):
            return seen
        region = pointed[1]
        alike = sorted(seen.percepts, key=lambda it: -overlap(it.region, region))
        rest = (it for it in seen.percepts if it is not alike[0])
        return replace(seen, percepts=(*alike[:1], *rest))

    def attention(self) -> Attention:
        """The attention of a robot that has seen nothing yet and follows the finger."""
        seen = _look_at(self._view)
        if not seen.percepts:
            return Attention()
        pointed: Sighting = (seen.frame, seen.percepts[0].region)
        return Attention(pointed)

    def number_in_view(
        self, occasion: Occasion, number: int, view: NumberedLook
    ) -> int | None:
        """The number that a thing of the world has in a view of the robot's."""
        name = occasion.world.thing(number).kind
        outline = view.look.frame.outlines.get(name)
        if outline is None:
            return view.focus if number == occasion.x else None
        place = place_in_outline([it.region for it in view.look.percepts], outline)
        return None if place is None else place + 1

    def close(self) -> None:
        """There is nothing to release."""


def _look_at(view: object) -> Look:
    """The look at a view: in one scan, with what is pointed at before all else."""
    match view:
        case PictureView(path):
            return _look_at_kept_picture(path)
        case CaptureView() | TableView():
            return _look_at_frame(view)
    raise StudyError([f"nothing is shown: {view!r} is no view"])


@lru_cache(FRAMES)
def _look_at_frame(view: CaptureView | TableView) -> Look:
    """The look at a whole frame, and at a thing in it by its outline."""
    match view:
        case CaptureView(folder, number, name):
            frame = _shots(folder)[number].read()
        case TableView(source, stands):
            frame, name = lay_table(source, stands).frame(), stands[-1].name
    return look_at_outlined(frame, name)


_look_at_kept_picture = lru_cache(PICTURES)(look_at_picture)


@lru_cache(64)
def _shots(folder: Path) -> tuple[Shot, ...]:
    description = description_of(folder)
    assert description is not None
    return read_sequence(description)


def lay_table(source: str, stands: Sequence[Stand]) -> Synthetic:
    """Lay a table on which things stand so. SensorError if they cannot."""
    stage = open_synthetic(source)
    for name, *spot in stands:
        stage.place(name, At(*spot))
    return stage
