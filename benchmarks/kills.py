"""Is what was said to be learned there, whatever the moment of a kill -9?

`--of robot`: a robot hears a tutor who teaches without end, as `kille talk` does: it
looks, learns, and answers. `--of talk`: the command itself does, reading the tutor's
lines from a file and printing its own into a pipe. It is killed at a moment drawn at
random: some lessons and a part of one after it woke. Then its file is read, with all
that was seen in every lesson, and the next robot goes on with the same memory, or after
some kills with a new one, so that the making of a file is met too. A lesson counts as
acknowledged when the robot's answer has left its process.

`--of import`: `kille memory import` adds a package of lessons to a memory with some,
and is killed at any moment from its start to its end. All lessons that were there must
be there and whole, and those of the package all or none; all, once the command said so.

Exit code 1 if anything is lost, halved or cannot be read.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Set
from dataclasses import asdict, dataclass
from functools import partial
from itertools import count, islice
from pathlib import Path
from typing import NoReturn

import cv2

from kille import Agent
from kille.interfaces import cli
from kille.interfaces.memory import moving  # noqa: F401  children have it loaded
from kille.interfaces.talk import talk  # noqa: F401
from kille.memory import Memory, MemoryFileError, MemoryReader, Sighting
from kille.memory.exporting import export
from kille.perception.thumbnails import restore_crop
from kille.sensors.synthetic import open_synthetic

THINGS = ("cup", "book", "car")
SENSOR = "synthetic:empty?seed=7&faults=none"
LIFE = 3
"""How many lessons a robot may have acknowledged when its last moment begins."""
OF_ONE_FILE = 20
"""Kills after which a new memory is begun."""
IN_PACKAGE = 40
"""Lessons of the package that is imported."""

ACKNOWLEDGEMENT = re.compile(
    r"(?:S> OK, I learned an? (.*)\.|.*(learned from .*), 0 known before|(\w+))\n"
)
"""What is said to be learned: by `kille talk`, by an import, by a robot."""

Child = Callable[[int], None]
"""What runs in a process of its own; it tells what it learned to this descriptor."""


@dataclass
class Outcome:
    """What came of so many kills."""

    kills: int = 0
    idle: int = 0
    """Kills before a lesson was acknowledged."""
    acknowledged: int = 0
    kept: int = 0
    """Lessons on file. One a kill may have been kept that was not yet acknowledged."""
    whole: int = 0
    """Imports that were killed when all of the package was on disk."""
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


def robot_teaching(path: Path, start: int) -> Child:
    """A robot that is taught by calls, and tells each thing that it learned."""

    def run(telling: int) -> None:
        for thing in teach(path, count(start)):
            os.write(telling, f"{thing}\n".encode())

    return run


def talk_teaching(path: Path, start: int) -> Child:
    """`kille talk` with more to hear than it will live for."""
    things = [THINGS[it % len(THINGS)] for it in range(start, start + 10 * LIFE)]
    script = "".join(f"@ show {it}\nThis is a {it}.\n" for it in things)
    return command_running(["talk", "--sensor", SENSOR, "--memory", str(path)], script)


def command_running(arguments: list[str], script: str = "") -> Child:
    """A command of kille that reads these lines and prints into the pipe."""

    def run(telling: int) -> None:
        with tempfile.TemporaryFile() as lines:
            lines.write(script.encode())
            lines.seek(0)
            os.dup2(lines.fileno(), 0)
        os.dup2(telling, 1)
        with (
            open(0, closefd=False) as sys.stdin,
            open(1, "w", closefd=False) as sys.stdout,
        ):
            code = cli.main(arguments)
        if code:
            raise RuntimeError(f"kille {arguments[0]} ended with {code}")

    return run


def kill_child(child: Child, lessons: int, seconds: float) -> tuple[list[str], bool]:
    """What a child had said it learned, killed so long after so many lessons.

    And whether it was over before it could be killed.
    """
    telling, acknowledging = os.pipe()
    sys.stdout.flush()
    process = os.fork()
    if process == 0:
        living(child, acknowledging)
    os.close(acknowledging)
    with os.fdopen(telling, "rb") as lines:
        said = map(acknowledgement, lines)
        things = list(islice(filter(None, said), lessons))
        time.sleep(seconds)
        os.kill(process, signal.SIGKILL)
        things += filter(None, said)
    _, status = os.waitpid(process, 0)
    over = not os.WIFSIGNALED(status)
    if over and os.waitstatus_to_exitcode(status):
        raise RuntimeError("a child failed before it was killed")
    return things, over


def living(child: Child, acknowledging: int) -> NoReturn:
    """What the child does; it never comes back from here."""
    code = 1
    try:
        child(acknowledging)
        code = 0
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(code)


def acknowledgement(line: bytes) -> str:
    """What a line says was learned; "" if it says no such thing, or is cut short."""
    found = ACKNOWLEDGEMENT.fullmatch(line.decode())
    return found[1] or found[2] or found[3] if found else ""


def whole(memory: MemoryReader, key: int, said: Set[tuple[int, int]]) -> bool:
    """Is all there of a lesson: features, traits, picture, and the robot's answer?"""
    lesson = memory.lesson(key)
    picture = lesson.seen.picture
    if not isinstance(lesson.seen, Sighting) or picture is None or picture.crop is None:
        return False
    _, region = restore_crop(picture.crop)
    features = sum(len(scan.descriptors) for scan in lesson.seen.scans)
    answer = lesson.turn.dialogue, lesson.turn.number + 1
    parts = features, lesson.seen.traits, region.mask.any(), answer in said
    return all(map(bool, parts))


