"""Programs that nobody here wrote play what is written, and write what is played."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kille.scene import Frame, Intrinsics
from kille.sensors.kinect.calibration import Calibration
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture
from kille.sensors.kinect.motor import Tilt
from kille.sensors.recordings.bag_writing import write_bag, write_mcap
from kille.sensors.recordings.fakenect_writing import FakenectWriter
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.playback import RawRecording, Recording

LENS = Intrinsics(50.0, 51.5, 15.5, 11.25)

# --- libfreenect's player and recorder -----------------------------------------------


@pytest.fixture
def fakenect() -> str:
    """Runs a program on a recording, as libfreenect's player does it."""
    found = shutil.which("fakenect")
    if found is None or shutil.which("fakenect-record") is None:
        pytest.skip("no fakenect: apt-get install libfreenect-bin")
    return found


def captures(count: int) -> Iterator[KinectCapture]:
    rng = np.random.default_rng(11)
    for number in range(count):
        yield KinectCapture(
            time=number / 30,
            colour=rng.integers(0, 256, (480, 640, 3), np.uint8),
            depth=rng.integers(0, 2048, (480, 640), np.uint16),
            ticks_colour=2_000_000 * number + 4000,
            ticks_depth=2_000_000 * number + 5000,
            tilt=Tilt(-17, 803, 90 + number, -20, 4),
        )


