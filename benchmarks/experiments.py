"""How quickly studies are run, gone on with, and reported.

    python benchmarks/experiments.py [--dialogues N] [--rounds N] [--json]

A study of dialogues of 40 turns with simulated perception is played by two processes
and by one, in turns; medians are of the rounds, each ratio of one round. What the
runner itself takes is measured with dialogues that take no time. Exit code 1 where a
limit does not hold.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from statistics import median
from typing import NamedTuple

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.log import write_tables
from kille.lab.reports import report
from kille.lab.running_studies import Crew, alone, crew, run
from kille.lab.study import Run, Study
from kille.lab.study_files import parse

TURNS, THEORIES = 40, 2
STUDY = """
title = "How long dialogues take"
turns = 40
seeds = 1
theories.driven.mode = "driven"
theories.assisted.mode = "assisted"
tutors.Ann.kind = "simulated"
scenes.table.kind = "drawn"
phases = [
    { name = "lessons", do = "teach", what = "nouns" },
    { name = "places", do = "teach", what = "relations" },
    { name = "test", do = "ask", what = "nouns", of = "new" },
]
"""
IDLE = 1_000
"""So many dialogues that take no time are played."""


class Found(NamedTuple):
    """What was found, and between what it must be to hold."""

    what: str
    value: float
    unit: str
    most: float = float("inf")
    least: float = 0.0

    @property
    def holds(self) -> bool:
        return self.least <= self.value <= self.most


def study_of(dialogues: int) -> Study:
    seeds = tuple(range(1, dialogues // THEORIES + 1))
    return replace(parse(STUDY, Path("study.toml")), seeds=seeds)


def idle(study: Study, run: Run) -> Played:
    """A dialogue of as many turns and answers that takes no time."""
    degrees = {f"word {number}": 1 / number for number in range(1, 9)}
    turns = tuple(
        Turn(at, "lessons", "Ann", "instruct", "This is a cup.", "OK, I learned a cup.")
        for at in range(TURNS)
    )
    answers = tuple(
        Answer(at, "test", "noun", "cup", "cup", "assert", 0.5, degrees)
        for at in range(TURNS // 2)
    )
    return Played(turns, answers)


def seconds(task: Callable[[], object]) -> float:
    start = time.perf_counter()
    task()
    return time.perf_counter() - start


def measure_rounds(dialogues: int, rounds: int) -> Iterator[Found]:
    with tempfile.TemporaryDirectory() as folder:
        yield from overhead(Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        yield from throughput(dialogues, rounds, Path(folder))


def overhead(folder: Path) -> Iterator[Found]:
    """What the runner takes: all of the time, since the dialogues take none."""
    for name, by in (("one process", alone), ("two workers", crew(2))):
        spent = times_of(study_of(IDLE), folder / name, by, idle)
        each = 1000 * (spent[-1] - spent[1]) / (IDLE - 1)
        yield Found(f"overhead of a dialogue, {name}", each, "ms", most=5)
        yield Found(f"until the first is over, {name}", spent[1], "s")
    again = partial(run, study_of(IDLE), folder / "one process", idle)
    yield Found(f"going on when {IDLE:,} are over", seconds(again), "s", most=5)


def times_of(study: Study, folder: Path, by: Crew, play: object = None) -> list[float]:
    """When each dialogue was over, in seconds from the start."""
    start, times = time.perf_counter(), list[float]()

    def note_time(_: object) -> None:
        times.append(time.perf_counter() - start)

    run(study, folder, play, by, note_time)  # type: ignore[arg-type]
    return times


def throughput(dialogues: int, rounds: int, folder: Path) -> Iterator[Found]:
    study = study_of(dialogues)
    spent: dict[int, list[float]] = {2: [], 1: []}
    for number in range(rounds):
        for workers, times in spent.items():
            place = folder / f"{workers} {number}"
            times.append(seconds(partial(run, study, place, by=crew(workers))))
    for workers, times in spent.items():
        minutes = median(times) * 1000 / dialogues / 60
        what = f"1,000 dialogues of {TURNS} turns, {workers} at a time"
        yield Found(what, minutes, "min", most=10 if workers == 2 else float("inf"))
    ratios = [one / two for two, one in zip(spent[2], spent[1], strict=True)]
    yield Found("two workers as one", median(ratios), "times", least=1.7)
    place = folder / "2 0"
    yield Found(f"tables of {dialogues:,}", seconds(partial(write_tables, place)), "s")
    page = seconds(partial(report, place, command="benchmark"))
    yield Found(f"report of {dialogues:,}", page, "s", most=30)


def format_line(it: Found) -> str:
    limits = f"<= {it.most:g}" * (it.most < float("inf")) or f">= {it.least:g}"
    verdict = "holds" if it.holds else "MISSED"
    is_limited = it.most < float("inf") or it.least
    return f"{it.what:<48}{it.value:>9.3g} {it.unit:<6}" + (
        f"{limits} {verdict}" if is_limited else ""
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--dialogues", type=int, default=1000, metavar="N")
    parser.add_argument("--rounds", type=int, default=3, metavar="N")
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    options = parser.parse_args()
    all_found = []
    for it in measure_rounds(options.dialogues, options.rounds):
        all_found.append(it)
        if not options.json:
            print(format_line(it).rstrip(), flush=True)
    holds = all(it.holds for it in all_found)
    if options.json:
        facts = {it.what: {"value": it.value, "unit": it.unit} for it in all_found}
        print(json.dumps({"holds": holds, "found": facts}))
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
