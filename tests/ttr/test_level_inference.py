"""Superscripts that are left out: filled in, kept, refused."""

import pytest
from hypothesis import given

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Plus,
    Rec,
    RecType,
    SetOf,
    Str,
    Type,
    fun,
    outer,
    record,
    rectype,
    this,
)
from ttr.building.level_inference import levelled_judgement, with_levels, without_levels
from ttr.computing.universe_levels import level_of
from ttr.errors import IllFormedError
from ttr.testing.strategies import types
from ttr.types import EventString, Universe

T1, T2, T3 = (Universe("Type", n) for n in (1, 2, 3))
Of_types = rectype(x=Type)


def test_a_manifest_field_is_of_its_type():
    assert with_levels(rectype(T=Type @ Of_types)) is rectype(T=T1 @ Of_types)
    assert with_levels(rectype(T=Type @ rectype(x=Ind))) is rectype(
        T=Type @ rectype(x=Ind)
    )


def test_one_field_is_as_high_as_the_one_it_is_set_to():
    high = rectype(x=T2, y=Type @ this.x, z=rectype(w=Type @ outer.y))
    read = rectype(x=T2, y=T2 @ this.x, z=rectype(w=T2 @ outer.y))
    assert with_levels(high) is read


def test_a_field_set_to_a_field_with_a_value_is_as_high_as_the_value():
    low = rectype(x=T2 @ Ind, y=Type @ this.x)
    assert with_levels(low) is low


def test_a_function_takes_what_it_is_given():
    assert str(with_levels(fun(x=Type)(this.x)(Type))) == r"(\T:Type^1. T)(Type)"


@pytest.mark.parametrize(
    ("sit", "T", "read"),
    [
        (Type, Type, T1),
        (T1, Type, T2),
        (Ind, Type, Type),
        (RecType, Type, T1),
        (Of_types, RecType, Universe("RecType", 1)),
        ([Type, rectype(x=T1)], ListOf(Type), ListOf(T2)),
        ({Type}, SetOf(Type), SetOf(T1)),
        (EventString(Ind, Type), Str(Type, Type), Str(Type, T1)),
        (EventString(Ind, Type), Plus(Type), Plus(T1)),
        (record(T=Type), rectype(T=Type), rectype(T=T1)),
        (Type, Type & Type @ Type, T1 & T1 @ Type),
        (fun(x=T1)(this.x), T1 >> Type, T1 >> T1),
        (Type, Type | RecType, Type | RecType),
        ("fido", Ind, Ind),
    ],
)
def test_a_judgement_with_levels(sit, T, read):
    assert levelled_judgement(sit, T)[1] is read


def test_type_of_type_is_read_and_never_of_itself():
    """Girard: no reading makes a type of types one of its own objects."""
    sit, T = levelled_judgement(Type, Type)
    assert Model().judge(sit, T).holds is True
    assert sit is not T
    assert Model().judge(Type, Type).holds is False
    with pytest.raises(IllFormedError, match=r"level 2 is too high for Type\^1"):
        levelled_judgement(T1, T1)


def test_a_superscript_that_is_written_is_kept():
    assert with_levels(T3 @ Ind) is T3 @ Ind
    with pytest.raises(IllFormedError, match=r"write Type\^3, or leave") as wrong:
        with_levels(rectype(x=T1 @ T2))
    assert "level 3" in wrong.value.message


def test_superscripts_left_out():
    T = rectype(x=T2 @ T1, y=ListOf(Universe("RecType", 1)))
    assert without_levels(T) is rectype(x=Type @ Type, y=ListOf(RecType))


def test_what_is_no_type():
    with pytest.raises(IllFormedError, match="expected a type, found the object 'a'"):
        with_levels("a")
    with pytest.raises(IllFormedError, match="expected a type"):
        levelled_judgement("a", "b")


@given(types())
def test_reading_twice_is_reading_once(T):
    try:
        read = with_levels(without_levels(T))
    except IllFormedError:
        return
    assert with_levels(read) is read
    assert without_levels(read) is without_levels(T)


@given(types())
def test_every_type_is_of_type_in_some_reading(T):
    try:
        read = levelled_judgement(without_levels(T), Type)
    except IllFormedError:
        return
    sit, universe = read
    assert universe is Universe("Type", level_of(sit))
    assert Model().judge(sit, universe).holds


def test_what_has_no_levels_stays_as_it_is():
    A = Basic("A")
    T = rectype(x=A, y=A @ this.x, r=Rec)
    assert with_levels(T) is T