def played_by_libfreenect(fakenect: str, folder: Path, into: Path) -> None:
    done = subprocess.run(
        [fakenect, str(folder), "fakenect-record", str(into)],
        env={**os.environ, "FAKENECT_LOOP": "no"},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert "No more lines" in done.stdout, done.stdout + done.stderr


@pytest.mark.oracle
def test_libfreenect_plays_and_records_what_was_recorded(
    fakenect: str, tmp_path: Path
) -> None:
    """Ours, played by its player, recorded by its recorder, read by ours again."""
    given = list(captures(8))
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    with FakenectWriter(ours, Calibration.typical(), COLOUR_CAMERA, 1000.0) as writer:
        for capture in given:
            writer.write(capture)
    played_by_libfreenect(fakenect, ours, theirs)
    for kind, suffix in (("r", "ppm"), ("d", "pgm")):
        mine = {ticks(it): it.read_bytes() for it in ours.glob(f"{kind}-*.{suffix}")}
        found = {ticks(it): it.read_bytes() for it in theirs.glob(f"{kind}-*.{suffix}")}
        assert len(found) == 8
        assert found == mine
    states = {it.read_bytes() for it in theirs.glob("a-*.dump")}
    assert states >= {it.read_bytes() for it in ours.glob("a-*.dump")} - {
        min(ours.glob("a-*.dump")).read_bytes()
    }
    recording = open_recording(str(theirs))
    assert isinstance(recording, RawRecording)
    for capture in given:
        again = recording.capture()
        assert np.array_equal(again.depth, capture.depth)
        assert np.array_equal(again.colour, capture.colour)
        assert (again.ticks_colour, again.ticks_depth) == (
            capture.ticks_colour,
            capture.ticks_depth,
        )
    assert again.tilt == capture.tilt


def ticks(path: Path) -> str:
    return path.stem.rsplit("-", 1)[1]


@pytest.mark.oracle
def test_libfreenect_plays_it_as_fast_as_it_was(fakenect: str, tmp_path: Path) -> None:
    ours = tmp_path / "ours"
    with FakenectWriter(ours, Calibration.typical(), COLOUR_CAMERA, 1000.0) as writer:
        for number, capture in enumerate(captures(5)):
            writer.write(replace(capture, time=number / 5))
    took = []
    for attempt in range(4):
        theirs = tmp_path / f"theirs{attempt}"
        played_by_libfreenect(fakenect, ours, theirs)
        times = sorted(float(it.name.split("-")[1]) for it in theirs.glob("d-*"))
        took.append(times[-1] - times[0])
        # On a busy machine a player is late now and then.
        if took[-1] <= 4 / 5 + 0.25:
            break
    assert min(took) == pytest.approx(4 / 5, abs=0.25)


# --- ROS 1's own rosbag --------------------------------------------------------------

# Its modules are those of the system's Python, whatever runs the tests.
SYSTEM = "/usr/bin/python3"

READ = """
import hashlib, json, rosbag, sys
told = []
for topic, message, time in rosbag.Bag(sys.argv[1]).read_messages():
    stamp = message.header.stamp.to_nsec()
    about = {"topic": topic, "stamp": stamp, "kept": time.to_nsec()}
    about["frame"] = message.header.frame_id
    if hasattr(message, "encoding"):
        about["image"] = [message.encoding, message.height, message.width, message.step]
        about["data"] = hashlib.sha256(message.data).hexdigest()
    else:
        about["K"] = list(message.K)
    told.append(about)
print(json.dumps(told))
"""

WRITE = """
import genpy, rosbag, sys
from sensor_msgs.msg import CameraInfo, Image
out, encoding, deep, packing = sys.argv[1:]
lens = [50.0, 0, 15.5, 0, 51.5, 11.25, 0, 0, 1]
with rosbag.Bag(out, "w", compression=packing) as bag:
    for number in range(4):
        made = genpy.Time.from_sec(1600000000 + number / 30.0)
        kept = made + genpy.Duration(0, 70000000 - 10000000 * number)
        image = Image(height=24, width=32, encoding=encoding, step=32 * 3 + 5)
        image.data = open("%s.%d.colour" % (out, number), "rb").read()
        far = Image(height=24, width=32, encoding=deep)
        far.data = open("%s.%d.depth" % (out, number), "rb").read()
        far.step = len(far.data) // 24
        infrared = Image(height=24, width=32, encoding="mono8", step=32)
        infrared.data = bytes(24 * 32)
        for topic, message in (
            ("/camera/ir/image", infrared),
            ("/camera/rgb/image_color", image),
            ("/camera/depth_registered/image_raw", far),
            ("/camera/depth_registered/camera_info", CameraInfo(K=lens)),
        ):
            message.header.stamp = made
            bag.write(topic, message, kept)
"""


@pytest.fixture
def rosbag() -> None:
    done = subprocess.run(
        [SYSTEM, "-c", "import rosbag, sensor_msgs.msg"],
        capture_output=True,
        check=False,
    )
    if done.returncode:
        pytest.skip("no rosbag: apt-get install python3-rosbag python3-sensor-msgs")


def system(code: str, *arguments: str) -> str:
    done = subprocess.run(
        [SYSTEM, "-c", code, *arguments], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def frames(count: int) -> Iterator[Frame]:
    rng = np.random.default_rng(3)
    for number in range(count):
        depth = rng.uniform(0.4, 8.0, (24, 32)).astype(np.float32)
        depth[0, 0] = np.nan
        colour = rng.integers(0, 256, (24, 32, 3), np.uint8)
        yield Frame(colour, depth, LENS, 1_700_000_000 + number / 30, {})


def sha(array: np.ndarray) -> str:
    return hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()


@pytest.mark.ros
@pytest.mark.usefixtures("rosbag")
def test_ros_reads_the_bag_that_is_written(tmp_path: Path) -> None:
    path = tmp_path / "walk.bag"
    write_bag(path, frames(5))
    told = json.loads(system(READ, str(path)))
    assert len(told) == 20
    for number, frame in enumerate(frames(5)):
        colour, _, depth, _ = four = told[4 * number : 4 * number + 4]
        assert [it["topic"] for it in four] == [
            "/camera/rgb/image_color",
            "/camera/rgb/camera_info",
            "/camera/depth_registered/image",
            "/camera/depth_registered/camera_info",
        ]
        assert {it["stamp"] for it in four} == {it["kept"] for it in four}
        assert colour["stamp"] == pytest.approx(frame.time * 1e9, abs=1000)
        assert colour["image"] == ["rgb8", 24, 32, 96]
        assert depth["image"] == ["32FC1", 24, 32, 128]
        assert colour["data"] == sha(frame.colour)
        assert frame.depth is not None
        assert depth["data"] == sha(frame.depth)
        assert four[3]["K"] == [50.0, 0, 15.5, 0, 51.5, 11.25, 0, 0, 1]
        assert colour["frame"] == "camera_rgb_optical_frame"


@pytest.mark.ros
@pytest.mark.usefixtures("rosbag")
def test_rosbag_info_knows_the_bag_that_is_written(tmp_path: Path) -> None:
    write_bag(tmp_path / "walk.bag", frames(5))
    command = shutil.which("rosbag")
    if command is None:
        pytest.skip("no command rosbag: apt-get install python3-rosbag")
    done = subprocess.run(
        [command, "info", "--yaml", str(tmp_path / "walk.bag")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "messages: 20" in done.stdout
    assert "indexed: True" in done.stdout
    assert "sensor_msgs/Image" in done.stdout


@pytest.mark.ros
@pytest.mark.usefixtures("rosbag")
@pytest.mark.parametrize(
    ("encoding", "deep", "packing"),
    [("rgb8", "16UC1", "none"), ("bgr8", "32FC1", "bz2"), ("bgr8", "16UC1", "lz4")],
)
def test_the_bag_that_ros_writes_is_read(
    tmp_path: Path, encoding: str, deep: str, packing: str
) -> None:
    path = tmp_path / "theirs.bag"
    given = list(frames(4))
    for number, frame in enumerate(given):
        colour = frame.colour if encoding == "rgb8" else frame.colour[..., ::-1]
        padded = np.pad(colour.reshape(24, -1), ((0, 0), (0, 5)))
        (tmp_path / f"theirs.bag.{number}.colour").write_bytes(padded.tobytes())
        assert frame.depth is not None
        mm = np.nan_to_num(frame.depth * 1000).round().astype("<u2")
        depth = mm if deep == "16UC1" else frame.depth
        (tmp_path / f"theirs.bag.{number}.depth").write_bytes(depth.tobytes())
    system(WRITE, str(path), encoding, deep, packing)
    recording = open_recording(str(path))
    assert isinstance(recording, Recording)
    assert recording.reel.times == pytest.approx([it / 30 for it in range(4)], abs=1e-6)
    for expected in given:
        frame = recording.frame()
        assert frame.intrinsics == LENS
        assert np.array_equal(frame.colour, expected.colour)
        assert frame.depth is not None
        assert expected.depth is not None
        off = np.abs(frame.depth - expected.depth)
        assert np.array_equal(np.isnan(frame.depth), np.isnan(expected.depth))
        assert np.nanmax(off) <= (0.000501 if deep == "16UC1" else 0)
    recording.close()


KILLED = """
import genpy, os, rosbag, sys
from sensor_msgs.msg import Image
bag = rosbag.Bag(sys.argv[1], "w")
for number in range(12):
    image = Image(height=240, width=320, encoding="rgb8", step=960)
    image.data = bytes([number]) * (240 * 960)
    image.header.stamp = genpy.Time.from_sec(1600000000 + number / 30.0)
    bag.write("/camera/rgb/image_color", image, image.header.stamp)
bag._file.flush()
os._exit(0)
"""


@pytest.mark.ros
@pytest.mark.usefixtures("rosbag")
def test_a_bag_whose_recorder_was_killed_is_played(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    path = tmp_path / "walk.bag.active"
    system(KILLED, str(path))
    recording = open_recording(f"{path}?loop=no")
    assert isinstance(recording, Recording)
    assert "cut short: its end is missing" in caplog.text
    count = len(recording.rest)
    assert count >= 4
    for number in range(count):
        assert (recording.frame().colour == number).all()
    recording.close()


# --- Foxglove's own mcap -------------------------------------------------------------


@pytest.mark.oracle
def test_mcap_reads_the_file_that_is_written(tmp_path: Path) -> None:
    reading = pytest.importorskip(
        "mcap_ros2.reader", reason="pip install 'kille[senses]'"
    )
    path = tmp_path / "walk.mcap"
    write_mcap(path, frames(4))
    found = list(reading.read_ros2_messages(str(path)))
    assert len(found) == 16
    seen = [it for it in found if it.channel.topic == "/camera/rgb/image_color"]
    deep = [it for it in found if it.channel.topic == "/camera/depth_registered/image"]
    for frame, colour, depth in zip(frames(4), seen, deep, strict=True):
        assert bytes(colour.ros_msg.data) == frame.colour.tobytes()
        assert frame.depth is not None
        assert bytes(depth.ros_msg.data) == frame.depth.tobytes()
        assert colour.ros_msg.encoding == "rgb8"
        assert colour.log_time_ns == pytest.approx(frame.time * 1e9, abs=1000)
