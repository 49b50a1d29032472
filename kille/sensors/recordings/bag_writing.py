"""Write ROS bags without ROS: images and calibrations, as cameras publish them.

Colour is `rgb8`, depth `32FC1` in metres, on the topics of the usual Kinect drivers,
where depth lies on the colour picture. So a bag keeps frames bit for bit.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable
from dataclasses import fields
from functools import partial
from math import floor
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kille.scene import Frame, Intrinsics
from kille.sensors.recordings.bag_files import NOT_INSTALLED
from kille.sensors.sensor import SensorError

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

COLOUR, COLOUR_INFO = "/camera/rgb/image_color", "/camera/rgb/camera_info"
DEPTH = "/camera/depth_registered/image"
DEPTH_INFO = "/camera/depth_registered/camera_info"
OPTICAL_FRAME = "camera_rgb_optical_frame"

_IMAGE, _INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"

_LAST_SECOND = 1 << 31

Put = Callable[[str, str, int, Any], None]
"""Adds a message: its topic, its type, its nanoseconds."""


def write_bag(path: Path, frames: Iterable[Frame]) -> None:
    """Write a ROS 1 bag into this new file; OSError if it cannot be."""
    stores, get_typestore = _types()
    from rosbags.rosbag1 import Writer

    types = get_typestore(stores.ROS1_NOETIC)
    with Writer(path) as writer:
        _put_all(types, _message_writer(writer, types, types.serialize_ros1), frames)


def write_ros2(folder: Path, frames: Iterable[Frame]) -> None:
    """Write a ROS 2 bag into this new folder; OSError if it cannot be."""
    stores, get_typestore = _types()
    from rosbags.rosbag2 import StoragePlugin, Writer

    types = get_typestore(stores.ROS2_HUMBLE)
    with Writer(folder, version=8, storage_plugin=StoragePlugin.MCAP) as writer:
        _put_all(types, _message_writer(writer, types, types.serialize_cdr), frames)


def write_mcap(path: Path, frames: Iterable[Frame]) -> None:
    """Write a ROS 2 bag into this one new file; OSError if it cannot be."""
    folder = path.with_name(f"{path.name}.bag")
    try:
        write_ros2(folder, frames)
        (held,) = folder.glob("*.mcap")
        held.replace(path)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _types() -> tuple[Any, Any]:
    try:
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise SensorError(NOT_INSTALLED) from error
    return Stores, get_typestore


def _message_writer(
    writer: Any, types: Any, serialise: Callable[[Any, str], Any]
) -> Put:
    """How messages get into a bag: each topic is announced with its first."""
    connections: dict[str, Any] = {}

    def put(topic: str, kind: str, nanoseconds: int, message: Any) -> None:
        if topic not in connections:
            connections[topic] = writer.add_connection(topic, kind, typestore=types)
        writer.write(connections[topic], nanoseconds, serialise(message, kind))

    return put


def _put_all(types: Typestore, put: Put, frames: Iterable[Frame]) -> None:
    shift: int | None = None
    for number, frame in enumerate(frames):
        if shift is None:
            # ROS takes the time 0 for none at all, and knows of none before that.
            shift = max(0, 1 - floor(frame.time))
        nanoseconds = _nanoseconds(frame.time + shift)
        head = partial(_header, types, number, nanoseconds)
        colour = np.ascontiguousarray(frame.colour, np.uint8)
        put(COLOUR, _IMAGE, nanoseconds, _image(types, head(), "rgb8", colour))
        if frame.intrinsics is not None:
            size = frame.colour.shape[:2]
            info = _info(types, head(), frame.intrinsics, size)
            put(COLOUR_INFO, _INFO, nanoseconds, info)
        if frame.depth is not None and frame.intrinsics is not None:
            depth = np.ascontiguousarray(frame.depth, "<f4")
            put(DEPTH, _IMAGE, nanoseconds, _image(types, head(), "32FC1", depth))
            put(DEPTH_INFO, _INFO, nanoseconds, info)


def _nanoseconds(time: float) -> int:
    if time < _LAST_SECOND:
        return round(time * 1e9)
    raise SensorError(
        f"a frame is {time:g} seconds from 1970, and bags end in 2038: are its times "
        "in seconds?"
    )


def _fields(message: type[Any]) -> set[str]:
    return {field.name for field in fields(message)}


def _header(types: Typestore, number: int, nanoseconds: int) -> Any:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    stamp = types.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=rest)
    header = types.types["std_msgs/msg/Header"]
    # ROS 1 numbers messages, ROS 2 does not.
    numbered = {"seq": number} if "seq" in _fields(header) else {}
    return header(stamp=stamp, frame_id=OPTICAL_FRAME, **numbered)


def _image(types: Typestore, header: Any, encoding: str, pixels: Any) -> Any:
    height, width = pixels.shape[:2]
    return types.types[_IMAGE](
        header=header,
        height=height,
        width=width,
        encoding=encoding,
        is_bigendian=0,
        step=pixels.nbytes // height,
        data=pixels.reshape(-1).view(np.uint8),
    )


def _info(
    types: Typestore, header: Any, lens: Intrinsics, size: tuple[int, int]
) -> Any:
    info = types.types[_INFO]
    camera = np.array([[lens.fx, 0, lens.cx], [0, lens.fy, lens.cy], [0, 0, 1]])
    matrices = {
        "D": np.zeros(5),
        "K": camera.ravel(),
        "R": np.eye(3).ravel(),
        "P": np.column_stack([camera, np.zeros(3)]).ravel(),
    }
    if "K" not in _fields(info):
        matrices = {name.lower(): matrix for name, matrix in matrices.items()}
    whole = types.types["sensor_msgs/msg/RegionOfInterest"]
    return info(
        header=header,
        height=size[0],
        width=size[1],
        distortion_model="plumb_bob",
        binning_x=0,
        binning_y=0,
        roi=whole(x_offset=0, y_offset=0, height=0, width=0, do_rectify=False),
        **matrices,
    )
