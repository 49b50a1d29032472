"""Inclusion of types of strings, by two automata side by side."""

import pytest

from ttr import Basic, Pred, RecordType, Str, Theory, rectype, subtype, this
from ttr.computing.strings.automata import automaton
from ttr.computing.strings.inclusion import check_inclusion
from ttr.types.derived_types import star
from ttr.types.syntax import Ind, ListOf, Plus

A, B, C, D = map(Basic, "ABCD")
dog = Pred("dog", Ind)


def same(event, types):
    return event in types


def test_without_another_type_there_should_be_no_strings():
    assert check_inclusion(automaton(Str(A) & Str(A, A)), None, same).yes
    assert check_inclusion(automaton(Plus(A)), None, same).against == (A,)


def test_the_shortest_string_speaks_against_it():
    found = check_inclusion(automaton(Str(A, A) | Str(B)), automaton(Str(A)), same)
    assert found.against == (B & ~A,)


def test_an_event_may_be_of_several_types():
    """Whatever is of A is of B or of C, though not surely of one of them."""

    def below(event, types):
        return event in types or (event is A and {B, C} <= set(types))

    above = automaton(Str(B, D) | Str(C, D))
    assert check_inclusion(automaton(Str(A, D)), above, below).yes
    above = automaton(Str(B, D) | Str(C, C))
    assert check_inclusion(automaton(Str(A, D)), above, below).against == (
        A & ~B,
        D & ~C,
    )


def test_it_is_left_where_there_are_too_many_states():
    def nth_last(n):
        return Str(star(A | B), A, *[A | B] * n)

    found = check_inclusion(automaton(nth_last(12)), automaton(nth_last(11)), same)
    assert not found.yes


SAME = {
    "repetitions": (Plus(Plus(A)), Plus(A)),
    "a join inside": (Str(A, B) | Str(A, C), Str(A, B | C)),
    "once and more": (Str(A, star(A)), Plus(A)),
    "more and once": (Str(star(A), A), Plus(A)),
    "none left out": (star(A) & ~Str(), Plus(A)),
    "both": (Plus(A) & Plus(B), Plus(A & B)),
    "odd": (Plus(A) & ~Plus(Str(A, A)), Str(A, star(Str(A, A)))),
    "in a record": (
        rectype(x=Ind, s=Plus(dog(this.x))),
        rectype(x=Ind, s=Str(dog(this.x), star(dog(this.x)))),
    ),
    "in a list": (ListOf(Plus(Plus(A))), ListOf(Plus(A))),
    "what cannot be": (Plus(A & ~A), Plus(B & ~B)),
}


@pytest.mark.parametrize("name", SAME)
def test_the_same_strings(name):
    S, T = SAME[name]
    assert subtype(S, T).yes
    assert subtype(T, S).yes


BELOW = {
    "one or none": (Plus(A), star(A)),
    "an even number": (Plus(Str(A, A)), Plus(A)),
    "at least one B": (Str(star(A), B, star(A)), Plus(A | B)),
    "either": (Plus(A) | Plus(B), Plus(A | B)),
    "ends in A": (Str(star(A | B), A), Plus(A | B) & ~Str()),
    "as a whole": (Plus(Str(A) & B), Plus(A)),
    "wholes": (Plus(Str(A) & B & C), Plus(Str(A) & B)),
    "not empty": (Plus(A), ~Str()),
    "fields of events": (Str(rectype(x=A), Plus(rectype(y=A))), Plus(rectype())),
    "one of two lengths": (Plus(A), Str(A) | Str(A, Plus(A))),
}


DECIDED = BELOW.keys() - {"not empty", "one of two lengths"}
"""Where the other way round there is a string that speaks against it."""


@pytest.mark.parametrize("name", BELOW)
def test_fewer_strings(name):
    S, T = BELOW[name]
    assert subtype(S, T).yes
    if name in DECIDED:
        against = subtype(T, S)
        assert against.no
        assert against.counter.p == (0, 0)


def test_a_counter_example_is_found_inside_a_record():
    answer = subtype(rectype(s=Plus(A | B)), rectype(s=Plus(Str(A | B, A | B))))
    assert isinstance(answer.counter.type, RecordType)
    assert str(answer.counter.sit) == "{s = <a1>}"


def test_axioms_are_used_event_by_event():
    kennel = Theory.parse("basic Ind\npred bark(Ind), howl(Ind)\nhowl(x) <: bark(x)")
    S = kennel.parse("plus(howl('a'))")
    T = kennel.parse("plus(bark('a'))")
    assert subtype(S, T, kennel).yes
    assert subtype(S, T).no


def test_many_denials_come_to_an_end():
    denied = star(A)
    for T in (Str(), Str(A), Str(A, A), Str(A, A, A)):
        denied &= ~T
    answer = subtype(denied, Str(A, A, A, Plus(A)))
    assert answer.yes
