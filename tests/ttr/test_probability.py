"""Degrees: intervals, and what they print as."""

from itertools import pairwise, product
from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import TTRError
from ttr.probability import (
    All,
    AnyOf,
    Atomic,
    Conditional,
    ContradictionError,
    Degree,
    Dependence,
    ImpossibleError,
    Not,
    chance,
    degree,
)
from ttr.probability.dependence import Component
from ttr.probability.polytopes import polytope


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


def odds(event, known=None, given=None):
    """How probable an event is, without how it was found."""
    return chance(event, known or Dependence(), given or All(())).p


def test_all_of_independent_events():
    assert odds(All(())) == (1, 1)
    events = tuple(Atomic(i, Degree(0.5, 1)) for i in range(100_000))
    assert odds(All(events)) == (0, 1)


def number(name, p):
    return Atomic(name, Degree(p, p))


A, B = number("a", 0.4), number("b", 0.5)


def test_the_same_atom_is_one_event():
    assert odds(All((A, A))) == pytest.approx((0.4, 0.4))
    assert odds(All((A, Not(A)))) == pytest.approx((0, 0))
    assert odds(AnyOf((A, Not(A)))) == pytest.approx((1, 1))
    both_ways = AnyOf((All((A, B)), All((Not(A), Not(B)))))
    assert odds(both_ways) == pytest.approx((0.5, 0.5))


def test_an_unknown_atom_or_its_negation():
    unknown = Atomic("a", Degree(0, 1))
    assert odds(AnyOf((unknown, Not(unknown)))) == (1, 1)
    assert odds(All((unknown, B))) == (0, 0.5)


def test_an_atom_that_entails_another():
    low = number("b", 0.2)
    below = Dependence({"a": A.p, "b": low.p}, entailed=(("b", "a"),))
    assert odds(All((A, low)), below) == pytest.approx((0.2, 0.2))
    assert odds(AnyOf((A, low)), below) == pytest.approx((0.4, 0.4))
    assert odds(All((A, Not(low))), below) == pytest.approx((0.2, 0.2))
    assert odds(All((Not(A), low)), below) == (0, 0)
    assert odds(low, below, given=A) == pytest.approx((0.5, 0.5))


def test_two_atoms_below_a_third_are_not_independent():
    above = number("c", 0.5)
    known = Dependence(
        {"a": A.p, "b": B.p, "c": above.p}, entailed=(("a", "c"), ("b", "c"))
    )
    assert odds(AnyOf((A, B)), known) == pytest.approx((0.5, 0.5))
    assert odds(AnyOf((A, B, above)), known) == pytest.approx((0.5, 0.5))


def test_atoms_that_exclude_each_other():
    known = Dependence({"a": A.p, "b": B.p}, exclusive=(("a", "b"),))
    assert odds(All((A, B)), known) == (0, 0)
    assert odds(AnyOf((A, B)), known) == pytest.approx((0.9, 0.9))


def test_degrees_that_contradict_each_other():
    known = Dependence({"a": A.p, "b": Degree(0.7, 0.7)}, exclusive=(("a", "b"),))
    with pytest.raises(ContradictionError):
        odds(A, known)


def test_what_cannot_be_is_no_condition():
    with pytest.raises(ImpossibleError):
        odds(A, given=All((B, Not(B))))
    with pytest.raises(ImpossibleError):
        odds(A, given=number("c", 0.0))


def test_nothing_is_known_of_how_atoms_depend():
    known = Dependence({"a": A.p, "b": B.p}, unknown=(("a", "b"),))
    assert odds(All((A, B)), known) == pytest.approx((0, 0.4))
    assert odds(AnyOf((A, B)), known) == pytest.approx((0.5, 0.9))


def test_a_network_of_conditionals():
    """Rain and the sprinkler make the grass wet (as in Pearl 1988)."""
    rain, off, wet = "rain", "off", "wet"
    unknown = Degree(0, 1)
    table = {
        (True, True): 0.9,
        (True, False): 0.99,
        (False, True): 0.0,
        (False, False): 0.8,
    }
    conditionals = [
        Conditional(wet, ((rain, r), (off, o)), Degree(p, p))
        for (r, o), p in table.items()
    ]
    conditionals += [
        Conditional(off, ((rain, r),), Degree(p, p))
        for r, p in ((True, 0.99), (False, 0.6))
    ]
    known = Dependence({rain: Degree(0.2, 0.2)}, conditionals=tuple(conditionals))
    weights = {
        (r, o, w): (0.2 if r else 0.8)
        * (x if o else 1 - x)
        * (table[r, o] if w else 1 - table[r, o])
        for r, x in ((True, 0.99), (False, 0.6))
        for o in (True, False)
        for w in (True, False)
    }
    Wet, Rain = Atomic(wet, unknown), Atomic(rain, Degree(0.2, 0.2))
    is_wet = sum(p for (_, _, w), p in weights.items() if w)
    both = sum(p for (r, _, w), p in weights.items() if w and r)
    assert odds(Wet, known) == pytest.approx((is_wet,) * 2)
    assert odds(Rain, known, given=Wet) == pytest.approx((both / is_wet,) * 2)
    assert chance(Rain, known, given=Wet).exact


def test_too_many_shared_atoms_give_bounds():
    atoms = [number(i, 0.5) for i in range(40)]
    pairs = [All((a, b)) for a, b in pairwise(atoms)]
    lo, hi = odds(AnyOf(tuple(pairs)))
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
    assert odds(event) == pytest.approx((expected, expected))


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


def test_of_what_is_too_large_a_part_around_what_is_asked_gives_bounds():
    """Each of a chain of judgements entails the next; but the last two exclude."""
    half, chain = Degree(0.5, 0.5), tuple(range(40))
    links = tuple(pairwise(chain[:39]))
    known = dict.fromkeys(chain, half)
    whole = Component(chain, known, entailed=links, exclusive=((38, 39),))
    found = polytope(whole, [3])
    assert not found.exact
    assert set(found.component.atoms) == set(found.cases[0]) < set(chain)
    both = [degree(case[3] and case[20]) for case in found.cases]
    assert found.share(both, {}) == half
