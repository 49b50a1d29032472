"""Wavefront OBJ meshes with one texture, z up, in metres: scans, and the toys."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour
from kille.sensors.pictures import read_colour
from kille.sensors.sensor import SensorError
from kille.sensors.synthetic.toy_model import (
    TEXELS_PER_METRE,
    ToyModel,
    set_down,
    smooth_normals,
)
from ttr.safety.inputs import read_text
from ttr.safety.limits import MESH


def find_meshes(path: Path) -> dict[str, Path]:
    """The meshes at a path, name -> OBJ file, the names in order.

    The path is an OBJ file, a folder with one, or a folder of such folders. A mesh is
    called as its folder, with spaces for underscores; a mesh `textured.obj` stands for
    all of its folder. Raises SensorError when there is nothing of the kind.
    """
    if not path.exists():
        raise SensorError(f"{path}: no such mesh file or folder")
    files = [path] if path.is_file() else [*_in_folder(path)]
    if path.is_dir() and not files:
        files = [
            file for folder in sorted(path.iterdir()) for file in _in_folder(folder)
        ]
    if not files or any(file.suffix.lower() != ".obj" for file in files):
        raise SensorError(
            f"{path}: no OBJ mesh: give an .obj file or a folder of meshes"
        )
    return {_name_of(file): file for file in files}


@lru_cache(maxsize=64)
def load_scan(path: Path) -> ToyModel:
    """The scanned thing in an OBJ file, set down on z = 0 around the origin.

    The texture's v axis points up. Normals are computed from the triangles, and a
    texture that is finer than can be rendered is made smaller. Raises SensorError for
    a file that cannot be used.
    """
    lines = _read(path).splitlines()
    positions = _rows(path, lines, "v", 3)
    uv = _rows(path, lines, "vt", 2)
    texture = _texture(path, lines)
    corners, triangles = _corners(path, lines, len(positions), len(uv))
    vertices = set_down(positions[corners[0]])
    _check_size(path, vertices)
    triangles = _turn_outwards(vertices, triangles)
    texels = uv[corners[1]]
    density = _texels_per_metre(vertices, texels * texture.shape[1::-1], triangles)
    picture = _shrink(texture, min(1.0, TEXELS_PER_METRE / max(density, 1.0)))
    return ToyModel(
        vertices=vertices,
        normals=smooth_normals(vertices, triangles),
        uv=texel_places(texels, picture),
        triangles=triangles,
        texture=picture,
    )


def load_model(path: Path) -> ToyModel:
    """The model in an OBJ file with normals, all of it just as it stands there.

    Raises SensorError for a file that cannot be used.
    """
    lines = _read(path).splitlines()
    positions = _rows(path, lines, "v", 3)
    uv = _rows(path, lines, "vt", 2)
    normals = _rows(path, lines, "vn", 3)
    texture = _texture(path, lines)
    sizes = len(positions), len(uv), len(normals)
    corners, triangles = _corners(path, lines, *sizes)
    return ToyModel(
        vertices=positions[corners[0]].astype(np.float32),
        normals=normals[corners[2]].astype(np.float32),
        uv=texel_places(uv[corners[1]], texture),
        triangles=triangles,
        texture=texture,
    )


def texel_places(uv: NDArray[np.float64], texture: Colour) -> NDArray[np.float32]:
    """Places (n, 2) from 0 to 1, the second upwards, as (column, row) in texels."""
    height, width = texture.shape[:2]
    rows = height - uv[:, 1] * height
    places = np.stack([uv[:, 0] * width, rows], axis=1) - 0.5
    return places.astype(np.float32)


def _in_folder(folder: Path) -> list[Path]:
    """The folder's own mesh: `textured.obj`, else every OBJ file in it."""
    if not folder.is_dir():
        return []
    files = sorted(folder.glob("*.obj"))
    textured = [file for file in files if file.name == "textured.obj"]
    return textured or files


def _name_of(file: Path) -> str:
    name = file.resolve().parent.name if file.stem == "textured" else file.stem
    return name.replace("_", " ")


