"""The most specific type above two types, without making a join."""

import pytest

from ttr import (
    Basic,
    Ind,
    ListOf,
    Pi,
    Plus,
    Pred,
    Rec,
    RecType,
    SetOf,
    Str,
    Theory,
    Type,
    join,
    outer,
    rectype,
    this,
)
from ttr.building.generalisation import common_supertype
from ttr.errors import IllFormedError
from ttr.types import NonEmpty

A, B, C = map(Basic, "ABC")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)


@pytest.mark.parametrize(
    ("S", "T", "expected"),
    [
        (A & B, A, A),
        (A & B, B & C, B),
        (Ind @ "a", Ind @ "b", Ind),
        (Ind @ "a", Ind, Ind),
        (RecType, Type, Type),
        (ListOf(A & B), ListOf(A & C), ListOf(A)),
        (NonEmpty(A), ListOf(A & B), ListOf(A)),
        (NonEmpty(A & C), NonEmpty(A & B), NonEmpty(A)),
        (SetOf(A @ "a"), SetOf(A @ "b"), SetOf(A)),
        (Plus(A & B), Plus(A & C), Plus(A)),
        (Str(A & B, A), Str(A & C, A), Str(A, A)),
        ((A & C) >> (A & B), A >> (B & C), (A & C) >> B),
        ((A & B) | (A & C), A & Type, A),
    ],
)
def test_types_that_are_no_record_types(S, T, expected):
    assert common_supertype(S, T) is expected
    assert common_supertype(T, S) is expected


@pytest.mark.parametrize(
    ("S", "T"), [(A, B), (A, rectype(x=A)), (ListOf(A), SetOf(A)), (Str(A), Str(A, A))]
)
def test_there_is_no_type_of_everything(S, T):
    with pytest.raises(IllFormedError, match="have no common supertype without a join"):
        common_supertype(S, T)


def test_only_what_both_record_types_have_stays():
    S = rectype(x=Ind, y=A, c=dog(this.x))
    assert common_supertype(S, rectype(x=Ind, y=B, c=dog(this.x))) is rectype(
        x=Ind, c=dog(this.x)
    )
    assert common_supertype(rectype(x=A), rectype(y=A)) is Rec


def test_a_field_stays_only_with_what_it_depends_on():
    S = rectype(x=A, y=Ind, c=Pred("p", A, Ind)(this.x, this.y), d=dog(this.y))
    T = rectype(x=B, y=Ind, c=Pred("p", A, Ind)("k", this.y), d=dog(this.y))
    assert common_supertype(S, T) is rectype(y=Ind, d=dog(this.y))


def test_what_is_set_alike_stays_set():
    S = rectype(x=Ind @ "a", y=Ind @ "b", z=ListOf(Ind) @ ["a", "b"])
    T = rectype(x=Ind @ "a", y=Ind @ "c", z=ListOf(Ind) @ ["a", "c"])
    assert common_supertype(S, T) is rectype(
        x=Ind @ "a", y=Ind, z=ListOf(Ind) @ ("a", this.y)
    )


def test_what_is_equal_in_both_stays_equal():
    S = rectype(x=Ind @ "a", y=Ind @ "a")
    T = rectype(x=Ind, y=Ind @ this.x)
    assert common_supertype(S, T) is T
    both = common_supertype(S, rectype(x=Ind @ "b", y=Ind @ "b"))
    assert both in (rectype(x=Ind, y=Ind @ this.x), rectype(y=Ind, x=Ind @ this.y))


def test_objects_become_the_path_that_leads_to_them_in_both():
    S = rectype(x=Ind @ "a", c=dog("a"), f=Pi(v=Ind)(hug("a", this.v)))
    T = rectype(x=Ind @ "b", c=dog("b"), f=Pi(v=Ind)(hug("b", this.v)))
    assert common_supertype(S, T) is rectype(
        x=Ind, c=dog(this.x), f=Pi(v=Ind)(hug(outer.x, this.v))
    )


def test_nested_record_types_are_generalised_in_their_place():
    S = rectype(y=Ind, n=rectype(x=Ind @ outer.y, e=hug(outer.y, this.x), k=A))
    T = rectype(y=Ind, n=rectype(x=Ind, e=hug(outer.y, this.x), k=B))
    assert common_supertype(S, T) is rectype(
        y=Ind, n=rectype(x=Ind, e=hug(outer.y, this.x))
    )


def test_a_path_into_a_field_that_is_no_plain_record_type():
    n = A & rectype(x=Ind)
    S = rectype(n=n, c=dog(this.n.x), k=A)
    T = rectype(n=n, c=dog(this.n.x), k=B)
    assert common_supertype(S, T) is rectype(n=n, c=dog(this.n.x))


def test_a_circle_stays_a_circle():
    S = rectype(x=Ind @ this.y, y=Ind @ this.x, k=A)
    T = rectype(x=Ind @ this.y, y=Ind @ this.x, k=B)
    found = common_supertype(S, T)
    assert found >= S
    assert found >= T
    assert set(found) == {"x", "y"}


def test_axioms_of_a_theory_are_followed():
    pets = Theory.parse(
        """
        basic Pet, Dog, Cat
        pred lives(Pet), barks(Pet), meows(Pet)
        Dog <: Pet
        Cat <: Pet
        barks(x) <: lives(x)
        meows(x) <: lives(x)
        """
    )
    S = pets.parse("[x : Dog, c : barks(x)]")
    T = pets.parse("[x : Cat, c : meows(x)]")
    found = common_supertype(S, T, pets.signature)
    assert found is pets.parse("[x : Pet, c : lives(x)]")
    assert common_supertype(S, T) is Rec


def test_a_join_that_is_there_stays():
    S, T = rectype(x=A | B, y=A), rectype(x=A, y=B)
    assert common_supertype(S, T) is rectype(x=A | B)


def test_a_field_that_would_not_fit_any_more_is_left_out():
    either = Pred("p", A | B)
    S = rectype(x=A & C, c=either(this.x))
    T = rectype(x=B & C, c=either(this.x))
    found = common_supertype(S, T)
    assert found >= S
    assert found >= T
    assert found["x"] is C


def test_one_below_the_other_gives_the_other():
    S = rectype(x=Ind, c=dog(this.x))
    assert common_supertype(S, rectype(x=Ind)) is rectype(x=Ind)
    assert common_supertype(S, S) is S
    assert common_supertype(A & ~A, B) is B


def test_only_types_have_supertypes():
    with pytest.raises(IllFormedError, match="expected a type"):
        common_supertype("A", A)


def test_a_join_of_many():
    assert common_supertype(join(A & C, B & C), C & Type) is C


@pytest.mark.parametrize("turned", [False, True])
def test_functions_have_none_above_them_if_the_result_of_one_depends(turned):
    fixed = Ind >> rectype(a=A, c=dog("fido"))
    depends = Pi(x=Ind)(rectype(a=A, c=dog(outer.x)))
    both = (depends, fixed) if turned else (fixed, depends)
    with pytest.raises(IllFormedError, match="have no common supertype"):
        common_supertype(*both)
