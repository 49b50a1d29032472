"""What many words cost: `python benchmarks/vocabulary.py [--json] [--cpu] [--start]`.

On one thread, for up to ten thousand words with ten views each: the first question of
all, the first question after a lesson, any other question, a lesson, and the memory
that a view takes. With --start the views are lessons in a file, too: how large that is,
how long a robot takes to start with it, when all is checked and when the file is
believed, and the memory that a view takes after the first question.

A word's views are of a thing that nobody has seen: in every cue it looks like a mixture
of two things of the simulated table, and it has some features of one of them. Every
view is varied: half of these features each time, with noise, and a little noise in
every cue.
"""

from __future__ import annotations

import json
import statistics
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from _measuring import Clock, arguments, clock_of, limit_told
from _simulated_things import simulated_things, traits_of
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from kille.grounding.lessons_and_learners import Knowledge
from kille.lab.protocols.memory_use import resident_memory
from kille.memory import Memory, Scan, Sighting, Turn, believed_files
from kille.perception.descriptor_index import Background, View
from kille.perception.objects import ObjectMemory
from kille.scene import Features, Percept, Traits

WORDS = (100, 500, 1_000, 2_000, 4_000, 10_000)
VIEWS = 10  # of each word
FEATURES = 100  # of a thing, of which each view has half
NOISE = 12  # of each number of a descriptor, which are bytes
TRAIT_NOISE = 0.05  # of the length of a vector
AT_ONCE = 500  # lessons that are written in one transaction
LESSONS = 7  # that are followed by a question
FIRST, START = 150.0, 3_000.0
"""Milliseconds: the first question after a lesson; a start with the largest memory."""


