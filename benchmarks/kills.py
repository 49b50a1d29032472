"""Is a lesson that the robot said it learned there, whatever the moment of a kill -9?

A robot hears a tutor who teaches without end, as `kille talk` does: it looks, learns,
and answers. It is killed at a moment drawn at random: some lessons and a part of one
after it woke. Then its file is read, with all that was seen in every lesson, and the
next robot goes on with the same memory, or after some kills with a new one, so that the
making of a file is met too. A lesson counts as acknowledged when the robot's answer has
left its process.

Exit code 1 if anything is lost, halved or cannot be read.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Set
from dataclasses import asdict, dataclass
from itertools import count
from pathlib import Path
from typing import NoReturn

import cv2

from kille import Agent
from kille.memory import Memory, MemoryFileError, MemoryReader, Sighting
from kille.perception.thumbnails import restored
from kille.sensors.synthetic import open_synthetic

THINGS = ("cup", "book", "car")
SENSOR = "synthetic:empty?seed=7&faults=none"
LIFE = 3
"""How many lessons a robot may have acknowledged when its last moment begins."""
OF_ONE_FILE = 20
"""Kills after which a new memory is begun."""


@dataclass
class Outcome:
    """What came of so many kills."""

    kills: int = 0
    idle: int = 0
    """Kills before a lesson was acknowledged."""
    acknowledged: int = 0
    kept: int = 0
    """Lessons on file. One a kill may have been kept that was not yet acknowledged."""
    lost: int = 0
    halved: int = 0
    unreadable: int = 0

    @property
    def holds(self) -> bool:
        """Is every acknowledged lesson there and whole, and no file damaged?"""
        told = self.acknowledged <= self.kept <= self.acknowledged + self.kills
        return told and not (self.lost or self.halved or self.unreadable)


def teach(path: Path, numbers: Iterable[int]) -> Iterator[str]:
    """Teach a robot one thing after the other, by number; what it says it learned."""
    stage = open_synthetic(SENSOR)
    with Agent(stage, path, scans=1) as robot:
        for number in numbers:
            thing = THINGS[number % len(THINGS)]
            stage.show(thing)
            if "I learned" in robot.hear(f"This is a {thing}."):
                yield thing


def lesson_seconds() -> tuple[float, float]:
    """How long a robot takes to wake and learn a word, and how long another takes.

    What robots share is loaded by then, and not again by each.
    """
    for _ in range(2):
        times = [time.perf_counter()]
        with tempfile.TemporaryDirectory() as folder:
            for _ in teach(Path(folder) / "memory.db", range(2)):
                times.append(time.perf_counter())
    waking, first, second = times
    return first - waking, second - first


def killed(path: Path, start: int, lessons: int, seconds: float) -> list[str]:
    """What a robot had said it learned, killed so long after so many lessons."""
    telling, acknowledging = os.pipe()
    child = os.fork()
    if child == 0:
        teaching(path, start, acknowledging)
    os.close(acknowledging)
    with os.fdopen(telling, "rb") as told:
        things = [told.readline() for _ in range(lessons)]
        time.sleep(seconds)
        os.kill(child, signal.SIGKILL)
        things += told.readlines()
    _, status = os.waitpid(child, 0)
    if not os.WIFSIGNALED(status):
        raise RuntimeError("a robot ended before it was killed")
    return [it.decode().strip() for it in things]


def teaching(path: Path, start: int, acknowledging: int) -> NoReturn:
    """What the child does; it never comes back from here."""
    try:
        for thing in teach(path, count(start)):
            os.write(acknowledging, f"{thing}\n".encode())
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(1)


def whole(memory: MemoryReader, key: int, said: Set[tuple[int, int]]) -> bool:
    """Is all there of a lesson: features, traits, picture, and the robot's answer?"""
    lesson = memory.lesson(key)
    picture = lesson.seen.picture
    if not isinstance(lesson.seen, Sighting) or picture is None or picture.crop is None:
        return False
    _, region = restored(picture.crop)
    features = sum(len(scan.descriptors) for scan in lesson.seen.scans)
    answer = lesson.turn.dialogue, lesson.turn.number + 1
    parts = features, lesson.seen.traits, region.mask.any(), answer in said
    return all(map(bool, parts))


def examined(path: Path, acknowledged: Counter[str], outcome: Outcome) -> None:
    """Look through a memory after its last kill."""
    with Memory.reading(path) as memory:
        lessons = memory.lessons()
        said = {(it.dialogue, it.number) for it in memory.turns()}
        outcome.halved += sum(not whole(memory, it.key, said) for it in lessons)
    kept = Counter(it.word.name for it in lessons)
    outcome.kept += len(lessons)
    outcome.acknowledged += acknowledged.total()
    outcome.lost += (acknowledged - kept).total()


def kill_often(kills: int, seed: int, told: Callable[[int], None]) -> Outcome:
    """Kill so many robots, and tell after each how many there were."""
    chance, outcome = random.Random(seed), Outcome()
    first, later = lesson_seconds()
    while outcome.kills < kills:
        with tempfile.TemporaryDirectory() as folder:
            path, acknowledged = Path(folder) / "memory.db", Counter[str]()
            for _ in range(min(OF_ONE_FILE, kills - outcome.kills)):
                lessons = chance.randint(0, LIFE)
                seconds = chance.uniform(0, later if lessons else first)
                learned = killed(path, outcome.kills, lessons, seconds)
                acknowledged.update(learned)
                outcome.kills += 1
                outcome.idle += not learned
                outcome.unreadable += path.exists() and not readable(path)
                told(outcome.kills)
            if path.exists():
                examined(path, acknowledged, outcome)
    return outcome


def readable(path: Path) -> bool:
    """Does the file open, with its tables and pages in order?"""
    try:
        with Memory.reading(path) as memory:
            memory.lessons()
    except MemoryFileError as error:
        print(error, file=sys.stderr)
        return False
    return True


def on_terminal(kills: int) -> None:
    if sys.stderr.isatty():
        print(f"\r{kills} killed", end="", file=sys.stderr, flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--kills", type=int, default=1000, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    outcome = kill_often(options.kills, options.seed, on_terminal)
    facts = asdict(outcome) | {"holds": outcome.holds}
    if options.json:
        print(json.dumps(facts))
    else:
        print("  ".join(f"{what} {found}" for what, found in facts.items()))
    return 0 if outcome.holds else 1


if __name__ == "__main__":
    sys.exit(main())
