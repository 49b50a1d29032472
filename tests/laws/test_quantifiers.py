"""Laws of quantifiers: conservative, monotone, dual; degrees agree with worlds."""

from __future__ import annotations

from itertools import product
from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr import Ind, Model, Pred, fun, outer, this
from ttr.semantics.quantifiers import (
    Extension,
    Thresholds,
    UndefinedError,
    at_least,
    at_most,
    every,
    exactly,
    exist,
    exist_pl,
    extension,
    few,
    judge_situation,
    many,
    most,
    no,
    not_every,
    number,
    quantify,
    settle,
    several,
    share,
)

RISING = (exist, exist_pl, every, most, many, several, at_least(2))
FALLING = (no, not_every, few, at_most(2))
RISING_LEFT = (exist, exist_pl, not_every, several, at_least(2))
FALLING_LEFT = (no, every, at_most(2))
ALL = (*RISING, *FALLING, exactly(2))

NAMES = "abcdef"
things = st.sets(st.sampled_from(NAMES))
some = st.sets(st.sampled_from(NAMES), min_size=1)
quantifiers = st.sampled_from(ALL)

rising = st.sampled_from(["at least", "more than"])
falling = st.sampled_from(["at most", "fewer than"])


@st.composite
def thresholds(draw, signs=rising):
    if draw(st.booleans()):
        return number(draw(signs), draw(st.integers(0, 6)))
    return share(draw(signs), f"{draw(st.integers(0, 6))}/6")


agents = st.builds(
    Thresholds,
    most=thresholds(),
    many=thresholds(),
    few=thresholds(falling),
    several=thresholds(),
)


def so(q, P, Q, agent=None):
    """Whether it holds, or None where it is neither true nor false."""
    extensions = Extension.of(sorted(P)), Extension.of(sorted(Q))
    try:
        return quantify(q, *extensions, agent).holds
    except UndefinedError:
        return None


@given(quantifiers, things, things, agents)
def test_conservative(q, P, Q, agent):
    assert so(q, P, Q, agent) == so(q, P, P & Q, agent)


@given(st.sampled_from(RISING), some, things, things, agents)
def test_what_rises_goes_on_with_more_of_q(q, P, Q, more, agent):
    assert not so(q, P, Q, agent) or so(q, P, Q | more, agent)


@given(st.sampled_from(FALLING), some, things, things, agents)
def test_what_falls_goes_on_with_less_of_q(q, P, Q, less, agent):
    assert not so(q, P, Q, agent) or so(q, P, Q - less, agent)


@given(st.sampled_from(RISING_LEFT), things, things, things)
def test_what_rises_on_the_left_goes_on_with_more_of_p(q, P, Q, more):
    assert not so(q, P, Q) or so(q, P | more, Q)


@given(st.sampled_from(FALLING_LEFT), things, things, things)
def test_what_falls_on_the_left_goes_on_with_less_of_p(q, P, Q, less):
    assert not so(q, P, Q) or so(q, P - less, Q)


@given(things, things)
def test_the_square_of_opposition(P, Q):
    assert so(every, P, Q) is not so(not_every, P, Q)
    assert so(exist, P, Q) is not so(no, P, Q)
    rest = set(NAMES) - Q
    assert so(every, P, Q) == so(no, P, rest)


@given(some, things)
def test_few_is_not_many_by_default(P, Q):
    assert so(few, P, Q) is not so(many, P, Q)


@given(quantifiers, things, things, st.permutations(NAMES))
def test_only_how_many_matters(q, P, Q, order):
    renamed = dict(zip(NAMES, order, strict=True))
    image = [{renamed[x] for x in X} for X in (P, Q)]
    assert so(q, P, Q) == so(q, *image)


# --- in a model ----------------------------------------------------------------------

p, r = Pred("p", Ind), Pred("r", Ind, Ind)


@st.composite
def models(draw):
    """Models of some individuals, of which some are p and some stand in r."""
    M = Model()
    for name in "abc":
        M = M.given(name, Ind)
    for name in draw(st.sets(st.sampled_from("abc"))):
        M = M.given(f"p{name}", p(name))
    pairs = st.sampled_from(list(product("abc", repeat=2)))
    for x, y in sorted(draw(st.sets(pairs))):
        M = M.given(f"r{x}{y}", r(x, y))
    return M


RELATED = fun(x=Ind)(exist(p, fun(y=Ind)(r(outer.x, this.y))))
DEFINED = st.sampled_from([q for q in ALL if q not in (most, many, few)])


@given(models(), DEFINED)
def test_a_type_is_settled_as_its_extensions_count(M, q):
    counted = quantify(q, extension(M, p), extension(M, RELATED))
    assert settle(M, q(p, RELATED)).p == counted.p


@given(models(), DEFINED)
def test_the_witness_of_what_holds_is_a_witness(M, q):
    found = settle(M, q(p, RELATED))
    fits = judge_situation(M, found.witness, found.type)
    assert fits.holds == found.holds


# --- degrees -------------------------------------------------------------------------

chances = st.integers(0, 4).map(lambda quarter: quarter / 4)
uncertain = st.dictionaries(st.sampled_from("abcd"), chances, min_size=1)


def by_worlds(q, P, Q):
    """The probability as a sum over all worlds; None where one has no P at all."""
    names = sorted({*P, *Q})
    total = 0.0
    for isP, isQ in product(product((0, 1), repeat=len(names)), repeat=2):
        worlds = ((P, isP), (Q, isQ))
        weight = prod(
            d.get(name, 0.0) if on else 1 - d.get(name, 0.0)
            for d, on_off in worlds
            for name, on in zip(names, on_off, strict=True)
        )
        if weight == 0:
            continue
        found = [{n for n, on in zip(names, w, strict=True) if on} for _, w in worlds]
        true = so(q, *found)
        if true is None:
            return None
        total += weight * true
    return total


@given(quantifiers, uncertain, uncertain)
def test_degrees_are_sums_over_worlds(q, P, Q):
    expected = by_worlds(q, P, Q)
    if expected is None:
        return
    found = quantify(q, Extension.of(P.items()), Extension.of(Q.items())).p
    assert found.lo == pytest.approx(expected)
    assert found.hi == pytest.approx(expected)


intervals = st.tuples(chances, chances).map(sorted).map(tuple)


@given(
    quantifiers,
    st.dictionaries(st.sampled_from("abcd"), intervals, min_size=1),
    st.dictionaries(st.sampled_from("abcd"), intervals),
    st.data(),
)
def test_an_interval_holds_every_degree_inside_it(q, P, Q, data):
    def inside(extension_of):
        return {
            name: (lo if data.draw(st.booleans()) else hi)
            for name, (lo, hi) in extension_of.items()
        }

    point_p, point_q = inside(P), inside(Q)
    expected = by_worlds(q, point_p, point_q)
    if expected is None:
        return
    lo, hi = quantify(q, Extension.of(P.items()), Extension.of(Q.items())).p
    assert 0 <= lo <= hi <= 1
    assert lo - 1e-9 <= expected <= hi + 1e-9
