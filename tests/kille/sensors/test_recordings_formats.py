"""Every format that is written reads back; what is damaged is told in one line."""

from __future__ import annotations

import json
import logging
import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from rosbags.convert import convert as rosbags_convert
from rosbags.typesys import Stores, get_typestore

from kille.scene import Frame, Intrinsics
from kille.sensors.recordings import npz
from kille.sensors.recordings.bag_writing import write_mcap
from kille.sensors.recordings.conversion import FORMATS, convert, estimate, format_of
from kille.sensors.recordings.format_detection import open_recording
from kille.sensors.recordings.moments import Moment, RecordedMoments
from kille.sensors.recordings.playback import Recording
from kille.sensors.sensor import SensorError

LENS = Intrinsics(50.0, 51.5, 15.5, 11.25)
SIZED = ("tum", "captures", "bag", "mcap", "ros2", "npz")
"""The formats that hold frames of any size."""

COARSE = ("tum", "captures")
"""Those that round depth, to 0.2 mm."""

BEGAN = 1_700_000_000.25


def frames(count: int = 4, size: tuple[int, int] = (24, 32)) -> Iterator[Frame]:
    """Frames whose times are those of a clock, not even, and no two the same."""
    rng = np.random.default_rng(3)
    for number in range(count):
        depth = rng.uniform(0.4, 8.0, size).astype(np.float32)
        depth[rng.random(size) < 0.1] = np.nan
        colour = rng.integers(0, 256, (*size, 3), np.uint8)
        time = BEGAN + number / 30 + 0.001 * (number % 2)
        yield Frame(colour, depth, LENS, time, {})


def recording(some: Iterator[Frame]) -> Recording:
    """A recording in memory."""
    from kille.sensors.recordings.playback_options import Options

    moments = [Moment(it.time, lambda it=it: it) for it in some]
    return Recording("memory", RecordedMoments("memory", moments), Options())


def written(kind: str, folder: Path, some: Iterator[Frame]) -> Path:
    into = FORMATS[kind]
    out = folder / f"walk{into.suffix}"
    convert(recording(some), out, into, lambda: None)
    return out


def opened(path: Path | str) -> Recording:
    found = open_recording(str(path))
    assert isinstance(found, Recording)
    return found


def near(one: NDArray[np.float32], other: NDArray[np.float32], error: float) -> bool:
    same_gaps = np.array_equal(np.isnan(one), np.isnan(other))
    return same_gaps and bool(np.nanmax(np.abs(one - other), initial=0) <= error)


# --- there and back ------------------------------------------------------------------


@pytest.mark.parametrize("kind", SIZED)
def test_frames_come_back(kind: str, tmp_path: Path) -> None:
    again = opened(written(kind, tmp_path, frames()))
    expected = list(frames())
    assert len(again.rest) == len(expected)
    for moment, frame in zip(again.rest, expected, strict=True):
        found = moment.read()
        assert np.array_equal(found.colour, frame.colour)
        assert found.intrinsics == LENS
        assert found.depth is not None
        assert frame.depth is not None
        assert near(found.depth, frame.depth, 0.000101 if kind in COARSE else 0)
        assert moment.time == pytest.approx(frame.time, abs=1e-6)
        assert not found.colour.flags.writeable
        assert not found.depth.flags.writeable
    again.close()
    again.close()


@pytest.mark.parametrize("kind", SIZED)
def test_any_frame_can_be_gone_to(kind: str, tmp_path: Path) -> None:
    path = written(kind, tmp_path, frames(6))
    again = opened(f"{path}?start=0.1&loop=no")
    expected = [it.colour for it in frames(6)]
    seen = [again.frame().colour for _ in range(3)]
    again.seek(0)
    seen.append(again.frame().colour)
    for found, number in zip(seen, (3, 4, 5, 0), strict=True):
        assert np.array_equal(found, expected[number])
    again.close()


