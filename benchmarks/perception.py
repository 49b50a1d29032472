"""What seeing costs: `python benchmarks/perception.py [--json] [--cpu]`.

On one thread: finding the things in a frame, describing one, asking what it is among a
hundred to ten thousand views, the paper's own way beside ours, and learning one view
for good. Then where a thing is, by its region and by its best features. How well words
are told apart is measured by `kille evaluate`.

Frames are of real captures where they are there (../shared/data or KILLE_DATA), else of
the simulated table. Views are of ten simulated things; to have thousands, each is
varied: half of its features each time, with noise.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from itertools import chain
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from _measuring import (
    Clock,
    Measure,
    Measures,
    Result,
    Task,
    arguments,
    clock_of,
    results,
    table_lines,
)
from _simulated_things import simulated_things, traits_of
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from kille.memory import Memory, Scan, Sighting, Turn
from kille.perception.cues import EMBEDDING, MissingExtraError, measure_cues
from kille.perception.descriptor_index import Background, Index, View, rooted
from kille.perception.features import features_of
from kille.perception.geometry import points_at
from kille.perception.look import look
from kille.perception.objects import ObjectMemory
from kille.perception.paper_objects import PaperObjects
from kille.perception.segment import overlap, region_of, segment, segment_by_contact
from kille.perception.votes import beyond_chance, votes
from kille.scene import Features, Frame, Look, Mask, Percept, Point
from kille.sensors.sources import open_sensor

ROOT = Path(__file__).resolve().parent.parent
DATA = Path(os.environ.get("KILLE_DATA") or ROOT.parent / "shared" / "data")
SCENES = ("0001", "0002", "0050")
NOISE = 12.0  # of each number of a descriptor, which are bytes
LESSONS = 200
ASKED = 3  # the book: 190 features


def vary_view(key: int, chance: np.random.Generator) -> View:
    """A view of one of the ten things, like no other."""
    thing = simulated_things()[key % len(simulated_things())]
    rows = thing.scan.descriptors
    half = chance.permutation(len(rows))[: len(rows) // 2 + 1]
    noisy = rows[half] + chance.normal(0, NOISE, (len(half), rows.shape[1]))
    return View(
        key, thing.name, np.clip(noisy, 0, 255).astype(np.uint8), traits_of(thing)
    )


@cache
def views(size: int) -> tuple[View, ...]:
    chance = np.random.default_rng(0)
    return tuple(vary_view(key, chance) for key in range(size))


# --- tasks ---------------------------------------------------------------------------


def frame() -> Frame:
    """Six things on a real table, or what there is."""
    if DATA.is_dir():
        return open_sensor(str(DATA / "ycbv_scenes" / "0002")).frame()
    return simulated_things()[ASKED].frame


def segmenting(rule: Callable[[Frame], object]) -> Callable[[int], Task]:
    return lambda _: partial(rule, frame())


def extracting(_: int) -> Task:
    thing = simulated_things()[ASKED]
    return lambda: features_of(thing.frame, thing.region)


def describing(_: int) -> Task:
    thing = simulated_things()[ASKED]
    return lambda: measure_cues(thing.frame, thing.region)


def embedding(_: int) -> Task:
    thing = simulated_things()[ASKED]
    cues = {EMBEDDING.name: EMBEDDING}
    return lambda: measure_cues(thing.frame, thing.region, cues)


def voting(size: int) -> Task:
    """SIFT on the crop, the nearest descriptors, votes, and what chance would give."""
    thing, index = simulated_things()[ASKED], Index(views(size)).settled()

    def ask() -> object:
        rows = features_of(thing.frame, thing.region).descriptors
        cast = votes(index.neighbours(rooted(rows)), len(index.labels), 1)
        return beyond_chance(cast, index.sizes, len(rows))

    return ask


def voting_as_in_the_paper(size: int) -> Task:
    thing, memory = simulated_things()[ASKED], PaperObjects()
    for view in views(size):
        nowhere = np.zeros((len(view.descriptors), 3), np.float32)
        scan = Features(view.descriptors, nowhere[:, :2], nowhere)
        memory.learn_one(Percept(thing.region, (scan,)), view.label, key=view.key)
    return lambda: memory.predict_proba_one(thing.percept())


def recognising(size: int) -> Task:
    """All default cues and votes: what the robot does for one scan."""
    thing, memory = simulated_things()[ASKED], ObjectMemory(views(size))
    memory.predict_proba_one(thing.percept())
    return lambda: memory.predict_proba_one(thing.percept())


# --- learning ------------------------------------------------------------------------


def learning_times(size: int, clock: Clock) -> tuple[float, float]:
    """Milliseconds to learn one view for good, beside so many: median, 99 %."""
    chance = np.random.default_rng(1)
    taken = []
    with tempfile.TemporaryDirectory() as folder:
        index = Index(views(size), builder=Background())
        index.settled()
        with Memory.open(Path(folder) / "memory.sqlite") as memory:
            dialogue = memory.begin_dialogue("2000-01-01T00:00:00")
            for number in range(LESSONS):
                view = vary_view(size + number, chance)
                turn = Turn(dialogue, number + 1, "tutor", "This is it.", "", "")
                start = clock()
                index.learn(view)
                memory.learn_object(
                    turn, view.label.replace(" ", "_"), view.label, sighting_of(view)
                )
                taken.append(1000 * (clock() - start))
        index.settled()
    return float(np.median(taken)), float(np.quantile(taken, 0.99))


def sighting_of(view: View) -> Sighting:
    points = np.zeros((len(view.descriptors), 3), np.float32)
    scan = Scan(view.descriptors, points)
    return Sighting("synthetic", 0.0, (scan,), None, view.traits)


def learning(sizes: tuple[int, ...], clock: Clock) -> Result:
    times = {size: learning_times(size, clock) for size in sizes}
    limits = [
        limit
        for size, (median, slowest) in times.items()
        for limit in (
            (f"n = {size:,}", 5.0, median),
            (f"n = {size:,}, 99 %", 30.0, slowest),
        )
    ]
    medians = {size: median for size, (median, _) in times.items()}
    return Result("learning", "one view, durable", medians, tuple(limits))


# --- where a thing is ----------------------------------------------------------------


Shown = tuple[str, Percept, NDArray[np.float64]]
"""A word, what is seen of it, and where it truly is."""


@dataclass(frozen=True)
class Placing:
    """How far from the truth one way to say where a thing is was, in cm.

    It is infinite where that way did not say.
    """

    scenes: str
    way: str
    errors: tuple[float, ...]

    def facts(self) -> dict[str, object]:
        known = [error for error in self.errors if np.isfinite(error)]
        return {
            "scenes": self.scenes,
            "way": self.way,
            "things": len(self.errors),
            "placed": len(known),
            "median": round(float(np.median(known)), 2),
            "90 %": round(float(np.quantile(known, 0.9)), 2),
        }

    def table_line(self) -> str:
        scenes, way, *numbers = self.facts().values()
        return f"  {scenes:<11}{way:<36}" + "".join(f"{it:>8}" for it in numbers)


def placings() -> Iterator[Placing]:
    """Both ways on each set of scenes; the features are those taught in other looks."""
    sets = {"simulated": simulate_views()}
    if DATA.is_dir():
        sets["real"] = real()
    for scenes, (lessons, asked) in sets.items():
        memory = PaperObjects()
        for word, percept, _ in lessons:
            memory.learn_one(percept, word)
        by_region = [away(it.region.place, true) for _, it, true in asked]
        yield Placing(scenes, "middle of the region", tuple(by_region))
        by_best = [away(memory.locate(it, word), true) for word, it, true in asked]
        yield Placing(scenes, "20 best features, as in the paper", tuple(by_best))


def simulate_views() -> tuple[list[Shown], list[Shown]]:
    stages = [open_sensor(f"synthetic:empty?seed={seed}") for seed in (0, 1, 2)]
    taught, *asked = [list(on_stage(stage)) for stage in stages]
    return taught, [shown for some in asked for shown in some]


def on_stage(stage: Any) -> Iterator[Shown]:
    for name in stage.things():
        stage.show(name)
        seen = look(stage, 1)
        outline = seen.frame.outlines[name]
        yield from shown_things(name, outline, seen)


def real() -> tuple[list[Shown], list[Shown]]:
    """All scenes teach by the tutor's outlines, and are asked by their own regions."""
    lessons, asked = [], []
    for scene in SCENES:
        folder = str(DATA / "ycbv_scenes" / scene)
        seen = look(open_sensor(folder), 1)
        for name, outline in seen.frame.outlines.items():
            shown = look(open_sensor(folder), 1, pointed=outline).percepts[0]
            lessons.append((name, shown, middle(seen.frame, outline)))
            asked.extend(shown_things(name, outline, seen))
    return lessons, asked


