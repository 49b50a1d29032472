"""Recordings: what a path is found to be, what its frames are, how it fails."""

from __future__ import annotations

import json
import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.scene import Frame
from kille.sensors.recordings import Gallery, Recording, open_recording
from kille.sensors.sensor import At, SensorError, Stage
from kille.sensors.sources import open_sensor

INTRINSICS = {"fx": 50.0, "fy": 50.0, "cx": 15.5, "cy": 11.5}


def write_picture(path: Path, value: int, size: tuple[int, int] = (24, 32)) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), np.full((*size, 3), (value, 0, 200), np.uint8))


def write_depth(path: Path, value: int, size: tuple[int, int] = (24, 32)) -> None:
    depth = np.full(size, value, np.uint16)
    depth[0, 0] = 0
    cv2.imwrite(str(path), depth)


def write_scene(folder: Path, frames: int = 3) -> Path:
    """A scene of some frames in which a cup and two books are labelled."""
    folder.mkdir(parents=True)
    objects = [
        {"label": 7, "name": "025_red_cup"},
        {"label": 8, "name": "book"},
        {"label": 9, "name": "book"},
    ]
    names = [f"{i:06d}" for i in range(frames)]
    for i, name in enumerate(names):
        write_picture(folder / f"{name}_color.png", 10 * i)
        write_depth(folder / f"{name}_depth.png", 10000 + 1000 * i)
        labels = np.zeros((24, 32), np.uint8)
        labels[5:9, 3:6], labels[5:9, 10:12], labels[5:9, 20:22] = 7, 8, 9
        cv2.imwrite(str(folder / f"{name}_label.png"), labels)
    description = {
        "intrinsics": INTRINSICS,
        "depth_units_per_metre": 10000,
        "frames": dict.fromkeys(names, objects),
    }
    (folder / "scene.json").write_text(json.dumps(description))
    return folder


def edit(folder: Path, **changes: object) -> None:
    path = folder / "scene.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))


def seen(frame: Frame) -> int:
    """Which picture it is: `write_picture` puts that into the blue channel."""
    return int(frame.colour[0, 0, 2])


def complaint(name: Path | str) -> str:
    with pytest.raises(SensorError) as caught:
        open_sensor(str(name))
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_a_scene_gives_its_frames_in_order_and_begins_again(tmp_path: Path) -> None:
    sensor = open_recording(str(write_scene(tmp_path / "scene")))
    assert isinstance(sensor, Recording)
    assert not isinstance(sensor, Stage)
    frames = [sensor.frame() for _ in range(4)]
    assert [seen(frame) for frame in frames] == [0, 10, 20, 0]
    times = [frame.time for frame in frames]
    assert times == sorted(set(times))
    sensor.close()
    sensor.close()


def test_a_frame_has_colour_metres_intrinsics_and_outlines(tmp_path: Path) -> None:
    frame = open_recording(str(write_scene(tmp_path / "scene"))).frame()
    assert frame.colour[3, 3].tolist() == [200, 0, 0]
    assert frame.depth is not None
    assert frame.depth.dtype == np.float32
    assert np.isnan(frame.depth[0, 0])
    assert frame.depth[1, 1] == pytest.approx(1.0)
    assert frame.intrinsics is not None
    assert frame.intrinsics.cx == 15.5
    assert list(frame.outlines) == ["red cup", "book", "book 2"]
    assert np.argwhere(frame.outlines["red cup"]).min(axis=0).tolist() == [5, 3]
    assert not frame.colour.flags.writeable


def test_scenes_in_one_folder_are_stills_to_choose_from(tmp_path: Path) -> None:
    for name, value in (("s1", 10), ("s2", 20)):
        write_picture(tmp_path / f"{name}_color.png", value)
        write_depth(tmp_path / f"{name}_depth.png", 800)
    description = {"intrinsics": INTRINSICS, "depth_units_per_metre": 1000}
    (tmp_path / "index.json").write_text(json.dumps(description))
    gallery = open_recording(str(tmp_path))
    assert isinstance(gallery, Stage)
    assert gallery.things() == ("s1", "s2")
    gallery.show("s2")
    assert [seen(gallery.frame()) for _ in range(3)] == [20, 20, 20]
    one = open_recording(str(tmp_path / "s2"))
    assert not isinstance(one, Stage)
    assert one.frame().depth is not None
    assert seen(one.frame()) == 20