@pytest.mark.parametrize("kind", [*SIZED, "fakenect"])
def test_whole_millimetres_are_kept_to_the_last_bit(kind: str, tmp_path: Path) -> None:
    """What a Kinect says is in millimetres: so any format will do for it."""
    source = next(frames(1, (480, 640)))
    assert source.depth is not None
    if kind == "fakenect":
        once = opened(written(kind, tmp_path, iter([source]))).frame()
    else:
        metres = (np.rint(source.depth * 1000) / np.float32(1000)).astype(np.float32)
        once = replace(source, depth=metres)
    (tmp_path / "again").mkdir()
    again = opened(written(kind, tmp_path / "again", iter([once])))
    found = again.frame()
    assert found.depth is not None
    assert once.depth is not None
    assert near(found.depth, once.depth, 0)
    again.close()


@pytest.mark.parametrize("kind", ["tum", "bag", "mcap", "ros2", "npz"])
def test_colour_alone_comes_back_alone(kind: str, tmp_path: Path) -> None:
    plain = [replace(it, depth=None, intrinsics=None) for it in frames(2)]
    again = opened(written(kind, tmp_path, iter(plain)))
    found = again.frame()
    assert found.depth is None
    assert found.intrinsics is None
    assert np.array_equal(found.colour, plain[0].colour)
    again.close()


def test_captures_keep_outlines(tmp_path: Path) -> None:
    masks = {name: np.zeros((24, 32), bool) for name in ("red cup", "book")}
    masks["red cup"][3:5, 4:9] = True
    masks["book"][10:, :] = True
    some = [replace(it, outlines=masks) for it in frames(2)]
    found = opened(written("captures", tmp_path, iter(some))).frame()
    assert {name: mask.tolist() for name, mask in found.outlines.items()} == {
        name: mask.tolist() for name, mask in masks.items()
    }


def test_captures_without_depth_are_refused(tmp_path: Path) -> None:
    plain = [replace(it, depth=None) for it in frames(1)]
    with pytest.raises(SensorError, match=r"captures have depth, and this .* none"):
        written("captures", tmp_path, iter(plain))


def test_fakenect_is_of_one_size(tmp_path: Path) -> None:
    with pytest.raises(
        SensorError, match="frames are 32x24, and a Kinect's are 640x480"
    ):
        written("fakenect", tmp_path, frames())


@settings(max_examples=25)
@given(
    depth=arrays(np.float32, (2, 3, 4), elements=st.floats(0, 70, width=32)),
    colour=arrays(np.uint8, (2, 3, 4, 3)),
)
def test_archives_keep_all_bits(
    tmp_path_factory: pytest.TempPathFactory,
    depth: NDArray[np.float32],
    colour: NDArray[np.uint8],
) -> None:
    path = tmp_path_factory.mktemp("npz") / "walk.npz"
    rows = zip(colour, depth, strict=True)
    npz.write_npz(path, (Frame(c, d, LENS, i / 7, {}) for i, (c, d) in enumerate(rows)))
    with np.load(path) as archive:
        assert np.array_equal(archive["depth"], depth)
        assert np.array_equal(archive["colour"], colour)
    again = opened(path)
    for number in range(2):
        frame = again.frame()
        assert np.array_equal(frame.colour, colour[number])
        assert frame.depth is not None
        assert np.array_equal(np.nan_to_num(frame.depth), depth[number])


def test_an_archive_may_be_compressed_and_named_as_others_do(tmp_path: Path) -> None:
    shots = list(frames(3))
    mm = np.stack([np.nan_to_num(it.depth * 1000).astype(np.uint16) for it in shots])
    matrix = np.array([[50.0, 0, 15.5], [0, 51.5, 11.25], [0, 0, 1]])
    np.savez_compressed(
        tmp_path / "walk",
        rgb=np.stack([it.colour for it in shots]),
        depth=mm,
        depth_units_per_metre=1000,
        K=matrix,
    )
    again = opened(tmp_path / "walk.npz")
    frame = again.frame()
    assert frame.intrinsics == LENS
    assert frame.depth is not None
    assert np.array_equal(np.nan_to_num(frame.depth), mm[0] / np.float32(1000))
    assert [it.time for it in again.reel.moments] == [0, 1 / 30, 2 / 30]


