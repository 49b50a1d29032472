"""Laws of probability: degrees of judgements, whatever depends on what."""

from itertools import combinations, permutations, product
from math import prod

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import linprog

from ttr import Basic, Ind, Model, Pred, join, meet, rectype, subtype, this
from ttr.errors import RefusedError
from ttr.semantics.quantifiers import truth
from ttr.semantics.random_variables import RandomVariable
from ttr.signature.signature import Axiom, Exclusion, Signature

ATOMS = [Basic(name) for name in "ABCDE"]
SLACK = 1e-9

hundredths = st.integers(0, 100).map(lambda n: n / 100)
intervals = st.one_of(
    hundredths.map(lambda p: (p, p)),
    st.tuples(hundredths, hundredths).map(sorted).map(tuple),
)
pairs = st.sampled_from([(a, b) for a in ATOMS for b in ATOMS if a is not b])
theories = st.builds(
    lambda below, apart: Signature(
        axioms=tuple(Axiom(*pair) for pair in below),
        exclusions=tuple(Exclusion(*pair) for pair in apart),
    ),
    st.lists(pairs, max_size=2),
    st.lists(pairs, max_size=2),
)
types = st.recursive(
    st.sampled_from(ATOMS),
    lambda inner: st.one_of(
        inner.map(lambda T: ~T),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: meet(*parts)),
        st.lists(inner, min_size=2, max_size=3).map(lambda parts: join(*parts)),
    ),
    max_leaves=5,
)
facts = st.lists(st.tuples(st.sampled_from(ATOMS), intervals), max_size=5)
seen = st.dictionaries(st.sampled_from(ATOMS), intervals, max_size=1)
conditionals = st.lists(st.tuples(pairs, st.booleans(), intervals), max_size=2)

numbers = st.tuples(*[st.sampled_from([0.1, 0.25, 0.5, 0.8]) for _ in ATOMS])


@st.composite
def models(draw):
    """A model of one object a, in which judgements depend on one another."""
    theory = draw(theories)
    M = Model(Signature(theory.axioms, frozenset(ATOMS), exclusions=theory.exclusions))
    for T, p in draw(seen).items():
        M = attempted(M, lambda M, T=T, p=p: judging(M.witnessed(T, by=lambda _: p)))
    for T, p in draw(facts):
        M = attempted(M, lambda M, T=T, p=p: M.given("a", T, p))
    for (T, S), so, p in draw(conditionals):
        when = [("a", S if so else ~S)]
        M = attempted(M, lambda M, T=T, p=p, w=when: M.given("a", T, p, when=w))
    return M


def attempted(M, change):
    """The model after a change; the same one where that contradicts it."""
    try:
        return change(M)
    except RefusedError:
        return M


def judging(M):
    """The model, if what its witness functions say goes together."""
    for T in ATOMS:
        M.judge("a", T)
    return M


def below(p, q):
    return p.lo <= q.lo + SLACK and p.hi <= q.hi + SLACK


@given(models(), types)
def test_degrees_are_intervals_in_order(M, T):
    lo, hi = M.judge("a", T).p
    assert 0 <= lo <= hi <= 1


@given(models(), types, types)
def test_a_meet_is_at_most_as_probable_as_its_parts(M, S, T):
    whole = M.judge("a", S & T).p
    assert below(whole, M.judge("a", S).p)
    assert below(whole, M.judge("a", T).p)


@given(models(), types, types)
def test_a_join_is_at_least_as_probable_as_its_parts(M, S, T):
    whole = M.judge("a", S | T).p
    assert below(M.judge("a", S).p, whole)
    assert below(M.judge("a", T).p, whole)


@given(numbers, types, types)
def test_a_join_is_the_sum_less_what_both_have(degrees, S, T):
    """p(S ∨ T) = p(S) + p(T) − p(S ∧ T)."""
    M = Model()
    for atom, p in zip(ATOMS, degrees, strict=True):
        M = M.given("a", atom, p)
    one, other, both, either = (M.judge("a", U).p for U in (S, T, S & T, S | T))
    assert either == pytest.approx((one.lo + other.lo - both.lo,) * 2)