def shown_things(name: str, outline: Mask, seen: Look) -> Iterator[Shown]:
    """What was made out of a labelled thing, if anything was."""
    truth = region_of(seen.frame, outline)
    nearest = max(seen.percepts, key=lambda it: overlap(it.region, truth))
    if overlap(nearest.region, truth) >= 0.5:
        yield name, nearest, middle(seen.frame, outline)


def middle(frame: Frame, outline: Mask) -> NDArray[np.float64]:
    """The median of the points under a true outline."""
    down, right = np.nonzero(outline)
    points = points_at(frame, np.stack([right, down], axis=1).astype(np.float32))
    return np.asarray(np.nanmedian(points, axis=0), np.float64)


def away(place: Point | None, true: NDArray[np.float64]) -> float:
    return np.inf if place is None else 100 * float(np.linalg.norm(place - true))


# --- all of it -----------------------------------------------------------------------

VIEWS = (100, 1_000, 10_000)
LIMITS = {100: 12.0, 1_000: 15.0, 10_000: 20.0}


def measures() -> Measures:
    seeing = {
        "segmentation, plain": Measure(segmenting(segment_by_contact), (1,), {1: 8.0}),
        "segmentation, splitting": Measure(segmenting(segment), (1,), {1: 25.0}),
        "SIFT on the thing": Measure(extracting, (1,)),
        "all default cues": Measure(describing, (1,)),
    }
    try:
        embedding(1)()
        seeing["embedding"] = Measure(embedding, (1,), {1: 50.0})
    except MissingExtraError as error:
        print(f"embedding: left out, {error}", file=sys.stderr)
    asking = {
        "votes, with SIFT": Measure(voting, VIEWS, LIMITS),
        "all default cues and votes": Measure(
            recognising, VIEWS, dict.fromkeys(VIEWS, 60.0)
        ),
        "the paper's way": Measure(voting_as_in_the_paper, VIEWS[:2]),
    }
    return {"one frame": seeing, "one scan by views": asking}


def main() -> None:
    options = arguments(__doc__ or "").parse_args()
    cv2.setNumThreads(1)
    clock = clock_of(options)
    with threadpool_limits(1):
        found = results(measures(), clock)
        durable = map(partial(learning, clock=getattr(time, clock)), [VIEWS])
        placed = placings()
        if options.json:
            print(json.dumps(facts(clock, chain(found, durable), placed)))
            return
        for line in table_lines(chain(found, durable)):
            print(line, flush=True)
        heads = "".join(f"{it:>8}" for it in ("things", "placed", "median", "90 %"))
        print(f"\n{'where a thing is, cm':<49}{heads}")
        for one in placed:
            print(one.table_line(), flush=True)


def facts(
    clock: str, found: Iterable[Result], placed: Iterable[Placing]
) -> dict[str, object]:
    return {
        "clock": clock,
        "results": [one.facts() for one in found],
        "places": [one.facts() for one in placed],
    }


if __name__ == "__main__":
    main()