@pytest.mark.parametrize("kind", ["bag", "mcap", "npz"])
def test_what_is_no_distance_is_no_depth(kind: str, tmp_path: Path) -> None:
    odd = next(frames(1))
    assert odd.depth is not None
    depth = odd.depth.copy()
    depth[:4, 0] = np.inf, -np.inf, -1, 0
    path = written(kind, tmp_path, iter([replace(odd, depth=depth)]))
    again = opened(path)
    found = again.frame().depth
    assert found is not None
    assert np.isnan(found[:4, 0]).all()
    assert np.array_equal(found[4:], odd.depth[4:], equal_nan=True)
    again.close()


@pytest.mark.parametrize("kind", ["bag", "mcap", "npz"])
def test_a_file_is_known_by_its_content(kind: str, tmp_path: Path) -> None:
    path = written(kind, tmp_path, frames(1))
    odd = path.rename(tmp_path / "holiday.jpeg.txt")
    again = opened(odd)
    assert np.array_equal(again.frame().colour, next(frames(1)).colour)
    again.close()


def test_a_picture_is_known_by_its_content(tmp_path: Path) -> None:
    picture = tmp_path / "cup.png"
    cv2.imwrite(str(picture), np.full((4, 5, 3), 9, np.uint8))
    assert opened(picture.rename(tmp_path / "cup")).frame().colour.shape == (4, 5, 3)


# --- what to write -------------------------------------------------------------------


@pytest.mark.parametrize("name", ["a.bag", "a.mcap", "a.npz", "A.NPZ"])
def test_the_end_of_a_name_tells_the_format(name: str) -> None:
    assert format_of(Path(name), None).suffix == Path(name).suffix.lower()


@pytest.mark.parametrize("kind", SIZED)
def test_frames_of_the_same_time_are_all_kept(kind: str, tmp_path: Path) -> None:
    some = [replace(it, time=BEGAN) for it in frames(3)]
    again = opened(written(kind, tmp_path, iter(some)))
    for frame, moment in zip(some, again.rest, strict=True):
        assert np.array_equal(moment.read().colour, frame.colour)
        assert moment.time == pytest.approx(BEGAN, abs=1e-5)
    again.close()


def test_captures_of_the_same_time_are_all_recorded(tmp_path: Path) -> None:
    some = [replace(it, time=BEGAN) for it in frames(3, (480, 640))]
    again = opened(written("fakenect", tmp_path, iter(some)))
    for frame in some:
        assert np.array_equal(again.frame().colour, frame.colour)


@pytest.mark.parametrize("kind", [*SIZED, "fakenect"])
@pytest.mark.parametrize("began", [-5.5, 0.0, 0.7])
def test_times_may_begin_before_all_clocks(
    kind: str, began: float, tmp_path: Path
) -> None:
    rows = enumerate(frames(3, (480, 640)))
    some = [replace(it, time=began + number / 10) for number, it in rows]
    again = opened(written(kind, tmp_path, iter(some)))
    assert again.reel.times == pytest.approx([0, 0.1, 0.2], abs=1e-5)
    again.close()


@pytest.mark.parametrize("kind", ["bag", "mcap", "ros2"])
def test_times_that_no_bag_knows_are_told_of(kind: str, tmp_path: Path) -> None:
    some = [replace(it, time=1e9 * it.time) for it in frames(2)]
    with pytest.raises(SensorError, match="are its times in seconds"):
        written(kind, tmp_path, iter(some))


def test_a_name_may_leave_it_open() -> None:
    with pytest.raises(SensorError, match=r"walk: say which format by --to, fakenect,"):
        format_of(Path("walk"), None)
    assert format_of(Path("walk"), "tum") is FORMATS["tum"]


@pytest.mark.parametrize("kind", SIZED)
def test_no_more_is_written_than_was_estimated(kind: str, tmp_path: Path) -> None:
    some = list(frames(3, (120, 160)))
    told = estimate(recording(iter(some)), FORMATS[kind])
    path = written(kind, tmp_path, iter(some))
    files = path.rglob("*") if path.is_dir() else [path]
    size = sum(it.stat().st_size for it in files if it.is_file())
    assert told.frames == 3
    assert size <= told.bytes + 30_000  # heads and indices


# --- TUM -----------------------------------------------------------------------------


