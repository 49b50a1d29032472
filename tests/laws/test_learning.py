"""Laws of learning: exact retraction, no order, frequencies that behave as such."""

from itertools import permutations

import pytest
from generators import names, types
from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, meet
from ttr.errors import RefusedError
from ttr.judging.propositions import probabilistic
from ttr.semantics.learning import (
    JEFFREYS,
    LAPLACE,
    NO_SMOOTHING,
    Counts,
    LogOdds,
    NaiveBayes,
    lidstone,
    posterior,
)

A, B, C = Basic("A"), Basic("B"), Basic("C")
BASIC = (A, B, C)

kinds = st.lists(st.sampled_from(BASIC), min_size=1, max_size=3).map(lambda k: meet(*k))
numbers = st.floats(0, 1)
degrees = numbers | st.tuples(numbers, numbers).map(sorted).map(tuple)
evidence = st.builds(probabilistic, st.sampled_from("abcde"), kinds, degrees)
smoothings = st.sampled_from([NO_SMOOTHING, LAPLACE, JEFFREYS, lidstone(0.25)])


def learned(said):
    """What was learned, as far as it is not refused, and what was refused."""
    J, kept = Counts(), []
    for one in said:
        try:
            J = J.learned(one)
        except RefusedError:
            continue
        kept.append(one)
    return J, kept


def answers(J):
    return [J.p(S, given=T) for S in BASIC for T in (None, *BASIC)]


@given(st.lists(evidence, max_size=6), st.lists(evidence, max_size=4))
def test_learn_then_retract_is_the_identity(before, more):
    J, _ = learned(before)
    after, kept = J, []
    for one in more:
        try:
            after = after.learned(one)
        except RefusedError:
            continue
        kept.append(one)
    back = after.retracted(*kept)
    assert back == J
    assert answers(back) == answers(J)


@given(st.lists(evidence, max_size=8), st.data())
def test_the_order_of_evidence_does_not_matter(said, data):
    J, kept = learned(said)
    shuffled = data.draw(st.permutations(kept))
    assert Counts().learned(*shuffled) == J
    assert answers(Counts().learned(*shuffled)) == answers(J)


@given(st.lists(evidence, max_size=6), types(), types())
def test_frequency_rises_with_subtyping(said, T, U):
    J, _ = learned(said)
    for lower, upper in [(T & U, T), (T, T | U)]:
        assert J.weight(lower).lo <= J.weight(upper).lo
        assert J.p(lower).lo <= J.p(upper).lo
        assert J.p(lower).hi <= J.p(upper).hi


@given(st.lists(st.builds(probabilistic, names, types(), degrees), max_size=4), types())
def test_a_frequency_is_a_probability(said, T):
    J, _ = learned(said)
    p = J.p(T)
    assert 0 <= p.lo <= p.hi <= 1
    conditional = J.p(T, given=T)
    assert conditional in ((0, 1), (1, 1)) or conditional.hi == 1


@given(st.lists(evidence, min_size=1, max_size=8), st.lists(numbers, min_size=8))
def test_the_interval_has_every_frequency_of_numbers_within(said, at):
    """However the intervals are made exact, the frequency is within what was said."""
    J, kept = learned(said)
    exact, where = Counts(), iter(at)
    for one in kept:
        lo, hi = one.prob if isinstance(one.prob, tuple) else (one.prob, one.prob)
        p = min(hi, max(lo, lo + (hi - lo) * next(where)))
        try:
            exact = exact.learned(probabilistic(one.sit, one.sit_type, p))
        except RefusedError:
            return
    for S in BASIC:
        for T in (None, *BASIC):
            found, point = J.p(S, given=T), exact.p(S, given=T)
            if point != (0, 1):
                assert found.lo - 1e-12 <= point.lo <= point.hi <= found.hi + 1e-12


@given(st.lists(evidence, max_size=8), smoothings)
def test_posteriors_sum_to_one(said, smoothing):
    J, _ = learned(one for one in said if not isinstance(one.prob, tuple))
    found = posterior(J, [A, B], [C], smoothing=smoothing)
    if (0, 1) not in found.values():
        assert sum(p.lo for p in found.values()) == pytest.approx(1)
        assert all(p.lo == p.hi for p in found.values())


# --- classifiers ---

lessons = st.lists(st.tuples(kinds, st.sampled_from(["a", "b", "c"])), max_size=8)
empty = st.sampled_from(
    [NaiveBayes(BASIC), NaiveBayes(BASIC, LAPLACE), LogOdds(BASIC, variance=2.0)]
)


def taught(classifier, keyed):
    for key, (x, label) in keyed:
        classifier = classifier.learned(x, label, key=key)
    return classifier


@given(empty, lessons, kinds, st.sampled_from(["a", "b", "d"]))
def test_a_classifier_that_takes_back_is_as_it_was(classifier, lessons, x, label):
    before = taught(classifier, enumerate(lessons))
    after = before.learned(x, label, key="one more").retracted("one more")
    assert after == before
    assert [after.probabilities(T) for T in BASIC] == [
        before.probabilities(T) for T in BASIC
    ]


@given(empty, lessons, st.data())
def test_a_classifier_does_not_mind_the_order(classifier, lessons, data):
    before = taught(classifier, enumerate(lessons))
    shuffled = taught(classifier, data.draw(st.permutations([*enumerate(lessons)])))
    assert shuffled == before
    for x in (*BASIC, A & B):
        assert list(shuffled.probabilities(x).items()) == list(
            before.probabilities(x).items()
        )


@given(empty, lessons, kinds)
def test_probabilities_of_labels(classifier, lessons, x):
    found = taught(classifier, enumerate(lessons)).probabilities(x)
    assert set(found) <= {label for _, label in lessons}
    assert all(0 <= p <= 1 for p in found.values())
    assert sum(found.values()) <= 1 + 1e-12


def test_every_order_of_three_lessons():
    said = [(A, "a"), (A & B, "b"), (C, "a")]
    classifiers = {
        str(taught(LogOdds(BASIC), order).weights)
        for order in permutations(enumerate(said))
    }
    assert len(classifiers) == 1
