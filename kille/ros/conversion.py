"""Messages of the bus as messages of ROS 1, of its standard types, and back.

| bus | ROS |
| --- | --- |
| Text | std_msgs/String |
| Facts | std_msgs/String, JSON |
| Image | sensor_msgs/Image: rgb8, 32FC1, 16UC1 or mono8 |
| Camera | sensor_msgs/CameraInfo |
| Bundle | std_msgs/UInt8MultiArray, a NumPy archive |
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from kille.bus import Bundle, BusError, Camera, Facts, Image, Text
from kille.bus.packing import format_facts, pack, parse_facts, unpack
from kille.bus.pixels import encoding_of, pixels_of
from kille.ros.system_modules import ros

_FRAME = "kille_camera"
_SECOND = 1_000_000_000


class Ros1Form(NamedTuple):
    """The form that messages of a kind have in ROS: its class, the way there and back.

    `of` raises BusError for what cannot be read.
    """

    sent: type[Any]
    to: Callable[[Any], Any]
    of: Callable[[Any], Any]


def form_of(kind: type[Any]) -> Ros1Form:
    """The form of a kind of messages; BusError where ROS is absent."""
    std, sensor = ros("std_msgs.msg"), ros("sensor_msgs.msg")
    if kind is Text:
        return Ros1Form(
            std.String, lambda it: std.String(it.text), lambda it: Text(it.data)
        )
    if kind is Facts:
        return Ros1Form(
            std.String,
            lambda it: std.String(format_facts(it.facts)),
            lambda it: Facts(parse_facts(it.data)),
        )
    if kind is Image:
        return Ros1Form(sensor.Image, _to_image, _of_image)
    if kind is Camera:
        return Ros1Form(sensor.CameraInfo, _to_camera, _of_camera)
    return Ros1Form(std.UInt8MultiArray, _to_array, lambda it: unpack(bytes(it.data)))


def _to_image(image: Image) -> Any:
    height, width = image.pixels.shape[:2]
    pixels = np.ascontiguousarray(image.pixels)
    native = pixels.dtype.newbyteorder("<")
    return ros("sensor_msgs.msg").Image(
        header=_header(image.stamp),
        height=height,
        width=width,
        encoding=encoding_of(pixels),
        is_bigendian=0,
        step=pixels.nbytes // height if height else 0,
        data=pixels.astype(native, copy=False).tobytes(),
    )


def _of_image(it: Any) -> Image:
    pixels = pixels_of(
        it.data, it.encoding, it.height, it.width, it.step, bool(it.is_bigendian)
    )
    return Image(pixels, _stamp(it))


def _to_camera(camera: Camera) -> Any:
    fx, fy, cx, cy = camera.fx, camera.fy, camera.cx, camera.cy
    return ros("sensor_msgs.msg").CameraInfo(
        header=_header(camera.stamp),
        height=camera.height,
        width=camera.width,
        distortion_model="plumb_bob",
        D=[0.0] * 5,
        K=[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        R=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        P=[fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    )


def _of_camera(it: Any) -> Camera:
    """The camera's own matrix; one of zeros says that it was never calibrated."""
    fx, _, cx, _, fy, cy, *_ = it.K
    if not (fx > 0 and fy > 0):
        raise BusError("the camera says that it is not calibrated: its K is zero")
    return Camera(fx, fy, cx, cy, it.width, it.height, _stamp(it))


def _to_array(bundle: Bundle) -> Any:
    std = ros("std_msgs.msg")
    data = pack(bundle)
    whole = std.MultiArrayDimension(label="npz", size=len(data), stride=len(data))
    return std.UInt8MultiArray(std.MultiArrayLayout([whole], 0), data)


def _header(stamp: int) -> Any:
    header = ros("std_msgs.msg").Header(frame_id=_FRAME)
    header.stamp.secs, header.stamp.nsecs = divmod(stamp, _SECOND)
    return header


def _stamp(it: Any) -> int:
    return int(it.header.stamp.secs) * _SECOND + int(it.header.stamp.nsecs)
