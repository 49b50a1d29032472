"""Normal forms: meets of joins, joins of meets, negations inside."""

import pytest

from ttr import Basic, Plus, Str, join, meet, rectype
from ttr.computing.case_analysis import cases
from ttr.computing.normal_forms import join_normal_form, meet_normal_form
from ttr.errors import IllFormedError, UnsupportedError
from ttr.types import Negation

A, B, C, D = map(Basic, "ABCD")


def test_joins_are_spread_over_meets():
    assert meet_normal_form((A & B) | C) is (A | C) & (B | C)
    assert join_normal_form(A & (B | C)) is (A & B) | (A & C)
    assert join_normal_form((A | B) & (C | D)) is join(A & C, A & D, B & C, B & D)


def test_negations_go_inwards():
    assert meet_normal_form(~~A) is join_normal_form(~~A) is A
    assert meet_normal_form(~~~A) is ~A
    assert meet_normal_form(~((A & ~B) | C)) is (~A | B) & ~C
    assert join_normal_form(~((A & ~B) | C)) is (~A & ~C) | (B & ~C)


def test_what_says_nothing_more_is_left_out():
    assert meet_normal_form(A & (A | B)) is A
    assert join_normal_form(A | (A & B)) is A
    assert meet_normal_form((A & B) | (A & C)) is A & (B | C)


def test_what_is_no_meet_or_join_stays_as_it_is():
    T = rectype(x=A & (B | C))
    assert meet_normal_form(T) is join_normal_form(T) is T
    assert join_normal_form(~(T & A)) is ~T | ~A


def test_one_form_leads_to_the_other_and_back():
    T = join(*[Basic(f"L{i}") & Basic(f"R{i}") for i in range(6)])
    assert len(meet_normal_form(T).parts) == 64
    assert join_normal_form(meet_normal_form(T)) is T


def test_there_is_a_limit_and_it_is_named():
    pairs = [(Basic(f"L{i}"), Basic(f"R{i}")) for i in range(14)]
    with pytest.raises(
        UnsupportedError, match="a normal form of more than 4,096 parts"
    ):
        meet_normal_form(join(*[L & R for L, R in pairs]))
    with pytest.raises(
        UnsupportedError, match="a normal form of more than 4,096 parts"
    ):
        join_normal_form(meet(*[L | R for L, R in pairs]))
    many = meet(*[Basic(f"L{i}") for i in range(4000)])
    assert meet_normal_form(many) is many


def test_deep_nesting_is_an_error_of_ours():
    T = A
    for _ in range(20_000):
        T = Negation(T)
    with pytest.raises(UnsupportedError, match="deeper than can be followed"):
        meet_normal_form(T)


def test_only_types_have_normal_forms():
    with pytest.raises(IllFormedError, match="expected a type"):
        meet_normal_form("A")
    with pytest.raises(IllFormedError, match="expected a type"):
        join_normal_form("A")


def test_there_is_a_case_for_each_way_to_choose_the_parts():
    T = rectype(x=A | B, y=C | D, z=A)
    some = [rectype(x=X, y=Y, z=A) for X in (A, B) for Y in (C, D)]
    assert cases(T) == tuple(some)
    assert cases(Str(A | B, Plus(A | B))) == (Str(A, Plus(A | B)), Str(B, Plus(A | B)))
    assert cases((A | B) @ "a") == (A @ "a", B @ "a")
    assert cases(~(A & B)) == (~A, ~B)


def test_cases_that_are_too_many_are_not_left_out():
    several = [join(*(Basic(f"A{i}{j}") for j in range(9))) for i in range(4)]
    assert len(cases(several[0])) == 9
    assert cases(meet(*several)) is None
    assert cases(A | meet(*several)) is None
