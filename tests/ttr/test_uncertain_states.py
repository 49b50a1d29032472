"""Beliefs: sets of states and their degrees."""

import pytest

from ttr.computing.strings.uncertain_states import NOWHERE, SETS, Beliefs
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.probability.degrees import frechet_conjunction, independent_conjunction

ONE, TWO, BOTH = frozenset((1,)), frozenset((2,)), frozenset((1, 2))


def test_together():
    p, q = Degree(0.5, 0.8), Degree(0.7, 0.9)
    assert independent_conjunction(p, q) == pytest.approx((0.35, 0.72))
    assert frechet_conjunction(p, q) == pytest.approx((0.2, 0.8))
    assert frechet_conjunction(CERTAIN, q) == independent_conjunction(CERTAIN, q) == q
    assert frechet_conjunction(REFUTED, q) == REFUTED


def test_what_is_certain():
    beliefs = Beliefs.certain(ONE)
    assert beliefs.probability(bool) == CERTAIN
    assert Beliefs.certain(NOWHERE).probability(bool) == REFUTED


def test_a_bound_is_known_from_what_is_so_and_from_what_is_not():
    beliefs = Beliefs({ONE: Degree(0.1, 0.9), NOWHERE: Degree(0.2, 0.3)})
    assert beliefs.probability(bool) == pytest.approx((0.7, 0.8))


def test_ways_to_one_set_add_up():
    beliefs = Beliefs({ONE: Degree(0.25, 0.25), TWO: Degree(0.75, 0.75)})
    after = beliefs.after(lambda states: [(BOTH, CERTAIN)], independent_conjunction)
    assert after.degrees == {BOTH: CERTAIN}


def test_where_there_are_too_many_sets_bounds_are_kept():
    number = SETS + 10
    share = 1 / number
    sets = {frozenset((0, i)): Degree(share, share) for i in range(1, number + 1)}
    after = Beliefs(sets).after(
        lambda states: [(states, CERTAIN)], independent_conjunction
    )
    assert len(after.degrees) == SETS
    assert after.states() == list(range(number + 1))
    for state in range(number + 1):
        truth = 1.0 if state == 0 else share
        lo, hi = after.probability(lambda states, state=state: state in states)
        assert lo - 1e-9 <= truth <= hi + 1e-9
    assert after.probability(lambda states: 0 in states).lo == pytest.approx(1.0)


def test_what_nothing_is_known_of():
    beliefs = Beliefs({ONE: UNKNOWN, NOWHERE: UNKNOWN})
    assert beliefs.probability(bool) == UNKNOWN
