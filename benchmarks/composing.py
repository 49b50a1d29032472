"""How fast meanings compose, and how fast what is small but combinatorial is decided.

    python benchmarks/composing.py [--json] [--cpu] [NAME …]

Each line is one question with the milliseconds that it may take. A time is the median
of several runs in one process; each run asks it of types or models that were made anew,
so that none is answered from what an earlier one left. Making them is not counted. An
answer that is not the right one is a failure, whatever it took.
"""

from __future__ import annotations

import gc
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count
from time import perf_counter

from _measuring import RUNS, Clock, Result, Task, arguments, clock_of, report

from ttr import (
    Basic,
    Ind,
    Model,
    Pred,
    Theory,
    consistent,
    join,
    meet,
    rectype,
    subtype,
    this,
)
from ttr.computing import equal, normal_form
from ttr.errors import TooLargeError
from ttr.safety.budgets import open_purse, within_budget
from ttr.types import TypeNode

PATIENCE = 20.0
"""Seconds after which no further run of a question is made."""

_numbers = count()


@dataclass(frozen=True)
class Question:
    """What is asked: how to make it anew, the right answer, and its milliseconds."""

    make: Callable[[], Task]
    answer: object
    limit: float


# --- types that double ---------------------------------------------------------------

TIMES = 40


def doubled_records() -> Task:
    leaf = f"A{next(_numbers)}"
    lines = [f"T{i + 1} := [l : T{i}, r : T{i}]" for i in range(TIMES)]
    theory = Theory.parse("\n".join([f"basic {leaf}", f"T0 := {leaf}", *lines]))
    T = theory.definitions[f"T{TIMES}"]
    return lambda: normal_form(T, theory) is T


def read_doubled_records() -> Task:
    leaf = f"A{next(_numbers)}"
    lines = [f"T{i + 1} := [l : T{i}, r : T{i}]" for i in range(TIMES)]
    text = "\n".join([f"basic {leaf}", f"T0 := {leaf}", *lines])
    return lambda: normal_form(Theory.parse(text).definitions[f"T{TIMES}"]) is not None


def doubling_theory(name: str) -> Theory:
    """A theory with a predicate of that name, and what doubles a type made of it."""
    functions = [
        f"F{i + 1} := \\v:Ind. [a : F{i}(v), b : F{i}(v)]" for i in range(TIMES)
    ]
    return Theory.parse(
        "\n".join(
            [
                f"basic Ind\npred {name}(Ind)\nobject j : Ind",
                f"Man := \\v:Ind. [e : {name}(v)]",
                f"F0 := \\v:Ind. [e : {name}(v)]",
                *functions,
                "D := \\P:(Ind -> RecType). \\v:Ind. [a : P(v), b : P(v)]",
            ]
        )
    )


def doubled_type(name: str) -> TypeNode:
    """What the doubled functions come to at j."""
    T: TypeNode = rectype(e=Pred(name, Ind)("j"))
    for _ in range(TIMES):
        T = rectype(a=T, b=T)
    return T


def repeat_application(outer: str, inner: str) -> str:
    for _ in range(TIMES):
        inner = f"{outer}({inner})"
    return inner


def normal_form_task(written: Callable[[str], str]) -> Callable[[], Task]:
    """The normal form of what is written over a predicate, against the type it is."""

    def make() -> Task:
        name = f"p{next(_numbers)}"
        theory = doubling_theory(name)
        T, wanted = theory.parse(written(name)), doubled_type(name)
        return lambda: normal_form(T, theory) is wanted

    return make


def asked_of_doubled(ask: Callable[[TypeNode, TypeNode, Theory], str]) -> Task:
    """A question about one doubled type written in two ways."""
    name = f"p{next(_numbers)}"
    theory = doubling_theory(name)
    one = theory.parse(f"F{TIMES}(j)")
    other = theory.parse(repeat_application("D", "Man") + "(j)")
    return lambda: ask(one, other, theory)


