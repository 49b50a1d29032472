"""Work is bounded: a question ends within its budget, with an honest answer."""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Callable

import pytest

import ttr
from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Plus,
    Pred,
    Str,
    Theory,
    TTRError,
    consistent,
    join,
    meet,
    merge,
    record,
    rectype,
    subtype,
    this,
)
from ttr.cli.main import main
from ttr.computing import Answer
from ttr.errors import TooLargeError
from ttr.safety import budgets
from ttr.safety.budgets import open_purse, spend, within_budget
from ttr.theories.checking import check
from ttr.types import Meet, TypeNode
from ttr.updates import rule
from ttr.updates.games import Game

A, B, C = map(Basic, "ABC")
FEW = 20_000
"""Enough for all that people write, and soon spent by what is made to be large."""


def doubled(times: int, leaf: TypeNode) -> TypeNode:
    """[l : T, r : T] of such a type and so on: 40 lines stand for 2⁴⁰ fields."""
    for _ in range(times):
        leaf = rectype(l=leaf, r=leaf)
    return leaf


def deep_record(times: int) -> object:
    value: object = "a"
    for _ in range(times):
        value = record(l=value, r=value)
    return value


def pigeons(holes: int) -> Meet:
    """One pigeon more than there are holes, no two in one: nothing is of it."""
    at = [[Basic(f"P{p}H{h}") for h in range(holes)] for p in range(holes + 1)]
    somewhere = [join(*row) for row in at]
    alone = [
        ~one[h] | ~other[h]
        for h in range(holes)
        for i, one in enumerate(at)
        for other in at[:i]
    ]
    found = meet(*somewhere, *alone)
    assert isinstance(found, Meet)
    return found


def friends(count: int) -> tuple[Model, TypeNode]:
    """A relation without circles among so many, and the type of a circle of four."""
    r = Pred("r", Ind, Ind)
    M = Model()
    for i in range(count):
        M = M.given(f"a{i}", Ind)
    for i in range(count):
        for j in range(i):
            M = M.given(f"e{i}_{j}", r(f"a{i}", f"a{j}"))
    four = dict.fromkeys("xyzw", Ind)
    around = zip("xyzw", "yzwx", strict=True)
    return M, rectype(**four, **{f"c{x}": r(this[x], this[y]) for x, y in around})


# --- what three-valued questions answer ----------------------------------------------

UNKNOWN: dict[str, Callable[[], Answer]] = {
    "doubled records": lambda: subtype(doubled(40, A), doubled(39, A)),
    "doubled joins": lambda: subtype(doubled(40, A | B), rectype(l=doubled(38, A))),
    "joins against negations": lambda: subtype(
        meet(*[part for part in pigeons(8).parts if len(part.parts) == 8]),
        join(*[~part for part in pigeons(8).parts if len(part.parts) == 2]),
    ),
    "pigeonholes": lambda: subtype(pigeons(8), C),
    "consistent joins": lambda: consistent(doubled(40, A | B), doubled(40, C)),
    "chains of functions": lambda: subtype(_arrows(30, A), _arrows(29, A)),
}


def _arrows(times: int, T: TypeNode) -> TypeNode:
    for _ in range(times):
        T = T >> T
    return T


def _pairs_of_joins(count: int) -> tuple[TypeNode, list[TypeNode], list[TypeNode]]:
    As = [Basic(f"A{i}") for i in range(count)]
    Bs = [Basic(f"B{i}") for i in range(count)]
    both = meet(*[A | B for A, B in zip(As, Bs, strict=True)])
    denied = [~(A | ~B) for A, B in zip(As, Bs, strict=True)]
    return both, denied, [~(A & B) for A, B in zip(As, Bs, strict=True)]


SEARCHED: dict[str, tuple[str, Callable[[], Answer]]] = {
    "joins against negations": (
        "no",
        lambda: subtype(_pairs_of_joins(9)[0], join(*_pairs_of_joins(9)[1])),
    ),
    "joins against a union": (
        "yes",
        lambda: subtype(
            _pairs_of_joins(9)[0], join(Basic("A0"), *_pairs_of_joins(9)[1])
        ),
    ),
    "joins against as many negations": (
        "yes",
        lambda: consistent(_pairs_of_joins(9)[0], *_pairs_of_joins(9)[2]),
    ),
    "pigeonholes": ("yes", lambda: subtype(pigeons(5), C)),
    "inconsistent pigeonholes": ("no", lambda: consistent(pigeons(6))),
    "pigeonholes in a field": (
        "yes",
        lambda: subtype(rectype(x=pigeons(5), y=A), rectype(y=B)),
    ),
    "pigeonholes in a list": (
        "yes",
        lambda: subtype(ListOf(pigeons(5)), ListOf(C)),
    ),
    "functions from pigeonholes": (
        "yes",
        lambda: subtype(A >> B, pigeons(5) >> B),
    ),
}


