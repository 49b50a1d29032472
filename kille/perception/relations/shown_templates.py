"""Spatial templates as pictures: where a target may be, seen from above."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

from kille.scene import Configuration
from ttr.degree_pictures import Point, degree_map
from ttr.showing import Beside, Part, Text, below

_MOST = 12
"""A notebook shows so many templates at most."""

_AROUND = 1.5
"""How much farther a template is drawn than things were when its word was taught."""


class SpatialDegrees(Protocol):
    """What has degrees of spatial words."""

    @property
    def farthest(self) -> float:
        """The farthest distance in metres of which one was said."""
        ...

    def degrees_of(
        self, seen: Sequence[Configuration], /
    ) -> Sequence[Mapping[str, float]]:
        """The degrees of each word for several configurations."""
        ...


def templates_shown(memory: SpatialDegrees, words: Iterable[str]) -> Part:
    """The template of each word: its degrees around a landmark in the middle.

    Right is to the right and away is upwards, as the viewer sees them.
    """
    every = [*words]
    drawn = [below(Text(it, "strong"), _template(memory, it)) for it in every[:_MOST]]
    left = len(every) - len(drawn)
    more = [Text(f"… {left} more", "quiet")] if left > 0 else []
    none = [] if drawn else [Text("It knows no spatial word.", "quiet")]
    return Beside((*drawn, *more, *none))


def _template(memory: SpatialDegrees, word: str) -> Part:
    def degrees(places: Sequence[Point]) -> list[tuple[float, float]]:
        placed = [Configuration((right, away, 0.0)) for right, away in places]
        found = [it.get(word, 0.0) for it in memory.degrees_of(placed)]
        return [(p, p) for p in found]

    reach = max(0.1, round(_AROUND * min(memory.farthest, 10.0), 1))
    about = f"where “{word}” holds around the middle: the stronger, the surer"
    return degree_map(degrees, reach, unit=" m", about=about)
