"""The public strategies: what they draw, what they reach, what they refuse."""

import sys
from collections import Counter

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    Record,
    RecordType,
    Theory,
    TTRError,
    record,
    rectype,
    this,
    wellformed,
)
from ttr.computing.path_cycles import describe_cycle
from ttr.errors import IllFormedError, RefusedError
from ttr.testing import strategies as tst
from ttr.types import (
    EventString,
    FiniteSet,
    Function,
    FunType,
    Operation,
    Path,
    Singleton,
    TypeNode,
)
from ttr.types.paths import free_paths, parts, subterms

many = settings(
    max_examples=1000,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
few = settings(parent=many, max_examples=100)

KENNEL = Theory.parse(
    """
    basic Animal, Dog
    pred barks(Dog), bites(Dog, Animal)
    object rex, fido : Dog
    Biting := [x : Dog, y : Animal, e : bites(x, y)]
    Dog <: Animal
    """
)


def drawn(strategy, run=many):
    found = []

    def keep(value):
        found.append(value)

    run(given(strategy)(keep))()
    return found


def kinds_in(value):
    """Names for what there is in a type: constructors, operations, sorts of paths."""
    for part in subterms([value]):
        yield type(part).__name__
        match part:
            case Operation(name):
                yield name
            case Path(up, labels):
                yield f"path {up} out" if labels[0] != "•" else f"variable {up} out"
                yield f"path of {min(len(labels), 2)}"
            case FunType(_, result) if any(p.up == 0 for p in free_paths(result)):
                yield "dependent function type"
    if describe_cycle(value):
        yield "circle"


def nesting(value):
    same, inner = parts(value)
    return 1 + max(map(nesting, (*same, *inner)), default=0)


REACHED = (
    "Basic PType Universe RecordType Singleton Meet Join Negation ListOf NonEmpty "
    "SetOf Str Plus FunType Function Application Record FiniteSet EventString tuple "
    "int float"
)


@pytest.mark.slow
def test_every_constructor_is_reached_in_1000_draws():
    found = drawn(tst.types())
    seen = Counter(kind for T in found for kind in set(kinds_in(T)))
    for kind in REACHED.split():
        assert seen[kind] >= 5, (kind, seen)
    for kind in ("+", "fst", "rst", "circle", "dependent function type"):
        assert seen[kind] >= 5, (kind, seen)
    for kind in ("path 0 out", "path 1 out", "path of 2", "variable 0 out"):
        assert seen[kind] >= 3, (kind, seen)
    assert max(map(nesting, found)) >= 6


def test_types_are_closed_and_well_formed():
    for T in drawn(tst.types(), few):
        assert not free_paths(T)
        answer = wellformed(T)
        assert answer.yes or "circle" in answer.why


def test_depth_is_how_deep_constructors_nest():
    assert all(isinstance(T, RecordType) for T in drawn(tst.record_types(depth=0), few))
    assert max(nesting(T) for T in drawn(tst.types(depth=0), few)) <= 2


def test_types_use_the_names_of_a_theory():
    names = {name for T in drawn(tst.types(KENNEL), few) for name in Theory.of(T).names}
    assert {"Animal", "Dog", "barks", "bites", "rex", "fido"} <= names
    assert "A" not in names
    assert KENNEL.Biting in [
        part for T in drawn(tst.types(KENNEL), few) for part in subterms([T])
    ]


def test_a_theory_without_names_will_do():
    assert all(isinstance(T, TypeNode) for T in drawn(tst.types(Theory.parse("")), few))
    assert all(isinstance(M, Model) for M in drawn(tst.models(Theory.parse("")), few))


@pytest.mark.slow
def test_objects_of_every_kind_are_reached():
    kinds = {type(a) for a in drawn(tst.objects())}
    assert {str, int, float, Record, tuple, FiniteSet, EventString, Function} <= kinds
    assert any(issubclass(kind, TypeNode) for kind in kinds)


DOG = rectype(x=Ind, c=Pred("dog", Ind)(this.x))


@given(tst.records(DOG))
def test_without_a_model_the_record_is_of_the_type(pair):
    r, M = pair
    assert M.judge(r, DOG).holds


@settings(parent=few)
@given(st.data())
def test_a_record_of_any_record_type_is_of_it(data):
    T = data.draw(tst.record_types())
    try:
        r, M = data.draw(tst.records(T))
    except RefusedError:
        return
    assert M.judge(r, T).holds


def test_with_a_model_some_records_are_of_the_type_and_some_are_not():
    dog = Pred("dog", Ind)
    M = Model().given(record(x="fido", c="s1"), DOG)
    M = M.given("s2", dog("fido")).given("s3", dog("new1"))
    found = drawn(tst.records(DOG, M), few)
    verdicts = Counter(M.judge(r, DOG).holds for r in found)
    assert verdicts[True] >= 5
    assert verdicts[False] >= 5
    assert all(set(r) == {"x", "c"} for r in found)
    assert {"fido", "new1"} <= {r.x for r in found}


@given(tst.models(KENNEL))
def test_models_go_by_the_axioms_of_the_theory(M):
    for name in ("rex", "fido"):
        assert M.judge(name, KENNEL.Dog).holds
        assert M.judge(name, KENNEL.Animal).holds


@given(tst.models(degrees=st.just((0.25, 0.5))))
def test_facts_have_the_degrees_that_are_asked_for(M):
    for name in "abstx":
        assert M.judge(name, Basic("A")).p in [(0, 0), (0, 1), (0.25, 0.5)]


def test_nothing_is_drawn_where_nothing_can_be():
    T = rectype(x=Ind @ this.y, y=Ind @ this.x)
    with pytest.raises(RefusedError):
        drawn(tst.records(rectype(x=ListOf(Ind) @ "a", n=T)), few)


def test_wrong_arguments_are_named():
    with pytest.raises(
        IllFormedError, match="records are drawn for a record type, found"
    ):
        tst.records(Ind)
    with pytest.raises(IllFormedError, match="expected a type"):
        tst.records("Dog")
    with pytest.raises(TTRError, match="records are drawn over a model, found"):
        tst.records(DOG, model=KENNEL)
    with pytest.raises(TTRError, match="types are drawn from a theory, found"):
        tst.types("kennel")
    with pytest.raises(TTRError, match="a depth is a whole number, 0 or more"):
        tst.types(depth=-1)
    with pytest.raises(TTRError, match="degrees are drawn by a strategy"):
        tst.models(degrees=0.5)


def test_what_is_missing_is_said(monkeypatch):
    for name in [name for name in sys.modules if name.split(".")[0] == "hypothesis"]:
        monkeypatch.delitem(sys.modules, name)
    for name in ("ttr.testing.strategies", "ttr.testing.strategies.random_types"):
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "hypothesis", None)
    with pytest.raises(ImportError, match=r"pip install 'kille\[test\]'"):
        import ttr.testing.strategies  # noqa: F401


def test_fields_are_set_to_objects_and_to_other_fields():
    T = tst.record_types(depth=0)
    fields = [field for one in drawn(T, few) for _, field in one.fields]
    set_to = Counter(type(one.value) for one in fields if isinstance(one, Singleton))
    assert set_to[Path] >= 5
    assert set_to[str] >= 5, set_to