@dataclass(frozen=True)
class Thing:
    """What a word is for: vectors by cue, and descriptors."""

    word: str
    traits: Traits
    descriptors: NDArray[np.uint8]

    def view(self, key: int, chance: np.random.Generator) -> View:
        rows = self.descriptors[chance.permutation(FEATURES)[: FEATURES // 2]]
        noisy = rows + chance.integers(-2 * NOISE, 2 * NOISE, rows.shape, np.int16)
        traits = {
            cue: vector + noise(vector, chance) for cue, vector in self.traits.items()
        }
        return View(key, self.word, np.clip(noisy, 0, 255).astype(np.uint8), traits)


def noise(
    vector: NDArray[np.float32], chance: np.random.Generator
) -> NDArray[np.float32]:
    spread = TRAIT_NOISE * float(np.linalg.norm(vector)) / len(vector) ** 0.5
    return np.float32(spread) * chance.standard_normal(len(vector), np.float32)


def invent_thing(word: str, chance: np.random.Generator) -> Thing:
    """A thing like no other: a mixture of two others in each cue."""
    traits = {}
    seen = simulated_things()
    for cue in traits_of(seen[0]):
        one, other = (
            traits_of(seen[chance.integers(len(seen))])[cue] for _ in range(2)
        )
        traits[cue] = (one + (other - one) * np.float32(chance.random())).astype("f4")
    rows = np.concatenate([it.scan.descriptors for it in seen])
    return Thing(word, traits, rows[chance.integers(0, len(rows), FEATURES)])


def percept_of(view: View) -> Percept:
    """What is seen in a view: one scan."""
    nowhere = np.zeros((len(view.descriptors), 3), np.float32)
    scan = Features(view.descriptors, nowhere[:, :2], nowhere)
    return Percept(simulated_things()[0].region, (scan,), lambda: view.traits, None)


@dataclass(frozen=True)
class Result:
    """What was measured with so many words, in milliseconds and bytes."""

    words: int
    first: float
    """The first question of all; trees are built in the background meanwhile."""
    lesson: float
    after: float
    """The first question after a lesson in a known word, the median."""
    new: float
    """The first question after a lesson in a new word, the median."""
    question: float
    right: float
    looks: float
    """Of questions about known words, the share answered by the right one; and of those
    about things that show no features, only how they look."""
    view: float
    """The memory that a view takes, with its part of all that is made of it."""
    file: float | None = None
    start: float | None = None
    started: float | None = None
    checking: float | None = None
    held: float | None = None
    """The bytes of a lesson in a file; the start with a file that is believed, and the
    first question after it; the start with a file that is checked; the bytes of working
    memory that a view takes after the question, with what of the trees is built."""

    def limits(self) -> Iterator[tuple[str, float, float]]:
        yield "after a lesson", FIRST, max(self.after, self.new)
        if self.start is not None and self.words == WORDS[-1]:
            yield "start", START, self.start

    def facts(self) -> dict[str, object]:
        limits = [
            {"of": what, "limit": most, "found": found, "holds": found <= most}
            for what, most, found in self.limits()
        ]
        return {**self.__dict__, "limits": limits}

    def table_line(self) -> str:
        times = (self.first, self.lesson, self.after, self.new, self.question)
        told = "".join(f"{it:>9,.0f}" if it >= 10 else f"{it:>9.2g}" for it in times)
        kept = ""
        if self.file is not None and self.start and self.started:
            kept = f"{self.file / 1e3:8.1f}{self.start:8,.0f}{self.started:8,.0f}"
            kept += f"{self.checking:9,.0f}{(self.held or 0) / 1e3:8.1f}"
        limits = "; ".join(map(limit_told, self.limits()))
        return (
            f"{self.words:>7,}{told}{self.right:>7.2f}{self.looks:>7.2f}"
            f"{self.view / 1e3:>8.1f}"
            f"{kept}   {limits}"
        )


def milliseconds(clock: Clock, act: object) -> float:
    begun = clock()
    act()  # type: ignore[operator]
    return 1000 * (clock() - begun)


def measure(words: int, clock: Clock, start: bool) -> Result:
    chance = np.random.default_rng(words)
    things = [invent_thing(f"w{n:05}", chance) for n in range(words)]
    before = resident_memory() or 0
    views = [things[key % words].view(key, chance) for key in range(VIEWS * words)]
    memory = ObjectMemory(views, builder=Background())

    def ask(thing: Thing, features: bool = True) -> str:
        asked = percept_of(thing.view(-1, chance))
        if not features:
            asked = replace(asked, scans=())
        degrees = memory.predict_proba_one(asked)
        return max(degrees, key=degrees.__getitem__)

    first = milliseconds(clock, lambda: ask(things[0]))
    memory._index.settled()
    taken: dict[str, list[float]] = {"lesson": [], "after": [], "new": [], "else": []}
    key = len(views)
    for number in range(LESSONS):
        for which in ("after", "new"):
            unheard = invent_thing(f"x{number}", chance)
            thing = things[chance.integers(words)] if which == "after" else unheard
            view, key = thing.view(key, chance), key + 1
            taken["lesson"].append(
                milliseconds(clock, lambda it=view: memory.learn(it))
            )
            asked = things[chance.integers(words)]
            taken[which].append(milliseconds(clock, lambda it=asked: ask(it)))
            taken["else"].append(milliseconds(clock, lambda it=asked: ask(it)))
    some = [things[n] for n in chance.integers(0, words, 30)]
    right = statistics.mean(ask(it) == it.word for it in some)
    looks = statistics.mean(ask(it, features=False) == it.word for it in some)
    size = ((resident_memory() or 0) - before) / len(views)
    middle = {name: statistics.median(some) for name, some in taken.items()}
    found = Result(
        words,
        first,
        middle["lesson"],
        middle["after"],
        middle["new"],
        middle["else"],
        right,
        looks,
        size,
    )
    return measure_start(found, views, clock) if start else found


def measure_start(found: Result, views: list[View], clock: Clock) -> Result:
    """The same with what a file of these lessons takes, and a start with it."""
    with tempfile.TemporaryDirectory(dir="/var/tmp") as folder:
        path = Path(folder) / "memory.db"
        write(path, views)
        size = sum(it.stat().st_size for it in Path(folder).iterdir()) / len(views)
        believed_files.doubt(path)
        checking, *_ = start_from(path, views[0], clock)
        start, first, held = start_from(path, views[0], clock)
    return replace(
        found,
        file=size,
        start=start,
        started=first,
        checking=checking,
        held=held / len(views),
    )


def start_from(path: Path, view: View, clock: Clock) -> tuple[float, float, int]:
    """The times of a start and of the first question, and the memory they take."""
    before, begun = resident_memory() or 0, clock()
    with Memory.open(path) as memory:
        robot = Knowledge(memory)
        start = 1000 * (clock() - begun)
        ask = percept_of(view)
        first = milliseconds(clock, lambda: robot.objects.predict_proba_one(ask))
        return start, first, (resident_memory() or 0) - before


def write(path: Path, views: list[View]) -> None:
    with Memory.open(path) as memory:
        dialogue = memory.begin_dialogue("2026-01-31T12:00:00")
        for start in range(0, len(views), AT_ONCE):
            with memory.together():
                for view in views[start : start + AT_ONCE]:
                    keep(memory, dialogue, view)


def keep(memory: Memory, dialogue: int, view: View) -> None:
    turn = Turn(dialogue, int(view.key), "tutor", "This is it.", "", "")
    points = np.zeros((len(view.descriptors), 3), np.float32)
    scan = Scan(view.descriptors, points)
    sighting = Sighting("synthetic", 0.0, (scan,), None, view.traits)
    memory.learn_object(turn, view.label, view.label, sighting)


def main() -> None:
    parser = arguments(__doc__ or "")
    parser.add_argument("--start", action="store_true", help="start from a file, too")
    parser.add_argument("--words", type=int, action="append", help="so many words")
    options = parser.parse_args()
    clock = getattr(time, clock_of(options))
    cv2.setNumThreads(1)
    with threadpool_limits(1):
        found = (
            measure(words, clock, options.start) for words in options.words or WORDS
        )
        if options.json:
            facts = [it.facts() for it in found]
            print(json.dumps({"clock": clock_of(options), "results": facts}))
            return
        print(
            f"{'words':>7}{'1st, ms':>9}{'lesson':>9}{'after':>9}{'new word':>9}"
            f"{'else':>9}{'right':>7}{'looks':>7}{'kB/view':>8}"
            + (
                f"{'on disk':>8}{'start':>8}{'asked':>8}{'checking':>9}{'held':>8}"
                if options.start
                else ""
            )
        )
        for it in found:
            print(it.table_line(), flush=True)


if __name__ == "__main__":
    main()
