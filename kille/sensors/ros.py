"""A camera that is a node of ROS: `ros:TOPIC`, the topic of its picture in colour."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING
from urllib.parse import parse_qsl

from kille.bus import BusError
from kille.sensors.bus_sensor import COLOUR, Feed, Stream
from kille.sensors.sensor import SensorError

if TYPE_CHECKING:
    from kille.ros.bus import RosBus

_KNOWN = ("depth", "info", "patience")
_DEPTH_FOLDERS = ("depth_registered", "depth")
_DEPTH_PICTURES = ("image", "image_raw", "image_rect", "image_rect_raw")


class _RosSensor(Stream):
    """A stream that closes its bus."""

    def __init__(self, bus: RosBus, feed: Feed, name: str, patience: float) -> None:
        super().__init__(bus, feed, name, patience)
        self._bus = bus

    def close(self) -> None:
        """Listen no more; a second call does nothing."""
        super().close()
        self._bus.close()


def open_ros_sensor(name: str) -> Stream:
    """The camera whose colour picture is on this topic, `ros:/camera/rgb/image_color`.

    Options: `depth=TOPIC` and `info=TOPIC` where these have other names than usual,
    `depth=none` for colour alone, `patience=SECONDS` to wait for a frame (5).
    SensorError if ROS or its master is not there, or the topic.
    """
    source, _, rest = name.partition("?")
    options = dict(parse_qsl(rest, keep_blank_values=True))
    unknown = next((it for it in options if it not in _KNOWN), None)
    if unknown is not None:
        raise SensorError(
            f"{name}: unknown option `{unknown}`; known are {', '.join(_KNOWN)}"
        )
    patience = _seconds(name, options.get("patience", "5"))
    # A node of ROS is only made by those who ask for one.
    from kille.ros.bus import anonymous, open_ros

    try:
        bus = open_ros(anonymous("kille_eye"))
        colour = bus.full_name(source.partition(":")[2] or COLOUR)
        sent = [topic for topic, kind in bus.topics() if kind == "sensor_msgs/Image"]
        if colour not in sent:
            raise SensorError(
                f"{name}: nobody sends {colour}; {_offered_pictures(sent)}"
            )
        feed = feed_of(colour, sent, options.get("depth", ""), options.get("info", ""))
        return _RosSensor(bus, feed, name, patience)
    except BusError as error:
        raise SensorError(f"{name}: {error}") from error


def feed_of(colour: str, sent: Collection[str], depth: str, info: str) -> Feed:
    """The topics that belong to that of a picture in colour, where none are named.

    The calibration lies beside it; depth lies beside its folder, if anybody sends it.

    >>> feed = feed_of("/a/rgb/image_color", ["/a/depth_registered/image"], "", "")
    >>> feed.camera.name, feed.depth.name
    ('/a/rgb/camera_info', '/a/depth_registered/image')
    """
    folder = colour.rpartition("/")[0]
    beside = folder.rpartition("/")[0]
    usual = (
        f"{beside}/{inner}/{picture}"
        for inner in _DEPTH_FOLDERS
        for picture in _DEPTH_PICTURES
    )
    found = depth or next((topic for topic in usual if topic in sent), "")
    return Feed.of_topics(
        colour, info or f"{folder}/camera_info", "" if found == "none" else found
    )


def _offered_pictures(sent: Collection[str]) -> str:
    return (
        f"pictures are on {', '.join(sorted(sent))}" if sent else "no camera is there"
    )


def _seconds(name: str, text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds < float("inf"):
        raise SensorError(f"{name}: patience is a number of seconds, not `{text}`")
    return seconds
