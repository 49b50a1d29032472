"""A turn, a view and a file to remember them in, and any others."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import hypothesis.extra.numpy as arrays
import numpy as np
import pytest
from hypothesis import strategies as st

from kille.memory import Arrangement, Crop, Picture, Scan, Sighting, Turn
from kille.memory.pictures import JPEG, PNG
from kille.scene import Box, Configuration, Intrinsics, Point

NAMES = st.sampled_from(["cup", "can_of_paint", "left", "boîte"])
SURFACES = st.text("abö中 -'\N{NO-BREAK SPACE}\N{ZERO WIDTH JOINER}")
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
PLACES = st.builds(Point, NUMBERS, NUMBERS, NUMBERS)
DIRECTIONS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
CONFIGURATIONS = st.builds(
    Configuration,
    DIRECTIONS,
    viewed=st.none() | DIRECTIONS,
    target_size=st.none() | NUMBERS,
    others=st.lists(DIRECTIONS, max_size=2).map(tuple),
    contact=st.none() | NUMBERS,
)
PNGS = st.binary(max_size=9).map(PNG.__add__)
JPEGS = st.binary(max_size=9).map(JPEG.__add__)
PIXELS = st.integers(-9, 10_000)
LENSES = st.builds(Intrinsics, NUMBERS, NUMBERS, NUMBERS, NUMBERS)
CROPS = st.builds(Crop, JPEGS | PNGS, PNGS, st.none() | PNGS, st.none() | LENSES)
PICTURES = st.none() | st.builds(
    Picture,
    JPEGS,
    st.lists(st.builds(Box, PIXELS, PIXELS, PIXELS, PIXELS), max_size=2).map(tuple),
    st.none() | CROPS,
)
ARRANGEMENTS = st.builds(
    Arrangement, st.text(), NUMBERS, NAMES, NAMES, CONFIGURATIONS, PICTURES
)
VECTORS = arrays.arrays(
    np.float32,
    st.integers(0, 5),
    elements=st.floats(allow_nan=False, allow_infinity=False, width=32),
)


@st.composite
def scans(draw: st.DrawFn) -> Scan:
    n = draw(st.integers(0, 3))
    return Scan(
        draw(arrays.arrays(np.uint8, (n, 128), elements=st.integers(0, 255))),
        draw(arrays.arrays(np.float32, (n, 3), elements=st.floats(width=32))),
    )


SIGHTINGS = st.builds(
    Sighting,
    st.text(),
    NUMBERS,
    st.lists(scans(), max_size=3).map(tuple),
    st.none() | PLACES,
    st.dictionaries(st.sampled_from(["colour", "size", "texture"]), VECTORS),
    PICTURES,
)


def plain(seen: Sighting) -> tuple[object, ...]:
    """A sighting that can be compared; the bits of NaNs count too."""
    pairs = [(s.descriptors.tobytes(), s.points.tobytes()) for s in seen.scans]
    traits = {cue: vector.tobytes() for cue, vector in seen.traits.items()}
    return seen.sensor, seen.time, pairs, seen.place, traits


NOW = "2026-01-31T12:00:00+00:00"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Where a memory may be; nothing is there yet, not even the folder."""
    return tmp_path / "folder" / "memory.db"


@pytest.fixture
def said() -> Callable[[int], Turn]:
    """The n-th turn of the first dialogue."""
    return lambda n: Turn(1, n, "tutor", "This is a cup.", "s : Naming", NOW)


@pytest.fixture
def picture() -> Picture:
    """What starts as pictures do: a memory keeps them as they are."""
    lens = Intrinsics(525.0, 524.5, 31.5, 40.25)
    crop = Crop(
        b"\xff\xd8\xff colour",
        b"\x89PNG\r\n\x1a\n mask",
        b"\x89PNG\r\n\x1a\n depth",
        lens,
    )
    return Picture(b"\xff\xd8\xff frame", (Box(10, 20, 30, 40),), crop)


@pytest.fixture
def seen(picture: Picture) -> Sighting:
    rng = np.random.default_rng(7)
    scan = Scan(
        rng.integers(0, 256, (30, 128), dtype=np.uint8),
        rng.random((30, 3), dtype=np.float32),
    )
    return Sighting(
        "synthetic",
        0.5,
        (scan, scan),
        Point(0.1, -0.2, 0.9),
        {
            "colour": rng.random(50, dtype=np.float32),
            "size": np.log(np.array([0.26, 0.13, 0.07], np.float32)),
        },
        picture,
    )