def test_a_folder_of_categories_is_a_stage(tmp_path: Path) -> None:
    for i in (0, 2, 10):
        write_picture(tmp_path / "rubber_duck" / f"duck{i}.png", i)
    write_picture(tmp_path / "cup" / "cup1.png", 99)
    (tmp_path / "README.md").write_text("pictures")
    stage = open_recording(str(tmp_path))
    assert isinstance(stage, Stage)
    assert stage.things() == ("cup", "rubber duck")
    assert seen(stage.frame()) == 99
    shown = []
    for _ in range(4):
        stage.show("Rubber_duck")
        shown.append({seen(stage.frame()) for _ in range(10)})
    assert shown == [{0}, {2}, {10}, {0}]
    assert stage.frame().depth is None
    assert stage.frame().intrinsics is None


def test_a_plain_folder_shows_its_pictures_by_name_or_in_order(tmp_path: Path) -> None:
    folder = tmp_path / "cups"
    for i in (1, 2, 10):
        write_picture(folder / f"cup{i}.png", i)
    gallery = open_recording(str(folder))
    assert isinstance(gallery, Gallery)
    assert gallery.things() == ("cups", "cup1", "cup2", "cup10")
    gallery.show("cup2")
    assert seen(gallery.frame()) == 2
    in_order = []
    for _ in range(3):
        gallery.show("cups")
        in_order.append(seen(gallery.frame()))
    assert in_order == [1, 2, 10]


def test_one_picture_is_a_still(tmp_path: Path) -> None:
    write_picture(tmp_path / "cup.png", 7)
    sensor = open_recording(str(tmp_path / "cup.png"))
    assert [seen(sensor.frame()) for _ in range(3)] == [7, 7, 7]


def test_recorded_things_stay_where_they_are(tmp_path: Path) -> None:
    write_picture(tmp_path / "cup" / "cup1.png", 1)
    stage = open_recording(str(tmp_path))
    assert isinstance(stage, Stage)
    with pytest.raises(SensorError, match="cannot be moved"):
        stage.place("cup", At(0, 0))
    with pytest.raises(SensorError, match="cannot be taken out"):
        stage.remove("cup")
    with pytest.raises(
        SensorError, match="no cap \\(did you mean cup\\?\\); it has cup"
    ):
        stage.show("cap")


def test_a_path_that_is_not_there_suggests_its_neighbours(tmp_path: Path) -> None:
    write_scene(tmp_path / "kitchen")
    text = complaint(tmp_path / "kitchn")
    assert "there is no such" in text
    assert "did you mean kitchen?" in text


def test_a_folder_of_recordings_asks_for_one_of_them(tmp_path: Path) -> None:
    write_scene(tmp_path / "0001")
    write_scene(tmp_path / "0002")
    text = complaint(tmp_path)
    assert "name one of them" in text
    assert f"{tmp_path}/0002" in text


def test_an_empty_folder(tmp_path: Path) -> None:
    assert "the folder is empty" in complaint(tmp_path)


