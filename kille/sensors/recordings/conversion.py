"""Convert recordings: the formats that can be written, and what each keeps."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

from kille.scene import Frame
from kille.sensors.kinect.calibration import IDENTITY
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture
from kille.sensors.recordings.bag_writing import write_bag, write_mcap, write_ros2
from kille.sensors.recordings.capture_folders import write_captures
from kille.sensors.recordings.fakenect_writing import FakenectWriter
from kille.sensors.recordings.moments import Moment, after
from kille.sensors.recordings.npz import write_npz
from kille.sensors.recordings.playback import Recording
from kille.sensors.recordings.raw_frames import develop_frame
from kille.sensors.recordings.tum import write_tum
from kille.sensors.sensor import SensorError


@dataclass(frozen=True)
class Format:
    """A format that is written: what it is called, how its files end, what they take.

    Without a suffix it is a folder. `pixel` is how many bytes a pixel of colour and
    depth takes at the most, while it is written.
    """

    title: str
    suffix: str
    pixel: int
    write: Callable[[Path, Recording, Iterable[Moment]], None]


def _of_frames(
    write: Callable[[Path, Iterable[Frame]], None],
) -> Callable[[Path, Recording, Iterable[Moment]], None]:
    """What writes a recording, made of what writes frames."""

    def write_recording(
        path: Path, recording: Recording, moments: Iterable[Moment]
    ) -> None:
        write(path, (replace(it.read(), time=it.time) for it in moments))

    return write_recording


def _fakenect(path: Path, recording: Recording, moments: Iterable[Moment]) -> None:
    lens = recording.rest[0].read().intrinsics or COLOUR_CAMERA
    calibration = recording.reel.calibration or IDENTITY
    began = max(0.0, recording.rest[0].time)
    with FakenectWriter(path, calibration, lens, began) as writer:
        for moment in moments:
            writer.write(_capture(recording.name, moment))


def _capture(name: str, moment: Moment) -> KinectCapture:
    """The readings that were kept, or those that a Kinect would have had."""
    if moment.capture is not None:
        return replace(moment.capture(), time=moment.time)
    return develop_frame(name, replace(moment.read(), time=moment.time))


FORMATS = {
    "fakenect": Format("fakenect folder", "", 5, _fakenect),
    "tum": Format("TUM RGB-D folder", "", 5, _of_frames(write_tum)),
    "captures": Format("capture folder", "", 7, _of_frames(write_captures)),
    "bag": Format("ROS 1 bag", ".bag", 7, _of_frames(write_bag)),
    "mcap": Format("ROS 2 bag in one file", ".mcap", 7, _of_frames(write_mcap)),
    "ros2": Format("ROS 2 bag folder", "", 7, _of_frames(write_ros2)),
    "npz": Format("NumPy archive", ".npz", 14, _of_frames(write_npz)),
}


def format_of(out: Path, named: str | None) -> Format:
    """The format that was named, or the one whose files end as this does.

    SensorError if neither tells.
    """
    if named is not None:
        return FORMATS[named]
    for known in FORMATS.values():
        if known.suffix and known.suffix == out.suffix.lower():
            return known
    raise SensorError(
        f"{out}: say which format by --to, {', '.join(FORMATS)}, or end the name in "
        ".bag, .mcap or .npz"
    )


@dataclass(frozen=True)
class SizeEstimate:
    """What is to be written: frames, and the bytes they take at most."""

    frames: int
    bytes: int


def estimate(recording: Recording, into: Format) -> SizeEstimate:
    """How much there is to write, estimated by the first frame."""
    height, width = recording.rest[0].read().colour.shape[:2]
    frames = len(recording.rest)
    return SizeEstimate(frames, frames * height * width * into.pixel)


def convert(
    recording: Recording, draft: Path, into: Format, tell: Callable[[], None]
) -> None:
    """Write the rest of a recording to a new path; `tell` is called for every frame.

    OSError if it cannot be written, SensorError if it cannot be read or the format has
    no room for it.
    """
    into.write(draft, recording, _tell_each(_make_times_rise(recording.rest), tell))


def _make_times_rise(moments: Iterable[Moment]) -> Iterator[Moment]:
    """The same moments, with times that rise strictly."""
    last = -inf
    for moment in moments:
        last = after(last, moment.time)
        yield replace(moment, time=last)


def _tell_each(moments: Iterable[Moment], tell: Callable[[], None]) -> Iterator[Moment]:
    for moment in moments:
        yield moment
        tell()
