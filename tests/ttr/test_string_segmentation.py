"""Judging strings by dividing them: certain, uncertain, and why not."""

import pytest

from ttr import Basic, Ind, Model, Plus, Pred, Str, rectype, this
from ttr.types import EventString
from ttr.types.derived_types import star

A, B, C = map(Basic, "ABC")
M = Model().given("a", A).given("b", B)


def why(word, T, model=M):
    return model.judge(EventString(*word), T).why


@pytest.mark.parametrize(
    ("word", "T", "rule"),
    [
        ("aab", Plus(A), "first 2 events; event 3, b, is of B, expected: A"),
        ("abb", Plus(Str(A, B)), "first 2 events; event 3, b, is of B, expected: A"),
        ("aba", Plus(Str(A, B)), "it ends after 3 events; expected next: B"),
        ("a", Plus(Str(A, B)), "it ends after 1 event; expected next: B"),
        ("", Plus(A), "it is empty; expected next: A"),
        ("b", Plus(A), "event 1, b, is of B, expected: A"),
        ("ab", Str(A, Str() | Plus(A)), "first event; event 2, b, is of B"),
        ("aba", Str(Plus(A), B), "event 3, a, is of A, expected: no more events"),
        ("az", Plus(A), "event 2, z, is of nothing known, expected: A"),
    ],
)
def test_why_a_string_is_none(word, T, rule):
    reason = why(word, T)
    assert reason.p == (0, 0)
    assert rule in reason.rule


def test_why_a_string_is_one():
    reason = why("aab", Str(Plus(A), B))
    assert reason.p == (1, 1)
    assert [str(part.type) for part in reason.parts] == ["A", "A", "B"]
    assert [part.sit for part in reason.parts[1:]] == ["a", "b"]
    assert str(reason).splitlines()[-1] == "  ✓ b : B   (given)"


def test_the_reasons_of_a_string_are_a_list():
    parts = why("aab", Str(Plus(A), B)).parts
    assert len(parts) == 3
    assert [part.sit for part in parts] == ["a", "a", "b"]
    assert [part.sit for part in parts[::2]] == ["a", "b"]
    assert (len(parts[1:]), parts[-1].sit) == (2, "b")


def test_fields_around_a_string_are_looked_up():
    run = Pred("run", Ind)
    T = rectype(x=Ind, s=Str(Plus(run(this.x)), B))
    model = M.given("kim", Ind).given("e", run("kim"))
    r = {"x": "kim", "s": EventString("e", "e", "b")}
    assert model.judge(r, T).holds
    assert model.judge({**r, "x": "b"}, T).holds is False


def test_a_witness_function_is_asked_once_for_each_event_and_type():
    asked = []

    def is_short(event):
        asked.append(event)
        return len(event) < 3

    Short = Basic("Short")
    model = M.witnessed(Short, by=is_short).given("abc", A)
    judged = model.judge(EventString("ab", "cd", "abc"), Str(Plus(Short | B), A))
    assert judged.holds
    assert [part.p for part in judged.why.parts] == [(1, 1)] * 3
    assert str(judged.why.parts[2].type) == "A"
    assert sorted(asked) == ["ab", "abc", "cd"]


def test_one_way_is_as_probable_as_its_events():
    model = M.given("u", A, 0.5).given("v", A, 0.5)
    assert why(("u", "v", "b"), Str(Plus(A), B), model).p == (0.25, 0.25)
    assert why(("u", "u", "b"), Str(Plus(A), B), model).p == (0.5, 0.5)


def test_several_ways_are_put_together():
    model = M.given("u", A, 0.5).given("u", B, 0.5).given("v", B, 0.5)
    T = Str(A, star(B)) | Str(B, B)
    assert why(("u", "v"), Str(T, star(C)), model).p == pytest.approx((0.375, 0.375))


def test_more_ways_than_can_be_told_are_followed_at_once():
    model = M
    word = [f"u{number}" for number in range(12)]
    for event in word:
        model = model.given(event, A, 0.5).given(event, B, 0.5)
    found = why(word, Plus(Str(A) | Str(B, B)), model)
    assert "more than 64 ways" in found.rule
    assert 0 < found.p.lo == pytest.approx(found.p.hi)


def test_what_is_asked_of_a_whole_part():
    part = EventString("a", "a")
    model = M.given(part, C)
    T = Plus((Plus(A) & C) | B)
    assert why("aab", T, model).p == (1, 1)
    assert why("ab", T, model).p == (0, 0)
    doubtful = M.given(part, C, 0.5)
    assert why("aab", T, doubtful).p == (0.5, 1)
    closed = doubtful.given(EventString("a"), C, 0)
    assert why("aab", T, closed).p == (0.5, 0.5)
    empty = Model().given("b", B).given(EventString(), C, 0.5)
    assert why("b", Str(Str() & C, B), empty).p == (0.5, 0.5)


def test_one_certain_way_is_enough_among_more_than_can_be_told():
    word = [f"u{number}" for number in range(10)]
    model = Model().given(EventString(*word), C)
    for event in word:
        model = model.given(event, A).given(event, B, 0.5)
    found = why(word, Plus((Plus(A) & C) | Str(B) | Str(B, B)), model)
    assert (found.p, len(found.parts)) == ((1, 1), 1)


def test_more_ways_than_can_be_told_are_open_where_a_part_is_asked_as_a_whole():
    word = [f"u{number}" for number in range(10)]
    model = Model().given(EventString(*word), C, 0.5)
    for event in word:
        model = model.given(event, A).given(event, B, 0.5)
    found = why(word, Plus((Plus(A) & C) | Str(B) | Str(B, B)), model)
    assert found.p == (0, 1)
    assert "more than 64 ways" in found.rule


def test_what_is_open_leaves_a_string_open():
    opened = M.given("x", A, 0.5)
    assert why(("a", "new"), Plus(A), opened).p == (0, 1)


def test_long_strings_are_judged_in_one_go():
    word = ["a", "b"] * 5_000
    assert why(word, Plus(Str(A, B))).p == (1, 1)
    assert why([*word, "a"], Plus(Str(A, B))).rule.startswith("it ends after 10001")
