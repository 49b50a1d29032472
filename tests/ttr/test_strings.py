"""Types of strings by their form: pieces, concatenation, alternatives."""

import pytest

from ttr import Basic, Model, Plus, Rec, Str, Theory, join, rectype
from ttr.building import common_supertype
from ttr.computing.strings.pieces import (
    alternatives,
    events_of,
    is_of_strings,
    is_regular,
    regular_above,
    string_of,
)
from ttr.types import EventString
from ttr.types.derived_types import star

A, B, C = map(Basic, "ABC")


def test_concatenation_is_flat():
    assert Str(Str(A, B), C) is Str(A, Str(B, C)) is Str(A, B, C)
    assert Str(Str()) is Str()
    assert Str(Plus(A), Str(B)).items == (Plus(A), B)


def test_concatenation_prints_and_reads_back():
    T = Str(Str(A), Plus(Str(B, C)), A | Str(B))
    assert str(T) == r"str(A, plus(str(B, C)), A \/ str(B))"
    assert Theory.of(T).parse(str(T)) is T
    assert eval(repr(T), {"Basic": Basic, "Plus": Plus, "Str": Str, "join": join}) is T


def test_star_is_none_or_more():
    assert star(A) is Str() | Plus(A)


@pytest.mark.parametrize(
    ("T", "so"),
    [
        (Str(A), True),
        (Plus(A) & B, True),
        (Str(A) @ EventString("a"), True),
        (A | Str(B), True),
        (~(~Str(A) | B), True),
        (A, False),
        (~Str(A), False),
    ],
    ids=str,
)
def test_what_is_of_strings_by_its_form(T, so):
    assert is_of_strings(T) is so


def test_the_events_of_a_string():
    assert events_of(Str(A, ~B)) == (A, ~B)
    assert events_of(Str(A, star(B))) is None


@pytest.mark.parametrize(
    ("T", "several"),
    [
        (A | B, [A | B]),
        (A | Str(B), [A, Str(B)]),
        ((A | Str(B)) & C, [A & C, C & Str(B)]),
        (Plus(A) & (~Str(A) | ~Str(B)), [Plus(A) & ~Str(A), Plus(A) & ~Str(B)]),
        (~~(A | Str(B)), [A, Str(B)]),
        ((A | Str(B)) @ EventString("b"), [T @ EventString("b") for T in (A, Str(B))]),
    ],
    ids=str,
)
def test_alternatives_are_of_strings_or_of_events(T, several):
    assert set(alternatives(T)) == set(several)


def test_many_alternatives_are_left_whole():
    whole = Plus(A)
    for number in range(9):
        whole &= Str(A) | Basic(f"T{number}")
    assert alternatives(whole) == (whole,)


@pytest.mark.parametrize(
    ("T", "above"),
    [
        (Str(A) & B, Str(A)),
        (Str(A) @ EventString("a"), Str(A)),
        (Plus(A) & ~Str(A) & C, Plus(A) & ~Str(A)),
        (Plus(A) & (Str(B) @ EventString("b")), Plus(A) & Str(B)),
    ],
    ids=str,
)
def test_what_events_do_not_tell_is_left_out_above(T, above):
    assert not is_regular(T)
    assert regular_above(T) is above


def test_pieces_are_put_in_a_row():
    nested = EventString("a")
    assert string_of((Plus(A), A), (EventString("a", "b"), nested)) is EventString(
        "a", "b", nested
    )


M = Model().given("a", A).given("b", B).given("c", C)


@pytest.mark.parametrize(
    ("string", "T", "so"),
    [
        ("aab", Str(Plus(A), B), True),
        ("b", Str(Plus(A), B), False),
        ("b", Str(star(A), B), True),
        ("", star(A), True),
        ("", Plus(A), False),
        ("", Plus(Str() | A), True),
        ("abab", Str(A, star(Str(B, A)), B), True),
        ("aba", Str(A, star(Str(B, A)), B), False),
        ("abc", Str(Str(A, B), C), True),
        ("aab", Plus(A | B) & ~Plus(A), True),
        ("aaa", Plus(Str(A, A)) & Plus(A), False),
        ("ba", Str(A | Str(B), Str(A) | B), True),
    ],
)
def test_strings_of_pieces_are_judged(string, T, so):
    assert M.judge(EventString(*string), T).holds is so


def test_a_nested_string_is_no_piece():
    nested = EventString(EventString("a"), "b")
    assert M.judge(nested, Str(Plus(A), B)).holds is False


def test_a_string_with_pieces_is_given_only_if_its_events_are_known():
    assert M.given(EventString("a", "b"), Str(Plus(A), B)) is M
    told = Model().given(EventString("x", "y"), Str(Str(A), B))
    assert told.judge("x", A).holds


def test_the_known_witnesses_of_pieces():
    T = Str(A, Str() | Str(B))
    assert set(M.witnesses(T)) == {EventString("a"), EventString("a", "b")}


def test_what_strings_have_in_common_is_made_of_strings():
    whole, other = Plus(Str(A) & C), Plus(Str(B) & C)
    assert common_supertype(rectype(s=whole), rectype(s=other)) is Rec
    S, T = Plus(Str(A & B)), Plus(Str(A & C))
    assert common_supertype(rectype(s=S), rectype(s=T)) is rectype(s=Plus(Str(A)))


@pytest.mark.parametrize(
    "T",
    [
        Str(star(A), B),
        Plus(A) & Plus(Str(B, B)),
        Plus(A) & ~Str(A),
        Plus((Str() & Str(A)) | Str(B)),
        Str(A | Str(B, C), Plus(C)),
        Str(A, B) & Plus(C) & B,
    ],
    ids=str,
)
def test_what_is_made_up_is_of_the_type(T):
    made, model = Model().create(T)
    assert model.judge(made, T).holds


def test_what_is_not_of_two_types_of_events_is_an_event():
    assert not is_of_strings(~(A & B))
    assert events_of(Str(~(A & B), A)) == (~(A & B), A)
