"""ROS bags: which topics are played, how images are read, what is told of bad ones."""

from __future__ import annotations

import sqlite3
import sys
from collections.abc import Sequence
from contextlib import closing, suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
from rosbags import rosbag2
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from kille.scene import Intrinsics
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.playback import Recording
from kille.sensors.recordings.ros_images import (
    COLOURS,
    OtherFormatError,
    colour_of,
    depth_of,
    kind_of,
)
from kille.sensors.sensor import SensorError

TYPES = get_typestore(Stores.ROS1_NOETIC)
IMAGE, COMPRESSED, INFO = (
    f"sensor_msgs/msg/{kind}" for kind in ("Image", "CompressedImage", "CameraInfo")
)
Message = tuple[str, int, str, Any]
"""A topic, the nanoseconds at which the bag keeps it, its type, itself."""

RED = np.full((4, 6, 3), (200, 10, 20), np.uint8)
DEPTH = np.arange(24, dtype=np.uint16).reshape(4, 6) * 100


def header(nanoseconds: int) -> Any:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    stamp = TYPES.types["builtin_interfaces/msg/Time"](sec=seconds, nanosec=rest)
    return TYPES.types["std_msgs/msg/Header"](seq=0, stamp=stamp, frame_id="")


def image(
    topic: str, at: int, encoding: str, pixels: np.ndarray, made: int | None = None
) -> Message:
    message = TYPES.types[IMAGE](
        header=header(at if made is None else made),
        height=pixels.shape[0],
        width=pixels.shape[1],
        encoding=encoding,
        is_bigendian=0,
        step=pixels.nbytes // pixels.shape[0],
        data=np.ascontiguousarray(pixels).reshape(-1).view(np.uint8),
    )
    return topic, at, IMAGE, message


def packed(topic: str, at: int, kind: str, data: bytes) -> Message:
    content = np.frombuffer(data, np.uint8)
    message = TYPES.types[COMPRESSED](header=header(at), format=kind, data=content)
    return topic, at, COMPRESSED, message


