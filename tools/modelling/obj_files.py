"""Models as texts of OBJ files, with enough digits to be read back exactly."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from kille.sensors.synthetic.obj_files import texel_places
from kille.sensors.synthetic.toy_model import ToyModel

_MOST_DIGITS = 17  # of a float64


def obj_text(model: ToyModel, material: str) -> str:
    """The OBJ file of a model: `v`, `vt` and `vn` of each vertex, then the faces."""
    lines = [
        f"mtllib {material}",
        *_rows("v", _digits(model.vertices)),
        *_rows("vt", _texels(model)),
        *_rows("vn", _digits(model.normals)),
        *(
            "f " + " ".join(f"{corner}/{corner}/{corner}" for corner in triangle)
            for triangle in (model.triangles + 1).tolist()
        ),
    ]
    return "\n".join(lines) + "\n"


def _rows(kind: str, numbers: list[list[str]]) -> Iterator[str]:
    return (" ".join([kind, *row]) for row in numbers)


def _digits(numbers: NDArray[np.float32]) -> list[list[str]]:
    """The shortest decimals that give these numbers back."""
    return [[str(number) for number in row] for row in numbers]


def _texels(model: ToyModel) -> list[list[str]]:
    """Decimals from 0 to 1, as short as gives the places in the texture back.

    A few numbers of texels are given back by no decimals, save for an error of 1e-13.
    """
    height, width = model.texture.shape[:2]
    places = model.uv.astype(np.float64) + 0.5
    shares = np.stack([places[:, 0] / width, 1 - places[:, 1] / height], axis=1)
    texts = np.full(shares.shape, "", dtype="U24")
    for digits in range(1, _MOST_DIGITS + 1):
        tried = np.array([[f"{share:.{digits}g}" for share in row] for row in shares])
        given = texel_places(tried.astype(np.float64), model.texture)
        texts = np.where((texts == "") & (given == model.uv), tried, texts)
    found: list[list[str]] = np.where(texts == "", tried, texts).tolist()
    return found
