"""How long it takes to keep a lesson for good, and to load all lessons.

A view is 300 features of one scan, the vectors of the cues that a thing with depth has,
and a picture of 24 kB.
Each is one lesson of its own, on disk when `learn_object` returns. Loading is opening
the file, checks and all, and making every lesson a value, as a robot that starts does.
"""

from __future__ import annotations

import json
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from _measuring import arguments, clock_of, limit_told

from kille.memory import Crop, Memory, Picture, Scan, Sighting, Turn
from kille.perception.cues import CUES
from kille.scene import Box, Intrinsics, Point

FEATURES = 300
LENGTHS = {name: it.length for name, it in CUES.items() if "whole" not in name}
SIZES = (1_000, 10_000)
LEARN, LEARN_SLOWEST, LOAD = 5.0, 30.0, 2_000.0
"""Milliseconds: the median and the 99th percentile of a lesson; loading the largest."""


@dataclass(frozen=True)
class Result:
    """What was measured of a memory of so many views, in milliseconds."""

    views: int
    megabytes: float
    learned: tuple[float, float, float]
    """The median, the 99th percentile and the slowest."""
    opened: float
    loaded: float

    def limits(self) -> Iterator[tuple[str, float, float]]:
        """What each limit is of, the limit, and what was found."""
        yield "learn one", LEARN, self.learned[0]
        yield "learn one, 99 %", LEARN_SLOWEST, self.learned[1]
        if self.views == SIZES[-1]:
            yield "open and load", LOAD, self.opened + self.loaded

    def facts(self) -> dict[str, object]:
        return {
            "views": self.views,
            "megabytes": round(self.megabytes, 1),
            "learn_one": dict(zip(("median", "p99", "max"), self.learned, strict=True)),
            "open": self.opened,
            "load": self.loaded,
            "limits": [
                {"of": what, "limit": most, "found": found, "holds": found <= most}
                for what, most, found in self.limits()
            ],
        }


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
            {cue: rng.random(k, dtype=np.float32) for cue, k in LENGTHS.items()},
            picture(rng),
        )
        for _ in range(16)
    ]


def picture(rng: np.random.Generator) -> Picture:
    """Noise of the sizes that real pictures have; a memory keeps them as they are."""
    jpeg, png = b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n"
    crop = Crop(
        jpeg + rng.bytes(12_000),
        png + rng.bytes(700),
        png + rng.bytes(6_000),
        Intrinsics(525.0, 525.0, 60.0, 60.0),
    )
    return Picture(jpeg + rng.bytes(5_000), (Box(40, 40, 70, 70),), crop)


def teach(path: Path, views: int, clock: str) -> list[float]:
    """The milliseconds that each of so many lessons took."""
    seen = sightings(np.random.default_rng(1))
    now, taken = getattr(time, clock), []
    with Memory.open(path) as memory:
        dialogue = memory.begin_dialogue("2026-01-31T12:00:00")
        for n in range(views):
            turn = Turn(dialogue, n, "tutor", "This is a cup.", "", "2026-01-31T12:00")
            start = now()
            memory.learn_object(turn, "cup", "cup", seen[n % len(seen)])
            taken.append(1000 * (now() - start))
    return taken


def load(path: Path, clock: str) -> tuple[float, float]:
    """The milliseconds to open the file, checks and all, and to load every view."""
    now = getattr(time, clock)
    start = now()
    with Memory.open(path) as memory:
        opened = now()
        lessons = list(memory.objects())
        loaded = now()
    assert all(len(it.seen.scans[0].points) == FEATURES for it in lessons)
    return 1000 * (opened - start), 1000 * (loaded - opened)


def measure_memory(views: int, clock: str) -> Result:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "memory.db"
        taken = teach(path, views, clock)
        median, slow, slowest = (float(t) for t in np.percentile(taken, (50, 99, 100)))
        opened, loaded = load(path, clock)
        size = path.stat().st_size / 1e6
    return Result(views, size, (median, slow, slowest), opened, loaded)


def table_line(found: Result) -> str:
    median, slow, slowest = found.learned
    limits = "; ".join(map(limit_told, found.limits()))
    return (
        f"{found.views:6,} {found.megabytes:5.0f} {median:18.2f} {slow:6.2f} "
        f"{slowest:6.1f} {found.opened:8.0f} {found.loaded:8.0f}   {limits}"
    )


def main() -> None:
    options = arguments(__doc__ or "").parse_args()
    found = (measure_memory(views, clock_of(options)) for views in SIZES)
    if options.json:
        facts = [it.facts() for it in found]
        print(json.dumps({"clock": clock_of(options), "results": facts}))
        return
    print(
        f"{'views':>6} {'MB':>5} {'learn one: median, 99 %, max ms':>32} "
        f"{'open ms':>8} {'load ms':>8}"
    )
    for it in found:
        print(table_line(it), flush=True)


if __name__ == "__main__":
    main()