def _read(path: Path) -> str:
    try:
        return read_text(path, MESH)
    except OSError as error:
        raise SensorError(f"{path}: cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise SensorError(f"{path}: cannot be read as an OBJ mesh: {error}") from error


def _rows(path: Path, lines: list[str], kind: str, count: int) -> NDArray[np.float64]:
    """All lines of one kind as numbers (n, count)."""
    rows = [
        line.split()[1 : count + 1] for line in lines if line.startswith(kind + " ")
    ]
    try:
        numbers = np.array([list(map(float, row)) for row in rows])
    except ValueError as error:
        raise SensorError(f"{path}: a `{kind}` line is no {count} numbers") from error
    if numbers.ndim != 2 or not np.isfinite(numbers).all():
        raise SensorError(
            f"{path}: no usable `{kind}` lines, so it is no textured mesh"
        )
    return numbers


def _corners(
    path: Path, lines: list[str], *sizes: int
) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """The vertices that the faces have, and their triangles (m, 3).

    There are so many positions, texels and, if they count, normals. A vertex is every
    combination of them that a corner uses: their indices are (2 or 3, n).
    """
    faces = [line.split()[1:] for line in lines if line.startswith("f ")]
    fans = [
        corner
        for face in faces
        for k in range(1, len(face) - 1)
        for corner in (face[0], face[k], face[k + 1])
    ]
    try:
        numbers = [list(map(int, corner.split("/")[: len(sizes)])) for corner in fans]
        corners = np.array(numbers, np.int64)
    except (ValueError, OverflowError) as error:
        raise SensorError(
            f"{path}: an `f` line has no position/texture pairs"
        ) from error
    if corners.ndim != 2:
        raise SensorError(f"{path}: no `f` lines, so it is no mesh")
    if corners.shape[1] != len(sizes):
        raise SensorError(
            f"{path}: its faces have no texture, so it is no textured mesh"
        )
    corners = np.where(corners < 0, corners + np.array(sizes) + 1, corners) - 1
    if corners.min() < 0 or (corners.max(axis=0) >= sizes).any():
        raise SensorError(f"{path}: an `f` line names a vertex that is not there")
    flat = np.ravel_multi_index(tuple(corners.T), sizes)
    used, triangles = np.unique(flat, return_inverse=True)
    indices = np.stack(np.unravel_index(used, sizes))
    return indices, triangles.reshape(-1, 3).astype(np.int32)


def _file_names(lines: Iterable[str], key: str) -> list[str]:
    """The files that lines with this key name."""
    stripped = (line.strip() for line in lines)
    return [line.removeprefix(key).strip() for line in stripped if line.startswith(key)]


def _texture(path: Path, lines: list[str]) -> Colour:
    """The picture that the mesh's material file names."""
    materials = [_read(path.parent / name) for name in _file_names(lines, "mtllib ")]
    maps = [
        name for text in materials for name in _file_names(text.splitlines(), "map_Kd ")
    ]
    if not maps:
        raise SensorError(f"{path}: its material names no texture (`map_Kd`)")
    file = path.parent / maps[0]
    try:
        return read_colour(file)
    except SensorError as error:
        raise SensorError(f"{file}: the mesh's texture does not open") from error


def _check_size(path: Path, vertices: NDArray[np.float32]) -> None:
    largest = float(np.ptp(vertices, axis=0).max())
    if not 0.005 <= largest <= 1.0:
        raise SensorError(
            f"{path}: {largest:g} m big: a mesh is read in metres and should be "
            "between 5 mm and 1 m"
        )


def _turn_outwards(
    vertices: NDArray[np.float32], triangles: NDArray[np.int32]
) -> NDArray[np.int32]:
    """The triangles wound so that the volume inside them is positive."""
    a, b, c = (vertices[triangles[:, k]].astype(np.float64) for k in range(3))
    middle = vertices.mean(axis=0)
    volume = np.sum((a - middle) * np.cross(b - a, c - a))
    return triangles if volume >= 0 else np.ascontiguousarray(triangles[:, ::-1])


def _texels_per_metre(
    vertices: NDArray[np.float32],
    texels: NDArray[np.float64],
    triangles: NDArray[np.int32],
) -> float:
    """How finely the texture is printed on the mesh, on the whole."""
    a, b, c = (vertices[triangles[:, k]].astype(np.float64) for k in range(3))
    surface = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    d, e, f = (texels[triangles[:, k]] for k in range(3))
    g, h = e - d, f - d
    printed = np.abs(g[:, 0] * h[:, 1] - g[:, 1] * h[:, 0]).sum()
    return float(np.sqrt(printed / max(surface, 1e-12)))


def _shrink(picture: Colour, factor: float) -> Colour:
    if factor >= 1.0:
        return picture
    height, width = picture.shape[:2]
    size = (max(round(width * factor), 4), max(round(height * factor), 4))
    return cv2.resize(picture, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