def info(topic: str, at: int, focal: float = 5.0) -> Message:
    whole = TYPES.types["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, False)
    matrix = np.array([focal, 0, 2.5, 0, focal, 1.5, 0, 0, 1])
    flat = (np.zeros(5), matrix, np.eye(3).ravel(), np.zeros(12))
    message = TYPES.types[INFO](header(at), 4, 6, "plumb_bob", *flat, 0, 0, whole)
    return topic, at, INFO, message


def bag(path: Path, messages: Sequence[Message]) -> Path:
    with Writer(path) as writer:
        known: dict[str, Any] = {}
        for topic, at, kind, message in messages:
            if topic not in known:
                known[topic] = writer.add_connection(topic, kind, typestore=TYPES)
            data = TYPES.serialize_ros1(message, kind)
            writer.write(known[topic], at, data)
    return path


def opened(name: Path | str) -> Recording:
    recording = open_recording(str(name))
    assert isinstance(recording, Recording)
    return recording


def complaint(name: Path | str) -> str:
    with pytest.raises(SensorError) as caught:
        open_recording(str(name)).frame()
    assert "\n" not in str(caught.value)
    return str(caught.value)


SECOND = 1_000_000_000


def usual(at: int = SECOND) -> list[Message]:
    return [
        image("/cam/rgb/image", at, "rgb8", RED),
        image("/cam/depth/image", at, "16UC1", DEPTH),
        info("/cam/depth/camera_info", at),
    ]


# --- which topics --------------------------------------------------------------------


def test_colour_depth_and_lens_are_found(tmp_path: Path) -> None:
    recording = opened(bag(tmp_path / "a.bag", usual()))
    frame = recording.frame()
    assert np.array_equal(frame.colour, RED)
    assert frame.depth is not None
    assert np.isnan(frame.depth[0, 0])
    assert frame.depth[1, 1] == np.float32(0.7)
    assert frame.intrinsics == Intrinsics(5, 5, 2.5, 1.5)
    recording.close()


def test_registered_depth_and_colour_are_preferred(tmp_path: Path) -> None:
    other = np.zeros_like(RED)
    messages = [
        image("/cam/ir/image", SECOND, "mono8", other[..., 0]),
        image("/cam/left/image", SECOND, "rgb8", other),
        image("/cam/depth/image", SECOND, "16UC1", 2 * DEPTH),
        image("/cam/aligned_depth_to_color/image", SECOND, "16UC1", DEPTH),
        image("/cam/color/image", SECOND, "rgb8", RED),
        info("/cam/depth/camera_info", SECOND, 9.0),
        info("/cam/color/camera_info", SECOND),
        info("/cam/aligned_depth_to_color/camera_info", SECOND, 7.0),
    ]
    path = bag(tmp_path / "a.bag", messages)
    recording = opened(path)
    frame = recording.frame()
    assert np.array_equal(frame.colour, RED)
    assert frame.depth is not None
    assert frame.depth[1, 1] == np.float32(0.7)
    assert frame.intrinsics is not None
    assert frame.intrinsics.fx == 7
    recording.close()
    named = opened(f"{path}?colour=/cam/left/image&depth=/cam/depth/image")
    frame = named.frame()
    assert np.array_equal(frame.colour, other)
    assert frame.depth is not None
    assert frame.depth[1, 1] == np.float32(1.4)
    named.close()


def test_a_topic_that_is_not_there(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.bag", usual())
    text = complaint(f"{path}?colour=/cam/rgb/imag")
    assert "there is no topic /cam/rgb/imag (did you mean /cam/rgb/image?)" in text
    assert "it has /cam/depth/camera_info, /cam/depth/image, /cam/rgb/image" in text


def test_a_topic_of_another_kind(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.bag", usual())
    assert "16UC1 is not understood as colour" in complaint(
        f"{path}?colour=/cam/depth/image"
    )
    assert "holds no images" in complaint(f"{path}?colour=/cam/depth/camera_info")


def test_messages_are_paired_by_when_they_were_made(tmp_path: Path) -> None:
    messages = []
    for number in range(4):
        made = SECOND + number * 100_000_000
        kept = 5 * SECOND + number * 1000
        colour = np.full_like(RED, number)
        messages += [
            image("/rgb", kept, "rgb8", colour, made),
            image("/depth", kept, "16UC1", DEPTH + 100 * number, made + 5_000_000),
        ]
    messages.append(info("/camera_info", 5 * SECOND))
    recording = opened(bag(tmp_path / "a.bag", messages[::-1]))
    assert recording.reel.times == pytest.approx([0, 0.1, 0.2, 0.3])
    for number in range(4):
        frame = recording.frame()
        assert frame.colour[0, 0, 0] == number
        assert frame.depth is not None
        assert frame.depth[0, 1] == np.float32(0.1 + 0.1 * number)
    recording.close()


def test_without_stamps_it_is_when_they_were_kept(tmp_path: Path) -> None:
    messages = [
        image(topic, SECOND + number * 100_000_000, encoding, pixels, made=0)
        for number in range(3)
        for topic, encoding, pixels in (("/rgb", "rgb8", RED), ("/z", "16UC1", DEPTH))
    ]
    path = bag(tmp_path / "a.bag", [*messages, info("/camera_info", SECOND)])
    recording = opened(path)
    assert recording.reel.times == pytest.approx([0, 0.1, 0.2])
    recording.close()


def test_a_camera_that_was_started_again_is_one_topic(tmp_path: Path) -> None:
    path = tmp_path / "a.bag"
    with Writer(path) as writer:
        for number, caller in enumerate(("/one", "/two", "/three")):
            connection = writer.add_connection(
                "/rgb", IMAGE, typestore=TYPES, callerid=caller
            )
            at = SECOND + number * 100_000_000
            _, _, _, seen = image("/rgb", at, "rgb8", np.full_like(RED, number))
            writer.write(connection, at, TYPES.serialize_ros1(seen, IMAGE))
    recording = opened(path)
    assert [recording.frame().colour[0, 0, 0] for _ in range(3)] == [0, 1, 2]
    recording.close()


def test_messages_kept_at_the_same_moment_are_told_apart(tmp_path: Path) -> None:
    messages = [
        image("/rgb", SECOND, "rgb8", np.full_like(RED, number), number * 100_000_000)
        for number in range(1, 4)
    ]
    recording = opened(bag(tmp_path / "a.bag", messages))
    assert [recording.frame().colour[0, 0, 0] for _ in range(3)] == [1, 2, 3]
    recording.close()


# --- what is wrong -------------------------------------------------------------------


def test_a_bag_without_colour(tmp_path: Path) -> None:
    text = complaint(bag(tmp_path / "a.bag", usual()[1:]))
    assert "a.bag: has no colour: no topic holds images in colour; it has /cam" in text


def test_a_bag_without_anything(tmp_path: Path) -> None:
    assert "it has no topic at all" in complaint(bag(tmp_path / "a.bag", []))


def test_depth_without_calibration(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.bag", usual()[:2])
    text = complaint(path)
    assert "depth without calibration: no camera_info beside /cam/depth/image" in text
    told = opened(f"{path}?intrinsics=5,5,2.5,1.5")
    assert told.frame().intrinsics == Intrinsics(5, 5, 2.5, 1.5)
    told.close()


def test_a_lens_that_was_never_calibrated(tmp_path: Path) -> None:
    messages = [*usual()[:2], info("/cam/depth/camera_info", SECOND, 0.0)]
    text = complaint(bag(tmp_path / "a.bag", messages))
    assert "depth without calibration: camera_info does not say fx and fy" in text


def test_depth_that_is_not_registered(tmp_path: Path) -> None:
    messages = usual()
    messages[1] = image("/cam/depth/image", SECOND, "16UC1", DEPTH[:2])
    text = complaint(bag(tmp_path / "a.bag", messages))
    assert "/cam/depth/image is 6x2 but /cam/rgb/image is 6x4" in text
    assert "must be registered to colour" in text


def test_colour_and_depth_of_different_times(tmp_path: Path) -> None:
    messages = [usual()[0], *usual(9 * SECOND)[1:]]
    text = complaint(bag(tmp_path / "a.bag", messages))
    assert "no image of /cam/rgb/image has one of /cam/depth/image within 20 ms" in text


def test_without_rosbags_the_way_to_get_it_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = bag(tmp_path / "a.bag", usual())
    monkeypatch.setitem(sys.modules, "rosbags.highlevel", None)
    assert "ROS bags need rosbags: pip install 'kille[record]'" in complaint(path)


def test_a_damaged_bag_plays_or_is_told_of(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.bag", usual())
    whole = path.read_bytes()
    rng = np.random.default_rng(2)
    for _ in range(60):
        damaged = bytearray(whole)
        for place in rng.integers(13, len(whole), 40):
            damaged[place] = rng.integers(0, 256)
        path.write_bytes(damaged)
        with suppress(SensorError):
            opened(path).close()


def test_a_database_whose_topics_have_lost_their_names_is_told_of(
    tmp_path: Path,
) -> None:
    kinds = get_typestore(Stores.ROS2_HUMBLE)
    plugin = rosbag2.StoragePlugin.SQLITE3
    with rosbag2.Writer(tmp_path / "a", version=9, storage_plugin=plugin) as writer:
        writer.add_connection("/rgb", IMAGE, typestore=kinds)
    [path] = (tmp_path / "a").glob("*.db3")
    with closing(sqlite3.connect(path)) as database:
        database.execute("PRAGMA writable_schema = ON")
        database.execute("UPDATE sqlite_master SET sql = replace(sql, 'NOT NULL', '')")
        database.commit()
    with closing(sqlite3.connect(path)) as database:
        database.execute("INSERT INTO topics (id) VALUES (7)")
        database.commit()
    assert "this bag is damaged: a topic in it has no name" in complaint(path)


# --- images --------------------------------------------------------------------------


def message(pixels: np.ndarray, encoding: str, **changes: Any) -> SimpleNamespace:
    """What any client of ROS makes of an image message."""
    fields = {
        "height": pixels.shape[0],
        "width": pixels.shape[1],
        "encoding": encoding,
        "is_bigendian": 0,
        "step": 0,
        "data": np.ascontiguousarray(pixels).reshape(-1).view(np.uint8),
    }
    return SimpleNamespace(**(fields | changes))


@pytest.mark.parametrize(
    ("encoding", "pixels"),
    [
        ("rgb8", RED),
        ("bgr8", RED[..., ::-1]),
        ("8UC3", RED[..., ::-1]),
        ("rgba8", np.dstack([RED, RED[..., :1]])),
        ("bgra8", np.dstack([RED[..., ::-1], RED[..., :1]])),
    ],
)
def test_encodings_of_colour(encoding: str, pixels: np.ndarray) -> None:
    assert np.array_equal(colour_of(message(pixels, encoding)), RED)
    assert kind_of(message(pixels, encoding)) == "colour"
    assert encoding in COLOURS


def test_grey_and_bayer() -> None:
    grey = np.full((4, 6), 7, np.uint8)
    assert (colour_of(message(grey, "mono8")) == 7).all()
    seen = np.zeros((4, 6), np.uint8)
    seen[0::2, 1::2] = 200  # the red pixels of the Kinect's pattern
    red = colour_of(message(seen, "bayer_grbg8"))
    assert red[2, 2, 0] > 50
    assert red[..., 1:].max() == 0


@pytest.mark.parametrize(("encoding", "unit"), [("16UC1", 1000), ("mono16", 1000)])
@pytest.mark.parametrize("order", ["<u2", ">u2"])
def test_depth_in_millimetres(encoding: str, unit: int, order: str) -> None:
    big = int(order == ">u2")
    found = depth_of(message(DEPTH.astype(order), encoding, is_bigendian=big))
    assert np.array_equal(np.nan_to_num(found), DEPTH / np.float32(unit))


def test_depth_in_metres_has_gaps() -> None:
    metres = np.array([[0.5, np.nan, np.inf, 0.0, -1.0]], np.float32)
    found = depth_of(message(metres, "32FC1"))
    assert np.isnan(found).tolist() == [[False, True, True, True, True]]


def test_rows_may_be_padded() -> None:
    padded = np.pad(RED.reshape(4, -1), ((0, 0), (0, 3)))
    wide = message(padded, "rgb8", width=6, step=21)
    assert np.array_equal(colour_of(wide), RED)


def test_compressed_colour_and_depth() -> None:
    _, png = cv2.imencode(".png", RED[..., ::-1])
    seen = SimpleNamespace(format="rgb8; png compressed bgr8", data=png.ravel())
    assert kind_of(seen) == "colour"
    assert np.array_equal(colour_of(seen), RED)
    _, deep = cv2.imencode(".png", DEPTH)
    data = bytes(12) + deep.tobytes()
    far = SimpleNamespace(
        format="16UC1; compressedDepth", data=np.frombuffer(data, "u1")
    )
    assert kind_of(far) == "depth"
    assert np.array_equal(np.nan_to_num(depth_of(far)), DEPTH / np.float32(1000))


def test_compressed_images_of_a_bag_are_played(tmp_path: Path) -> None:
    _, jpeg = cv2.imencode(".jpg", RED[..., ::-1])
    _, deep = cv2.imencode(".png", DEPTH)
    messages = [
        packed("/rgb/image/compressed", SECOND, "jpeg", jpeg.tobytes()),
        packed(
            "/depth/image/compressedDepth",
            SECOND,
            "16UC1; compressedDepth png",
            bytes(12) + deep.tobytes(),
        ),
        info("/depth/camera_info", SECOND),
    ]
    recording = opened(bag(tmp_path / "a.bag", messages))
    frame = recording.frame()
    assert np.abs(frame.colour.astype(int) - RED).max() < 12
    assert frame.depth is not None
    assert frame.depth[1, 1] == np.float32(0.7)
    recording.close()


@pytest.mark.parametrize(
    ("read", "wrong", "told"),
    [
        (colour_of, message(RED, "yuv422"), "yuv422 is not understood as colour"),
        (depth_of, message(RED, "rgb8"), "rgb8 is not understood as depth"),
        (colour_of, message(RED, "rgb8", height=400), "is damaged or empty"),
        (colour_of, message(RED, "rgb8", height=0), "is damaged or empty"),
        (colour_of, message(RED, "rgb8", step=3), "is damaged or empty"),
        (colour_of, SimpleNamespace(format="jpeg", data=np.ones(9, "u1")), "not open"),
        (colour_of, SimpleNamespace(format="jpeg", data=np.ones(0, "u1")), "not open"),
        (
            depth_of,
            SimpleNamespace(format="32FC1; compressedDepth", data=np.ones(9, "u1")),
            "compressed depth of the kind `32FC1; compressedDepth`",
        ),
    ],
)
def test_an_image_that_cannot_be_read(read: Any, wrong: Any, told: str) -> None:
    with pytest.raises(OtherFormatError, match=told):
        read(wrong)