def complaint(name: Path | str) -> str:
    with pytest.raises(SensorError) as caught:
        open_recording(str(name)).frame()
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_tum_lists_may_have_comments_and_other_times(tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(3))
    rows = (folder / "depth.txt").read_text().splitlines()
    rows = [it for it in rows if not it.startswith("#")]
    later = [f"{float(it.split()[0]) + 0.009:.6f} {it.split()[1]}" for it in rows]
    (folder / "depth.txt").write_text("\n".join(["# depth", "", *reversed(later)]))
    assert len(opened(folder).rest) == 3
    never = [f"{float(it.split()[0]) + 90:.6f} {it.split()[1]}" for it in rows]
    (folder / "depth.txt").write_text("\n".join(never))
    assert "no colour picture has depth of the same time" in complaint(folder)


def test_tum_lists_may_have_tabs(tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(2))
    for name in ("rgb.txt", "depth.txt"):
        text = (folder / name).read_text()
        (folder / name).write_text(
            text.replace(" rgb/", "\trgb/").replace(" depth/", "\t  depth/")
        )
    assert len(opened(folder).rest) == 2


def test_tum_at_its_usual_size_needs_no_calibration(tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(1, (480, 640)))
    (folder / "calibration.txt").unlink()
    assert opened(folder).frame().intrinsics == Intrinsics(525, 525, 319.5, 239.5)


def test_tum_of_another_size_asks_for_a_calibration(tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(1))
    (folder / "calibration.txt").unlink()
    text = complaint(folder)
    assert "depth without calibration: pictures of 32x24 need calibration.txt" in text
    told = opened(f"{folder}?intrinsics=50,51.5,15.5,11.25")
    assert told.frame().intrinsics == LENS
    (folder / "calibration.txt").write_text("fx fy cx cy")
    assert "expected `fx fy cx cy`, four numbers above 0" in complaint(folder)


def test_tum_with_a_line_that_is_none(tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(1))
    with (folder / "depth.txt").open("a") as file:
        file.write("yesterday depth/1.png\n")
    assert "depth.txt, line 4: expected `SECONDS PATH`" in complaint(folder)


