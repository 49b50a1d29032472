"""Meshes from OBJ files."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.sensors.sensor import At, SensorError
from kille.sensors.synthetic import open_synthetic
from kille.sensors.synthetic.obj_files import find_meshes, load_scan

PLATE = """mtllib plate.mtl
v -0.1 0 0
v 0.1 0 0
v 0.1 0 0.2
v -0.1 0 0.2
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f {face}
"""


def write_mesh(folder: Path, text: str, name: str = "plate.obj") -> Path:
    """A standing plate, red above and blue below, white at its upper left."""
    folder.mkdir(parents=True, exist_ok=True)
    picture = np.zeros((40, 40, 3), np.uint8)
    picture[:20, :, 2], picture[20:, :, 0], picture[:12, :12] = 255, 255, 255
    cv2.imwrite(str(folder / "plate.png"), picture)
    (folder / "plate.mtl").write_text("newmtl m\nmap_Kd plate.png\n")
    (folder / name).write_text(text)
    return folder / name


def plate(folder: Path, face: str = "1/1 2/2 3/3 4/4", name: str = "plate.obj") -> Path:
    return write_mesh(folder, PLATE.format(face=face), name)


def test_a_plate_is_seen_upright_and_not_mirrored(tmp_path: Path) -> None:
    sensor = open_synthetic("synthetic:empty?faults=none")
    sensor.place(str(plate(tmp_path)), At(0, 0))
    frame = sensor.frame()
    rows, columns = np.nonzero(frame.outlines["plate"])
    upper, lower = rows.min() + 12, rows.max() - 12
    assert frame.colour[upper, columns.max() - 12].argmax() == 0
    assert frame.colour[lower, columns.max() - 12].argmax() == 2
    assert frame.colour[upper, columns.min() + 12].min() > 150


def test_indices_may_count_from_the_end(tmp_path: Path) -> None:
    forward = load_scan(plate(tmp_path / "a"))
    backward = load_scan(plate(tmp_path / "b", "-4/-4 -3/-3 -2/-2 -1/-1"))
    assert np.array_equal(forward.vertices, backward.vertices)
    assert np.array_equal(forward.uv, backward.uv)
    assert np.array_equal(forward.triangles, backward.triangles)


def test_meshes_are_called_by_their_folder(tmp_path: Path) -> None:
    plate(tmp_path / "blue_jug", name="textured.obj")
    plate(tmp_path / "dish")
    assert list(find_meshes(tmp_path)) == ["blue jug", "plate"]
    assert list(find_meshes(tmp_path / "blue_jug")) == ["blue jug"]
    sensor = open_synthetic(f"synthetic:empty?meshes={tmp_path}")
    assert sensor.things()[-2:] == ("blue jug", "plate")
    sensor.show("the Blue Jug")
    assert set(sensor.frame().outlines) == {"blue jug"}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (PLATE.format(face="1/1 2/2 9/3"), "names a vertex that is not there"),
        (PLATE.format(face="1/1 2/2 0/3"), "names a vertex that is not there"),
        (PLATE.format(face=f"1/1 2/2 {'9' * 30}/3"), "position/texture"),
        (PLATE.format(face="1 2 3"), "its faces have no texture"),
        (PLATE.format(face="a/b c/d e/f"), "position/texture"),
        (PLATE.format(face="1/1 2/2"), "no `f` lines"),
        (PLATE.format(face="1/1 2/2 3/3").replace("0.2", "x"), "`v` line"),
        (PLATE.format(face="1/1 2/2 3/3").replace("0.2", "200"), "read in metres"),
        ("mtllib plate.mtl\n", "no usable `v`"),
        (PLATE.format(face="1/1 2/2 3/3").replace("mtllib", "#"), "names no texture"),
        (PLATE.format(face="1/1 2/2 3/3").replace("plate.mtl", "\t"), "no texture"),
        (
            PLATE.format(face="1/1 2/2 3/3").replace("plate.mtl", "x.mtl"),
            "cannot be read",
        ),
    ],
)
def test_a_broken_mesh_is_one_clear_line(tmp_path: Path, text: str, words: str) -> None:
    file = write_mesh(tmp_path, text)
    with pytest.raises(SensorError, match=words) as caught:
        load_scan(file)
    assert "\n" not in str(caught.value)
    assert str(file.parent) in str(caught.value)


def test_a_missing_texture_is_named(tmp_path: Path) -> None:
    file = plate(tmp_path)
    (tmp_path / "plate.png").unlink()
    with pytest.raises(SensorError, match=r"plate\.png: the mesh's texture"):
        load_scan(file)


def test_a_place_without_meshes_is_said(tmp_path: Path) -> None:
    with pytest.raises(SensorError, match="no OBJ mesh"):
        find_meshes(tmp_path)
    (tmp_path / "notes.txt").write_text("no mesh")
    with pytest.raises(SensorError, match="no OBJ mesh"):
        find_meshes(tmp_path / "notes.txt")


def test_several_meshes_are_not_one(tmp_path: Path) -> None:
    plate(tmp_path / "a", name="textured.obj")
    plate(tmp_path / "b", name="textured.obj")
    sensor = open_synthetic("synthetic:empty")
    with pytest.raises(SensorError, match="holds 2 meshes"):
        sensor.place(str(tmp_path), At(0, 0))


def test_scanned_objects_load_and_have_their_size(data: Path) -> None:
    folder = data / "ycb_meshes"
    known = json.loads((folder / "index.json").read_text())
    sensor = open_synthetic(f"synthetic:empty?faults=none&meshes={folder}")
    for name in ("mustard_bottle", "cracker_box", "banana"):
        sensor.show(name)
        (shown,) = sensor.bodies.items()
        assert shown[0] == name.replace("_", " ")
        low, high = (np.array(known[name][f"bbox_{end}_m"]) for end in ("min", "max"))
        assert shown[1].model.size == pytest.approx(high - low, abs=0.002)
        frame = sensor.frame()
        grey = cv2.cvtColor(frame.colour, cv2.COLOR_RGB2GRAY)
        mask = frame.outlines[shown[0]]
        assert grey[mask].std() > 10
