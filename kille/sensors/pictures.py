"""Reading picture files: colour, depth, labels, or one line that says what is wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Depth
from kille.sensors.sensor import SensorError

SUFFIXES = frozenset({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp"})


def is_picture(path: Path) -> bool:
    """Whether the name is that of a picture file.

    >>> is_picture(Path("cup3.PNG")), is_picture(Path("README.md"))
    (True, False)
    """
    return path.suffix.lower() in SUFFIXES and not path.name.startswith(".")


def read_colour(path: Path) -> Colour:
    """The picture as (H, W, 3) RGB, read-only; SensorError if it does not open."""
    return _fixed(cv2.cvtColor(_decode(path, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB))


def fitted(colour: Colour, largest: tuple[int, int]) -> Colour:
    """The picture, made smaller where it is wider or higher than this; read-only.

    >>> fitted(np.zeros((600, 400, 3), np.uint8), (640, 480)).shape
    (480, 320, 3)
    """
    height, width = colour.shape[:2]
    factor = min(largest[0] / width, largest[1] / height)
    if factor >= 1:
        return colour
    size = (max(1, round(width * factor)), max(1, round(height * factor)))
    smaller = cv2.resize(colour, size, interpolation=cv2.INTER_AREA)
    return _fixed(smaller.astype(np.uint8, copy=False))


def read_depth(path: Path, units_per_metre: float) -> Depth:
    """Depth (H, W) in metres from a 16-bit picture, NaN where it holds 0; read-only.

    SensorError if it does not open or has not one channel of 16 bits.
    """
    raw = _decode(path, cv2.IMREAD_UNCHANGED)
    if raw.dtype != np.uint16 or raw.ndim != 2:
        raise SensorError(
            f"{path}: a depth picture has one channel of 16 bits, "
            f"this one has {_channels(raw)} of {raw.itemsize * 8}"
        )
    metres = raw.astype(np.float32) / np.float32(units_per_metre)
    metres[raw == 0] = np.nan
    return _fixed(metres)


def read_labels(path: Path) -> NDArray[Any]:
    """Whole numbers (H, W), one for each thing; SensorError if it does not open."""
    labels = _decode(path, cv2.IMREAD_UNCHANGED)
    if labels.ndim != 2:
        raise SensorError(
            f"{path}: a label picture has one channel, this one has {_channels(labels)}"
        )
    return _fixed(labels)


def _decode(path: Path, flags: int) -> NDArray[Any]:
    try:
        content = np.frombuffer(path.read_bytes(), np.uint8)
    except OSError as error:
        raise SensorError(f"{path}: cannot be read ({error.strerror})") from error
    if not content.size:
        raise SensorError(f"{path}: the file is empty, expected a picture")
    try:
        picture = cv2.imdecode(content, flags)
    except cv2.error:
        picture = None
    if picture is None:
        raise SensorError(f"{path}: this picture does not open; it may be damaged")
    return picture


def _channels(picture: NDArray[Any]) -> str:
    count = 1 if picture.ndim == 2 else picture.shape[2]
    return "1 channel" if count == 1 else f"{count} channels"


def _fixed(array: NDArray[Any]) -> NDArray[Any]:
    array.setflags(write=False)
    return array
