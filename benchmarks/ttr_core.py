"""How the core of `ttr` grows with the size of types and models.

    python benchmarks/ttr_core.py [--json]

Record types have n fields, half of them ptypes over earlier fields. A time is the
median of several runs; growth is the exponent of the last step, 1 where twice the
size takes twice the time.
"""

from __future__ import annotations

import argparse
import gc
import json
import math
import statistics
import time
from collections.abc import Callable

from ttr import Ind, Model, Pred, Record, RecordType, merge, rectype, subtype, this

SIZES = (5, 20, 80, 320, 1280)
MODEL_SIZES = (1_000, 10_000, 100_000)
RUNS = 7
ROUND = 0.02
"""A run lasts at least so many seconds: short tasks are repeated in it."""

p = Pred("p", Ind)


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
    assert M.judge(r, T).holds
    return T, r, M


def build(n: int) -> Callable[[], object]:
    return lambda: type_of(n)


def judge(n: int) -> Callable[[], object]:
    T, r, M = witness(n)
    return lambda: M.judge(r, T)


def judge_degrees(n: int) -> Callable[[], object]:
    T, r, M = witness(n)
    for label in T:
        if label.startswith("c"):
            M = M.given(r[label], p(r[label[1:]]), 0.9)
    assert M.judge(r, T).p.hi < 1 or n < 2
    return lambda: M.judge(r, T)


def below(n: int) -> Callable[[], object]:
    T = type_of(n)
    S = rectype({**dict(T.fields), "y": Ind})
    assert subtype(S, T).yes
    return lambda: subtype(S, T)


def merging(n: int) -> Callable[[], object]:
    S, T = halves(n)
    assert set(merge(S, T).labels) == {*S, *T}
    return lambda: merge(S, T)


def create(n: int) -> Callable[[], object]:
    T = type_of(n)
    return lambda: Model().create(T)


def given(n: int) -> Callable[[], object]:
    T, r, _ = witness(n)
    return lambda: Model().given(r, T)


def one_fact_more(n: int) -> Callable[[], object]:
    M = Model()
    for i in range(n):
        M = M.given(f"s{i}", p(f"a{i % 1000}"))
    return lambda: M.given("new", p("a"))


def one_question(n: int) -> Callable[[], object]:
    M = Model()
    for i in range(n):
        M = M.given(f"s{i}", p(f"a{i % 1000}"))
    sit, T = f"s{n // 2}", p(f"a{n // 2 % 1000}")
    assert M.judge(sit, T).holds
    return lambda: M.judge(sit, T)


TASKS: dict[str, tuple[Callable[[int], Callable[[], object]], tuple[int, ...]]] = {
    "build a record type": (build, SIZES),
    "judge a record": (judge, SIZES),
    "judge with degrees": (judge_degrees, SIZES),
    "subtype": (below, SIZES),
    "merge, half shared": (merging, SIZES),
    "create a witness": (create, SIZES),
    "give a record": (given, SIZES),
    "one fact more": (one_fact_more, MODEL_SIZES),
    "one question": (one_question, MODEL_SIZES),
}


def milliseconds(task: Callable[[], object]) -> float:
    """The median time of one call, the garbage collector off as in timeit."""
    calls = 1
    while _seconds(task, calls) < ROUND:
        calls *= 2
    return 1000 * statistics.median(_seconds(task, calls) / calls for _ in range(RUNS))


def _seconds(task: Callable[[], object], calls: int) -> float:
    gc.collect()
    gc.disable()
    start = time.perf_counter()
    for _ in range(calls):
        task()
    spent = time.perf_counter() - start
    gc.enable()
    return spent


def measured(name: str) -> dict[str, object]:
    made, sizes = TASKS[name]
    times = [milliseconds(made(n)) for n in sizes]
    growth = math.log(times[-1] / times[-2]) / math.log(sizes[-1] / sizes[-2])
    return {
        "task": name,
        "milliseconds": {
            str(n): round(t, 5) for n, t in zip(sizes, times, strict=True)
        },
        "growth": round(growth, 2),
    }


def row(result: dict[str, object]) -> str:
    times: dict[str, float] = result["milliseconds"]  # type: ignore[assignment]
    cells = "".join(f"{n:>7}: {t:<9.4g}" for n, t in times.items())
    return f"{result['task']:<22}{cells:<85}n^{result['growth']}"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--json", action="store_true", help="print JSON, one object")
    arguments = parser.parse_args()
    if arguments.json:
        print(json.dumps({"results": [measured(name) for name in TASKS]}))
        return
    print("milliseconds for each n, and growth of the last step")
    for name in TASKS:
        print(row(measured(name)), flush=True)


if __name__ == "__main__":
    main()
