"""Degrees: intervals, and what they print as."""

from itertools import pairwise, product
from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Degree, TTRError
from ttr.probability import All, AnyOf, Atomic, Not, chance, degree


@pytest.mark.parametrize(
    ("value", "p"),
    [(1, (1, 1)), (False, (0, 0)), ([0.1, 0.2], (0.1, 0.2)), (0.5, (0.5, 0.5))],
)
def test_degrees(value, p):
    assert degree(value) == p


@pytest.mark.parametrize(
    "value", ["1", b"1", None, (0.2, 0.1), (0.1,), (0, 0.5, 1), 2, -0.1, float("inf")]
)
def test_what_is_no_degree(value):
    with pytest.raises(TTRError, match=r"it is a number in \[0, 1\] or an interval"):
        degree(value, "it")


@pytest.mark.parametrize(
    ("p", "text"),
    [
        (Degree(1, 1), "1"),
        (Degree(0.99999, 1), "[0.99999, 1]"),
        (Degree(1e-9, 1e-9), "1e-09"),
        (Degree(1 / 3, 0.5), "[0.3333, 0.5]"),
    ],
)
def test_only_what_is_certain_prints_as_certain(p, text):
    assert str(p) == text


def test_all_of_independent_events():
    assert chance(All(()), {}) == (1, 1)
    events = tuple(Atomic(i, Degree(0.5, 1)) for i in range(100_000))
    assert chance(All(events), {}) == (0, 1)


def number(name, p):
    return Atomic(name, Degree(p, p))


A, B = number("a", 0.4), number("b", 0.5)


def test_the_same_atom_is_one_event():
    assert chance(All((A, A)), {}) == pytest.approx((0.4, 0.4))
    assert chance(All((A, Not(A))), {}) == pytest.approx((0, 0))
    assert chance(AnyOf((A, Not(A))), {}) == pytest.approx((1, 1))
    both_ways = AnyOf((All((A, B)), All((Not(A), Not(B)))))
    assert chance(both_ways, {}) == pytest.approx((0.5, 0.5))


def test_an_unknown_atom_or_its_negation():
    unknown = Atomic("a", Degree(0, 1))
    assert chance(AnyOf((unknown, Not(unknown))), {}) == (1, 1)
    assert chance(All((unknown, B)), {}) == (0, 0.5)


def test_an_atom_that_entails_another():
    entailed = {"b": frozenset({"a"}), "a": frozenset()}
    low = number("b", 0.2)
    assert chance(All((A, low)), entailed) == pytest.approx((0.2, 0.2))
    assert chance(AnyOf((A, low)), entailed) == pytest.approx((0.4, 0.4))
    mixed = chance(All((A, Not(low))), entailed)
    assert mixed.lo - 1e-9 <= 0.2 <= mixed.hi


def test_too_many_shared_atoms_give_bounds():
    atoms = [number(i, 0.5) for i in range(40)]
    pairs = [All((a, b)) for a, b in pairwise(atoms)]
    lo, hi = chance(AnyOf(tuple(pairs)), {})
    assert 0 <= lo < hi == 1


@given(st.data())
def test_what_is_computed_is_what_the_cases_add_up_to(data):
    degrees = data.draw(st.lists(st.floats(0, 1), min_size=1, max_size=4))
    atoms = [number(i, p) for i, p in enumerate(degrees)]
    event = data.draw(
        st.recursive(
            st.sampled_from(atoms),
            lambda inner: st.one_of(
                st.builds(Not, inner),
                st.lists(inner, max_size=3).map(tuple).map(All),
                st.lists(inner, max_size=3).map(tuple).map(AnyOf),
            ),
            max_leaves=8,
        )
    )
    expected = sum(
        prod(p if true else 1 - p for p, true in zip(degrees, truth, strict=True))
        for truth in product((True, False), repeat=len(degrees))
        if happens(event, truth)
    )
    assert chance(event, {}) == pytest.approx((expected, expected))


def happens(event, truth):
    match event:
        case Atomic(atom, _):
            return truth[atom]
        case Not(part):
            return not happens(part, truth)
        case All(parts):
            return all(happens(part, truth) for part in parts)
        case AnyOf(parts):
            return any(happens(part, truth) for part in parts)
