"""Pictures and looks as values that a notebook shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import cv2
import numpy as np

from kille.perception.picture_sheet import encode_picture, overview, write_picture
from kille.scene import Colour, Look, Point, shown_look
from ttr.showing import Figure, NotebookValue, Part, Text, below, table

_WIDEST = 960
"""The pixels across a picture at most, in a notebook."""

_QUALITY = 85
"""Of the JPEG in HTML, in percent; `_repr_png_` loses nothing."""

_SHOWN_WIDTH = 480
"""How wide a picture stands in a notebook where there is room: pixels of the page."""

_NO_ROLES: Mapping[int, str] = MappingProxyType({})


@dataclass(frozen=True, eq=False)
class Picture(NotebookValue):
    """A picture (H, W, 3) RGB or (H, W, 4) RGBA, and what it shows in words.

    A notebook shows it `width` pixels wide, where there is room; `save` writes it.
    """

    pixels: Colour
    about: str
    width: int = _SHOWN_WIDTH

    def save(self, path: Path | str) -> None:
        """Write it as PNG; raises OSError if that cannot be done."""
        write_picture(Path(path), self.pixels)

    def _repr_png_(self) -> bytes:
        return encode_picture(self.pixels, ".png")

    def _shown_as_(self) -> Part:
        return figure_of(self.pixels, self.about, self.width)

    def __repr__(self) -> str:
        height, width = self.pixels.shape[:2]
        return f"<Picture of {width} x {height} pixels: {self.about}>"


def figure_of(pixels: Colour, about: str, width: int = _SHOWN_WIDTH) -> Figure:
    """A picture, RGB or RGBA, as a part of what a notebook shows, of bounded size."""
    height, wide = pixels.shape[:2]
    if wide > _WIDEST:
        size = _WIDEST, max(1, round(height * _WIDEST / wide))
        smaller = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA)
        pixels = smaller.astype(np.uint8)
    if pixels.shape[-1] == 4:  # JPEG knows nothing of what can be seen through
        data = encode_picture(pixels, ".png")
        return Figure(data, "image/png", about, min(width, wide))
    data = encode_picture(pixels, ".jpg", (cv2.IMWRITE_JPEG_QUALITY, _QUALITY))
    return Figure(data, "image/jpeg", about, min(width, wide))


def annotated_picture(
    look: Look, names: Sequence[str] = (), roles: Mapping[int, str] = _NO_ROLES
) -> Picture:
    """A look with every thing in view outlined, numbered and, where known, named.

    `roles` are what things are called by pointing, by their numbers: they are marked
    where there are two of them, "this" and "that".
    """
    count = len(look.percepts)
    marked = roles if len(roles) > 1 else _NO_ROLES
    named = [f"{n} {name}".strip() for n, name in enumerate(names, start=1)]
    things = ", ".join(named) if any(names) else f"{count} of them"
    about = f"things in view: {things}" if count else "nothing is in view"
    about += "".join(f"; {number} is “{role}”" for number, role in marked.items())
    return Picture(overview(look, names, marked), about)


def view_shown(
    look: Look, names: Sequence[str] = (), roles: Mapping[int, str] = _NO_ROLES
) -> Part:
    """A look as its picture above a table of the things in it, with their roles."""
    picture = annotated_picture(look, names, roles)
    if not look.percepts:
        return below(picture._shown_as_(), Text("Nothing is in view.", "quiet"))
    heads = ("", "called", "where", "") if any(names) else ("", "where", "")

    def row(number: int) -> tuple[Part, ...]:
        percept = look.percepts[number - 1]
        name = Text(names[number - 1] or "–") if any(names) else None
        return (
            Text(f"#{number}", "strong"),
            *([name] if name else []),
            Text(place_in_words(percept.region.place)),
            Text(roles.get(number, ""), "quiet"),
        )

    numbers = range(1, len(look.percepts) + 1)
    return below(picture._shown_as_(), table(heads, numbers, row))


def place_in_words(place: Point | tuple[float, float, float] | None) -> str:
    """Where something is, seen from the camera, in metres.

    >>> place_in_words((-0.1, 0.0, 0.62))
    '0.62 m away, 10 cm to the left'
    """
    if place is None:
        return "place unknown"
    right, _, away = place
    side = "right" if right >= 0 else "left"
    if abs(right) < 0.02:
        return f"{away:.2f} m away, straight ahead"
    return f"{away:.2f} m away, {abs(right) * 100:.0f} cm to the {side}"


@shown_look.provided_by
def _shown_look(look: Look) -> Part:
    return view_shown(look)
