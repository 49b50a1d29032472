"""Laws of perceptual meanings, of learning, of comparing, and of places."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Ind, Model, Pred, record, rectype, this
from ttr.building import fix
from ttr.semantics.perceptual import (
    GradedPerceptron,
    Perceptron,
    PointMap,
    RealVector,
    agreement,
    blank,
    clusters,
    combined_type,
    coordinates,
    interpretation,
    meaning,
    perceive,
    relative,
)

numbers = st.integers(-8, 8).map(lambda i: i / 4)
places = st.tuples(numbers, numbers)
parameters = st.builds(lambda w, t: record(w=w, t=t), places, numbers)
methods = st.builds(Perceptron, st.sampled_from([0.25, 1.0, 3.0])) | st.builds(
    GradedPerceptron, steepness=st.sampled_from([0.5, 2.0])
)


def word(method, params, name="right", percept="pos"):
    T = rectype({"x": Ind, percept: RealVector, "c": Pred(name, Ind)(this.x)})
    return meaning(interpretation(T, "c"), method, params, of=percept)


meanings = st.builds(word, methods, parameters)
perceptrons = st.builds(word, st.builds(Perceptron), parameters)


def at(pos):
    return record(x="o1", pos=pos)


# --- judging -------------------------------------------------------------------------


@given(meanings)
def test_an_interpretation_is_that_of_its_fixed_point_type(m):
    assert interpretation(fix(m.interp), "c") is m.interp


@given(meanings, places)
def test_a_model_judges_as_the_meaning_does(m, pos):
    M = Model().given("o1", Ind)
    assert m.judge(M, at(pos)).p == m.degree(at(pos))


@given(perceptrons, places)
def test_what_it_is_classified_as_is_what_it_is_judged_to_be(m, pos):
    M = Model().given("o1", Ind)
    j = m.judge(M, at(pos))
    assert j.model.judge(j.sit.c, m.classify(at(pos))).holds


@given(parameters, parameters, places, places)
def test_what_is_of_a_combined_type_is_of_each(p, q, colour, shape):
    red = word(GradedPerceptron(), p, "red", "colour")
    cup = word(GradedPerceptron(), q, "cup", "shape")
    r = record(x="o1", colour=colour, shape=shape)
    both = perceive(Model().given("o1", Ind), r, red, cup).p
    assert both.lo == pytest.approx(red.degree(r).lo * cup.degree(r).lo)
    assert combined_type(red, cup) is combined_type(cup, red)


# --- learning ------------------------------------------------------------------------


@given(meanings, places)
def test_to_learn_leaves_the_old_meaning_as_it_was(m, pos):
    before, degree = str(m), m.degree(at(pos))
    m.confirmed(at(pos))
    m.rejected(at(pos))
    assert (str(m), m.degree(at(pos))) == (before, degree)


@given(perceptrons, places)
def test_a_correction_where_it_is_right_changes_nothing(m, pos):
    says_so = m.degree(at(pos)).lo == 1.0
    assert (m.confirmed if says_so else m.rejected)(at(pos)) is m


@given(meanings, places)
def test_feedback_never_goes_the_wrong_way(m, pos):
    r = at(pos)
    assert m.rejected(r).degree(r).lo <= m.degree(r).lo <= m.confirmed(r).degree(r).lo


@given(perceptrons, places)
def test_corrected_again_and_again_it_comes_right(m, pos):
    r = at(pos)
    margin = abs(m.score(r) - m.params.t)
    for _ in range(math.floor(margin / (1 + pos[0] ** 2 + pos[1] ** 2)) + 1):
        m = m.confirmed(r)
    assert m.degree(r) == (1.0, 1.0)


@given(places, numbers, st.lists(places, min_size=1, max_size=12, unique=True))
def test_on_separable_data_it_makes_few_mistakes_and_then_none(w, t, seen):
    """Novikoff: at most (R / γ)² corrections, whatever the order of the examples."""
    teacher = word(Perceptron(), record(w=w, t=t))
    margins = [teacher.score(at(pos)) - t for pos in seen]
    assume(all(abs(margin) >= 0.25 for margin in margins))
    length = math.hypot(*w, t)
    assume(length > 0)
    gamma = min(map(abs, margins)) / length
    reach = max(math.hypot(*pos, 1.0) for pos in seen)
    pupil, corrections, wrong = word(Perceptron(), blank(2)), 0, True
    while wrong:
        wrong = False
        for pos in seen:
            right = teacher.degree(at(pos)).lo == 1.0
            after = (pupil.confirmed if right else pupil.rejected)(at(pos))
            wrong |= after is not pupil
            corrections += after is not pupil
            pupil = after
        # A score that is just the threshold says no, so one more is allowed for.
        assert corrections <= (reach / gamma) ** 2 + 1
    assert agreement(teacher, pupil, map(at, seen)).share == 1.0


# --- comparing -----------------------------------------------------------------------


@given(meanings, meanings, st.lists(places, min_size=1, max_size=8))
def test_agreement_is_the_same_from_either_side(one, other, seen):
    there = agreement(one, other, map(at, seen))
    back = agreement(other, one, map(at, seen))
    assert (there.first, there.second) == (back.second, back.first)
    assert (there.share, there.kappa, there.apart) == (
        back.share,
        back.kappa,
        back.apart,
    )
    assert there.kappa is None or -1.0 <= there.kappa <= there.share
    assert 0.0 <= there.apart <= 1.0


@given(meanings, st.lists(places, min_size=1, max_size=8))
def test_a_meaning_agrees_with_itself(m, seen):
    found = agreement(m, m, map(at, seen))
    assert (found.share, found.apart) == (1.0, 0.0)
    assert found.kappa in (None, 1.0)


# --- places --------------------------------------------------------------------------


@given(places, places, places)
def test_frames_keep_distances(thing, ground, viewer):
    assume(ground != viewer)
    place = coordinates(thing, relative(ground, viewer))
    assert math.hypot(*place) == pytest.approx(math.dist(thing, ground))


@given(places, places, places)
def test_from_the_other_side_left_is_right(thing, ground, viewer):
    assume(ground != viewer)
    opposite = [2 * g - v for g, v in zip(ground, viewer, strict=True)]
    here = coordinates(thing, relative(ground, viewer))
    there = coordinates(thing, relative(ground, opposite))
    assert there == pytest.approx((-here[0], -here[1]))


@given(st.lists(places, min_size=1, max_size=15), st.sampled_from([0.3, 0.6, 1.2]))
def test_regions_part_the_points_at_steps_that_are_too_long(points, reach):
    regions = clusters(PointMap(points), reach)
    assert sorted(p for it in regions for p in it.points) == sorted(points)
    for region in regions:
        others = [p for it in regions if it is not region for p in it.points]
        assert all(math.dist(p, q) >= reach for p in region.points for q in others)
        assert _is_joined(region.points, reach)


def _is_joined(points, reach):
    """Whether short steps lead from the first point to all others, by trying each."""
    reached, rest = [points[0]], list(points[1:])
    for here in reached:
        near = [p for p in rest if math.dist(here, p) < reach]
        reached += near
        rest = [p for p in rest if p not in near]
    return not rest
