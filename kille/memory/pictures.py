"""Pictures kept with a lesson, in encoded form; nothing here decodes them."""

from __future__ import annotations

import math
from dataclasses import astuple, dataclass

from kille.scene import Box, Intrinsics

JPEG, PNG = b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Crop:
    """The part of a frame around a thing: enough to measure the thing again.

    `colour` is a JPEG or PNG picture; `mask` a PNG of the same size, white where the
    thing is; `depth` a PNG of 16 bits, in millimetres, 0 where there was no reading,
    None where the sensor has no depth. `intrinsics` are those of this picture, so that
    it is a frame of its own. Raises ValueError for bytes that are no such picture.

    >>> import cv2
    >>> import numpy as np
    >>> picture = np.zeros((8, 8, 3), np.uint8)
    >>> jpeg = cv2.imencode(".jpg", picture)[1].tobytes()
    >>> mask = cv2.imencode(".png", picture[:, :, 0])[1].tobytes()
    >>> Crop(jpeg, mask).depth is None
    True
    """

    colour: bytes
    mask: bytes
    depth: bytes | None = None
    intrinsics: Intrinsics | None = None

    def __post_init__(self) -> None:
        _require("the colour of a crop", self.colour, JPEG, PNG)
        _require("the mask of a crop", self.mask, PNG)
        if self.depth is not None:
            _require("the depth of a crop", self.depth, PNG)
        if self.intrinsics is not None:
            lens = astuple(self.intrinsics)
            if not all(map(math.isfinite, lens)):
                raise ValueError(f"intrinsics are finite numbers, not {lens}")


@dataclass(frozen=True)
class Picture:
    """What the robot saw when a word was taught.

    `frame` is the whole frame as a small JPEG. `boxes` say where in it the things are
    that the word was taught of: the thing itself, or target and landmark. Of a single
    thing there is a crop. Raises ValueError for bytes that are no JPEG, and for boxes
    that are not whole numbers of pixels.

    >>> import cv2
    >>> import numpy as np
    >>> picture = np.zeros((8, 8, 3), np.uint8)
    >>> jpeg = cv2.imencode(".jpg", picture)[1].tobytes()
    >>> from kille.scene import Box
    >>> len(Picture(jpeg, (Box(1, 1, 4, 4),)).boxes)
    1
    """

    frame: bytes
    boxes: tuple[Box, ...]
    crop: Crop | None = None

    def __post_init__(self) -> None:
        _require("a frame", self.frame, JPEG)
        for box in self.boxes:
            if not all(isinstance(side, int) for side in box):
                raise ValueError(f"a box has whole numbers of pixels, not {box}")


def _require(name: str, picture: bytes, *kinds: bytes) -> None:
    if not picture.startswith(kinds):
        known = {JPEG: "JPEG", PNG: "PNG"}
        wanted = " or ".join(known[kind] for kind in kinds)
        raise ValueError(f"{name} must be a {wanted} picture, not {picture[:8]!r}")
