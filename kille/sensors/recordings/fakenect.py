"""fakenect folders: what libfreenect records and plays, the raw readings of a Kinect.

`INDEX.txt` names a file a line, in the order in which things came. A name is
`T-SECONDS-TICKS.EXT`: T is `r` for colour, `d` for depth and `a` for the accelerometer;
SECONDS tell the time of the computer and TICKS that of the device. Pictures have a head
of one line, as PPM and PGM files do, but depth is little-endian: raw numbers of 11
bits. `device.json`, where there is one, holds the device's own calibration. Beside what
libfreenect writes there, it may have `intrinsics`: fx, fy, cx, cy of the colour camera.
See https://github.com/OpenKinect/libfreenect, fakenect/.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour, Frame, Intrinsics
from kille.sensors.kinect.calibration import Calibration, CalibrationError
from kille.sensors.kinect.capture import COLOUR_CAMERA, KinectCapture, frame_of
from kille.sensors.kinect.motor import Tilt
from kille.sensors.recordings.lenses import lens_from
from kille.sensors.recordings.moments import Moment, RecordedMoments, remark_on
from kille.sensors.recordings.pairing import pair_times
from kille.sensors.recordings.playback_options import Options
from kille.sensors.sensor import SensorError
from ttr.safety.inputs import open_file, parse_json, read_bytes, read_text
from ttr.safety.limits import SETTINGS, TABLE, Limit

INDEX, DEVICE = "INDEX.txt", "device.json"
WIDTH, HEIGHT = 640, 480
HEADS = {"r": b"P6 640 480 255\n", "d": b"P5 640 480 65535\n", "a": b""}
BYTES = {"r": WIDTH * HEIGHT * 3, "d": WIDTH * HEIGHT * 2, "a": 12}
"""What is in a file of each kind, behind its head."""

TILT = struct.Struct("<3hbxi")
"""The accelerometer's three counts, twice the angle in degrees, the motor's state."""

_NAME = re.compile(r"([rda])-(\d{1,200}(?:\.\d*)?)-(\d{1,20})\.\w+")
_LONGEST_HEAD = 64

RAW = Limit(max(BYTES.values()) + _LONGEST_HEAD, "bytes")
"""A file of a recording."""


class IndexLine(NamedTuple):
    """A line of the index: what came, when, and the file that holds it."""

    kind: str
    time: float
    ticks: int
    file: str


def is_fakenect(folder: Path) -> bool:
    """Whether the folder has an index as libfreenect writes it, or its beginning."""
    index = folder / INDEX
    if not index.is_file():
        return False
    with open_file(index) as file:
        first = file.readline(200).decode("utf-8", "replace")
    return not first.strip() or parse_index_line(first) is not None


def parse_index_line(line: str) -> IndexLine | None:
    """What a line of the index says, or None.

    >>> parse_index_line("d-1311.250000-4011.pgm")
    IndexLine(kind='d', time=1311.25, ticks=4011, file='d-1311.250000-4011.pgm')
    """
    found = _NAME.fullmatch(line.strip())
    if found is None:
        return None
    return IndexLine(found[1], float(found[2]), int(found[3]), found[0])


def open_fakenect(name: str, folder: Path, options: Options) -> RecordedMoments:
    """The recording in this folder.

    Colour is paired with the depth that is nearest in time, at most 20 ms away. A
    device that is not described has the usual calibration. SensorError if nothing of it
    can be played.
    """
    lines = read_text(folder / INDEX, TABLE, "replace").splitlines()
    told = [(line, parse_index_line(line)) for line in lines if line.strip()]
    if not told:
        raise SensorError(f"{name}: the recording is empty: {INDEX} names no file")
    kept = [event for _, event in told if event and _is_whole(folder, event)]
    whole = {event.file for event in kept}
    lost = [line for line, event in told if event is None or event.file not in whole]
    colour = _in_time(kept, "r")
    if not colour:
        raise SensorError(f"{name}: {INDEX} names no colour picture that is whole")
    device = _device(folder, options)
    depth = _in_time(kept, "d")
    remark = remark_on(lost, len(told))
    if not depth:
        shown = [Moment(it.time, partial(_colour_only, folder, it)) for it in colour]
        return RecordedMoments("fakenect", shown, remark)
    pairs = pair_times([it.time for it in colour], [it.time for it in depth])
    tilts = _tilts(kept)
    moments = [
        _Readings(folder, colour[i], depth[j], tilts.get(depth[j]), device).moment()
        for i, j in pairs
    ]
    if not moments:
        raise SensorError(
            f"{name}: no colour picture has depth of the same time (within 20 ms)"
        )
    return RecordedMoments("fakenect", moments, remark, device.calibration)


@dataclass(frozen=True)
class _Device:
    """What is known of the Kinect that was recorded."""

    calibration: Calibration
    lens: Intrinsics


@dataclass(frozen=True)
class _Readings:
    """The files that make one capture."""

    folder: Path
    colour: IndexLine
    depth: IndexLine
    tilt: IndexLine | None
    device: _Device

    def moment(self) -> Moment:
        """How and when they are read."""
        return Moment(self.depth.time, self.frame, self.capture)

    def frame(self) -> Frame:
        """The frame; SensorError if a file is damaged."""
        frame = frame_of(self.capture(), self.device.calibration)
        return replace(frame, intrinsics=self.device.lens)

    def capture(self) -> KinectCapture:
        """The readings themselves; SensorError if a file is damaged."""
        return KinectCapture(
            self.depth.time,
            _colour(self.folder, self.colour),
            _depth(self.folder, self.depth),
            self.colour.ticks,
            self.depth.ticks,
            None if self.tilt is None else _tilt(self.folder, self.tilt),
        )


def _in_time(events: Sequence[IndexLine], kind: str) -> list[IndexLine]:
    return sorted((it for it in events if it.kind == kind), key=lambda it: it.time)


def _tilts(events: Sequence[IndexLine]) -> Mapping[IndexLine, IndexLine]:
    """What the accelerometer had last said before each depth picture."""
    found: dict[IndexLine, IndexLine] = {}
    last: IndexLine | None = None
    for event in events:
        if event.kind == "a":
            last = event
        elif event.kind == "d" and last is not None:
            found[event] = last
    return found


def _is_whole(folder: Path, event: IndexLine) -> bool:
    try:
        size = (folder / event.file).stat().st_size
    except OSError:
        return False
    head = size - BYTES[event.kind]
    return head == 0 if event.kind == "a" else 0 < head <= _LONGEST_HEAD


def _device(folder: Path, options: Options) -> _Device:
    path = folder / DEVICE
    if not path.is_file():
        return _Device(Calibration.typical(), options.intrinsics or COLOUR_CAMERA)
    text = read_text(path, SETTINGS, "replace")
    try:
        calibration = Calibration.from_json(text)
        numbers = parse_json(text).get("intrinsics")
        told = COLOUR_CAMERA if numbers is None else lens_from([*map(float, numbers)])
    except CalibrationError as error:
        raise SensorError(
            f"{path}: {str(error).removeprefix('device.json ')}"
        ) from error
    except (TypeError, ValueError, OverflowError):
        told = None
    if told is None:
        raise SensorError(f"{path}: `intrinsics` needs fx, fy, cx, cy")
    return _Device(calibration, options.intrinsics or told)


def _colour_only(folder: Path, event: IndexLine) -> Frame:
    return Frame(_colour(folder, event), None, None, event.time, {})


def _colour(folder: Path, event: IndexLine) -> Colour:
    return np.frombuffer(_content(folder, event), np.uint8).reshape(HEIGHT, WIDTH, 3)


def _depth(folder: Path, event: IndexLine) -> NDArray[np.uint16]:
    raw = np.frombuffer(_content(folder, event), "<u2").reshape(HEIGHT, WIDTH)
    if raw.max() > 2047:
        path = folder / event.file
        raise SensorError(
            f"{path}: holds no raw depth of 11 bits; a number in it is {raw.max()}"
        )
    return raw


def _tilt(folder: Path, event: IndexLine) -> Tilt:
    return Tilt(*TILT.unpack(_content(folder, event)))


def _content(folder: Path, event: IndexLine) -> bytes:
    """What is behind the head; SensorError if the file cannot be read or misfits."""
    path = folder / event.file
    try:
        data = read_bytes(path, RAW)
    except OSError as error:
        raise SensorError(f"{path}: cannot be read ({error.strerror})") from error
    head, content = data[: -BYTES[event.kind]], data[-BYTES[event.kind] :]
    if head.split() != HEADS[event.kind].split() or len(content) < BYTES[event.kind]:
        expected = HEADS[event.kind].decode().strip()
        raise SensorError(f"{path}: is damaged; expected `{expected}` and its pixels")
    return content