@given(models(), types)
def test_a_negation_is_what_is_missing_to_one(M, T):
    p, q = M.judge("a", T).p, M.judge("a", ~T).p
    assert q == pytest.approx((1 - p.hi, 1 - p.lo))


@given(models(), types, types)
def test_a_subtype_is_at_most_as_probable(M, S, T):
    assume(subtype(S, T, M.theory).yes)
    assert below(M.judge("a", S).p, M.judge("a", T).p)


@given(models(), types)
def test_given_itself_everything_is_certain(M, T):
    try:
        assert M.judge("a", T, when=[("a", T)]).p == pytest.approx((1, 1))
    except RefusedError:
        assert M.judge("a", T).p.lo <= SLACK


@given(models(), types, types)
def test_the_chain_rule(M, S, T):
    """p(S ∧ T) = p(S) p(T | S), as far as the intervals go."""
    first, both = M.judge("a", S).p, M.judge("a", S & T).p
    try:
        after = M.judge("a", T, when=[("a", S)]).p
    except RefusedError:
        assert first.lo <= SLACK
        return
    assert both.lo <= first.hi * after.hi + SLACK
    assert both.hi >= first.lo * after.lo - SLACK


@given(models(), types, types)
def test_the_complement_under_a_condition(M, S, T):
    try:
        p = M.judge("a", T, when=[("a", S)]).p
    except RefusedError:
        assume(False)
    q = M.judge("a", ~T, when=[("a", S)]).p
    assert q == pytest.approx((1 - p.hi, 1 - p.lo))


# --- what there is no end of ---------------------------------------------------------

q = Pred("q", Ind)
DENIED = rectype(w=Ind, g=~q(this.w))
judgements = st.dictionaries(
    st.sampled_from([(x, T) for x in "ab" for T in (Ind, q("a"), q("b"))]),
    st.sampled_from([0, 0.3, 0.8, 1]),
    max_size=5,
)


def worlds(told):
    """The ways in which what was told may be, each with its probability."""
    for so in product((True, False), repeat=len(told)):
        world = dict(zip(told, so, strict=True))
        yield world, prod(p if world[key] else 1 - p for key, p in told.items())


def least_probability(told):
    """How probable it surely is that some w is an Ind and something is not of q(w).

    What nobody told of may be of q, if q is open: if some degree of it is between.
    """
    is_open = any(T is not Ind and 0 < p < 1 for (_, T), p in told.items())
    total = 0
    for world, p in worlds(told):
        total += p * any(
            world.get((w, Ind), False)
            and (
                not is_open or any(world.get((g, q(w))) is False for g in (*"ab", "()"))
            )
            for w in "ab"
        )
    return total


@given(judgements)
def test_a_denial_is_as_probable_as_its_known_witnesses_make_it(told):
    M = Model()
    for (x, T), p in told.items():
        M = M.given(x, T, p)
    found = M.true(DENIED)
    assert found.lo == pytest.approx(least_probability(told))
    some = 1 - prod(1 - told.get((x, Ind), 0) for x in "ab")
    is_open = any(T is Ind and 0 < p < 1 for (_, T), p in told.items())
    assert found.hi == pytest.approx(1 if is_open else some)
    assert truth(M, DENIED).p.lo <= least_probability(told) + SLACK


# --- conditions of any form ----------------------------------------------------------

THREE = ATOMS[:3]
WORLDS = [frozenset(so) for n in range(4) for so in combinations(THREE, n)]
events = st.recursive(
    st.sampled_from(THREE),
    lambda inner: st.one_of(
        inner.map(lambda T: ~T),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: meet(*parts)),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: join(*parts)),
    ),
    max_leaves=3,
)