def test_tum_cut_short_plays_what_is_whole(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    folder = written("tum", tmp_path, frames(4))
    pictures = sorted((folder / "rgb").iterdir())
    os.truncate(pictures[1], 100)
    pictures[3].unlink()
    with caplog.at_level(logging.WARNING):
        again = opened(folder)
    (told,) = caplog.messages
    assert "cut short: 2 of 8 files are missing or not whole (rgb/" in told
    assert len(again.rest) == 2
    for path in (folder / "rgb").iterdir():
        path.unlink()
    assert "none of the pictures that rgb.txt names is there and whole" in complaint(
        folder
    )


@pytest.mark.parametrize("line", [b"1.5 a\0b.png", b"\xff\xfe 1.png", b"\0\0\0"])
def test_tum_lists_of_anything_are_told_of(line: bytes, tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(1))
    with (folder / "rgb.txt").open("ab") as file:
        file.write(line)
    assert "rgb.txt, line 4: expected `SECONDS PATH`, found" in complaint(folder)


def test_a_calibration_of_anything_is_told_of(tmp_path: Path) -> None:
    folder = written("tum", tmp_path, frames(1))
    (folder / "calibration.txt").write_bytes(b"\xff\0 1 2 3")
    assert "expected `fx fy cx cy`" in complaint(folder)


def test_tum_that_is_empty(tmp_path: Path) -> None:
    (tmp_path / "rgb.txt").write_text("# nothing\n")
    assert "rgb.txt names no picture" in complaint(tmp_path)


# --- bags ----------------------------------------------------------------------------


def stored(storage: str, source: Path, out: Path) -> Path:
    """A bag of ROS 2 as rosbags makes it of another bag."""
    types = get_typestore(Stores.ROS2_HUMBLE)
    rosbags_convert([source], out, storage, 8, None, "", None, types, [], [], [], [])
    return out


@pytest.mark.parametrize("described", [True, False], ids=["described", "not described"])
@pytest.mark.parametrize("kind", ["bag", "mcap", "ros2", "sqlite3"])
@pytest.mark.parametrize("share", [0.55, 0.85, 0.999])
def test_a_bag_cut_short_plays_what_is_whole(
    kind: str,
    share: float,
    described: bool,
    tmp_path: Path,
    caplog: pytest.LogCaptureFixture,
) -> None:
    some = list(frames(12, (240, 320)))
    if kind == "sqlite3":
        source = written("bag", tmp_path, iter(some))
        path = stored(kind, source, tmp_path / "walk")
    else:
        path = written(kind, tmp_path, iter(some))
    (file,) = [*path.glob("*.mcap"), *path.glob("*.db3")] if path.is_dir() else [path]
    os.truncate(file, int(share * file.stat().st_size))
    if path.is_dir() and not described:
        (path / "metadata.yaml").unlink()
    with caplog.at_level(logging.WARNING):
        again = opened(f"{path}?loop=no")
    (told,) = caplog.messages
    assert "cut short: its end is missing; what is whole of it is played" in told
    count = len(again.rest)
    assert 0 < count <= 12
    for frame in some[:count]:
        found = again.frame()
        assert np.array_equal(found.colour, frame.colour)
        assert found.depth is not None
        assert frame.depth is not None
        assert np.array_equal(found.depth, frame.depth, equal_nan=True)
    again.close()


def test_messages_of_a_bag_cut_short_may_be_out_of_order(tmp_path: Path) -> None:
    some = list(frames(5, (240, 320)))
    write_mcap(tmp_path / "walk.mcap", some[::-1])
    size = (tmp_path / "walk.mcap").stat().st_size
    os.truncate(tmp_path / "walk.mcap", size - 100)
    again = opened(tmp_path / "walk.mcap")
    for frame in some:
        assert np.array_equal(again.frame().colour, frame.colour)
    again.close()


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_a_bag_cut_to_nothing_is_told_of(kind: str, tmp_path: Path) -> None:
    path = written(kind, tmp_path, frames(2))
    for size in (14, 40, 400):
        os.truncate(path, size)
        assert complaint(path)


@pytest.mark.parametrize(
    ("storage", "compress", "mode"),
    [
        ("sqlite3", None, ""),
        ("sqlite3", "zstd", "message"),
        ("sqlite3", "zstd", "file"),
        ("mcap", "zstd", "storage"),
    ],
)
def test_bags_that_rosbags_converts_are_played(
    storage: str, compress: str | None, mode: str, tmp_path: Path
) -> None:
    source, out = written("bag", tmp_path, frames(3)), tmp_path / "again"
    types = get_typestore(Stores.ROS2_HUMBLE)
    how = (storage, 8, compress, mode, None, types)
    rosbags_convert([source], out, *how, [], [], [], [])
    again = opened(out)
    for frame in frames(3):
        found = again.frame()
        assert np.array_equal(found.colour, frame.colour)
        assert found.depth is not None
        assert frame.depth is not None
        assert np.array_equal(found.depth, frame.depth, equal_nan=True)
    again.close()


@pytest.mark.parametrize(
    ("old", "new"),
    [("message_count: 2", "message_count: x2"), ("name: /cam", "name: [")],
)
def test_a_description_of_a_bag_that_is_wrong(
    old: str, new: str, tmp_path: Path
) -> None:
    path = written("ros2", tmp_path, frames(2)) / "metadata.yaml"
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))
    assert "this bag cannot be read" in complaint(path.parent)


def test_a_database_of_its_own_is_played(tmp_path: Path) -> None:
    out = stored("sqlite3", written("bag", tmp_path, frames(3)), tmp_path / "again")
    (file,) = out.glob("*.db3")
    again = opened(file.rename(tmp_path / "data"))
    assert np.array_equal(again.frame().colour, next(frames(1)).colour)
    again.close()


# --- captures ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("times", "told"),
    [
        ({}, "`times` needs the seconds of each"),
        ({"000000": 1, "000001": "x"}, "`times` needs the seconds of each"),
        ({"000000": 1, "000001": 1}, "must rise from frame to frame"),
        ([1, 2], "`times` needs the seconds of each"),
    ],
    ids=str,
)
def test_times_that_are_wrong(tmp_path: Path, times: object, told: str) -> None:
    folder = written("captures", tmp_path, frames(2))
    path = folder / "scene.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"times": times}))
    assert told in complaint(folder)


# --- archives ------------------------------------------------------------------------


