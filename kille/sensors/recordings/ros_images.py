"""ROS image messages as arrays, and arrays as messages, without cv_bridge.

Any object that has the fields of `sensor_msgs/Image` will do.
"""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Depth, Intrinsics
from kille.sensors.pictures import clean_depth, decode_picture, freeze
from kille.sensors.recordings.lenses import lens_from


class OtherFormatError(ValueError):
    """An image of another kind than was asked for, or a damaged one: one line."""


_CHANNELS = {"rgb8": 3, "bgr8": 3, "rgba8": 4, "bgra8": 4, "mono8": 1, "8UC3": 3}
_CHANNELS |= dict.fromkeys(
    ("bayer_rggb8", "bayer_bggr8", "bayer_gbrg8", "bayer_grbg8"), 1
)
_TO_RGB = {
    "bgr8": cv2.COLOR_BGR2RGB,
    "8UC3": cv2.COLOR_BGR2RGB,
    "rgba8": cv2.COLOR_RGBA2RGB,
    "bgra8": cv2.COLOR_BGRA2RGB,
    "mono8": cv2.COLOR_GRAY2RGB,
    "bayer_rggb8": cv2.COLOR_BayerRGGB2RGB,
    "bayer_bggr8": cv2.COLOR_BayerBGGR2RGB,
    "bayer_gbrg8": cv2.COLOR_BayerGBRG2RGB,
    "bayer_grbg8": cv2.COLOR_BayerGRBG2RGB,
}
_DEPTHS = {"16UC1": "u2", "mono16": "u2", "32FC1": "f4"}

COLOURS = tuple(_CHANNELS)
"""The encodings of colour that are understood."""

_HEAD_OF_DEPTH = 12
"""Bytes before the picture in what `compressed_depth_image_transport` sends."""


def is_compressed(message: Any) -> bool:
    """Whether it is a `CompressedImage`."""
    return hasattr(message, "format")


def kind_of(message: Any) -> str:
    """`colour`, `depth` or nothing, as the message's encoding says."""
    if is_compressed(message):
        return "depth" if "compressedDepth" in message.format else "colour"
    if message.encoding in _DEPTHS:
        return "depth"
    return "colour" if message.encoding in _CHANNELS else ""


def colour_of(message: Any) -> Colour:
    """The picture (H, W, 3) RGB, read-only.

    Raises `OtherFormatError` if the message holds none.
    """
    if is_compressed(message):
        content = np.asarray(message.data, np.uint8)
        return freeze(_decode(content, cv2.IMREAD_COLOR_RGB))
    channels = _CHANNELS.get(message.encoding)
    if channels is None:
        raise OtherFormatError(
            f"the encoding {message.encoding} is not understood as colour; "
            f"known are {', '.join(COLOURS)}"
        )
    rows = _rows(message, np.dtype(np.uint8), channels)
    picture = rows[..., 0] if channels == 1 else rows
    code = _TO_RGB.get(message.encoding)
    return freeze(np.array(picture) if code is None else cv2.cvtColor(picture, code))


def depth_of(message: Any) -> Depth:
    """The depth (H, W) in metres, read-only.

    Raises `OtherFormatError` if the message holds none.

    Whole numbers are millimetres, of which 0 is no reading; others are metres.
    """
    if is_compressed(message):
        if "16UC1" not in message.format:
            raise OtherFormatError(f"compressed depth of the kind `{message.format}`")
        content = np.asarray(message.data, np.uint8)[_HEAD_OF_DEPTH:]
        return _metres(_decode(content, cv2.IMREAD_UNCHANGED))
    kind = _DEPTHS.get(message.encoding)
    if kind is None:
        raise OtherFormatError(
            f"the encoding {message.encoding} is not understood as depth; "
            f"known are {', '.join(_DEPTHS)}"
        )
    return _metres(_rows(message, np.dtype(kind), 1)[..., 0])


def lens_of(message: Any) -> Intrinsics:
    """The lens that a `CameraInfo` tells; OtherFormatError if it tells none."""
    matrix = message.K if hasattr(message, "K") else message.k
    fx, _, cx, _, fy, cy = (float(number) for number in np.ravel(matrix)[:6])
    lens = lens_from([fx, fy, cx, cy])
    if lens is None:
        raise OtherFormatError(
            "camera_info does not say fx and fy, it is not calibrated"
        )
    return lens


def _rows(message: Any, kind: np.dtype[Any], channels: int) -> NDArray[Any]:
    """The pixels (H, W, channels) without what pads the rows."""
    height, width = int(message.height), int(message.width)
    ordered = kind.newbyteorder(">" if message.is_bigendian else "<")
    needed = width * channels * kind.itemsize
    step = int(message.step) or needed
    data = np.asarray(message.data, np.uint8)
    if not height or not width or step < needed or data.size < height * step:
        raise OtherFormatError(
            f"an image of {width}x{height} with {data.size} bytes is damaged or empty"
        )
    rows = data[: height * step].reshape(height, step)[:, :needed]
    return np.ascontiguousarray(rows).view(ordered).reshape(height, width, channels)


def _metres(depth: NDArray[Any]) -> Depth:
    if depth.ndim != 2 or depth.dtype.kind not in "uf":
        raise OtherFormatError("a depth picture has one channel of numbers")
    metres = depth.astype(np.float32)
    return clean_depth(metres / np.float32(1000) if depth.dtype.kind == "u" else metres)


def _decode(content: NDArray[np.uint8], flags: int) -> NDArray[Any]:
    picture = decode_picture(np.ascontiguousarray(content), flags)
    if picture is None:
        raise OtherFormatError("a compressed picture does not open; it may be damaged")
    return picture
