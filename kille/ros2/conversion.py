"""Messages of the bus as messages of ROS 2, of its standard types, and back.

They are those of `kille.ros.conversion`, as ROS 2 spells them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from kille.bus import Bundle, BusError, Camera, Facts, Image, Text
from kille.bus.packing import format_facts, pack, parse_facts, unpack
from kille.bus.pixels import encoding_of, pixels_of
from kille.ros2.types import of_bytes, store, to_bytes

_FRAME = "kille_camera"
_SECOND = 1_000_000_000
_IDENTITY = np.eye(3).ravel()


class Ros2Form(NamedTuple):
    """The form of a kind: the name of its type, from messages to bytes, and back.

    `of` raises BusError for what cannot be read.
    """

    name: str
    to: Callable[[Any], bytes]
    of: Callable[[bytes], Any]


def form_of(kind: type[Any]) -> Ros2Form:
    """The form of a kind of messages."""
    name, to, of = _FORMS[kind]
    return Ros2Form(
        name, lambda it: to_bytes(to(it)), lambda data: of(of_bytes(data, name))
    )


def _new_message(name: str, **fields: Any) -> Any:
    return store().types[name](**fields)


def _of_string(text: str) -> Any:
    return _new_message("std_msgs/msg/String", data=text)


def _of_image(image: Image) -> Any:
    height, width = image.pixels.shape[:2]
    pixels = np.ascontiguousarray(image.pixels)
    ordered = pixels.astype(pixels.dtype.newbyteorder("<"), copy=False)
    return _new_message(
        "sensor_msgs/msg/Image",
        header=_header(image.stamp),
        height=height,
        width=width,
        encoding=encoding_of(pixels),
        is_bigendian=0,
        step=pixels.nbytes // height if height else 0,
        data=ordered.view(np.uint8).ravel(),
    )


def _to_image(it: Any) -> Image:
    data, big_endian = it.data.tobytes(), bool(it.is_bigendian)
    pixels = pixels_of(data, it.encoding, it.height, it.width, it.step, big_endian)
    return Image(pixels, _stamp(it))


def _of_camera(camera: Camera) -> Any:
    fx, fy, cx, cy = camera.fx, camera.fy, camera.cx, camera.cy
    whole = dict.fromkeys(("x_offset", "y_offset", "height", "width"), 0)
    return _new_message(
        "sensor_msgs/msg/CameraInfo",
        header=_header(camera.stamp),
        height=camera.height,
        width=camera.width,
        distortion_model="plumb_bob",
        d=np.zeros(5),
        k=np.array([fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]),
        r=_IDENTITY,
        p=np.array([fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]),
        binning_x=0,
        binning_y=0,
        roi=_new_message("sensor_msgs/msg/RegionOfInterest", **whole, do_rectify=False),
    )


def _to_camera(it: Any) -> Camera:
    fx, _, cx, _, fy, cy, *_ = (float(number) for number in it.k)
    if not (fx > 0 and fy > 0):
        raise BusError("the camera says that it is not calibrated: its k is zero")
    return Camera(fx, fy, cx, cy, it.width, it.height, _stamp(it))


def _of_bundle(bundle: Bundle) -> Any:
    data = np.frombuffer(pack(bundle), np.uint8)
    size = {"size": len(data), "stride": len(data)}
    whole = _new_message("std_msgs/msg/MultiArrayDimension", label="npz", **size)
    layout = _new_message("std_msgs/msg/MultiArrayLayout", dim=[whole], data_offset=0)
    return _new_message("std_msgs/msg/UInt8MultiArray", layout=layout, data=data)


def _header(stamp: int) -> Any:
    seconds, rest = divmod(stamp, _SECOND)
    time = _new_message("builtin_interfaces/msg/Time", sec=seconds, nanosec=rest)
    return _new_message("std_msgs/msg/Header", stamp=time, frame_id=_FRAME)


def _stamp(it: Any) -> int:
    return int(it.header.stamp.sec) * _SECOND + int(it.header.stamp.nanosec)


_FORMS: dict[type, tuple[str, Callable[[Any], Any], Callable[[Any], Any]]] = {
    Text: (
        "std_msgs/msg/String",
        lambda it: _of_string(it.text),
        lambda it: Text(it.data),
    ),
    Facts: (
        "std_msgs/msg/String",
        lambda it: _of_string(format_facts(it.facts)),
        lambda it: Facts(parse_facts(it.data)),
    ),
    Image: ("sensor_msgs/msg/Image", _of_image, _to_image),
    Camera: ("sensor_msgs/msg/CameraInfo", _of_camera, _to_camera),
    Bundle: (
        "std_msgs/msg/UInt8MultiArray",
        _of_bundle,
        lambda it: unpack(it.data.tobytes()),
    ),
}
