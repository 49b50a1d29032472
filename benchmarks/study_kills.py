"""Is a study whole in the end, however often `kille experiment run` gets a kill -9?

    python benchmarks/study_kills.py [--kills N] [--seed N] [--json]

A study is run by two workers, and killed at a moment drawn at random: some dialogues
and a part of one after it was begun, or at any time until its report is written. Killed
are the command itself, one worker, the process that forks them, or all at once, and in
the end always the command. After every kill, what was over before must still be over,
and no process may be left. The command is run again until the study is over; then its
tables must be the same bytes as those of one process that nobody disturbed.

Exit code 1 if a dialogue is lost or differs, or anything is left behind.
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
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import NoReturn

import cv2

from kille.interfaces.cli import main as kille
from kille.lab import log
from kille.lab.errors import StudyError

STUDY = """
title = "What is killed goes on"
seeds = 30
theories.driven.mode = "driven"
theories.assisted.mode = "assisted"
tutors.Ann.kind = "simulated"
scenes.table.kind = "drawn"
phases = [
    { name = "lessons", do = "teach", what = "nouns" },
    { name = "test", do = "ask", what = "nouns" },
]
"""
TABLES = "runs.csv", "turns.csv", "answers.csv"
VICTIMS = ("command", "command", "command", "worker", "forking", "all")
LIFE = 5
"""How many dialogues may be over, at most, before the moment of a kill begins."""
DIALOGUES = 60
AT_ANY_TIME = 0.2
"""The share of kills at any time from when the study was begun."""
MARK = "KILLED_STUDY"
PATIENCE = 60.0
"""Seconds in which what should end has ended, on a busy machine."""


@dataclass
class Outcome:
    """What came of so many kills."""

    kills: int = 0
    studies: int = 0
    """How many studies were run to their end."""
    dialogues: int = 0
    over: int = 0
    """How many dialogues were over just before a kill, in total."""
    lost: int = 0
    """Dialogues that were over before a kill, and not after it."""
    broken: int = 0
    differing: int = 0
    """Studies whose tables are not those of a run that nobody disturbed."""
    unreadable: int = 0
    left_behind: int = 0
    """Kills after which a process or a file in the folder for such was left."""

    @property
    def holds(self) -> bool:
        """Is nothing lost, damaged or left behind?"""
        wrong = (self.lost, self.broken, self.differing, self.unreadable)
        return not any((*wrong, self.left_behind))


def running(folder: Path, workers: int) -> int:
    """A process that runs the study in a folder, as the command does."""
    process = os.fork()
    if process:
        return process
    run(folder, workers)


def run(folder: Path, workers: int) -> NoReturn:
    """What the child does; it never comes back from here."""
    code = 70
    try:
        os.environ |= {"TMPDIR": str(folder / "tmp"), MARK: str(folder)}
        out = os.open(folder / "out", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
        os.dup2(out, 1)
        os.dup2(out, 2)
        study, results = folder / "study.toml", folder / "results"
        words = ("experiment", "run", study, "--out", results, "--workers", workers)
        code = kille([str(it) for it in words])
    finally:
        os._exit(code)


def prepare_study(folder: Path) -> Path:
    """A folder with a study that was not run yet."""
    (folder / "tmp").mkdir(parents=True)
    (folder / "study.toml").write_text(STUDY)
    return folder


def tables(folder: Path) -> list[bytes]:
    """The tables of a study, whose bytes do not differ each time."""
    return [(folder / "results" / name).read_bytes() for name in TABLES]


def over(folder: Path) -> set[str]:
    """The dialogues that are over, as any other program can read them.

    A log whose tables are just being made has none.
    """
    with suppress(StudyError):
        return {str(it.run) for it in log.outcomes(folder / "results")}
    return set()


def workers_of(folder: Path) -> list[int]:
    """The process that forks workers for a study in a folder, and then the workers."""
    return sorted(_marked_processes(f"{MARK}={folder}".encode()))


def _marked_processes(mark: bytes) -> Iterator[int]:
    for it in Path("/proc").glob("[0-9]*/environ"):
        with suppress(OSError):
            if mark in it.read_bytes().split(b"\0"):
                yield int(it.parent.name)


def kill(victim: str, command: int, others: list[int]) -> bool:
    """Kills it if it is there; was it?"""
    victims = {
        "command": [command],
        "forking": others[:1],
        "worker": others[1:2],
        "all": [command, *others],
    }[victim]
    for process in victims:
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    return bool(victims)


def has_ended(process: int) -> bool:
    """Has a child ended? It is not forgotten by this."""
    how = os.WEXITED | os.WNOHANG | os.WNOWAIT
    return os.waitid(os.P_PID, process, how) is not None


def until(happened: Callable[[], object]) -> bool:
    """Waits until it has happened; did it, in time?"""
    end = time.monotonic() + PATIENCE
    while not happened():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


def disturb(
    folder: Path, chance: random.Random, seconds: float, outcome: Outcome
) -> bool:
    """Runs the study and kills once or twice; is it over?"""
    before, command = over(folder), running(folder, 2)
    try:
        for victim in (chance.choice(VICTIMS), "command"):
            wait_some(folder, chance, seconds, command)
            if has_ended(command):
                break
            before = over(folder)
            if kill(victim, command, workers_of(folder)):
                outcome.kills += 1
                outcome.over += len(before)
            if victim in ("command", "all"):
                break
    except KeyboardInterrupt:
        os.kill(command, signal.SIGKILL)
        os.waitpid(command, 0)
        raise
    _, status = os.waitpid(command, 0)
    left = not until(lambda: not workers_of(folder))
    outcome.left_behind += left or any((folder / "tmp").iterdir())
    outcome.lost += len(before - over(folder))
    return os.waitstatus_to_exitcode(status) == 0


def wait_some(
    folder: Path, chance: random.Random, seconds: float, command: int
) -> None:
    """Waits for some more dialogues and a part of one, or any time up to `seconds`."""
    results, part = folder / "results", chance.uniform(0, seconds)
    if chance.random() < AT_ANY_TIME:
        count = 0
    else:
        count = count_dialogues(results) + chance.randint(1, LIFE)
        part /= DIALOGUES
    until(lambda: has_ended(command) or count_dialogues(results) >= count)
    end = time.monotonic() + part
    until(lambda: has_ended(command) or time.monotonic() >= end)


def count_dialogues(results: Path) -> int:
    """How many dialogues are over."""
    with suppress(StudyError):
        return log.count_outcomes(results)
    return 0


def kill_often(kills: int, seed: int, outcome: Outcome) -> None:
    """Kills so often, and notes what came of it."""
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        undisturbed = prepare_study(Path(name, "undisturbed"))
        os.waitpid(running(undisturbed, 1), 0)
        start = time.monotonic()
        os.waitpid(running(prepare_study(Path(name, "timed")), 2), 0)
        seconds = time.monotonic() - start
        while outcome.kills < kills:
            folder = prepare_study(Path(name, str(outcome.studies)))
            try:
                while not disturb(folder, chance, seconds, outcome):
                    on_terminal(outcome)
                outcome.broken += len(log.broken_runs(folder / "results"))
                outcome.dialogues += len(over(folder))
                outcome.differing += tables(folder) != tables(undisturbed)
            except StudyError as error:
                print(error, file=sys.stderr)
                outcome.unreadable += 1
            outcome.studies += 1
            on_terminal(outcome)


def on_terminal(outcome: Outcome) -> None:
    if sys.stderr.isatty():
        print(f"\r{outcome.kills} killed", end="", file=sys.stderr, flush=True)


def _interrupt(_number: int, _frame: object) -> NoReturn:
    raise KeyboardInterrupt


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--kills", type=int, default=1000, metavar="N")
    parser.add_argument("--seed", type=int, default=1, metavar="N")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    for number in (signal.SIGINT, signal.SIGTERM):  # a background job ignores SIGINT
        signal.signal(number, _interrupt)
    outcome = Outcome()
    with suppress(KeyboardInterrupt):  # then it prints what came of it so far
        kill_often(options.kills, options.seed, outcome)
    facts = asdict(outcome) | {"holds": outcome.holds}
    if options.json:
        print(json.dumps(facts))
    else:
        print("  ".join(f"{what} {found}" for what, found in facts.items()))
    return 0 if outcome.holds else 1


if __name__ == "__main__":
    sys.exit(main())
