"""Laws of probability: degrees of judgements, whatever depends on what."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Basic, Model, join, meet, subtype
from ttr.errors import RefusedError
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
