"""A turn, a view and a file to remember them in."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from kille.memory import Scan, Sighting, Turn
from kille.scene import Point

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
def seen() -> Sighting:
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
        rng.random(50, dtype=np.float32),
        (0.25, 0.125, 0.0625),
    )