@st.composite
def linked_judgements(draw):
    """A model of what is said of a distribution over worlds, and rows that say it.

    Each row is a linear demand on the weights of the worlds: it adds up to 0.
    """
    weights = draw(st.lists(st.integers(1, 6), min_size=8, max_size=8))
    M = Model(Signature(opened=frozenset(THREE)))
    M = M.with_unknown_dependence(*[("a", T) for T in THREE])
    rows = []
    for T in draw(st.sets(st.sampled_from(THREE), max_size=2)):
        p = sum(w for w, so in zip(weights, WORLDS, strict=True) if T in so)
        M = M.given("a", T, p / sum(weights))
        rows.append([(T in so) - p / sum(weights) for so in WORLDS])
    for T, S in draw(st.sets(st.sampled_from([*permutations(THREE, 2)]), max_size=2)):
        both = sum(w for w, so in zip(weights, WORLDS, strict=True) if {S, T} <= so)
        whole = sum(w for w, so in zip(weights, WORLDS, strict=True) if S in so)
        M = M.given("a", T, both / whole, when=[("a", S)])
        rows.append([(S in so) * ((T in so) - both / whole) for so in WORLDS])
    return M, rows


def bounds_by_enumeration(rows, T, conditions):
    """The least and greatest p(T | conditions) over all weights that meet the rows.

    A linear program over the worlds, scaled so that the conditions have probability 1.
    """
    given = [int(all(is_so(S, so) for S in conditions)) for so in WORLDS]
    event = [g * is_so(T, so) for g, so in zip(given, WORLDS, strict=True)]
    equations, sums = [*rows, given], [0] * len(rows) + [1]
    least, most = (
        linprog([sign * x for x in event], A_eq=equations, b_eq=sums).fun
        for sign in (1, -1)
    )
    return least, -most


@given(linked_judgements(), events, st.lists(events, min_size=1, max_size=2))
def test_a_conditional_degree_is_what_the_worlds_leave(known, T, conditions):
    M, rows = known
    assume(any(all(is_so(S, so) for S in conditions) for so in WORLDS))
    p = M.judge("a", T, when=[("a", S) for S in conditions]).p
    assert p == pytest.approx(bounds_by_enumeration(rows, T, conditions), abs=1e-6)


@given(models(), types, st.sampled_from(ATOMS), types)
def test_a_condition_that_follows_from_another_adds_nothing(M, T, A, S):
    try:
        once = M.judge("a", T, when=[("a", A)]).p
    except RefusedError:
        assume(False)
    assert M.judge("a", T, when=[("a", A), ("a", A | S)]).p == pytest.approx(once)


def told_in(order, theory):
    M = Model(theory)
    for T, p in order:
        M = M.given("a", T, p)
    return M


@given(
    theories, st.dictionaries(st.sampled_from(ATOMS), intervals), types, st.randoms()
)
def test_the_order_of_what_is_given_does_not_matter(theory, told, T, random):
    orders = [list(told.items()), list(told.items())]
    random.shuffle(orders[1])
    found = []
    for order in orders:
        try:
            found.append(told_in(order, theory).judge("a", T).p)
        except RefusedError:
            found.append("refused")
    if "refused" in found:
        assert found[0] == found[1]
    else:
        assert found[0] == pytest.approx(found[1])


@given(st.sets(st.sampled_from(ATOMS)), types)
def test_what_is_certain_agrees_with_plain_judging(told, T):
    M = Model()
    for one in ATOMS:
        M = M.given("a", one, 1 if one in told else 0)
    assert M.judge("a", T).holds == is_so(T, told)


def is_so(T, told):
    parts = getattr(T, "parts", None)
    if T in ATOMS:
        return T in told
    if parts is None:
        return not is_so(T.body, told)
    truths = [is_so(part, told) for part in parts]
    return all(truths) if type(T) is type(meet(*ATOMS)) else any(truths)


@given(models(), types)
def test_telling_changes_nothing_of_what_was_told_before(M, T):
    before = M.judge("a", T).p
    attempted(M, lambda M: M.given("a", ATOMS[0], 0.5))
    assert M.judge("a", T).p == before


@given(models(), st.sets(st.sampled_from(ATOMS), min_size=2))
def test_a_random_variable_is_ordered_and_adds_up(M, values):
    V = RandomVariable("V", *sorted(values, key=str))
    try:
        degrees = V.distribution(M, "a").values()
    except RefusedError:
        assert all(M.judge("a", value).p.hi == 0 for value in values)
        return
    assert all(0 <= p.lo <= p.hi <= 1 for p in degrees)
    assert sum(p.lo for p in degrees) <= 1 + SLACK
    assert sum(p.hi for p in degrees) >= 1 - SLACK