def print_doubled() -> Task:
    T = doubled_type(f"p{next(_numbers)}")

    def ask() -> str:
        try:
            return str(T)
        except TooLargeError:
            return "refused"

    return ask


# --- sentences -----------------------------------------------------------------------

NOUNS = [f"N{i}" for i in range(8)]
VERBS = [f"V{i}" for i in range(8)]
ADJECTIVES = [f"Q{i}" for i in range(8)]


def lexicon() -> Theory:
    lines = ["basic Ind", "object j : Ind"]
    for noun in NOUNS:
        lines += [
            f"pred {noun.lower()}(Ind)",
            f"{noun} := \\v:Ind. [e : {noun.lower()}(v)]",
        ]
    for verb in VERBS:
        lines += [
            f"pred {verb.lower()}(Ind, Ind)",
            f"{verb} := \\q:((Ind -> RecType) -> RecType). \\v:Ind. "
            f"q(\\w:Ind. [e : {verb.lower()}(v, w)])",
        ]
    for adjective in ADJECTIVES:
        lines += [
            f"pred {adjective.lower()}(Ind)",
            f"{adjective} := \\P:(Ind -> RecType). \\v:Ind. "
            f"merge(P(v), [{adjective.lower()} : {adjective.lower()}(v)])",
        ]
    return Theory.parse(
        "\n".join(
            [
                *lines,
                "Some := \\P:(Ind -> RecType). \\Q:(Ind -> RecType). "
                "[x : Ind, r : P(x), s : Q(x)]",
                "Every := \\P:(Ind -> RecType). \\Q:(Ind -> RecType). "
                "[f : ((x : Ind) -> (P(x) -> Q(x)))]",
            ]
        )
    )


_ENGLISH: list[Theory] = []


