"""Laws of models: made-up witnesses, pure queries, degrees."""

from contextlib import suppress
from math import prod

import pytest
from generators import (
    NAMES,
    A,
    models,
    names,
    p,
    ptypes,
    record_types,
    records,
    samples,
    types,
)
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Model, merge, record, rectype, subtype, this
from ttr.errors import RefusedError


@given(types(), models())
def test_a_created_witness_is_a_witness(T, M):
    try:
        witness, after = M.create(T)
    except RefusedError:
        return
    assert after.judge(witness, T).holds


@given(record_types(), models())
def test_creation_is_refused_only_on_a_circle_or_a_contradiction(T, M):
    free = all(not path.labels[1:] for _, f in T.fields for path in _paths(f))
    assume(free and "n" not in T)
    assume(_acyclic(T))
    witness, after = M.create(T)
    assert after.judge(witness, T).holds


def _paths(field):
    from ttr.types.paths import free_paths

    return free_paths(field)


def _acyclic(T):
    seen = set()
    for label, field in T.fields:
        if not {path.labels[0] for path in _paths(field)} <= seen:
            return False
        seen.add(label)
    return True


@given(types(), models())
def test_creating_changes_nothing_that_was_judged(T, M):
    before = [M.judge(a, A).p for a in NAMES]
    try:
        M.create(T)
    except RefusedError:
        return
    assert [M.judge(a, A).p for a in NAMES] == before


@given(models(), samples(), types(), types(), records(), record_types())
def test_a_query_changes_no_later_answer(M, a, T, U, r, R):
    first, below = str(M.judge(a, T).why), str(subtype(T, U))
    M.judge(a, U)
    M.perceive(r, R)
    with suppress(RefusedError):
        M.create(U)
    subtype(U, T)
    merge(T, U)
    assert str(M.judge(a, T).why) == first
    assert str(subtype(T, U)) == below


@given(models(), names, ptypes(), st.sampled_from([0.0, 0.3, 1.0]))
def test_given_leaves_the_old_model_as_it_was(M, sit, T, degree):
    before = M.judge(sit, T).p
    after = M.given(sit, T, degree)
    assert M.judge(sit, T).p == before
    assert after.judge(sit, T).p == (degree, degree)


degrees = st.floats(0, 1)
intervals = st.tuples(degrees, degrees).map(sorted).map(tuple)


@given(records(), record_types(), st.lists(st.tuples(names, ptypes(), intervals)))
def test_degrees_are_ordered_and_in_the_unit_interval(r, T, facts):
    M = Model()
    for name in NAMES:
        M = M.given(name, A, (0.25, 0.5))
    for sit, ptype, degree in facts:
        M = M.given(sit, ptype, degree)
    lo, hi = M.judge(r, T).p
    assert 0 <= lo <= hi <= 1


@given(st.lists(intervals, min_size=1, max_size=4))
def test_a_record_is_as_probable_as_its_distinct_atoms_together(given_degrees):
    M = Model().given("a", A)
    for i, degree in enumerate(given_degrees):
        M = M.given(f"s{i}", p("a"), degree)
    labels = [f"c{i}" for i in range(len(given_degrees))]
    T = rectype({"x": A, **{label: p(this.x) for label in labels}})
    r = record({"x": "a", **{c: f"s{i}" for i, c in enumerate(labels)}})
    twice = rectype(one=T, two=T)
    lo, hi = M.judge(r, T).p
    assert lo == pytest.approx(prod(low for low, _ in given_degrees))
    assert hi == pytest.approx(prod(high for _, high in given_degrees))
    assert M.judge(record(one=r, two=r), twice).p == pytest.approx((lo, hi))


@given(types(), models())
def test_creating_is_deterministic(T, M):
    try:
        first = M.create(T)[0]
    except RefusedError:
        return
    assert str(M.create(T)[0]) == str(first)
