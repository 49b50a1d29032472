"""The toys that are shipped are those that the scripts model."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kille.scene import Colour
from kille.sensors.pictures import read_colour
from kille.sensors.sensor import SensorError
from kille.sensors.synthetic import catalogue
from kille.sensors.synthetic.obj_files import load_model
from kille.sensors.synthetic.toy_model import ToyModel
from tools.modelling.obj_files import obj_text
from tools.modelling.shapes import disc, ellipsoid, lathe
from tools.modelling.sheets import Sheet, assemble
from tools.modelling.toys import MAKERS, SHIPPED, write_picture
from tools.modelling.wood import wood


def pictures_agree(one: Colour, other: Colour) -> bool:
    """Whether they are the same but for how another processor may round."""
    return one.shape == other.shape and bool(
        (np.abs(one.astype(int) - other) <= 1).all()
    )


def save(folder: Path, model: ToyModel) -> Path:
    file = folder / "thing.obj"
    file.write_text(obj_text(model, "thing.mtl"))
    (folder / "thing.mtl").write_text("newmtl thing\nmap_Kd thing.png\n")
    write_picture(folder / "thing.png", model.texture)
    return file


def test_each_toy_has_a_maker() -> None:
    assert [name.replace("_", " ") for name in MAKERS] == [*catalogue.TOY_NAMES]
    files = {file.name for file in (SHIPPED / "toys").iterdir()}
    assert files == {
        f"{name}.{end}" for name in MAKERS for end in ("obj", "mtl", "png")
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", MAKERS)
def test_a_shipped_toy_is_what_its_maker_makes(name: str) -> None:
    shipped, made = catalogue.toy_model(name.replace("_", " ")), MAKERS[name]()
    assert np.array_equal(shipped.triangles, made.triangles)
    assert shipped.vertices == pytest.approx(made.vertices, abs=1e-6)
    assert shipped.normals == pytest.approx(made.normals, abs=1e-4)
    assert shipped.uv == pytest.approx(made.uv, abs=1e-3)
    assert pictures_agree(shipped.texture, made.texture)


@pytest.mark.slow
def test_the_shipped_wood_is_what_its_maker_makes() -> None:
    assert pictures_agree(read_colour(SHIPPED / "wood.png"), wood())


@pytest.mark.parametrize("seed", range(8))
def test_a_model_is_read_as_it_was_written(tmp_path: Path, seed: int) -> None:
    chance = np.random.default_rng(seed)

    def picture() -> Colour:
        return chance.integers(0, 256, (*chance.integers(4, 90, 2), 3)).astype(np.uint8)

    profile = chance.uniform(0.01, 0.1, (4, 2))
    sheets = ellipsoid(chance.uniform(0.01, 0.1, 3), 8), lathe(profile, 7), disc(0.05)
    model = assemble([Sheet(sheet, picture()) for sheet in sheets])
    read = load_model(save(tmp_path, model))
    for name in ("vertices", "normals", "triangles", "texture"):
        assert np.array_equal(getattr(read, name), getattr(model, name))
        assert getattr(read, name).dtype == getattr(model, name).dtype
    assert read.uv == pytest.approx(model.uv, rel=0, abs=1e-12)


def test_a_model_has_normals(tmp_path: Path) -> None:
    file = save(tmp_path, catalogue.toy_model("book"))
    lines = [it for it in file.read_text().splitlines() if not it.startswith("vn")]
    file.write_text("\n".join(lines))
    with pytest.raises(SensorError, match="no usable `vn` lines"):
        load_model(file)