def test_an_unknown_format_says_which_are_known(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("nothing to see")
    assert "unknown format; known are" in complaint(tmp_path)
    assert "unknown format; known are" in complaint(tmp_path / "notes.txt")


@pytest.mark.parametrize("content", [b"", b"no picture at all", b"\x89PNG\r\n\x1a\n"])
def test_a_picture_that_does_not_open_is_named(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "cup1.png").write_bytes(content)
    assert "cup1.png" in complaint(tmp_path)


@pytest.mark.parametrize("place", [20, 30, 60, -20, -6])
def test_a_damaged_picture_is_told_of_in_one_line_only(
    tmp_path: Path, place: int, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "cup1.png"
    write_picture(path, 9)
    damaged = bytearray(path.read_bytes())
    damaged[place] ^= 0x55
    path.write_bytes(damaged)
    assert "cup1.png: this picture does not open; it may be damaged" in complaint(path)
    path.write_bytes(damaged[:place])
    assert "cup1.png: this picture does not open" in complaint(path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("suffix", [".jpg", ".bmp", ".tiff", ".webp"])
def test_a_picture_of_any_kind_cut_short_is_told_of_in_one_line_only(
    tmp_path: Path, suffix: str, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"cup1{suffix}"
    noise = np.random.default_rng(1).integers(0, 256, (99, 99, 3), np.uint8)
    cv2.imwrite(str(path), noise)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    assert f"cup1{suffix}: this picture does not open" in complaint(path)
    assert capfd.readouterr() == ("", "")


def test_a_picture_that_is_missing_is_named(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    (scene / "000001_depth.png").unlink()
    sensor = open_recording(str(scene))
    sensor.frame()
    with pytest.raises(SensorError, match=r"000001_depth\.png: cannot be read"):
        sensor.frame()


def test_depth_of_another_size_says_both_sizes(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    write_depth(scene / "000000_depth.png", 10000, size=(12, 16))
    text = complaint(scene)
    assert "000000_depth.png: is 16x12" in text
    assert "000000_color.png is 32x24" in text


def test_depth_of_another_kind(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    write_picture(scene / "000000_depth.png", 5)
    assert "3 channels of 8" in complaint(scene)


def test_labels_of_another_size(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    cv2.imwrite(str(scene / "000000_label.png"), np.ones((12, 16), np.uint8))
    text = complaint(scene)
    assert "000000_label.png" in text
    assert "16x12" in text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"intrinsics": None}, "`intrinsics` is not what it should be"),
        ({"intrinsics": {"fx": 1}}, "needs the numbers fx, fy, cx and cy"),
        ({"intrinsics": INTRINSICS | {"fx": 0}}, "must be above 0"),
        ({"intrinsics": INTRINSICS | {"fx": float("nan")}}, "must be above 0"),
        ({"intrinsics": INTRINSICS | {"cx": float("inf")}}, "cx and cy finite"),
        ({"intrinsics": INTRINSICS | {"cx": 10**400}}, "needs the numbers"),
        ({"depth_units_per_metre": float("inf")}, "must be above 0"),
        ({"depth_units_per_metre": "mm"}, "`depth_units_per_metre`"),
        ({"frames": {}}, "`frames`"),
        ({"frames": {"000000": [{"name": "cup"}]}}, "whole number as `label`"),
        ({"frames": {"000000": "cup"}}, "whole number as `label`"),
    ],
)
def test_a_broken_description_says_what_is_wrong(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    scene = write_scene(tmp_path / "scene")
    edit(scene, **changes)
    text = complaint(scene)
    assert "scene.json" in text
    assert words in text


@pytest.mark.parametrize("scenes", [[], 3, {"000000": []}], ids=str)
def test_scenes_without_names_are_told(tmp_path: Path, scenes: object) -> None:
    folder = write_scene(tmp_path / "scene")
    (folder / "scene.json").unlink()
    described = {"intrinsics": INTRINSICS, "depth_units_per_metre": 1000}
    (folder / "index.json").write_text(json.dumps(described | {"scenes": scenes}))
    assert "`scenes`" in complaint(folder)


def test_a_thing_that_is_numbered_already_is_not_lost(tmp_path: Path) -> None:
    folder = write_scene(tmp_path / "scene", frames=1)
    names = {7: "book", 8: "book 2", 9: "book"}
    objects = [{"label": label, "name": name} for label, name in names.items()]
    edit(folder, frames={"000000": objects})
    outlines = open_sensor(str(folder)).frame().outlines
    assert list(outlines) == ["book", "book 2", "book 3"]


def test_a_description_that_is_not_json(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    (scene / "scene.json").write_text('{"frames": ')
    assert "is not JSON" in complaint(scene)
    (scene / "scene.json").write_text("[]")
    assert "expected an object" in complaint(scene)


def test_depth_without_a_description(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    (scene / "scene.json").unlink()
    assert "has depth pictures but none of scene.json" in complaint(scene)


@pytest.mark.skipif(os.geteuid() == 0, reason="the superuser may read everything")
def test_no_permission(tmp_path: Path) -> None:
    scene = write_scene(tmp_path / "scene")
    scene.chmod(0)
    try:
        assert "cannot be read" in complaint(scene)
    finally:
        scene.chmod(0o700)


def test_a_path_that_leads_nowhere(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    assert str(loop) in complaint(loop)


def test_no_name() -> None:
    assert "no sensor named" in complaint(" ")


def test_the_real_captures_open(data: Path) -> None:
    still = open_sensor(str(data / "mosd_scenes" / "learn02")).frame()
    assert still.depth is not None
    assert 0.4 < np.nanmedian(still.depth) < 1.5
    assert len(still.outlines) == 2
    moving = open_sensor(str(data / "ycbv_scenes" / "0050"))
    names = {name for _ in range(10) for name in moving.frame().outlines}
    assert {"mustard bottle", "cracker box", "banana", "power drill"} <= names
    pictures = open_sensor(str(data / "sota_kinect"))
    assert isinstance(pictures, Stage)
    assert len(pictures.things()) == 12
