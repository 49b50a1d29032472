"""How fast the core of `ttr` is, and how it grows with the size of types and models.

    python benchmarks/ttr_core.py [--json] [--cpu]

Record types have n fields, half of them ptypes over earlier fields. A time is the
median of several runs in milliseconds, the garbage collector off as in timeit; growth
is the exponent k where it goes with n to the k, 1 where twice the size takes twice the
time. `--cpu` counts what this process used instead of the clock, for busy machines.
"""

from __future__ import annotations

import argparse
import gc
import json
import math
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

from ttr import (
    EventString,
    Ind,
    ListOf,
    Model,
    Plus,
    Pred,
    PType,
    Record,
    RecordType,
    Str,
    Theory,
    fun,
    merge,
    rectype,
    subtype,
    this,
)

FIELDS = (5, 20, 80, 320, 1280, 5000)
COUNTS = (10, 100, 1_000, 10_000, 100_000)
RUNS = 7
ROUND = 0.02
"""A run lasts at least so many seconds: short tasks are repeated in it."""

GROWTH = 1.15
"""How much the time may grow between the sizes of `GROWS`."""

GROWS = (320, 5000)

p = Pred("p", Ind)
Task = Callable[[], object]
Clock = Callable[[], float]


@dataclass(frozen=True)
class Measure:
    """What is measured: how to make the task for n, for which n, and what it may take.

    `limits` are milliseconds for an n. `grows` says whether its growth has a limit.
    """

    make: Callable[[int], Task]
    sizes: tuple[int, ...] = FIELDS
    limits: Mapping[int, float] = field(default_factory=dict)
    grows: tuple[int, int] | None = None


# --- record types of n fields --------------------------------------------------------


