"""NumPy archives: `colour`, `depth`, `intrinsics`, `times`, an entry for each frame.

`colour` (n, H, W, 3) uint8 RGB; `depth` (n, H, W), floating metres with NaN or 0 for no
reading, or whole units with `depth_units_per_metre`; `intrinsics` fx, fy, cx, cy or the
matrix (3, 3); `times` (n,) in seconds, thirty frames a second without it.
"""

from __future__ import annotations

import struct
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from math import isfinite
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from kille.safety.archives import (
    DamagedArchiveError,
    open_zip,
    read_array,
    read_head,
    report_damage,
)
from kille.scene import Frame, Intrinsics
from kille.sensors.captures import RATE
from kille.sensors.pictures import clean_depth, freeze
from kille.sensors.recordings.lenses import lens_from
from kille.sensors.recordings.moments import Moment, RecordedMoments
from kille.sensors.recordings.playback_options import Options
from kille.sensors.sensor import SensorError
from ttr.safety.inputs import open_file
from ttr.safety.limits import ARRAYS, PICTURE

_ALSO = {"color": "colour", "rgb": "colour", "time": "times", "K": "intrinsics"}


def is_npz(path: Path) -> bool:
    """Whether it is an archive of arrays, or begins as one and is cut short."""
    with open_file(path) as file:
        head = file.read(512)
    return head.startswith(b"PK\x03\x04") and b".npy" in head


def open_npz(name: str, path: Path, options: Options) -> RecordedMoments:
    """The recording in this file; SensorError if an array is missing or misfits."""
    try:
        arrays = _arrays(path)
    except DamagedArchiveError as error:
        raise SensorError(
            f"{name}: this archive does not open; it may be cut short ({error})"
        ) from error
    colour = _colour(name, arrays)
    read = partial(_colour_only, colour)
    if "depth" in arrays:
        depth = _depth(name, arrays, colour)
        lens = options.intrinsics or _lens(name, arrays)
        read = partial(_with_depth, colour, depth, _unit(name, arrays), lens)
    times = _times(name, arrays, len(colour))
    moments = [
        Moment(seconds, partial(read, number, seconds))
        for number, seconds in enumerate(times)
    ]
    return RecordedMoments("npz", moments)


def _colour_only(colour: NDArray[Any], number: int, seconds: float) -> Frame:
    return Frame(freeze(np.array(colour[number])), None, None, seconds, {})


def _with_depth(
    colour: NDArray[Any],
    depth: NDArray[Any],
    unit: float,
    lens: Intrinsics,
    number: int,
    seconds: float,
) -> Frame:
    metres = clean_depth(np.asarray(depth[number], np.float32) / np.float32(unit))
    return Frame(freeze(np.array(colour[number])), metres, lens, seconds, {})


