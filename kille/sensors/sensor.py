"""What every source of frames can do, and how it fails."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from kille.scene import Frame


class SensorError(Exception):
    """A source that cannot be opened or read: one line says what, and what to do."""


class Sensor(Protocol):
    """A source of frames."""

    @property
    def name(self) -> str:
        """The source as a user writes it, such as `synthetic:desk?seed=7`."""
        ...

    def frame(self) -> Frame:
        """The next frame."""
        ...

    def close(self) -> None:
        """Let go of the source; a second call does nothing."""
        ...


@dataclass(frozen=True)
class At:
    """A spot on the table: metres right of and away from its middle, turned by degrees.

    `right` and `away` are seen from the camera.
    """

    right: float
    away: float
    turn: float = 0.0


@dataclass(frozen=True)
class Beside:
    """A spot in a relation to another object: `left of`, `right of`, `behind` …"""

    relation: str
    landmark: str


@runtime_checkable
class Stage(Protocol):
    """A sensor whose scene can be changed while the conversation goes on."""

    def things(self) -> tuple[str, ...]:
        """The names of all that can be shown."""
        ...

    def show(self, name: str) -> None:
        """Show only this object, in a place and pose of its own."""
        ...

    def place(self, name: str, spot: At | Beside) -> None:
        """Put the object there and leave the others where they are."""
        ...

    def remove(self, name: str) -> None:
        """Take the object away."""
        ...


@dataclass(frozen=True)
class Placed:
    """A thing on the table: its name, its spot, and what it covers from above.

    The corners of the outline are metres right and away of its spot, before its turn.
    """

    name: str
    spot: At
    outline: tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class TablePlan:
    """The table from above: its left, near, right and far edge in metres, and what
    stands on it."""

    table: tuple[float, float, float, float]
    placed: tuple[Placed, ...]


@runtime_checkable
class PlannedStage(Stage, Protocol):
    """A stage that knows where everything stands."""

    def plan(self) -> TablePlan:
        """The table as it is now."""
        ...


@runtime_checkable
class Seekable(Protocol):
    """A recording in which one can go to any moment."""

    @property
    def length(self) -> float:
        """Seconds from the first frame to the last."""
        ...

    @property
    def position(self) -> float:
        """Where the next frame is, in seconds since the first."""
        ...

    def seek(self, seconds: float) -> None:
        """Go to the first frame at or after so many seconds since the first.

        SensorError beyond the last.
        """
        ...