def ten_words() -> Task:
    """A sentence of ten words that was not composed before, with known words."""
    if not _ENGLISH:
        _ENGLISH.append(lexicon())
        for _ in range(5):
            ten_words()()
    (english,) = _ENGLISH
    n = next(_numbers)

    def word(words: list[str], place: int) -> str:
        return words[(n // 8**place + place) % 8]

    adjectives = [word(ADJECTIVES, place) for place in range(5)]
    noun, verb, other = word(NOUNS, 0), word(VERBS, 1), word(NOUNS, 2)
    a, b, c, d, e = adjectives
    sentence = f"Every({a}({b}({noun})))({verb}(Some({c}({d}({e}({other}))))))"
    assert sentence.count("(") == 9
    return lambda: str(normal_form(english.parse(sentence), english)).startswith("[f")


# --- joins and negations -------------------------------------------------------------


def atoms(letter: str, number: int) -> list[Basic]:
    return [Basic(f"{letter}{next(_numbers)}") for _ in range(number)]


def joins_below(number: int, what: str) -> Callable[[], Task]:
    def make() -> Task:
        As, Bs = atoms("A", number), atoms("B", number)
        J = meet(*[A | B for A, B in zip(As, Bs, strict=True)])
        denied = [~(A | ~B) for A, B in zip(As, Bs, strict=True)]
        (C,) = atoms("C", 1)
        above = {
            "themselves": meet(*[B | A | C for A, B in zip(As, Bs, strict=True)]),
            "a union": As[0] | join(*denied),
            "negations": join(*denied),
            "all cases": _in_all_cases(As, Bs),
            "another": meet(*[A | C for A in As]),
        }[what]
        return lambda: subtype(J, above).verdict

    return make


def _in_all_cases(As: list[Basic], Bs: list[Basic]) -> TypeNode:
    """Not all of the As and Bs, and one of each: what the joins come to, turned."""
    return join(meet(*As), *[A & B for A, B in zip(As, Bs, strict=True)], *Bs)


def joins_against_negations(number: int, possible: bool) -> Callable[[], Task]:
    """Joins against as many negations: one of each pair, and not both."""

    def make() -> Task:
        As, Bs = atoms("A", number), atoms("B", number)
        (C,) = atoms("C", 1)
        pairs = list(zip(As, Bs, strict=True))
        joins = [A | B for A, B in pairs]
        denied = [~(A & B) for A, B in pairs]
        if not possible:
            # Whichever of a pair it is, C follows; and C is denied.
            denied = [~((A | B) & ~C) for A, B in pairs[1:]]
            denied += [~(pairs[0][0] & C), ~(pairs[0][1] & C)]
        return lambda: consistent(*joins, *denied).verdict

    return make


def pigeons(holes: int) -> TypeNode:
    at = [atoms("P", holes) for _ in range(holes + 1)]
    alone = [
        ~one[h] | ~other[h]
        for h in range(holes)
        for i, one in enumerate(at)
        for other in at[:i]
    ]
    return meet(*[join(*row) for row in at], *alone)


def pigeons_below(holes: int) -> Callable[[], Task]:
    def make() -> Task:
        T, (C,) = pigeons(holes), atoms("C", 1)
        return lambda: subtype(T, C).verdict

    return make


def pigeons_consistent(holes: int) -> Callable[[], Task]:
    def make() -> Task:
        T = pigeons(holes)
        return lambda: consistent(T).verdict

    return make


# --- relations -----------------------------------------------------------------------

PEOPLE = 40


def cycle(length: int, there: bool) -> Callable[[], Task]:
    """Is a circle in a relation of so many, with a third of the pairs in it?"""

    def make() -> Task:
        r = Pred(f"r{next(_numbers)}", Ind, Ind)
        M = Model()
        for i in range(PEOPLE):
            M = M.given(f"a{i}", Ind)
        for i in range(PEOPLE):
            for j in range(i + 1, PEOPLE):
                if (i * 7 + j * 3) % 11 < 4:
                    M = M.given(f"e{i}_{j}", r(f"a{i}", f"a{j}"))
        if there:
            for i in range(length - 1):
                M = M.given(f"f{i}", r(f"a{30 + i}", f"a{31 + i}"))
            M = M.given("back", r(f"a{29 + length}", "a30"))
        labels = "xyzw"[:length]
        around = zip(labels, labels[1:] + labels[:1], strict=True)
        T = rectype(
            dict.fromkeys(labels, Ind)
            | {f"c{x}": r(this[x], this[y]) for x, y in around}
        )
        return lambda: str(M.true(T))

    return make


# --- what is uncertain ---------------------------------------------------------------

INDIVIDUALS, UNCERTAIN = 3, 10


def uncertain_individuals(linked: bool) -> tuple[Model, list[Basic]]:
    """Individuals of which each of some types is uncertain."""
    types = atoms("U", UNCERTAIN)
    M = Model()
    for i in range(INDIVIDUALS):
        for number, T in enumerate(types):
            sit = f"o{i}"
            p = (0.3, 0.8) if number % 2 else 0.5
            if linked and number:
                before = types[number - 1]
                M = M.given(sit, T, p, when=[(sit, before)])
                M = M.given(sit, T, 0.1, when=[(sit, ~before)])
            else:
                M = M.given(sit, T, p)
    return M, types


def chance_of(linked: bool) -> Callable[[], Task]:
    def make() -> Task:
        M, types = uncertain_individuals(linked)
        T = meet(*[one | ~other for one, other in zip(types[1:], types, strict=False)])
        if linked:
            T = meet(*types[1:7], ~types[8], types[9])
        return lambda: M.chance(T, when=types[0]).p.hi < 1.0

    return make


def some_of(linked: bool) -> Callable[[], Task]:
    def make() -> Task:
        M, types = uncertain_individuals(linked)
        T = meet(*[one | other for one, other in zip(types[1:], types, strict=False)])
        objects = [f"o{i}" for i in range(INDIVIDUALS)]
        return lambda: M.true(T, among=objects).hi < 1.0

    return make


QUESTIONS: dict[str, Question] = {
    "normal form of doubled records": Question(doubled_records, True, 50),
    "the same, with reading": Question(read_doubled_records, True, 100),
    "normal form of doubled functions": Question(
        normal_form_task(lambda name: f"F{TIMES}(j)"), True, 50
    ),
    "of D(D(…(Man)))(j)": Question(
        normal_form_task(lambda name: repeat_application("D", "Man") + "(j)"), True, 50
    ),
    "doubled = doubled": Question(
        lambda: asked_of_doubled(lambda S, T, Θ: equal(S, T, Θ).verdict), "yes", 100
    ),
    "doubled <= doubled": Question(
        lambda: asked_of_doubled(lambda S, T, Θ: subtype(S, T, Θ).verdict), "yes", 100
    ),
    "print doubled records": Question(print_doubled, "refused", 50),
    "a sentence of ten words": Question(ten_words, True, 5),
    "nine joins <= wider ones": Question(joins_below(9, "themselves"), "yes", 50),
    "nine joins <= a union": Question(joins_below(9, "a union"), "yes", 50),
    "nine joins <= negations": Question(joins_below(9, "negations"), "no", 50),
    "nine joins <= their cases": Question(joins_below(9, "all cases"), "yes", 50),
    "nine joins <= others": Question(joins_below(9, "another"), "no", 50),
    "eight against eight": Question(joins_against_negations(8, True), "yes", 50),
    "eight against eight, no": Question(joins_against_negations(8, False), "no", 50),
    "nine against nine": Question(joins_against_negations(9, True), "yes", 50),
    "nine against nine, no": Question(joins_against_negations(9, False), "no", 50),
    "pigeonholes of 4 <= C": Question(pigeons_below(4), "yes", 1000),
    "pigeonholes of 5 <= C": Question(pigeons_below(5), "yes", 1000),
    "pigeonholes of 6 <= C": Question(pigeons_below(6), "yes", 1000),
    "pigeonholes of 5": Question(pigeons_consistent(5), "no", 1000),
    "pigeonholes of 6": Question(pigeons_consistent(6), "no", 1000),
    "a triangle that is there": Question(cycle(3, True), "1", 100),
    "a triangle that is not": Question(cycle(3, False), "0", 100),
    "a 4-cycle that is there": Question(cycle(4, True), "1", 100),
    "a 4-cycle that is not": Question(cycle(4, False), "0", 100),
    "chance of 3 × 10 atoms": Question(chance_of(False), True, 1000),
    "chance, linked": Question(chance_of(True), True, 1000),
    "some of 3 × 10 atoms": Question(some_of(False), True, 1000),
    "some, linked": Question(some_of(True), True, 1000),
}


def milliseconds(it: Question, clock: Clock) -> tuple[float, object]:
    """The median time, and the last answer."""
    times: list[float] = []
    answer: object = None
    start = perf_counter()
    while len(times) < RUNS and (not times or perf_counter() - start < PATIENCE):
        task = it.make()
        gc.collect()
        gc.disable()
        before = clock()
        try:
            answer = task()
        except TooLargeError as error:
            answer = error.message
        times.append(clock() - before)
        gc.enable()
    return 1000 * statistics.median(times), answer


def steps_of(it: Question) -> int:
    """How many steps of its budget a question takes."""
    task = it.make()

    @within_budget
    def ask() -> int:
        before = open_purse()
        assert before is not None
        left = before.left
        task()
        return left - before.left

    try:
        return ask()
    except TooLargeError:
        return -1


def results_of(names: list[str], clock: str) -> Iterator[Result]:
    for name in names or QUESTIONS:
        it = QUESTIONS[name]
        spent, answer = milliseconds(it, getattr(time, clock))
        wrong = "" if answer == it.answer else f" ({answer}, not {it.answer})"
        limit = (f"{steps_of(it):,} steps{wrong}", it.limit, spent)
        if wrong:
            limit = (limit[0], 0.0, spent)
        yield Result("composing and deciding", name, {1: spent}, (limit,))


def main() -> None:
    parser = arguments(__doc__ or "")
    parser.add_argument("names", nargs="*", metavar="NAME", choices=[*QUESTIONS, []])
    options = parser.parse_args()
    report(results_of(options.names, clock_of(options)), options)


if __name__ == "__main__":
    sys.exit(main())
