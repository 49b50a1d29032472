"""How fast probability, quantifiers, strings and meanings that learn are in `ttr`.

    python benchmarks/ttr_theory.py [--json] [--cpu] [--queries N]

`--queries` asks random judgements for their probability, in random theories with
axioms, exclusions and conditionals, and counts intervals that are out of order;
1,000,000 take some fifteen minutes.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable

from _measuring import (
    Measure,
    Measures,
    Task,
    arguments,
    clock_of,
    report,
    results,
)

from ttr import (
    Basic,
    Ind,
    Model,
    Plus,
    Pred,
    Str,
    fun,
    join,
    meet,
    outer,
    record,
    rectype,
    this,
)
from ttr.errors import RefusedError
from ttr.semantics.perceptual import Perceptron, RealVector, meaning
from ttr.semantics.quantifiers import (
    Determiner,
    Extension,
    every,
    most,
    quantify,
    settle,
)
from ttr.signature.signature import Axiom, Exclusion, Signature
from ttr.types import EventString, TypeNode

FIELDS = (5, 20, 80, 320)
p, q = Pred("p", Ind), Pred("q", Ind)

# --- a record of n fields ------------------------------------------------------------


def judging_task(n: int, M: Model) -> Task:
    """Judging a record of n fields, half of them ptypes with an interval each."""
    labels = {f"x{i}": Ind for i in range(n // 2)}
    T = rectype({**labels, **{f"c{label}": p(this[label]) for label in labels}})
    values = {label: f"a{label}" for label in labels}
    for label, name in values.items():
        M = M.given(name, Ind).given(f"s{label}", p(name), (0.9, 0.99))
    r = record({**values, **{f"c{label}": f"s{label}" for label in values}})
    assert 0 < M.judge(r, T).p.lo < 1
    return lambda: M.judge(r, T)


def intervals(n: int) -> Task:
    return judging_task(n, Model())


def intervals_with_axioms(n: int) -> Task:
    axioms = (Axiom(q(this.x), p(this.x)),)
    return judging_task(n, Model(Signature(axioms=axioms)))


def intervals_along_conditionals(n: int) -> Task:
    """Each ptype depends on another one of the same individual."""
    M = Model()
    for i in range(n // 2):
        other = [(f"t{i}", q(f"ax{i}"))]
        M = M.given(*other[0], 0.5)
        M = M.given(f"sx{i}", p(f"ax{i}"), 0.8, when=other)
    labels = {f"x{i}": Ind for i in range(n // 2)}
    T = rectype({**labels, **{f"c{label}": p(this[label]) for label in labels}})
    for label in labels:
        M = M.given(f"a{label}", Ind)
    values = {label: f"a{label}" for label in labels}
    r = record({**values, **{f"c{label}": f"s{label}" for label in values}})
    assert 0 < M.judge(r, T).p.hi < 1
    return lambda: M.judge(r, T)


# --- extensions of n ------------------------------------------------------------------


def dogs(n: int) -> Extension:
    return Extension.of([f"d{i}" for i in range(n)], "dog")


def barking(n: int) -> Extension:
    """Half of the dogs, and as many cats."""
    cats = [f"c{i}" for i in range(n // 2)]
    return Extension.of([*[f"d{i}" for i in range(0, n, 2)], *cats], "bark")


def quantifying_task(q: Determiner) -> Callable[[int], Task]:
    """Quantifying over two known extensions of n."""

    def made(n: int) -> Task:
        P, Q = dogs(n), barking(n)
        assert not quantify(q, P, Q).holds
        return lambda: quantify(q, P, Q)

    return made


def settling_task(n: int) -> Task:
    """The same of a model, in which the extensions have to be found first."""
    dog, bark = Pred("dog", Ind), Pred("bark", Ind)
    M = Model()
    for i in range(n):
        M = M.given(f"a{i}", Ind).given(f"d{i}", dog(f"a{i}"))
        M = M.given(f"b{i}", bark(f"a{i}")) if i % 2 else M
    return lambda: settle(M, most(dog, bark))


# --- strings of n events --------------------------------------------------------------


def twenty_states(n: int) -> Task:
    """A string of n events against twenty places, ten of which may be doubled."""
    kinds = [p(f"k{i}") for i in range(20)]
    M = Model()
    for i in range(n):
        M = M.given(f"e{i}", kinds[i % 20])
    T = Plus(Str(*[kinds[i] | Str(kinds[i], kinds[i]) for i in range(10)], *kinds[10:]))
    events = EventString(*(f"e{i}" for i in range(n)))
    assert M.judge(events, T).holds
    return lambda: M.judge(events, T)


# --- one thing ------------------------------------------------------------------------


def correcting_task(_: int) -> Task:
    """One correction of Larsson's `right`, the learner's own cost included."""
    bg = rectype(foo=Ind, spkr=Ind, pos=RealVector)
    interp = fun(r=bg)(rectype(c=Pred("right", Ind)(outer.r.foo)))
    params = record(w=[0.8, 0.01], t=0.09)
    right = meaning(interp, Perceptron(), params, of="pos")
    seen = record(foo="o1", spkr="a", pos=[0.9, 0.1])
    return lambda: right.rejected(seen)


EXTENSIONS = (100, 1_000, 10_000)
EVENTS = (1_000, 10_000, 100_000)
GROWS = (10_000, 100_000)

MEASURES: Measures = {
    "a record of n fields": {
        "with intervals": Measure(intervals, FIELDS, {320: 10}),
        "with intervals and an axiom": Measure(
            intervals_with_axioms, FIELDS, {320: 10}
        ),
        "along conditionals": Measure(intervals_along_conditionals, FIELDS),
    },
    "extensions of n": {
        "most": Measure(quantifying_task(most), EXTENSIONS, {10_000: 10}),
        "every": Measure(quantifying_task(every), EXTENSIONS, {10_000: 10}),
        "most, of a model": Measure(settling_task, EXTENSIONS),
    },
    "strings of n events": {
        "a type of 20 states": Measure(twenty_states, EVENTS, {100_000: 500}, GROWS),
    },
    "one thing": {
        "correct a perceptron": Measure(correcting_task, (1,), {1: 0.05}),
    },
}


# --- random queries -------------------------------------------------------------------

KINDS = [Basic(name) for name in "ABCDEF"]
SEED = 2026


def random_model(chosen: random.Random) -> Model:
    """A model of one object whose judgements depend on one another."""
    M = Model(
        Signature(
            axioms=tuple(
                Axiom(*chosen.sample(KINDS, 2)) for _ in range(chosen.randint(0, 2))
            ),
            exclusions=tuple(
                Exclusion(*chosen.sample(KINDS, 2)) for _ in range(chosen.randint(0, 1))
            ),
        )
    )
    for _ in range(chosen.randint(0, 7)):
        T, S = chosen.sample(KINDS, 2)
        condition = [("a", chosen.choice((S, ~S)))] if chosen.random() < 0.25 else []
        ends = sorted((chosen.random(), chosen.random()))
        degree = ends[0] if chosen.random() < 0.6 else tuple(ends)
        try:
            M = M.given("a", T, degree, when=condition)
        except RefusedError:
            continue
    return M


def random_type(chosen: random.Random, depth: int = 0) -> TypeNode:
    if depth > 2 or chosen.random() < 0.35:
        return chosen.choice(KINDS)
    if chosen.random() < 0.25:
        return ~random_type(chosen, depth + 1)
    several = chosen.choice((meet, join))
    return several(random_type(chosen, depth + 1), random_type(chosen, depth + 1))


def random_queries(count: int) -> str:
    """So many random queries; how many intervals were out of order."""
    chosen, wrong, refused, done = random.Random(SEED), 0, 0, 0
    start = time.perf_counter()
    while done < count:
        M = random_model(chosen)
        for _ in range(20):
            T = random_type(chosen)
            when = [("a", random_type(chosen))] if chosen.random() < 0.3 else []
            done += 1
            try:
                lo, hi = M.judge("a", T, when=when).p
            except RefusedError:
                refused += 1
                continue
            wrong += not 0 <= lo <= hi <= 1
    seconds = time.perf_counter() - start
    return (
        f"{done:,} random queries in {seconds:,.0f} s: {wrong} intervals out of order, "
        f"{refused:,} under conditions that cannot be"
    )


def main() -> None:
    parser = arguments(__doc__ or "")
    parser.add_argument("--queries", type=int, metavar="N", help="only random queries")
    options = parser.parse_args()
    if options.queries:
        print(random_queries(options.queries))
        return
    report(results(MEASURES, clock_of(options)), options)


if __name__ == "__main__":
    main()
