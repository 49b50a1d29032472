"""How time and memory grow with what was learned: up to ten thousand views.

The views are of the ten things of the simulated table, each seen once and then varied:
half of its features, with noise, and its traits with a little noise. A learner gets
them one by one, and is asked about other such views each time their number has grown
about threefold. A method that compares with view after view takes longer and longer:
when a question takes a second, the rest is extrapolated from the time for each view,
and marked.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.lab.progress import Steps
from kille.lab.protocols.memory_use import ResidentMemory
from kille.lab.results import Cell, Figure, Progress, Result, Table, silent
from kille.lab.scenes.shown_things import OnTable
from kille.lab.theories.candidates import Methods
from kille.memory import Memory, Scan, Sighting, Turn
from kille.perception.thumbnails import evidence_of
from kille.scene import Features, Percept
from kille.sensors.synthetic.catalogue import TOY_NAMES

SIZES = (10, 30, 100, 300, 1_000, 3_000, 10_000)
"""The numbers of views at which learners are asked."""

_BEARABLE = 1.0  # seconds that a question may take
_QUESTIONS = 5
_NOISE = 12.0  # of each number of a descriptor, which are bytes
_TRAIT_NOISE = 0.05  # of the length of a trait
_KEPT = 40  # lessons that are written to measure their size in a file
_MEGA = 1e6
_TIME = "2000-01-01T00:00:00"


@dataclass(frozen=True)
class _Point:
    """The measurements of a method at a number of views; memory None if unknown."""

    views: int
    question: float  # seconds, the median
    first: float  # seconds of the first question after the lessons
    lesson: float  # seconds, the median of those since the last point
    slowest: float  # the 99th percentile of them
    memory: float | None  # bytes more than before the first lesson


def growth(
    methods: Methods,
    *,
    seed: int,
    progress: Progress = silent,
    sizes: Sequence[int] = SIZES,
) -> Result:
    """The time of a question and of a lesson, and memory, by the number of views."""
    seen = _look_at_things(seed)
    steps = Steps(progress, len(methods) * len(sizes))
    kept = _stored_size(seen)
    memory = ResidentMemory()
    courses = {}
    for name, make in methods.items():
        memory.begin()
        step = partial(_report_step, steps, name)
        courses[name] = _measure_growth(make(), seen, seed, sizes, memory, step)
    return Result(
        f"Time and memory up to {max(sizes):,} views",
        (_table(courses, sizes, kept),),
        (_figure(courses, sizes),),
        {
            "features of a scan": round(np.mean([_features(it) for it in seen])),
            "bytes of a lesson on disk": round(kept),
            "methods": {
                name: [_facts(point) for point in course]
                for name, course in courses.items()
            },
        },
    )


def _report_step(steps: Steps, name: str, views: int) -> None:
    steps(f"{name}, {views:,} views")


def _look_at_things(seed: int) -> list[Percept]:
    """Look at each of the ten things once, and measure its features and traits."""
    table = OnTable(seed)
    looks = [table.look_at(name, scans=1) for name in TOY_NAMES]
    for percept in looks:
        _ = percept.traits
    return looks


def _features(percept: Percept) -> int:
    return len(percept.scans[0].descriptors)


def _vary(percept: Percept, chance: np.random.Generator) -> Percept:
    scan = percept.scans[0]
    count = len(scan.descriptors)
    half = np.sort(chance.permutation(count)[: count // 2 + 1])
    noise = chance.normal(0, _NOISE, (len(half), 128))
    traits = {
        name: (vector + _noise(vector, chance)).astype(np.float32)
        for name, vector in percept.traits.items()
    }
    again = Features(
        np.clip(scan.descriptors[half] + noise, 0, 255).astype(np.uint8),
        scan.pixels[half],
        scan.points[half],
    )
    return replace(percept, scans=(again,), measure=lambda: traits, frame=None)


def _noise(
    vector: NDArray[np.float32], chance: np.random.Generator
) -> NDArray[np.float64]:
    spread = _TRAIT_NOISE * float(np.linalg.norm(vector)) / len(vector) ** 0.5
    return chance.normal(0, spread, vector.shape)


def _measure_growth(
    learner: Any,
    seen: Sequence[Percept],
    seed: int,
    sizes: Sequence[int],
    memory: ResidentMemory,
    step: Callable[[int], None],
) -> list[_Point]:
    """Measure one method, until a question takes too long."""
    chance = np.random.default_rng(seed)
    course: list[_Point] = []
    learned = 0
    for size in sizes:
        if not course or course[-1].question <= _BEARABLE:
            lessons = []
            for number in range(learned, size):
                place = number % len(seen)
                x, word = _vary(seen[place], chance), TOY_NAMES[place]
                teach = partial(learner.learn_one, x, word, key=number)
                lessons.append(_time_call(teach))
            learned = size
            course.append(_point(learner, seen, chance, lessons, memory, size))
        step(size)
    return course


def _point(
    learner: Any,
    seen: Sequence[Percept],
    chance: np.random.Generator,
    lessons: Sequence[float],
    memory: ResidentMemory,
    size: int,
) -> _Point:
    asked = [_vary(percept, chance) for percept in seen[: _QUESTIONS + 1]]
    first, *others = [_time_call(partial(learner.predict_proba_one, x)) for x in asked]
    return _Point(
        size,
        float(np.median(others)),
        first,
        float(np.median(lessons)),
        float(np.quantile(lessons, 0.99)),
        memory.growth(),
    )


def _time_call(act: Callable[[], object]) -> float:
    start = time.perf_counter()
    act()
    return time.perf_counter() - start


def _stored_size(seen: Sequence[Percept]) -> float:
    """The bytes that one lesson takes in a file, with its evidence."""
    chance = np.random.default_rng(0)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "growth.sqlite"
        with Memory.open(path) as memory:
            dialogue = memory.begin_dialogue(_TIME)
            sizes = [path.stat().st_size]
            for number in range(_KEPT):
                once = seen[number % len(seen)]
                x = replace(_vary(once, chance), frame=once.frame)
                turn = Turn(dialogue, number + 1, "tutor", "This is it.", "", _TIME)
                memory.learn_object(turn, "thing", "thing", _sighting_of(x))
        sizes.append(path.stat().st_size)
    return (sizes[1] - sizes[0]) / _KEPT


def _sighting_of(x: Percept) -> Sighting:
    scans = tuple(Scan(it.descriptors, it.points) for it in x.scans)
    picture = None if x.frame is None else evidence_of(x.frame, x.region)
    return Sighting("synthetic", 0.0, scans, x.region.place, x.traits, picture)


# --- tables and figures --------------------------------------------------------------


def _table(
    courses: Mapping[str, Sequence[_Point]], sizes: Sequence[int], kept: float
) -> Table:
    return Table(
        "Time and memory by the number of views",
        (
            "method",
            "views",
            "a question, ms",
            "the first one, ms",
            "a lesson, ms",
            "99 % of lessons, ms",
            "memory, MB",
            "file, MB",
        ),
        tuple(
            (name, size, *cells, _megabytes(size * kept))
            for name, course in courses.items()
            for size, cells in _rows(course, sizes)
        ),
        "A question is about one scan whose features and traits are there already. The "
        "first question after lessons waits for trees to be built, which are built in "
        "the background when the robot talks. Memory is given where the program had to "
        "grow. ~ is what follows from the time a view.",
    )


def _rows(
    course: Sequence[_Point], sizes: Sequence[int]
) -> Iterator[tuple[int, tuple[Cell, ...]]]:
    measured = {point.views: point for point in course}
    last = course[-1]
    for size in sizes:
        if (point := measured.get(size)) is None:
            guess = last.question * size / last.views
            yield size, (f"~{1000 * guess:.0f}", None, None, None, None)
            continue
        cells = (
            _milliseconds(point.question),
            _milliseconds(point.first),
            _milliseconds(point.lesson),
            _milliseconds(point.slowest),
            None if point.memory is None else _megabytes(point.memory),
        )
        yield size, cells


def _milliseconds(seconds: float) -> float:
    return _round_number(1000 * seconds)


def _megabytes(size: float) -> float:
    return _round_number(size / _MEGA)


def _round_number(number: float) -> float:
    """Round to a whole number from 10 on, below that to two digits."""
    return round(number) if number >= 10 else float(f"{number:.2g}")


def _figure(courses: Mapping[str, Sequence[_Point]], sizes: Sequence[int]) -> Figure:
    series = {}
    for name, course in courses.items():
        last = course[-1]
        known = {point.views: point.question for point in course}
        means = [1000 * known.get(n, last.question * n / last.views) for n in sizes]
        series[name] = {"mean": means, "low": means, "high": means}
    return Figure(
        "curves",
        "The time of a question",
        {
            "x": list(sizes),
            "series": series,
            "xlabel": "views learned",
            "ylabel": "a question, ms",
            "log": ["x", "y"],
        },
    )


def _facts(point: _Point) -> Mapping[str, Any]:
    return {
        "views": point.views,
        "question_ms": 1000 * point.question,
        "first_question_ms": 1000 * point.first,
        "lesson_ms": 1000 * point.lesson,
        "lesson_p99_ms": 1000 * point.slowest,
        "memory_bytes": point.memory,
    }
