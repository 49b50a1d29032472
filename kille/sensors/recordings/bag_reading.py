"""ROS bags, read without ROS: `.bag` of ROS 1, `.mcap` and folders of ROS 2.

The encodings of messages say what is colour and what is depth, not the names of topics.
Of several topics those are taken whose names say that they are registered colour and
depth, or those that the options name.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from kille.scene import Frame, Intrinsics
from kille.sensors.recordings.bag_files import Bag, Stamp, explain_errors, open_bag_file
from kille.sensors.recordings.moments import Moment, RecordedMoments
from kille.sensors.recordings.name_suggestions import first_names, suggest_name
from kille.sensors.recordings.pairing import pair_times
from kille.sensors.recordings.playback_options import Options
from kille.sensors.recordings.ros_images import (
    OtherFormatError,
    colour_of,
    depth_of,
    kind_of,
    lens_of,
)
from kille.sensors.sensor import SensorError

IMAGES = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage")
INFO = "sensor_msgs/msg/CameraInfo"


def open_bag(name: str, path: Path, options: Options) -> RecordedMoments:
    """The recording in this bag; SensorError if it has no colour or cannot be read.

    Colour is paired with the depth that is nearest in time, at most 20 ms away; without
    depth there is only colour.
    """
    bag = open_bag_file(name, path)
    try:
        with explain_errors(name):
            moments = _moments(bag, options)
    except BaseException:
        bag.reader.close()
        raise
    kind = "ROS 2 bag" if bag.reader.is2 else "ROS 1 bag"
    return RecordedMoments(kind, moments, bag.remark, close=bag.reader.close)


def _moments(bag: Bag, options: Options) -> list[Moment]:
    kinds = {
        topic: kind_of(first)
        for topic in bag.topics
        if bag.kind(topic) in IMAGES and (first := bag.first(topic)) is not None
    }
    colour = _choose_topic(bag, "colour", kinds, options.colour)
    if colour is None:
        raise SensorError(
            f"{bag.name}: has no colour: no topic holds images in colour; "
            f"it has {first_names(list(bag.topics)) or 'no topic at all'}"
        )
    seen = bag.stamps(colour)
    depth = _choose_topic(bag, "depth", kinds, options.depth)
    if depth is None:
        return [Moment(it.time, partial(_colour_only, bag, colour, it)) for it in seen]
    lens = options.intrinsics or _lens(bag, colour, depth)
    deep = bag.stamps(depth)
    pairs = pair_times([it.time for it in seen], [it.time for it in deep])
    moments = [
        Moment(seen[i].time, partial(_both, bag, colour, seen[i], depth, deep[j], lens))
        for i, j in pairs
    ]
    if not moments:
        raise SensorError(
            f"{bag.name}: no image of {colour} has one of {depth} within 20 ms"
        )
    return moments


def _colour_only(bag: Bag, topic: str, stamp: Stamp) -> Frame:
    with explain_errors(f"{bag.name}, {topic}"):
        colour = colour_of(bag.message(topic, stamp))
    return Frame(colour, None, None, stamp.time, {})


def _both(
    bag: Bag, topic: str, stamp: Stamp, behind: str, deep: Stamp, lens: Intrinsics
) -> Frame:
    seen = _colour_only(bag, topic, stamp)
    with explain_errors(f"{bag.name}, {behind}"):
        depth = depth_of(bag.message(behind, deep))
    if depth.shape != seen.colour.shape[:2]:
        sizes = [f"{it.shape[1]}x{it.shape[0]}" for it in (depth, seen.colour)]
        raise SensorError(
            f"{bag.name}: {behind} is {sizes[0]} but {topic} is {sizes[1]}; "
            "depth must be registered to colour"
        )
    return Frame(seen.colour, depth, lens, stamp.time, {})


_SAYS_SO = {
    "depth": ("depth_registered", "aligned_depth", "registered"),
    "colour": ("rgb", "color", "colour"),
}
"""What the names of the topics that are wanted usually have in them."""


def _choose_topic(
    bag: Bag, kind: str, kinds: Mapping[str, str], named: str | None
) -> str | None:
    """The topic that was named, or the likeliest of its kind, or none."""
    if named is not None and named in bag.topics:
        if bag.kind(named) in IMAGES:
            return named
        raise SensorError(f"{bag.name}: the topic {named} holds no images")
    if named is not None:
        raise SensorError(
            f"{bag.name}: there is no topic {named}"
            f"{suggest_name(named, list(bag.topics))}; "
            f"it has {first_names(list(bag.topics))}"
        )
    topics = [topic for topic, it in kinds.items() if it == kind]
    return min(topics, key=partial(_rank, bag, kind), default=None)


def _rank(bag: Bag, kind: str, topic: str) -> tuple[bool, bool, int, str]:
    says_so = any(word in topic for word in _SAYS_SO[kind])
    count = sum(connection.msgcount for connection in bag.topics[topic])
    return not says_so, bag.kind(topic) != IMAGES[0], -count, topic


def _lens(bag: Bag, colour: str, depth: str) -> Intrinsics:
    """What the camera_info beside the depth says, or that beside the colour, or any."""
    infos = [it for it in bag.topics if bag.kind(it) == INFO]
    beside = {topic: _beside(topic, infos) for topic in (depth, colour)}
    order = [*beside[depth], *beside[colour], *(infos if len(infos) == 1 else ())]
    message = next(
        (it for topic in order if (it := bag.first(topic)) is not None), None
    )
    way_out = "write PATH?intrinsics=fx,fy,cx,cy"
    if message is None:
        raise SensorError(
            f"{bag.name}: depth without calibration: no camera_info beside {depth} or "
            f"{colour}; {way_out}"
        )
    try:
        return lens_of(message)
    except OtherFormatError as error:
        raise SensorError(
            f"{bag.name}: depth without calibration: {error}; {way_out}"
        ) from error


def _beside(topic: str, infos: Sequence[str]) -> list[str]:
    """The nearest of them above the topic: `/a/b/image/compressed` has `/a/b/…`."""
    parts = topic.split("/")
    above = ["/".join(parts[:end]) for end in range(len(parts) - 1, 0, -1)]
    return [f"{it}/camera_info" for it in above if f"{it}/camera_info" in infos]