def examine_memory(path: Path, acknowledged: Counter[str], outcome: Outcome) -> None:
    """Look through a memory after its last kill."""
    with Memory.reading(path) as memory:
        lessons = memory.lessons()
        said = {(it.dialogue, it.number) for it in memory.turns()}
        outcome.halved += sum(not whole(memory, it.key, said) for it in lessons)
    kept = Counter(it.word.name for it in lessons)
    outcome.kept += len(lessons)
    outcome.acknowledged += acknowledged.total()
    outcome.lost += (acknowledged - kept).total()


def kill_often(
    teaching: Callable[[Path, int], Child],
    kills: int,
    seed: int,
    told: Callable[[int], None],
) -> Outcome:
    """Kill so many of these, and tell after each how many there were."""
    chance, outcome = random.Random(seed), Outcome()
    first, later = lesson_seconds()
    while outcome.kills < kills:
        with tempfile.TemporaryDirectory() as folder:
            path, acknowledged = Path(folder) / "memory.db", Counter[str]()
            for _ in range(min(OF_ONE_FILE, kills - outcome.kills)):
                lessons = chance.randint(0, LIFE)
                seconds = chance.uniform(0, later if lessons else first)
                child = teaching(path, outcome.kills)
                learned, over = kill_child(child, lessons, seconds)
                if over:
                    raise RuntimeError("a robot ended before it was killed")
                acknowledged.update(learned)
                outcome.kills += 1
                outcome.idle += not learned
                outcome.unreadable += path.exists() and not readable(path)
                told(outcome.kills)
            if path.exists():
                examine_memory(path, acknowledged, outcome)
    return outcome


def kill_imports(kills: int, seed: int, told: Callable[[int], None]) -> Outcome:
    """Kill so many imports, and tell after each how many there were."""
    chance, outcome = random.Random(seed), Outcome()
    with tempfile.TemporaryDirectory() as folder:
        start, package = Path(folder) / "start.db", Path(folder) / "lessons.zip"
        path = Path(folder) / "memory.db"
        mine = list(teach(start, range(LIFE)))
        theirs = list(teach(path, range(IN_PACKAGE)))
        with Memory.reading(path) as memory:
            export(memory, package)
        importing = command_running(
            ["memory", "import", str(package), "--memory", str(path)]
        )
        shutil.copy(start, path)
        longest = 0.0
        for _ in range(3):
            shutil.copy(start, path)
            begun = time.perf_counter()
            kill_child(importing, 1, 0)
            longest = time.perf_counter() - begun
        shutil.copy(start, path)
        while outcome.kills < kills:
            # Most of an import is reading; half of the kills are meant for its end.
            earliest = chance.choice((0, 0.8 * longest))
            seconds = chance.uniform(earliest, 1.1 * longest)
            said, over = kill_child(importing, 0, seconds)
            if over:
                shutil.copy(start, path)
                continue
            outcome.kills += 1
            outcome.idle += not said
            outcome.unreadable += not readable(path)
            with Memory.reading(path) as memory:
                whole_import = len(memory.lessons()) > len(mine)
            expected = Counter(mine)
            if said or whole_import:
                expected.update(theirs)
            outcome.whole += whole_import
            examine_memory(path, expected, outcome)
            if whole_import or chance.random() < 1 / OF_ONE_FILE:
                for it in path.parent.glob("memory.db*"):
                    it.unlink()
                shutil.copy(start, path)
            told(outcome.kills)
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
    parser.add_argument("--of", choices=("robot", "talk", "import"), default="robot")
    parser.add_argument("--kills", type=int, default=1000, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    kill = {
        "robot": partial(kill_often, robot_teaching),
        "talk": partial(kill_often, talk_teaching),
        "import": kill_imports,
    }[options.of]
    outcome = kill(options.kills, options.seed, on_terminal)
    facts = asdict(outcome) | {"holds": outcome.holds}
    if options.json:
        print(json.dumps(facts))
    else:
        print("  ".join(f"{what} {found}" for what, found in facts.items()))
    return 0 if outcome.holds else 1


if __name__ == "__main__":
    sys.exit(main())