def archive(tmp_path: Path, **changes: NDArray[np.generic] | None) -> Path:
    shots = list(frames(2))
    usual = {
        "colour": np.stack([it.colour for it in shots]),
        "depth": np.stack([it.depth for it in shots]),
        "intrinsics": np.array([50.0, 51.5, 15.5, 11.25]),
    }
    kept = {name: it for name, it in (usual | changes).items() if it is not None}
    np.savez(tmp_path / "walk.npz", **kept)
    return tmp_path / "walk.npz"


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"colour": None}, "has no array `colour`; it has depth, intrinsics"),
        ({"colour": np.zeros((2, 24, 32))}, r"`colour` is (2, 24, 32) of float64"),
        ({"colour": np.zeros((0, 2, 2, 3), np.uint8)}, "`colour` holds no frame"),
        ({"depth": np.zeros((2, 5, 5))}, "expected numbers for each pixel"),
        (
            {"depth": np.ones((2, 24, 32), np.uint16)},
            "depth without calibration: whole",
        ),
        ({"intrinsics": None}, "depth without calibration: `intrinsics` needs"),
        ({"intrinsics": np.ones(3)}, "depth without calibration: `intrinsics` needs"),
        ({"times": np.zeros(2)}, "expected 2 seconds that rise"),
        ({"times": np.array(["a", "b"])}, "expected 2 seconds that rise"),
        ({"colour": np.array([{}, []], object)}, "this archive does not open"),
    ],
)
def test_an_archive_that_misfits(
    tmp_path: Path, changes: dict[str, NDArray[np.generic] | None], told: str
) -> None:
    assert told in complaint(archive(tmp_path, **changes))


def test_an_archive_cut_short(tmp_path: Path) -> None:
    path = archive(tmp_path)
    os.truncate(path, path.stat().st_size // 2)
    assert "this archive does not open; it may be cut short" in complaint(path)


def test_a_damaged_archive_plays_or_is_told_of(tmp_path: Path) -> None:
    shots = np.stack([it.colour for it in frames(20, (48, 64))])
    rng = np.random.default_rng(4)
    for write in (np.savez, np.savez_compressed):
        path = tmp_path / "walk.npz"
        write(path, colour=shots, times=np.arange(20))
        whole = path.read_bytes()
        for place in [6, 8, *range(40, 90), *rng.integers(0, len(whole), 50)]:
            damaged = bytearray(whole)
            damaged[place] ^= 0x55
            path.write_bytes(damaged)
            with suppress(SensorError):
                opened(path).close()


# --- what is nothing -----------------------------------------------------------------


def test_an_empty_file(tmp_path: Path) -> None:
    (tmp_path / "walk.bag").touch()
    assert "the file is empty; expected a folder of" in complaint(tmp_path / "walk.bag")


@pytest.mark.parametrize("kind", ["fakenect", "tum", "ros2"])
def test_a_folder_of_recordings_of_any_format(kind: str, tmp_path: Path) -> None:
    written(kind, tmp_path, frames(1, (480, 640)))
    text = complaint(tmp_path)
    assert f"holds recordings, name one of them: {tmp_path}/walk" in text


@pytest.mark.parametrize("kind", ["bag", "mcap", "npz"])
@pytest.mark.parametrize("count", [1, 2])
def test_a_folder_of_files_of_any_format(kind: str, count: int, tmp_path: Path) -> None:
    for number in range(count):
        into = FORMATS[kind]
        out = tmp_path / f"walk{number}{into.suffix}"
        convert(recording(frames(1)), out, into, lambda: None)
    if (kind, count) == ("mcap", 1):
        again = opened(tmp_path)
        assert again.frame().depth is not None
        again.close()
        return
    assert f"name one of them: {tmp_path}/walk0.{kind}" in complaint(tmp_path)


def test_stills_know_no_time(tmp_path: Path) -> None:
    for name in ("cup", "car"):
        cv2.imwrite(str(tmp_path / f"{name}.png"), np.zeros((4, 5, 3), np.uint8))
    assert "holds stills, which know no time" in complaint(f"{tmp_path}?speed=1")


def test_a_path_that_is_not_there_with_options(tmp_path: Path) -> None:
    assert "there is no such" in complaint(f"{tmp_path / 'walk'}?speed=1")
