"""Subtraction: a type without a path, unless another field needs it."""

import pytest

from ttr import Basic, Ind, Pred, Rec, meet, outer, record, rectype, this
from ttr.building.subtraction import subtract
from ttr.errors import IllFormedError

A = Basic("A")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
PAIR = rectype(x=Ind, y=Ind, e=hug(this.x, this.y))


def test_case_t13():
    assert subtract(PAIR, "e") is rectype(x=Ind, y=Ind)


def test_a_field_that_is_needed_cannot_go_alone():
    with pytest.raises(IllFormedError, match="without y, the path y leads nowhere"):
        subtract(PAIR, "y")
    assert subtract(PAIR, "y", "e") is subtract(PAIR, "e", "y") is rectype(x=Ind)


def test_a_path_into_a_nested_record_type():
    T = rectype(bg=rectype(x=Ind, c=dog(this.x)), y=Ind)
    assert subtract(T, "bg.c") is rectype(bg=rectype(x=Ind), y=Ind)
    assert subtract(T, "bg.c", "bg.x") is rectype(bg=Rec, y=Ind)
    with pytest.raises(
        IllFormedError, match=r"without bg\.x, the path x leads nowhere"
    ):
        subtract(T, "bg.x")


def test_what_is_needed_from_outside_or_further_in_cannot_go():
    T = rectype(bg=rectype(x=Ind), c=dog(this.bg.x))
    with pytest.raises(IllFormedError, match=r"the path bg\.x leads nowhere"):
        subtract(T, "bg.x")
    U = rectype(x=Ind, n=rectype(c=dog(outer.x)))
    with pytest.raises(IllFormedError, match="without x, the path x leads nowhere"):
        subtract(U, "x")


def test_a_field_goes_from_every_part_of_a_meet():
    T = rectype(bg=meet(rectype(x=Ind, y=A), rectype(x=A), A))
    assert subtract(T, "bg.x") is rectype(bg=meet(rectype(y=A), Rec, A))


def test_records_lose_what_a_path_leads_to():
    r = record(bg={"x": "a", "y": "b"}, z="c")
    assert subtract(r, "bg.x", "z") == record(bg={"y": "b"})
    with pytest.raises(IllFormedError, match=r"there is no bg\.zz to take away"):
        subtract(r, "bg.zz")
    with pytest.raises(IllFormedError, match=r"there is no z\.x to take away"):
        subtract(r, "z.x")


def test_a_path_that_is_not_there_is_named():
    with pytest.raises(IllFormedError, match="there is no ee to take away") as caught:
        subtract(PAIR, "ee")
    assert caught.value.hint == "did you mean e?"
    with pytest.raises(
        IllFormedError, match=r"no x\.y to take away: x : Ind is no record"
    ):
        subtract(PAIR, "x.y")
    with pytest.raises(IllFormedError, match=r"bg : \[x : Ind\]@a is no record type"):
        subtract(rectype(bg=rectype(x=Ind) @ "a"), "bg.x")


def test_what_cannot_be_subtracted_from_is_said():
    with pytest.raises(
        IllFormedError, match="subtract takes a record type or a record"
    ):
        subtract(Ind, "x")
    with pytest.raises(IllFormedError, match="a path as a text"):
        subtract(PAIR, 3)


def test_subtraction_gives_a_supertype():
    assert subtract(PAIR, "e") >= PAIR


def test_a_longer_path_goes_into_the_part_of_a_meet_that_has_it():
    T = rectype(x=rectype(a=rectype(b=Ind, c=Ind)) & ~rectype(d=A))
    without = rectype(x=rectype(a=rectype(c=Ind)) & ~rectype(d=A))
    assert subtract(T, "x.a.b") is without
