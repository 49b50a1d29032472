"""Flattening: one level of labels, paths that follow, and the way back."""

import pytest

from ttr import Basic, Ind, ListOf, Pred, Rec, meet, outer, record, rectype, this
from ttr.building.flattening import flatten, unflatten
from ttr.errors import IllFormedError
from ttr.types import Application, Path

A = Basic("A")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
DEEP = rectype(
    x=Ind,
    bg=rectype(y=Ind, n=rectype(z=Ind, e=hug(outer(2).x, outer.y)), c=dog(this.n.z)),
    d=dog(this.bg.n.z),
)
FLAT = rectype(
    x=Ind,
    bg__y=Ind,
    bg__n__z=Ind,
    bg__n__e=hug(this.x, this.bg__y),
    bg__c=dog(this.bg__n__z),
    d=dog(this.bg__n__z),
)


def test_paths_follow_in_and_out():
    assert flatten(DEEP) is FLAT
    assert unflatten(FLAT) is DEEP


def test_a_flat_type_stays_what_it_is():
    assert flatten(FLAT, sep="_in_") is FLAT
    assert unflatten(rectype(x=Ind, c=dog(this.x))) is rectype(x=Ind, c=dog(this.x))


def test_records_are_flattened_alike():
    r = record(x="a", bg={"y": "b", "n": {"z": "c", "e": "s"}, "c": "t"}, d="u")
    flat = record(x="a", bg__y="b", bg__n__z="c", bg__n__e="s", bg__c="t", d="u")
    assert flatten(r) == flatten(r, DEEP) == flat
    assert unflatten(flat) == r


def test_a_record_is_taken_apart_where_a_type_says_so():
    r = record(bg={"x": {"k": "a"}, "extra": "b"}, y={"k": "c"}, z={})
    assert flatten(r) == record(bg__x__k="a", bg__extra="b", y__k="c", z={})
    assert flatten(r, rectype(bg=rectype(x=Rec))) == record(
        bg__x={"k": "a"}, bg__extra="b", y={"k": "c"}, z={}
    )


def test_a_record_lacks_what_the_type_has():
    T = rectype(bg=rectype(x=A))
    for r in (record(), record(bg="a"), record(bg={"y": "a"})):
        with pytest.raises(IllFormedError, match=r"there is no bg"):
            flatten(r, T)


def test_only_record_types_with_fields_are_taken_apart():
    T = rectype(a=Rec, b=rectype(x=A) @ {"x": "a"}, c=meet(A, rectype(x=Ind)))
    U = rectype(n=T, d=dog(this.n.c.x))
    assert flatten(U) is rectype(
        n__a=Rec,
        n__b=rectype(x=A) @ {"x": "a"},
        n__c=meet(A, rectype(x=Ind)),
        d=dog(this.n__c.x),
    )


def test_paths_from_further_in_follow():
    T = rectype(y=Ind, bg=rectype(x=Ind, k=ListOf(rectype(e=hug(outer.x, outer(2).y)))))
    assert flatten(T) is rectype(
        y=Ind, bg__x=Ind, bg__k=ListOf(rectype(e=hug(outer.bg__x, outer.y)))
    )
    assert unflatten(flatten(T)) is T


def test_paths_that_lead_out_of_the_whole_follow():
    T = rectype(bg=rectype(e=hug(outer(2).a, outer(2).b)))
    assert flatten(T) is rectype(bg__e=hug(outer.a, outer.b))
    assert unflatten(flatten(T)) is T


def test_what_is_said_of_a_nested_record_keeps_it_from_being_flat():
    said = Application(Path(0, ("f",)), Path(0, ("bg",)))
    T = rectype(bg=rectype(x=A), f=rectype(x=A) >> A, c=A @ said)
    with pytest.raises(
        IllFormedError, match="bg cannot be flattened: c is about bg as a"
    ):
        flatten(T)


@pytest.mark.parametrize(
    "value",
    [
        rectype(a__b=A),
        rectype(a_=rectype(b=A)),
        rectype(bg__x=A, bg=rectype(x=A)),
        record(bg__x="a", bg={"x": "b"}),
    ],
)
def test_a_label_that_could_be_taken_apart_otherwise_is_refused(value):
    with pytest.raises(IllFormedError, match="cannot become the label") as caught:
        flatten(value)
    assert "separator" in caught.value.hint
    assert unflatten(flatten(value, sep="_in_"), sep="_in_") == value


def test_what_cannot_be_nested_is_said():
    with pytest.raises(IllFormedError, match=r"bg__x cannot become bg\.x"):
        unflatten(rectype(bg=A, bg__x=A))
    with pytest.raises(IllFormedError, match=r"bg__x__y cannot become bg\.x\.y"):
        unflatten(record(bg__x="a", bg__x__y="b"))
    with pytest.raises(IllFormedError, match="a label is an identifier"):
        unflatten(rectype(a____b=A))
    with pytest.raises(IllFormedError, match="flatten takes a record type or a record"):
        flatten(A)
    with pytest.raises(
        IllFormedError, match="unflatten takes a record type or a record"
    ):
        unflatten(A)


@pytest.mark.parametrize("sep", ["", ".", " ", 3])
def test_a_separator_is_a_part_of_an_identifier(sep):
    with pytest.raises(IllFormedError, match="a separator is a part of an identifier"):
        flatten(DEEP, sep=sep)
