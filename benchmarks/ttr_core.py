"""How fast the core of `ttr` is, and how it grows with the size of types and models.

    python benchmarks/ttr_core.py [--json] [--cpu]

Record types have n fields, half of them ptypes over earlier fields. A time is the
median of several runs in milliseconds, the garbage collector off as in timeit; growth
is the exponent k where it goes with n to the k, 1 where twice the size takes twice the
time. `--cpu` counts what this process used instead of the clock, for busy machines.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
from collections.abc import Callable, Iterator

from _measuring import (
    RUNS,
    Measure,
    Measures,
    Result,
    Task,
    arguments,
    clock_of,
    report,
    results,
)

from ttr import (
    Ind,
    ListOf,
    Model,
    Plus,
    Pred,
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
from ttr.types import EventString, PType

FIELDS = (5, 20, 80, 320, 1280, 5000)
COUNTS = (10, 100, 1_000, 10_000, 100_000)
GROWS = (320, 5000)

p = Pred("p", Ind)
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


def giving_task(n: int) -> Task:
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


MEASURES: Measures = {
    "record types of n fields": {
        "build": Measure(build, FIELDS),
        "judge a record": Measure(judge, FIELDS, limits={320: 5}, grows=GROWS),
        "judge with degrees": Measure(judge_degrees, FIELDS, grows=GROWS),
        "judge against a meet": Measure(
            judge_meet, FIELDS, limits={320: 8}, grows=GROWS
        ),
        "subtype, yes": Measure(below, FIELDS, limits={320: 5}, grows=GROWS),
        "subtype, no": Measure(not_below, FIELDS, limits={320: 5}, grows=GROWS),
        "merge, half shared": Measure(merging, FIELDS, limits={320: 3}, grows=GROWS),
        "create a witness": Measure(create, FIELDS, limits={320: 5}, grows=GROWS),
        "give a record": Measure(giving_task, FIELDS, grows=GROWS),
        "apply, checked": Measure(apply, FIELDS, limits={320: 5}, grows=GROWS),
        "print": Measure(printing, FIELDS, limits={320: 5}),
        "parse": Measure(parsing, FIELDS, limits={320: 60}),
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


def core_results(clock: str) -> Iterator[Result]:
    yield from results(MEASURES, clock)
    once = import_ttr(clock)
    yield Result("one thing", "import ttr", {1: once}, (("n = 1", 150, once),))


def main() -> None:
    options = arguments(__doc__ or "").parse_args()
    report(core_results(clock_of(options)), options)


if __name__ == "__main__":
    main()
