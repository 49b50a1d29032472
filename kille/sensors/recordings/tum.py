"""TUM RGB-D folders: `rgb.txt` and `depth.txt` say when each picture was taken.

A line is `SECONDS PATH`, with `#` before comments. Depth is registered to colour, 5000
units a metre, 0 for no reading. The format says nothing of the lens: `calibration.txt`
may hold `fx fy cx cy`; without it the lens is the one that its authors name for 640x480
pictures. See https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite
from pathlib import Path
from typing import NamedTuple

from kille.scene import Frame, Intrinsics
from kille.sensors.captures import Geometry, Shot
from kille.sensors.pictures import (
    depth_picture,
    read_colour,
    whole_picture,
    write_colour,
    write_picture,
)
from kille.sensors.recordings.lenses import lens_from
from kille.sensors.recordings.moments import Moment, RecordedMoments, remark_on
from kille.sensors.recordings.pairing import pair_times
from kille.sensors.recordings.playback_options import Options
from kille.sensors.sensor import SensorError
from ttr.safety.inputs import open_file, read_text
from ttr.safety.limits import SETTINGS, TABLE

UNITS_PER_METRE = 5000.0
USUAL = Intrinsics(fx=525.0, fy=525.0, cx=319.5, cy=239.5)
CALIBRATION = "calibration.txt"


class ListedPicture(NamedTuple):
    """A line of a list: when the picture was taken, and where it is in the folder."""

    time: float
    path: str


def is_tum(folder: Path) -> bool:
    """Whether the folder holds a recording as TUM's are, or its beginning."""
    listed = folder / "rgb.txt"
    if not listed.is_file():
        return False
    with open_file(listed) as file:
        lines = file.read(4096).decode("utf-8", "replace").splitlines()
    first = next((it for it in lines if it.strip() and it[0] != "#"), "0")
    return _number(first.split()[0]) is not None


def open_tum(name: str, folder: Path, options: Options) -> RecordedMoments:
    """The recording in this folder.

    Colour is paired with the depth that is nearest in time, at most 20 ms away; without
    `depth.txt` there is only colour. SensorError if nothing of it can be played.
    """
    colour = _read_list(folder / "rgb.txt")
    depth = (
        _read_list(folder / "depth.txt") if (folder / "depth.txt").is_file() else None
    )
    if not colour:
        raise SensorError(f"{name}: the recording is empty: rgb.txt names no picture")
    entries = [*colour, *(depth or ())]
    lost = [it.path for it in entries if not whole_picture(folder / it.path)]
    gone = set(lost)
    colour = [it for it in colour if it.path not in gone]
    if not colour:
        raise SensorError(
            f"{name}: none of the pictures that rgb.txt names is there and whole"
        )
    if depth is None:
        shots = [Shot(it.path, folder / it.path, time=it.time) for it in colour]
    else:
        kept = [it for it in depth if it.path not in gone]
        shots = _with_depth(name, folder, colour, kept, options)
    moments = [Moment(shot.time, shot.read) for shot in shots]
    return RecordedMoments("TUM", moments, remark_on(lost, len(entries)))


def _with_depth(
    name: str,
    folder: Path,
    colour: Sequence[ListedPicture],
    depth: Sequence[ListedPicture],
    options: Options,
) -> list[Shot]:
    pairs = list(pair_times([it.time for it in colour], [it.time for it in depth]))
    if not pairs:
        raise SensorError(
            f"{name}: no colour picture has depth of the same time (within 20 ms)"
        )
    lens = options.intrinsics or _lens(name, folder, folder / colour[0].path)
    geometry = Geometry(lens, UNITS_PER_METRE)
    return [
        Shot(
            name=colour[i].path,
            colour=folder / colour[i].path,
            depth=folder / depth[j].path,
            geometry=geometry,
            time=colour[i].time,
        )
        for i, j in pairs
    ]


def _read_list(path: Path) -> list[ListedPicture]:
    """The entries of a list in order of time; SensorError for a line that is none."""
    entries = []
    text = read_text(path, TABLE, "replace")
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip() or line.startswith("#"):
            continue
        seconds, *rest = line.split(maxsplit=1)
        time = _number(seconds)
        if time is None or not rest or "\0" in line:
            raise SensorError(
                f"{path}, line {number}: expected `SECONDS PATH`, found {line[:40]!r}"
            )
        entries.append(ListedPicture(time, rest[0].strip()))
    return sorted(dict.fromkeys(entries))


def _number(text: str) -> float | None:
    try:
        number = float(text)
    except ValueError:
        return None
    return number if isfinite(number) else None


def _lens(name: str, folder: Path, picture: Path) -> Intrinsics:
    told = folder / CALIBRATION
    if told.is_file():
        words = read_text(told, SETTINGS, "replace").split()[:4]
        lens = lens_from([it for word in words if (it := _number(word)) is not None])
        if lens is None:
            raise SensorError(f"{told}: expected `fx fy cx cy`, four numbers above 0")
        return lens
    height, width = read_colour(picture).shape[:2]
    if (width, height) == (640, 480):
        return USUAL
    raise SensorError(
        f"{name}: depth without calibration: pictures of {width}x{height} need "
        f"{CALIBRATION} with `fx fy cx cy`, or PATH?intrinsics=fx,fy,cx,cy"
    )


def write_tum(folder: Path, frames: Iterable[Frame]) -> None:
    """Write a recording into this new folder.

    Depth is rounded to 0.2 mm, and lost beyond 13.1 m. OSError if it cannot be written.
    """
    folder.mkdir()
    lists: dict[str, list[str]] = {"rgb": [], "depth": []}
    lens: Intrinsics | None = None
    for frame in frames:
        picture = f"{frame.time:.6f}.png"
        (folder / "rgb").mkdir(exist_ok=True)
        write_colour(folder / "rgb" / picture, frame.colour)
        lists["rgb"].append(f"{frame.time:.6f} rgb/{picture}\n")
        if frame.depth is None:
            continue
        lens = frame.intrinsics
        (folder / "depth").mkdir(exist_ok=True)
        units = depth_picture(frame.depth, UNITS_PER_METRE)
        write_picture(folder / "depth" / picture, units)
        lists["depth"].append(f"{frame.time:.6f} depth/{picture}\n")
    for kind, lines in lists.items():
        head = f"# {kind} pictures\n# timestamp filename\n"
        if lines:
            (folder / f"{kind}.txt").write_text(head + "".join(lines))
    if lens is not None:
        told = f"{lens.fx} {lens.fy} {lens.cx} {lens.cy}\n"
        (folder / CALIBRATION).write_text(told)
