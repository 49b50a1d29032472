"""Merge and asymmetric merge beyond their laws."""

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pred,
    Rec,
    amerge,
    merge,
    outer,
    record,
    rectype,
    this,
)
from ttr.building.merging import singleton_type
from ttr.errors import IllFormedError, TTRError
from ttr.signature.signature import Axiom, Signature

A, B, Dog = Basic("A"), Basic("B"), Basic("Dog")
dog = Pred("dog", Ind)
theory = Signature(axioms=(Axiom(Dog, Ind),))


def test_the_simpler_one_where_one_is_below():
    assert merge(A & B, A) is A & B
    assert merge(rectype(x=A, y=B @ this.x), rectype(x=B)) is rectype(x=A, y=B @ this.x)
    assert merge(Dog, Ind, theory) is Dog
    assert merge(Dog, Ind) is Dog & Ind
    assert merge(rectype(x=Dog), rectype(x=Ind), theory) is rectype(x=Dog)


def test_of_two_ways_to_say_the_same_the_shorter():
    S, T = rectype(x=A @ this.y, y=A), rectype(x=A, y=A @ this.x)
    assert merge(S, T) is merge(T, S)


def test_singletons_keep_their_object():
    assert merge(A @ "a", B) is (A & B) @ "a"
    assert merge(A @ "a", B @ "a") is (A & B) @ "a"
    assert merge(A @ "a", A @ "b") is A @ "a" & A @ "b"


def test_nested_types_keep_their_paths():
    S = rectype(x=Ind, n=rectype(c=dog(outer.x)))
    T = rectype(n=rectype(y=Ind), x=Ind @ "j")
    assert merge(S, T) is rectype(x=Ind @ "j", n=rectype(c=dog(outer.x), y=Ind))


def test_no_label_is_lost_where_nothing_is_of_a_type():
    S = merge(rectype(x=Ind @ "j"), rectype(x=Ind @ "k"))
    assert str(S) == "[x : (Ind@j) /\\ (Ind@k)]"
    assert merge(S, rectype(y=Ind)) is merge(rectype(y=Ind), S)
    assert merge(S, rectype(y=Ind)).labels == ("x", "y")


def test_types_of_other_kinds_meet():
    assert merge(ListOf(A), Rec) is ListOf(A) & Rec
    assert merge(ListOf(A), ListOf(B)) is ListOf(A) & ListOf(B)


def test_merging_under_a_theory_keeps_what_fits_by_it():
    S = rectype({"x": Dog, "c": dog(this.x)}, theory)
    assert merge(S, rectype(y=Ind), theory).labels == ("x", "y", "c")
    assert amerge(S, rectype(y=Ind), theory).labels == ("x", "y", "c")


def test_amerge_refuses_what_would_lead_nowhere():
    S = rectype(n=rectype(x=Ind), c=dog(this.n.x))
    with pytest.raises(IllFormedError, match=r"the path n\.x leads nowhere"):
        amerge(S, rectype(n=Ind))


def test_the_type_of_just_one_state():
    T = rectype(x=Ind, n=rectype(y=Ind @ outer.x), l=ListOf(Ind), c=dog(this.x))
    state = record(x="a", n={"y": "a"}, l=["a"], c="s", extra=1)
    assert singleton_type(state, T) is rectype(
        x=Ind @ "a",
        n=rectype(y=Ind @ "a"),
        l=ListOf(Ind) @ ["a"],
        c=dog(this.x) @ "s",
    )
    with pytest.raises(TTRError, match=r"has no l, so it is not of"):
        singleton_type(record(), T)


def test_what_is_no_type():
    for operation in (merge, amerge):
        with pytest.raises(
            IllFormedError, match="expected a type, found the predicate dog"
        ):
            operation(dog, A)
