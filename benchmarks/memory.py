"""How long it takes to keep a lesson for good, and to load all lessons.

A view is one scan of 300 features. Each is one lesson of its own, on disk when
`learn_object` returns.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np

from kille.memory import Memory, Scan, Sighting, Turn
from kille.scene import Point

FEATURES = 300
COLOURS = 800
SIZES = (1_000, 10_000)


def sightings(rng: np.random.Generator) -> list[Sighting]:
    """A few different views, so that nothing can be kept twice as one."""
    return [
        Sighting(
            "synthetic",
            0.0,
            (
                Scan(
                    rng.integers(0, 256, (FEATURES, 128), dtype=np.uint8),
                    rng.random((FEATURES, 3), dtype=np.float32),
                ),
            ),
            Point(0.0, 0.0, 1.0),
            rng.random(COLOURS, dtype=np.float32),
            (0.2, 0.1, 0.05),
        )
        for _ in range(16)
    ]


def teach(path: Path, views: int) -> list[float]:
    """The milliseconds that each of so many lessons took."""
    seen = sightings(np.random.default_rng(1))
    taken = []
    with Memory.open(path) as memory:
        dialogue = memory.begin_dialogue("2026-01-31T12:00:00")
        for n in range(views):
            turn = Turn(dialogue, n, "tutor", "This is a cup.", "", "2026-01-31T12:00")
            start = time.perf_counter()
            memory.learn_object(turn, "cup", "cup", seen[n % len(seen)])
            taken.append(1000 * (time.perf_counter() - start))
    return taken


def load(path: Path) -> tuple[float, float]:
    """The milliseconds to open the file, checks and all, and to read every view."""
    start = time.perf_counter()
    with Memory.open(path) as memory:
        opened = time.perf_counter()
        features = sum(
            len(s.descriptors) for x in memory.objects() for s in x.seen.scans
        )
        read = time.perf_counter()
    assert features % FEATURES == 0
    return 1000 * (opened - start), 1000 * (read - opened)


def main() -> None:
    print(
        f"{'views':>6} {'MB':>5} {'learn one: median, 99 %, max ms':>32} "
        f"{'open ms':>8} {'load ms':>8}"
    )
    for views in SIZES:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "memory.db"
            median, slow, slowest = np.percentile(teach(path, views), (50, 99, 100))
            opening, loading = load(path)
            size = path.stat().st_size / 1e6
        print(
            f"{views:6} {size:5.0f} {median:18.2f} {slow:6.2f} {slowest:6.1f} "
            f"{opening:8.0f} {loading:8.0f}"
        )


if __name__ == "__main__":
    main()