def type_of(n: int, extra: str = "") -> RecordType:
    individuals = {f"x{extra}{i}": Ind for i in range(n // 2)}
    paths = {label: this[label] for label in individuals}
    events = {f"c{label}": p(path) for label, path in paths.items()}
    rest = {"z": Ind} if n % 2 else {}
    return rectype({**individuals, **events, **rest})


def halves(n: int) -> tuple[RecordType, RecordType]:
    """Two types of n fields that share half of their labels."""
    shared = dict(type_of(n // 2).fields)
    one, other = (dict(type_of(n - len(shared), extra).fields) for extra in "ab")
    return rectype({**shared, **one}), rectype({**shared, **other})


def witness(n: int) -> tuple[RecordType, Record, Model]:
    T = type_of(n)
    r, M = Model().create(T)
    assert isinstance(r, Record)
    assert M.judge(r, T).holds
    return T, r, M


def build(n: int) -> Task:
    return lambda: type_of(n)


def judge(n: int) -> Task:
    T, r, M = witness(n)
    return lambda: M.judge(r, T)


def judge_degrees(n: int) -> Task:
    T, r, M = witness(n)
    for label in T:
        if label.startswith("c"):
            M = M.given(r[label], p(r[label[1:]]), 0.9)
    assert M.judge(r, T).p.hi < 1
    return lambda: M.judge(r, T)


def judge_meet(n: int) -> Task:
    S, T = halves(n)
    r, M = Model().create(merge(S, T))
    both = S & T
    assert M.judge(r, both).holds
    return lambda: M.judge(r, both)


def below(n: int) -> Task:
    T = type_of(n)
    S = rectype({**dict(T.fields), "y": Ind})
    assert subtype(S, T).yes
    return lambda: subtype(S, T)


def not_below(n: int) -> Task:
    T = type_of(n)
    S = rectype({**dict(T.fields), "y": Ind})
    assert subtype(T, S).no
    return lambda: subtype(T, S)


def merging(n: int) -> Task:
    S, T = halves(n)
    merged = merge(S, T)
    assert isinstance(merged, RecordType)
    assert set(merged) == {*S, *T}
    return lambda: merge(S, T)


def create(n: int) -> Task:
    T = type_of(n)
    return lambda: Model().create(T)


def given(n: int) -> Task:
    T, r, _ = witness(n)
    return lambda: Model().given(r, T)


def apply(n: int) -> Task:
    T, r, M = witness(n)
    f = fun(r=T)(p(this.r.x0))
    assert M.apply(f, r) is p(r["x0"])
    return lambda: M.apply(f, r)


def printing(n: int) -> Task:
    T = type_of(n)
    return lambda: str(T)


def parsing(n: int) -> Task:
    T = type_of(n)
    theory, text = Theory.of(T), str(T)
    assert theory.parse(text) is T
    return lambda: theory.parse(text)


def reading(n: int) -> Task:
    statements = [f"T{i} := [x : Ind, c : p(x)]" for i in range(n)]
    text = "\n".join(("basic Ind", "pred p(Ind)", *statements))
    assert len(Theory.parse(text).definitions) == n
    return lambda: Theory.parse(text)


# --- models, lists, strings and theories of n ----------------------------------------


def individuals(n: int) -> tuple[list[str], Model]:
    names, M = [f"a{i}" for i in range(n)], Model()
    for name in names:
        M = M.given(name, Ind)
    return names, M


def one_fact_more(n: int) -> Task:
    M = Model()
    for i in range(n):
        M = M.given(f"s{i}", p(f"a{i % 1000}"))
    return lambda: M.given("new", p("a"))


def one_of_many(n: int) -> Task:
    names, M = individuals(n)
    known = names[n // 2]
    assert M.judge(known, Ind).holds
    return lambda: M.judge(known, Ind)


def long_list(n: int) -> Task:
    names, M = individuals(n)
    T, several = ListOf(Ind), tuple(names)
    assert M.judge(several, T).holds
    return lambda: M.judge(several, T)


def string_of(T: Plus, *kinds: PType) -> Callable[[int], Task]:
    """Judging a string of n events, of the kinds in turn, to be of T."""

    def made(n: int) -> Task:
        M = Model()
        for i in range(n):
            M = M.given(f"e{i}", kinds[i % len(kinds)])
        several = EventString(*(f"e{i}" for i in range(n)))
        assert M.judge(several, T).holds
        return lambda: M.judge(several, T)

    return made


run_a, run_b = p("a"), p("b")
every = Plus(run_a)
one_or_two = Plus(Str(run_a) | Str(run_a, run_b))

# --- one thing -----------------------------------------------------------------------


def new_node(_: int) -> Task:
    return lambda: p("an object")


def known_node(_: int) -> Task:
    kept = p("an object")
    return lambda: p("an object") is kept


def import_ttr(clock: str) -> float:
    """The milliseconds that `import ttr` takes in a fresh process."""
    program = f"import time; t = time.{clock}(); import ttr; print(time.{clock}() - t)"
    command = [sys.executable, "-c", program]
    times = [float(subprocess.check_output(command)) for _ in range(RUNS)]
    return 1000 * statistics.median(times)


MEASURES: Mapping[str, Mapping[str, Measure]] = {
    "record types of n fields": {
        "build": Measure(build),
        "judge a record": Measure(judge, limits={320: 5}, grows=GROWS),
        "judge with degrees": Measure(judge_degrees, grows=GROWS),
        "judge against a meet": Measure(judge_meet, limits={320: 8}, grows=GROWS),
        "subtype, yes": Measure(below, limits={320: 5}, grows=GROWS),
        "subtype, no": Measure(not_below, limits={320: 5}, grows=GROWS),
        "merge, half shared": Measure(merging, limits={320: 3}, grows=GROWS),
        "create a witness": Measure(create, limits={320: 5}, grows=GROWS),
        "give a record": Measure(given, grows=GROWS),
        "apply, checked": Measure(apply, limits={320: 5}, grows=GROWS),
        "print": Measure(printing, limits={320: 5}),
        "parse": Measure(parsing, limits={320: 60}),
    },
    "models, lists, strings and theories of n": {
        "read a theory": Measure(reading, COUNTS[:4], {1_000: 1200}, (1_000, 10_000)),
        "one fact more": Measure(one_fact_more, COUNTS, {100_000: 0.05}),
        "is a known witness": Measure(one_of_many, COUNTS, {100_000: 0.01}),
        "judge a list": Measure(long_list, COUNTS),
        "judge plus(T)": Measure(
            string_of(Plus(run_a), run_a), COUNTS[:4], {10_000: 100}
        ),
        "judge plus(S \\/ T)": Measure(
            string_of(one_or_two, run_a, run_b), COUNTS[:4], {10_000: 100}
        ),
    },
    "one thing": {
        "build a new node": Measure(new_node, (1,), {1: 0.003}),
        "build a known node": Measure(known_node, (1,), {1: 0.003}),
    },
}


# --- measuring -----------------------------------------------------------------------


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


def measured(section: str, task: str, it: Measure, clock: Clock) -> Result:
    times = {n: milliseconds(it.make(n), clock) for n in it.sizes}
    limits = [(f"n = {n:,}", most, times[n]) for n, most in it.limits.items()]
    if it.grows:
        least, most = it.grows
        steps = math.log(most / least)
        limits.append(("growth", GROWTH, math.log(times[most] / times[least]) / steps))
    return Result(section, task, times, tuple(limits))


def results(clock: str) -> Iterator[Result]:
    for section, measures in MEASURES.items():
        for task, it in measures.items():
            yield measured(section, task, it, getattr(time, clock))
    once = import_ttr(clock)
    yield Result("one thing", "import ttr", {1: once}, (("n = 1", 150, once),))


# --- telling -------------------------------------------------------------------------


def told(found: Iterator[Result]) -> Iterator[str]:
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


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    parser.add_argument("--cpu", action="store_true", help="count time of the process")
    arguments = parser.parse_args()
    clock = "process_time" if arguments.cpu else "perf_counter"
    if arguments.json:
        found = [one.facts() for one in results(clock)]
        print(json.dumps({"clock": clock, "results": found}))
        return
    for line in told(results(clock)):
        print(line, flush=True)


if __name__ == "__main__":
    main()
