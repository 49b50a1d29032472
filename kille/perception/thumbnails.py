"""The evidence kept of a frame: a thumbnail, and a crop that can be measured again.

The crop keeps its pixels, so that better traits and features can be computed from it
later. Its depth is written as ROS does it (REP 118): 16 bits, millimetres, 0
where there was no reading.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.memory.pictures import Crop, Picture
from kille.perception.segment import region_of
from kille.scene import Box, Colour, Depth, Frame, Intrinsics, Mask, Region
from kille.sensors import pictures

_WIDTH, _HEIGHT = 160, 120  # of a thumbnail at most
_LARGEST = 640  # pixels that a crop may be wide or high: a VGA frame is never shrunk
_MARGIN = 8  # pixels around the thing
_SMALL, _FINE = 75, 95  # quality of JPEG; at 95 features hardly change
_MILLIMETRES = 1000
_MARK = (255, 96, 0)


def evidence_of(frame: Frame, *regions: Region) -> Picture:
    """The evidence for a lesson about these things: one, or target and landmark.

    >>> frame = Frame(np.zeros((240, 320, 3), np.uint8), None, None, 0.0, {})
    >>> mask = np.zeros((240, 320), np.bool_)
    >>> mask[100:140, 200:260] = True
    >>> picture = evidence_of(frame, Region(mask, Box(200, 100, 260, 140), None))
    >>> picture.boxes
    (Box(left=100, top=50, right=130, bottom=70),)
    """
    height, width = frame.colour.shape[:2]
    scale = min(1.0, _WIDTH / width, _HEIGHT / height)
    small = _shrink(frame.colour, scale)
    boxes = tuple(_scale_box(it.box, scale) for it in regions)
    crop = _crop(frame, regions[0]) if len(regions) == 1 else None
    return Picture(_jpeg(small, _SMALL), boxes, crop)


def restore_crop(crop: Crop, time: float = 0.0) -> tuple[Frame, Region]:
    """Turn a kept crop back into a frame and the region of the thing in it.

    What is measured of them is nearly what was measured when the word was taught.
    ValueError if the pictures of the crop cannot be decoded.
    """
    colour = decode_picture(crop.colour)
    mask: Mask = _decode(crop.mask, cv2.IMREAD_GRAYSCALE) > 127
    frame = Frame(colour, _depth(crop), crop.intrinsics, time, {})
    if mask.shape != colour.shape[:2]:
        raise ValueError(f"the mask {mask.shape} does not fit the crop {colour.shape}")
    return frame, region_of(frame, mask)


def decode_picture(picture: bytes) -> Colour:
    """Decode a JPEG or PNG to pixels (H, W, 3) RGB. ValueError if it cannot be
    decoded."""
    return _decode(picture, cv2.IMREAD_COLOR_RGB).astype(np.uint8, copy=False)


def outline_things(picture: Picture) -> Colour:
    """The frame of a picture, with a box around each thing that it is about."""
    pixels = decode_picture(picture.frame)
    for box in picture.boxes:
        corner = box.right - 1, box.bottom - 1
        cv2.rectangle(pixels, (box.left, box.top), corner, _MARK, 1)
    return pixels


def _crop(frame: Frame, region: Region) -> Crop | None:
    """Crop the region with a margin; None if it has no pixels.

    It is shrunk where it is larger than any VGA frame.
    """
    if not region.mask.any():
        return None
    left, top, right, bottom = _crop_box(frame, region.box)
    cut = slice(top, bottom), slice(left, right)
    scale = min(1.0, _LARGEST / (right - left), _LARGEST / (bottom - top))
    mask = region.mask[cut].astype(np.uint8) * 255
    return Crop(
        _jpeg(_shrink(frame.colour[cut], scale), _FINE),
        _png(_shrink(mask, scale, cv2.INTER_NEAREST)),
        None if frame.depth is None else _png(_levels(frame.depth[cut], scale)),
        _seen_from(frame.intrinsics, left, top, scale),
    )


def _crop_box(frame: Frame, box: Box) -> Box:
    """The part of a frame that is kept: the box with a margin.

    Of a frame without depth it is all, since what is the thing there was a guess, and
    some cues are of the whole picture.
    """
    height, width = frame.colour.shape[:2]
    if frame.depth is None:
        return Box(0, 0, width, height)
    return Box(
        max(0, box.left - _MARGIN),
        max(0, box.top - _MARGIN),
        min(width, box.right + _MARGIN),
        min(height, box.bottom + _MARGIN),
    )


def _seen_from(
    lens: Intrinsics | None, left: int, top: int, scale: float
) -> Intrinsics | None:
    """The intrinsics of a picture that begins at a pixel and is scaled.

    The middle of a pixel is its whole number, hence the halves.
    """
    if lens is None:
        return None
    return Intrinsics(
        lens.fx * scale,
        lens.fy * scale,
        (lens.cx - left + 0.5) * scale - 0.5,
        (lens.cy - top + 0.5) * scale - 0.5,
    )


def _scale_box(box: Box, scale: float) -> Box:
    """Scale a box; it stays at least one pixel wide and high."""
    left, top = int(box.left * scale), int(box.top * scale)
    right, bottom = round(box.right * scale), round(box.bottom * scale)
    return Box(left, top, max(right, left + 1), max(bottom, top + 1))


def _shrink(
    pixels: NDArray[Any], scale: float, how: int = cv2.INTER_AREA
) -> NDArray[Any]:
    if scale == 1.0:
        return pixels
    height, width = pixels.shape[:2]
    size = max(1, round(width * scale)), max(1, round(height * scale))
    return cv2.resize(pixels, size, interpolation=how)


def _levels(depth: Depth, scale: float) -> NDArray[np.uint16]:
    """Depth in whole millimetres; 0 where it is unknown or too large."""
    small = _shrink(depth, scale, cv2.INTER_NEAREST)
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.round(small.astype(np.float64) * _MILLIMETRES)
        told = (steps > 0) & (steps <= np.iinfo(np.uint16).max)
    return np.where(told, steps, 0).astype(np.uint16)


def _depth(crop: Crop) -> Depth | None:
    if crop.depth is None:
        return None
    levels = _decode(crop.depth, cv2.IMREAD_UNCHANGED).astype(np.float32)
    depth: Depth = np.where(levels > 0, levels / np.float32(_MILLIMETRES), np.nan)
    return depth.astype(np.float32, copy=False)


def _decode(picture: bytes, flags: int) -> NDArray[Any]:
    try:
        pixels = pictures.decode_picture(np.frombuffer(picture, np.uint8), flags)
    except OSError as error:
        raise ValueError(f"a kept picture is invalid: {error.strerror}") from error
    if pixels is None:
        raise ValueError("a kept picture cannot be decoded")
    return pixels


def _jpeg(colour: Colour, quality: int) -> bytes:
    bgr = cv2.cvtColor(np.ascontiguousarray(colour), cv2.COLOR_RGB2BGR)
    return _encode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, quality])


def _png(pixels: NDArray[Any]) -> bytes:
    return _encode(".png", np.ascontiguousarray(pixels), [])


def _encode(kind: str, pixels: NDArray[Any], settings: Sequence[int]) -> bytes:
    done, encoded = cv2.imencode(kind, pixels, settings)
    if not done:
        raise ValueError(f"a picture {pixels.shape} cannot be encoded as {kind}")
    return encoded.tobytes()