def _colour(name: str, arrays: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    colour = arrays.get("colour")
    if colour is None:
        raise SensorError(f"{name}: has no array `colour`; it has {', '.join(arrays)}")
    if colour.ndim != 4 or colour.shape[3] != 3 or colour.dtype != np.uint8:
        raise SensorError(
            f"{name}: `colour` is {_shape_text(colour)}, expected (n, H, W, 3) of uint8"
        )
    if not colour.size:
        raise SensorError(f"{name}: `colour` holds no frame")
    try:
        PICTURE.check(colour.shape[1] * colour.shape[2])
    except OSError as error:
        raise SensorError(f"{name}: `colour`: {error.strerror}") from error
    return colour


def _depth(
    name: str, arrays: Mapping[str, NDArray[Any]], colour: NDArray[Any]
) -> NDArray[Any]:
    depth = arrays["depth"]
    if depth.shape != colour.shape[:3] or depth.dtype.kind not in "uif":
        raise SensorError(
            f"{name}: `depth` is {_shape_text(depth)}, expected numbers for each pixel "
            f"of `colour`, {colour.shape[:3]}"
        )
    return depth


def _unit(name: str, arrays: Mapping[str, NDArray[Any]]) -> float:
    """What a metre is in the numbers of `depth`."""
    told = arrays.get("depth_units_per_metre")
    if told is None and arrays["depth"].dtype.kind == "f":
        return 1.0
    if told is None or told.size != 1 or not 0 < float(told.reshape(())) < np.inf:
        raise SensorError(
            f"{name}: depth without calibration: whole numbers need "
            "`depth_units_per_metre`, one number above 0, such as 1000"
        )
    return float(told.reshape(()))


def _lens(name: str, arrays: Mapping[str, NDArray[Any]]) -> Intrinsics:
    told = arrays.get("intrinsics", np.empty(0))
    if told.shape == (3, 3):
        told = told[[0, 1, 0, 1], [0, 1, 2, 2]]
    if told.shape == (4,) and told.dtype.kind in "uif":
        lens = lens_from([float(it) for it in told])
        if lens is not None:
            return lens
    raise SensorError(
        f"{name}: depth without calibration: `intrinsics` needs fx, fy, cx and cy or "
        "the matrix (3, 3); or write PATH?intrinsics=fx,fy,cx,cy"
    )


def _times(name: str, arrays: Mapping[str, NDArray[Any]], count: int) -> list[float]:
    times = arrays.get("times", np.arange(count) / RATE)
    if times.shape == (count,) and times.dtype.kind in "uif":
        row = [float(it) for it in times]
        if all(map(isfinite, row)) and all(a < b for a, b in pairwise(row)):
            return row
    raise SensorError(
        f"{name}: `times` is {_shape_text(times)}, expected {count} seconds that rise"
    )


def _shape_text(array: NDArray[Any]) -> str:
    return f"{array.shape} of {array.dtype}"


def _arrays(path: Path) -> dict[str, NDArray[Any]]:
    """The arrays that are asked for, by name; those not compressed stay on disk."""
    with open_zip(path) as archive:
        entries = [it for it in archive.infolist() if it.filename.endswith(".npy")]
        named = {_name(it): it for it in entries}
        held = [it for it in named.values() if not _stays(it)]
        try:
            ARRAYS.check(sum(it.file_size for it in held))
        except OSError as error:
            way_out = "np.savez, which does not compress, leaves them on disk"
            raise SensorError(f"{path}: {error.strerror}; {way_out}") from error
        return {
            name: _map(path, archive, entry)
            if _stays(entry)
            else read_array(archive, entry)
            for name, entry in named.items()
        }


def _name(entry: zipfile.ZipInfo) -> str:
    name = entry.filename.removesuffix(".npy")
    return _ALSO.get(name, name)


def _stays(entry: zipfile.ZipInfo) -> bool:
    """Whether the array stays on disk, of which only what is asked for is read."""
    return entry.compress_type == zipfile.ZIP_STORED and entry.file_size >= 65536


def _map(path: Path, archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> NDArray[Any]:
    with report_damage():
        with archive.open(entry) as file:
            head = read_head(file)
            skipped = file.tell()
        return np.memmap(
            path,
            head.kind,
            "r",
            _start(path, entry) + skipped,
            head.shape,
            order="F" if head.by_columns else "C",
        )


def _start(path: Path, entry: zipfile.ZipInfo) -> int:
    """Where the bytes of an entry begin, behind the head that it has in the archive."""
    with open_file(path) as file:
        file.seek(entry.header_offset + 26)
        name, extra = struct.unpack("<HH", file.read(4))
    return int(entry.header_offset + 30 + name + extra)


def write_npz(path: Path, frames: Iterable[Frame]) -> None:
    """Write a recording, bit for bit, into this new file; OSError if it cannot be.

    Outlines are not kept. SensorError if pictures have several sizes, or only some have
    depth.
    """
    with TemporaryFile(dir=path.parent) as colour, TemporaryFile(dir=path.parent) as z:
        shapes, times, lens = set(), [], None
        for frame in frames:
            colour.write(np.ascontiguousarray(frame.colour).data)
            times.append(frame.time)
            lens = frame.intrinsics
            deep = frame.depth is not None
            shapes.add((frame.colour.shape[:2], deep))
            if frame.depth is not None:
                z.write(np.ascontiguousarray(frame.depth, np.float32).data)
        if len(shapes) != 1:
            raise SensorError("the frames have several sizes, or partly depth")
        ((height, width), deep), count = shapes.pop(), len(times)
        with zipfile.ZipFile(path, "w") as archive:
            shape = (count, height, width)
            _add_rows(archive, "colour", colour, "|u1", (*shape, 3))
            _add(archive, "times", np.array(times))
            if deep and lens is not None:
                _add_rows(archive, "depth", z, "<f4", shape)
                row = np.array([lens.fx, lens.fy, lens.cx, lens.cy])
                _add(archive, "intrinsics", row)


def _add(archive: zipfile.ZipFile, name: str, array: NDArray[Any]) -> None:
    with _entry(archive, name) as entry:
        np.lib.format.write_array(entry, array, allow_pickle=False)


def _add_rows(
    archive: zipfile.ZipFile,
    name: str,
    rows: IO[bytes],
    kind: str,
    shape: tuple[int, ...],
) -> None:
    head = {"descr": kind, "fortran_order": False, "shape": shape}
    rows.seek(0)
    with _entry(archive, name) as entry:
        np.lib.format.write_array_header_1_0(entry, head)
        while block := rows.read(1 << 20):
            entry.write(block)


@contextmanager
def _entry(archive: zipfile.ZipFile, name: str) -> Iterator[IO[bytes]]:
    with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
        yield entry
