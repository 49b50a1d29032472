"""How benchmarks measure: medians of runs, growth, and limits that hold or not."""

from __future__ import annotations

import argparse
import gc
import json
import math
import statistics
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

RUNS = 7
ROUND = 0.02
"""A run lasts at least so many seconds: short tasks are repeated in it."""

GROWTH = 1.15
"""How much the time may grow between two sizes."""

Task = Callable[[], object]
Clock = Callable[[], float]


@dataclass(frozen=True)
class Measure:
    """What is measured: how to make the task for n, for which n, and what it may take.

    `limits` are milliseconds for an n. `grows` are the sizes between which its growth
    has a limit.
    """

    make: Callable[[int], Task]
    sizes: tuple[int, ...]
    limits: Mapping[int, float] = field(default_factory=dict)
    grows: tuple[int, int] | None = None


Measures = Mapping[str, Mapping[str, Measure]]
"""By section and by task."""


def milliseconds(task: Task, clock: Clock) -> float:
    """The median time of one call."""
    calls = 1
    while seconds(task, calls, clock) < ROUND:
        calls *= 2
    times = [seconds(task, calls, clock) / calls for _ in range(RUNS)]
    return 1000 * statistics.median(times)


def seconds(task: Task, calls: int, clock: Clock) -> float:
    gc.collect()
    gc.disable()
    start = clock()
    for _ in range(calls):
        task()
    spent = clock() - start
    gc.enable()
    return spent


@dataclass(frozen=True)
class Result:
    """The milliseconds for each n, and the limits with what was found."""

    section: str
    task: str
    times: Mapping[int, float]
    limits: tuple[tuple[str, float, float], ...]
    """For each limit what it is of, the limit, and what was found."""

    def facts(self) -> dict[str, object]:
        return {
            "section": self.section,
            "task": self.task,
            "milliseconds": {str(n): round(t, 5) for n, t in self.times.items()},
            "limits": [
                {"of": what, "limit": most, "found": found, "holds": found <= most}
                for what, most, found in self.limits
            ],
        }


def measure_task(section: str, task: str, it: Measure, clock: Clock) -> Result:
    times = {n: milliseconds(it.make(n), clock) for n in it.sizes}
    limits = [(f"n = {n:,}", most, times[n]) for n, most in it.limits.items()]
    if it.grows:
        least, most = it.grows
        steps = math.log(most / least)
        limits.append(("growth", GROWTH, math.log(times[most] / times[least]) / steps))
    return Result(section, task, times, tuple(limits))


def results(measures: Measures, clock: str) -> Iterator[Result]:
    for section, tasks in measures.items():
        for task, it in tasks.items():
            yield measure_task(section, task, it, getattr(time, clock))


# --- telling -------------------------------------------------------------------------


def table_lines(found: Iterable[Result]) -> Iterator[str]:
    """The results as a table, line by line."""
    section = ""
    for one in found:
        if one.section != section:
            section = one.section
            sizes = "".join(f"{n:>9,}" if n > 1 else "" for n in one.times)
            yield f"\n{section + ', ms':<34}{sizes}"
        times = "".join(map(cell, one.times.values()))
        limits = "; ".join(map(limit_told, one.limits))
        yield f"  {one.task:<32}{times:<54}  {limits}".rstrip()


def cell(time: float) -> str:
    return f"{time:>9,.0f}" if time >= 1000 else f"{time:>9.3g}"


def limit_told(limit: tuple[str, float, float]) -> str:
    what, most, found = limit
    verdict = "holds" if found <= most else "MISSED"
    shown = f" is {found:.2f}" if what == "growth" else ""
    return f"{what}{shown} <= {most:g} {verdict}"


def arguments(doc: str) -> argparse.ArgumentParser:
    """The options that every benchmark has."""
    parser = argparse.ArgumentParser(description=doc.split("\n")[0])
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    parser.add_argument("--cpu", action="store_true", help="count time of the process")
    return parser


def clock_of(options: argparse.Namespace) -> str:
    return "process_time" if options.cpu else "perf_counter"


def report(found: Iterable[Result], options: argparse.Namespace) -> None:
    """Print the results, as a table line by line or as JSON."""
    if options.json:
        facts = [one.facts() for one in found]
        print(json.dumps({"clock": clock_of(options), "results": facts}))
        return
    for line in table_lines(found):
        print(line, flush=True)
