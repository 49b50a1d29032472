"""Takes the white ground of drawings away: `python docs/pictures/grounds.py FILE …`.

What is left can stand on a light page and on a dark one: black ink becomes a grey that
both have 4 : 1 of contrast to, and what shone through onto white shines through still.
"""

from __future__ import annotations

import sys
from pathlib import Path

import cv2
import numpy as np

from kille.perception.lettering import INK_ON_ANY_PAGE
from kille.scene import Colour

_GREY = 24
"""Colours are ink if their channels differ by less than this, of 255."""


def remove_ground(drawing: Colour) -> Colour:
    """A drawing (H, W, 3) RGB on white as it is without it (H, W, 4), its ink in grey.

    A pixel is c α + 255 (1 - α), of which α is taken to be as small as it can be.
    """
    seen = drawing.astype(np.float32)
    alpha = 255 - seen.min(axis=2, keepdims=True)
    colour = 255 - 255 * (255 - seen) / np.maximum(alpha, 1)
    is_ink = np.ptp(colour, axis=2, keepdims=True) < _GREY
    colour = np.where(is_ink, np.float32(INK_ON_ANY_PAGE), colour)
    both = np.concatenate([colour, alpha], axis=2)
    bare: Colour = np.clip(np.rint(both), 0, 255).astype(np.uint8)
    return bare


def remove_ground_of(file: Path) -> None:
    """The same for a PNG; what has no ground stays as it is."""
    drawing = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
    if drawing.shape[2] == 4 and drawing[..., 3].min() < 255:
        return
    bare = remove_ground(cv2.cvtColor(drawing[..., :3], cv2.COLOR_BGR2RGB))
    cv2.imwrite(str(file), cv2.cvtColor(bare, cv2.COLOR_RGBA2BGRA))


if __name__ == "__main__":
    for name in sys.argv[1:]:
        remove_ground_of(Path(name))
