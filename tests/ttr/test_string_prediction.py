"""Courses: what may come next, what is left, and what is not expected."""

import pytest

from ttr import Basic, Ind, Model, Plus, Pred, Str, TTRError, this
from ttr.building.constructors import rectype
from ttr.errors import RefusedError, UnexpectedError, UnsupportedError
from ttr.semantics.string_prediction import start_course
from ttr.types.derived_types import star

A, B, C = map(Basic, "ABC")
M = Model().given("a", A).given("b", B).given("c", C).given("ab", A).given("ab", B)

pick_up, throw = Pred("pick_up", Ind, Ind), Pred("throw", Ind, Ind)
attract, run_after = Pred("attract_attention", Ind, Ind), Pred("run_after", Ind, Ind)
bring = Pred("return", Ind, Ind, Ind)
ROUND = (
    pick_up("h", "s"),
    attract("h", "d"),
    throw("h", "s"),
    run_after("d", "s"),
    pick_up("d", "s"),
    bring("d", "s", "h"),
)


def test_a_game_of_fetch_is_predicted_event_by_event():
    model = Model()
    for number, kind in enumerate(ROUND):
        model = model.given(f"e{number}", kind)
    game = start_course(Plus(Str(*ROUND)), model)
    for number, kind in enumerate(ROUND * 2):
        assert game.expected is kind
        assert game.may_end.hi == (number == 6)
        game = game.seen(f"e{number % 6}")
    assert game.length == 12
    assert game.may_end == (1, 1)


def test_several_things_may_come_next():
    course = start_course(Str(star(A), B) | Str(C), M)
    assert course.expected is A | B | C
    assert course.seen("a").expected is A | B
    assert course.seen("c").expected is None
    assert str(course.seen("c")).endswith("after 1 event, complete")


def test_the_rest_is_a_type_of_strings():
    course = start_course(Str(A, Plus(B)), M)
    assert course.rest is Str(A, Plus(B))
    assert course.seen("a").rest is Plus(B)
    assert course.seen("a").seen("b").rest is star(B)


def test_a_course_does_not_change():
    course = start_course(Str(A, B), M)
    course.seen("a")
    assert course.length == 0
    assert course.expected is A


def test_an_unexpected_event_is_named_with_what_was_expected():
    course = start_course(Str(A, B | Str(C)), M).seen("a")
    with pytest.raises(UnexpectedError) as caught:
        course.seen("a")
    assert caught.value.message == r"event 2, a, is of A, but expected: B \/ C"
    assert isinstance(caught.value, RefusedError)
    with pytest.raises(
        UnexpectedError, match="is of nothing that is known, but expected"
    ):
        course.seen("zz")
    with pytest.raises(
        UnexpectedError, match=r"event 3, b, .* expected: no more events"
    ):
        course.seen("b").seen("b")


def test_asking_does_not_raise():
    course = start_course(Str(A, B), M)
    assert course.expects("b") == (0, 0)
    assert course.expects("ab") == (1, 1)


def test_both_readings_of_an_event_are_followed():
    course = start_course(Str(A, A) | Str(B, B), M).seen("ab")
    assert course.expected is A | B
    assert course.seen("a").expected is None
    assert course.seen("a").may_end == (1, 1)


def test_an_uncertain_event_makes_the_course_uncertain():
    model = M.given("u", A, 0.25).given("u", C, 0.5)
    course = start_course(Str(A, B) | Str(C), model).seen("u")
    assert course.on_course == pytest.approx((0.625, 0.625))
    assert course.may_end == (0.5, 0.5)
    assert course.seen("b").may_end == (0.25, 0.25)
    assert course.seen("b").on_course == (0.25, 0.25)


def test_what_was_in_doubt_before_is_not_taken_as_independent():
    model = M.given("u", A, 0.5)
    course = start_course(Plus(A), model).seen("u").seen("u")
    assert course.may_end == (0, 0.5)


def test_events_that_depend_on_one_another_have_bounds():
    model = (
        M.given("u", A, 0.5)
        .with_unknown_dependence(("u", A), ("v", A))
        .given("v", A, 0.5)
    )
    course = start_course(Plus(A), model).seen("u").seen("v")
    assert course.may_end == (0, 0.5)


def test_an_event_with_many_uncertain_types_is_bounded():
    kinds = [Basic(f"T{number}") for number in range(6)]
    model = M
    for kind in kinds:
        model = model.given("u", kind, 0.5)
    several = Str(kinds[0], A)
    for kind in kinds[1:]:
        several |= Str(kind, A)
    course = start_course(several, model).seen("u").seen("a")
    assert course.may_end == (0, 1)
    surely = start_course(several | Str(A, A), model.given("u", A)).seen("u").seen("a")
    assert surely.may_end == (1, 1)


def test_later_events_are_judged_in_another_model():
    course = start_course(Str(A, B), M).seen("a")
    later = M.given("new", B)
    with pytest.raises(UnexpectedError):
        course.seen("new")
    assert course.judged_in(later).seen("new").may_end == (1, 1)


def test_events_that_are_records():
    run = Pred("run", Ind)
    kind = rectype(x=Ind, e=run(this.x))
    model = M.given("kim", Ind).given("s1", run("kim"))
    course = start_course(Str(kind, kind), model).seen({"x": "kim", "e": "s1"})
    assert course.expected is kind


def test_a_type_without_strings_expects_nothing():
    course = start_course(Str(A) & Str(A, A), M)
    assert course.expected is None
    assert course.on_course == (0, 0)
    assert course.rest is course.type
    assert str(course) == "a string of str(A) /\\ str(A, A), of which there is none"
    with pytest.raises(UnexpectedError):
        course.seen("a")


@pytest.mark.parametrize(
    ("T", "message"),
    [
        (A, "A is no type of strings that can be predicted"),
        (Plus(Pred("p", Ind)(this.x)), "is no type of strings that can be predicted"),
        (Plus(Str(A) & B), "says something of a string as a whole"),
    ],
)
def test_what_cannot_be_followed(T, message):
    with pytest.raises(UnsupportedError, match=message):
        start_course(T, M)


def test_a_course_needs_a_model():
    with pytest.raises(TTRError, match="expected a model to judge in"):
        start_course(Plus(A), "M")
    with pytest.raises(TTRError, match="expected a model to judge in"):
        start_course(Plus(A), M).judged_in("M")


def test_each_step_costs_the_same():
    course = start_course(Plus(Str(A, B)), M)
    for _ in range(2_000):
        course = course.seen("a").seen("b")
    assert course.length == 4_000
    assert course.rest is star(Str(A, B))
