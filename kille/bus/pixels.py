"""Pixels as other programs send them: encodings with the names that ROS gives them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.bus.messages import BusError

Array = NDArray[Any]


class _Encoding(NamedTuple):
    """The type of a number in it, and which of its channels are red, green and blue."""

    dtype: str
    channels: int = 1
    rgb: tuple[int, ...] = ()


_ENCODINGS = {
    "rgb8": _Encoding("u1", 3, (0, 1, 2)),
    "bgr8": _Encoding("u1", 3, (2, 1, 0)),
    "rgba8": _Encoding("u1", 4, (0, 1, 2)),
    "bgra8": _Encoding("u1", 4, (2, 1, 0)),
    "8UC3": _Encoding("u1", 3, (2, 1, 0)),
    "mono8": _Encoding("u1"),
    "8UC1": _Encoding("u1"),
    "mono16": _Encoding("u2"),
    "16UC1": _Encoding("u2"),
    "32FC1": _Encoding("f4"),
}


def pixels_of(
    data: bytes,
    encoding: str,
    height: int,
    width: int,
    step: int,
    big_endian: bool,
) -> Array:
    """The pixels in the bytes of a picture whose rows take `step` bytes each.

    (H, W, 3) RGB, or (H, W). They are those bytes, and not copied, where these are in
    order already. BusError for another encoding, or too few bytes.

    >>> pixels_of(bytes([3, 2, 1, 0]), "bgr8", 1, 1, 4, False)
    array([[[1, 2, 3]]], dtype=uint8)
    """
    known = _ENCODINGS.get(encoding)
    if known is None:
        raise BusError(
            f"a picture is encoded as {encoding}, which is not read; send "
            f"{', '.join(_ENCODINGS)}"
        )
    number = np.dtype(known.dtype).newbyteorder(">" if big_endian else "<")
    row = width * known.channels * number.itemsize
    if step < row or len(data) < height * step:
        raise BusError(
            f"a picture of {width}x{height} in {encoding} has too few bytes: "
            f"{len(data)}, in rows of {step}"
        )
    rows = np.frombuffer(data, np.uint8, height * step).reshape(height, step)[:, :row]
    numbers = np.ascontiguousarray(rows).view(number)
    numbers = numbers.astype(number.newbyteorder("="), copy=False)
    if not known.rgb:
        return numbers
    channels = numbers.reshape(height, width, known.channels)
    if known.rgb == tuple(range(known.channels)):
        return channels
    return np.ascontiguousarray(channels[..., known.rgb])


def encoding_of(pixels: Array) -> str:
    """How pixels of this shape and type are called.

    >>> encoding_of(np.zeros((480, 640), np.float32))
    '32FC1'
    """
    match pixels.dtype.name, pixels.ndim:
        case "uint8", 3 if pixels.shape[2] == 3:
            return "rgb8"
        case "uint8", 2:
            return "mono8"
        case "uint16", 2:
            return "16UC1"
        case "float32", 2:
            return "32FC1"
    raise BusError(f"{pixels.dtype} pixels of shape {pixels.shape} are no picture")