@pytest.mark.parametrize("name", SEARCHED)
def test_a_search_that_learns_stays_within_few_steps(name):
    verdict, ask = SEARCHED[name]
    with ttr.budget(steps=FEW):
        assert ask().verdict == verdict


@pytest.mark.parametrize("name", UNKNOWN)
def test_what_is_too_large_is_unknown(name):
    with ttr.budget(steps=FEW):
        answer = UNKNOWN[name]()
    assert answer.unknown
    assert answer.why.startswith(
        f"too large: it takes more than {FEW:,} steps, and ended in "
    )


@pytest.mark.parametrize("name", UNKNOWN)
def test_a_step_stands_for_a_bounded_piece_of_work(name):
    """Else a budget of steps would not be one of seconds."""
    calls = 0

    def count(frame: object, event: str, argument: object) -> None:
        nonlocal calls
        calls += event == "call"

    before = sys.getprofile()
    with ttr.budget(steps=FEW):
        sys.setprofile(count)
        try:
            UNKNOWN[name]()
        finally:
            sys.setprofile(before)
    assert calls <= 30 * FEW


def test_degrees_are_unknown_where_the_budget_ends():
    M, circle = friends(40)
    with ttr.budget(steps=FEW):
        assert M.true(circle) == ttr.probability.Degree(0.0, 1.0)
        judged = M.judge(deep_record(25), doubled(25, Ind))
        assert judged.p == ttr.probability.Degree(0.0, 1.0)
        assert "too large" in str(judged.why.rule)
        chance = M.given("o", A).chance(doubled(40, A | B), when=A)
        assert chance.p == ttr.probability.Degree(0.0, 1.0)
    assert M.true(rectype(x=Ind, y=Ind)) == ttr.probability.Degree(1.0, 1.0)


RAISED: dict[str, Callable[[], object]] = {
    "create": lambda: Model().create(doubled(40, Ind)),
    "give": lambda: Model().given(deep_record(40), doubled(40, Ind)),
    "merge": lambda: merge(doubled(40, A), doubled(40, B)),
    "print": lambda: str(doubled(40, A)),
    "repr": lambda: repr(doubled(40, A)),
    "box": lambda: ttr.box(doubled(40, A)),
    "latex": lambda: ttr.latex(doubled(40, A)),
    "flatten": lambda: ttr.building.flatten(doubled(40, A)),
    "common supertype": lambda: ttr.building.common_supertype(
        doubled(40, A), doubled(40, B)
    ),
    "judge an object that is too large": lambda: Model().judge(_pairs(40), ListOf(A)),
    "list witnesses": lambda: friends(9)[0].witnesses(
        rectype({f"x{i}": Ind for i in range(9)})
    ),
    "reduce": lambda: Model().reduce(deep_record(40)),
    "a normal form": lambda: ttr.computing.join_normal_form(_negated(30)),
}


def _pairs(times: int) -> object:
    value: object = "a"
    for _ in range(times):
        value = (value, value)
    return value


def _negated(times: int) -> TypeNode:
    T: TypeNode = A
    for _ in range(times):
        T = (T & B) | ~T
    return T


ENDED = {
    "create": "`create`",
    "give": "`given`",
    "list witnesses": "`witnesses`",
    "reduce": "`reduce`",
    "merge": "`subtype`",
    "flatten": "`flatten`",
    "a normal form": "`join_normal_form`",
    "print": "printing",
    "box": "`box`",
    "latex": "`latex`",
}
"""What was being asked when the budget ended."""


@pytest.mark.parametrize("name", ENDED)
def test_the_error_says_what_was_asked_when_it_ended(name):
    with ttr.budget(steps=FEW), pytest.raises(TooLargeError) as raised:
        RAISED[name]()
    assert raised.value.message == (
        f"too large: it takes more than {FEW:,} steps, and ended in {ENDED[name]}"
    )
    assert raised.value.hint == (
        "ask for less, or allow more steps (ttr.budget, or --steps)"
    )


@pytest.mark.parametrize("name", RAISED)
def test_what_has_no_unknown_raises(name):
    with ttr.budget(steps=FEW), pytest.raises(TooLargeError, match="too large: it"):
        RAISED[name]()


def test_the_same_question_takes_about_the_same_steps_again():
    def steps() -> int:
        @within_budget
        def asked() -> int:
            before = open_purse().left  # type: ignore[union-attr]
            subtype(doubled(6, A | B), doubled(6, A))
            return before - open_purse().left  # type: ignore[union-attr]

        return asked()

    first, again = steps(), steps()
    assert first * 0.99 <= again <= first < budgets.STEPS  # levels are kept with types


