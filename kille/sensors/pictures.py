"""Picture files: reading and writing colour, depth and labels; errors are one line."""

from __future__ import annotations

import io
import os
import struct
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Depth
from kille.sensors.sensor import SensorError
from ttr.safety.inputs import open_file, read_bytes
from ttr.safety.limits import MEASURED, PICTURE, PICTURE_FILE

SUFFIXES = frozenset({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp"})


def is_picture(path: Path) -> bool:
    """Whether the name is that of a picture file.

    >>> is_picture(Path("cup3.PNG")), is_picture(Path("README.md"))
    (True, False)
    """
    return path.suffix.lower() in SUFFIXES and not path.name.startswith(".")


def read_colour(path: Path) -> Colour:
    """The picture as (H, W, 3) RGB, read-only; SensorError if it does not open."""
    return freeze(_decode(path, cv2.IMREAD_COLOR_RGB))


def shrink_to_fit(colour: Colour, largest: tuple[int, int]) -> Colour:
    """The picture, made smaller where it is wider or higher than this; read-only.

    >>> shrink_to_fit(np.zeros((600, 400, 3), np.uint8), (640, 480)).shape
    (480, 320, 3)
    """
    height, width = colour.shape[:2]
    factor = min(largest[0] / width, largest[1] / height)
    if factor >= 1:
        return colour
    size = (max(1, round(width * factor)), max(1, round(height * factor)))
    smaller = cv2.resize(colour, size, interpolation=cv2.INTER_AREA)
    return freeze(smaller.astype(np.uint8, copy=False))


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
    return clean_depth(raw.astype(np.float32) / np.float32(units_per_metre))


def clean_depth(metres: Depth) -> Depth:
    """The depth with NaN for what is no distance: 0, less, and infinite; read-only.

    >>> clean_depth(np.array([0.5, 0.0, -1.0, np.inf], np.float32))
    array([0.5, nan, nan, nan], dtype=float32)
    """
    there = (metres > 0) & (metres < np.inf)
    return freeze(np.where(there, metres, np.float32(np.nan)))


def read_labels(path: Path) -> NDArray[Any]:
    """Whole numbers (H, W), one for each thing; SensorError if it does not open."""
    labels = _decode(path, cv2.IMREAD_UNCHANGED)
    if labels.ndim != 2:
        raise SensorError(
            f"{path}: a label picture has one channel, this one has {_channels(labels)}"
        )
    return freeze(labels)


def _decode(path: Path, flags: int) -> NDArray[Any]:
    try:
        content = np.frombuffer(read_bytes(path, PICTURE_FILE), np.uint8)
        picture = decode_picture(content, flags)
    except OSError as error:
        raise SensorError(f"{path}: cannot be read ({error.strerror})") from error
    if not content.size:
        raise SensorError(f"{path}: the file is empty, expected a picture")
    if picture is None:
        raise SensorError(f"{path}: this picture does not open; it may be damaged")
    return picture


def decode_picture(content: NDArray[np.uint8], flags: int) -> NDArray[Any] | None:
    """The picture in the bytes of a file, read as OpenCV's flags say; None if none is.

    What is larger than is read raises `OSError`, before any of it is decoded. OpenCV
    would tell of damage in lines of its own.
    """
    size = _size(content)
    if size is None or _is_broken_png(content):
        return None
    (MEASURED if flags == cv2.IMREAD_UNCHANGED else PICTURE).check(size[0] * size[1])
    level = cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)
    try:
        return cv2.imdecode(content, flags)
    except cv2.error:
        return None
    finally:
        cv2.utils.logging.setLogLevel(level)


_HEADS = {
    b"\x89PNG": 24,
    b"\xff\xd8\xff": 1 << 22,
    b"GIF8": 1 << 10,
    b"BM": 1 << 10,
    b"RIFF": 1 << 10,
    b"II": PICTURE_FILE.most,
    b"MM": PICTURE_FILE.most,
    b"P1": 1 << 16,
    b"P2": 1 << 16,
    b"P3": 1 << 16,
    b"P4": 1 << 16,
    b"P5": 1 << 16,
    b"P6": 1 << 16,
}
"""How the files of the known kinds begin, and within how many bytes they say how wide
and high the picture is; those of TIFF say it anywhere."""


def _size(content: NDArray[np.uint8]) -> tuple[int, int] | None:
    """The width and height that the head of a file tells; None if it is no picture."""
    start = content[:4].tobytes()
    within = next((it for head, it in _HEADS.items() if start.startswith(head)), 0)
    head = content[:within].tobytes()
    if start == _PNG[:4]:
        width, height = int.from_bytes(head[16:20]), int.from_bytes(head[20:24])
    else:
        import imagesize  # which imports readers of XML and of addresses

        width, height = imagesize.get(io.BytesIO(head), exif_rotation=False)
    return (int(width), int(height)) if width > 0 and height > 0 else None


_PNG = b"\x89PNG\r\n\x1a\n"


def _is_broken_png(content: NDArray[np.uint8]) -> bool:
    """Whether it begins as a PNG file, but a part of it is missing or altered.

    Such a file is a row of parts: a length, four letters, the data and a checksum.
    """
    data = content.data
    if data[:8] != _PNG:
        return False
    place, kind = 8, b""
    while kind != b"IEND":
        if place + 12 > len(data):
            return True
        (length,) = struct.unpack_from(">I", data, place)
        end = place + 8 + length
        if end + 4 > len(data):
            return True
        (checksum,) = struct.unpack_from(">I", data, end)
        if zlib.crc32(data[place + 4 : end]) != checksum:
            return True
        place, kind = end + 4, bytes(data[place + 4 : place + 8])
    return False


def _channels(picture: NDArray[Any]) -> str:
    count = 1 if picture.ndim == 2 else picture.shape[2]
    return "1 channel" if count == 1 else f"{count} channels"


def freeze(array: NDArray[Any]) -> NDArray[Any]:
    """The same array, which can no longer be written to."""
    array.setflags(write=False)
    return array


_ENDS = {_PNG: b"IEND\xaeB`\x82", b"\xff\xd8\xff": b"\xff\xd9"}
"""How the files of some kinds begin, and how they end."""


def whole_picture(path: Path) -> bool:
    """Whether the file is there, is not empty, and ends as its kind does."""
    try:
        with open_file(path) as file:
            head = file.read(8)
            file.seek(max(0, file.seek(0, os.SEEK_END) - 8))
            tail = file.read(8)
    except OSError:
        return False
    ends = [end for start, end in _ENDS.items() if head.startswith(start)]
    return bool(head) and all(tail.endswith(end) for end in ends)


def depth_picture(depth: Depth, units_per_metre: float) -> NDArray[np.uint16]:
    """Depth in metres as whole units, 0 where there is none or it is too far.

    >>> depth_picture(np.array([[0.5, np.nan, 70.0]], np.float32), 1000)
    array([[500,   0,   0]], dtype=uint16)
    """
    units = np.rint(depth * np.float32(units_per_metre))
    told = (units > 0) & (units <= np.iinfo(np.uint16).max)
    return np.where(told, units, 0).astype(np.uint16)


def write_colour(path: Path, colour: Colour) -> None:
    """Write an RGB picture; OSError if it cannot be."""
    write_picture(path, cv2.cvtColor(colour, cv2.COLOR_RGB2BGR))


def write_picture(path: Path, picture: NDArray[Any]) -> None:
    """Write an array as a PNG picture; OSError if it cannot be."""
    _, encoded = cv2.imencode(".png", picture)
    path.write_bytes(encoded.tobytes())


def shows_picture(path: Path) -> bool:
    """Whether the file begins as those of pictures do, whatever its name."""
    try:
        with open_file(path) as file:
            return file.read(4).startswith(tuple(_HEADS))
    except OSError:
        return False