# --- one budget for all that a question asks -----------------------------------------


def test_a_question_inside_another_shares_its_budget_and_its_end():
    answers = []

    def by(x: object) -> bool:
        try:
            answers.append(subtype(doubled(40, A), doubled(39, A)))
        except Exception as error:  # it is not an error of the types
            answers.append(error)
        return False

    with ttr.budget(steps=FEW):
        judged = (
            Model().witnessed(Pred("p", Ind), by=by).judge("s", Pred("p", Ind)("a"))
        )
    assert judged.p == ttr.probability.Degree(0.0, 1.0)
    assert answers == []


def test_a_rule_never_reads_it_as_no():
    T = doubled(40, A)

    @rule(when=rectype(n=A))
    def ask(s):
        return record(n=s.n) if subtype(T, doubled(39, A)).yes else s

    game = Game("asking", rectype(n=A), record(n="a"), ask, model=Model().given("a", A))
    with ttr.budget(steps=FEW), pytest.raises(TooLargeError):
        game.take(game.begin())


def test_each_thread_has_a_budget_of_its_own():
    found = {}

    def ask(name: str) -> None:
        with ttr.budget(steps=FEW if name == "few" else budgets.STEPS):
            found[name] = subtype(doubled(11, A | B), doubled(11, A | B | C)).verdict

    threads = [threading.Thread(target=ask, args=(name,)) for name in ("few", "many")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    with ttr.budget(steps=FEW):
        alone = subtype(doubled(11, A | B), doubled(11, A | B | C)).verdict
    assert found["few"] == alone


def test_nothing_is_counted_where_nothing_is_asked():
    spend(10**9)
    assert open_purse() is None


@pytest.mark.parametrize("steps", [0, -1, True, 1.5, "many"])
def test_a_budget_is_a_number_of_steps(steps):
    with (
        pytest.raises(TTRError, match="a budget is a whole number of steps from 1"),
        ttr.budget(steps=steps),
    ):
        pass


# --- theory files --------------------------------------------------------------------

LINES = "\n".join(f"A{i + 1} := [l : A{i}, r : A{i}]" for i in range(27))
DOUBLING = f"basic A0\n{LINES}\n"


def test_checks_are_unknown_each_by_itself():
    theory = Theory.parse(
        f"{DOUBLING}check A27 <= [l : A25]\ncheck A2 <= [l : A1]\n"
        "check unknown A27 <= [l : A25]"
    )
    with ttr.budget(steps=FEW):
        report = check(theory)
    (failure,) = report.failures
    assert (failure.found, failure.check.span.line) == ("unknown", 29)
    assert failure.why.startswith(f"too large: it takes more than {FEW:,} steps")


def test_many_checks_share_what_the_file_may_take():
    theory = Theory.parse(DOUBLING + "check A27 <= [l : A25]\n" * 20)
    with ttr.budget(steps=FEW):
        report = check(theory)
    assert len(report.failures) == 20
    assert "with what comes before, it takes more than" in report.failures[-1].why


def test_a_statement_that_is_too_large_is_a_mistake_where_it_stands(tmp_path, capsys):
    file = tmp_path / "long.ttr"
    lines = "\n".join(f"S{i + 1} := str(S{i}, S{i})" for i in range(40))
    file.write_text(f"basic S0\n{lines}\ncheck S40 <= S39\n")
    assert main(["check", str(file), "--steps", "5000"]) == 2
    said = capsys.readouterr().out
    assert "error: too large: it takes more than 5,000 steps" in said
    assert "long.ttr:1" in said
    assert "--steps" in said
    assert "1 mistake, nothing checked" in said


def test_the_command_takes_the_number_of_steps(tmp_path, capsys):
    file = tmp_path / "small.ttr"
    file.write_text(
        "basic A, B\nA <: B\nT := [l : A, r : A]\nU := [l : T, r : T]\n"
        "V := [l : B, r : B]\ncheck [l : U, r : U] <= [l : [l : V, r : V]]\n"
    )
    assert main(["check", str(file)]) == 0
    assert main(["check", str(file), "--steps", "40", "--json"]) == 1
    said = capsys.readouterr().out
    (facts,) = json.loads(said[said.index("[\n") :])
    assert facts["failures"][0]["found"] == "unknown"
    with pytest.raises(SystemExit, match="2"):
        main(["check", str(file), "--steps", "none"])
    assert "a whole number from 1, found 'none'" in capsys.readouterr().err


def test_a_doubling_repetition_ends():
    def repeated(times: int) -> TypeNode:
        T: TypeNode = A
        for number in range(times):
            T = Plus(Str(T, T) | T | Plus(Basic(f"C{number}")))
        return T

    with ttr.budget(steps=FEW), pytest.raises(TooLargeError):
        str(repeated(20))
