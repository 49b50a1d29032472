"""Running automata: one way, all ways, and where a string stops."""

from itertools import islice

from ttr import Basic, Plus, Str
from ttr.computing.strings.automata import automaton
from ttr.computing.strings.automaton_runs import (
    Stop,
    accepts,
    find_division,
    find_divisions,
    shortest_words,
)
from ttr.types.derived_types import star

A, B, C = map(Basic, "ABC")


def among(*kinds):
    """What each event is of, one or several types."""
    return lambda number, T: T in kinds[number]


def never(start, end, T):
    return False


def test_a_way_goes_back_where_it_has_to():
    found = automaton(Plus(Str(A, B) | Str(A, A, B)))
    kinds = ({A}, {A}, {B}, {A}, {B})
    assert find_division(5, found, among(*kinds)) == (A, A, B, A, B)


def test_where_a_string_stops():
    found = automaton(Str(A, B | Str(C)))
    stop = find_division(2, found, among({A}, {A}))
    assert stop == Stop(1, (B, C), False)
    stop = find_division(3, found, among({A}, {B}, {A}))
    assert stop == Stop(2, (), True)
    stop = find_divisions(1, found, among({A}), never)
    assert stop == Stop(1, (B, C), False)


def test_every_event_is_asked_for_a_type_once():
    asked = []

    def fits(number, T):
        asked.append((number, T))
        return True

    find_division(4, automaton(Plus(Str(A) | Str(A, A) | Str(A, B))), fits)
    assert len(asked) == len(set(asked))


def test_ways_are_told_apart_by_types_not_by_states():
    found = find_divisions(
        3, automaton(Str(star(A), star(A))), among({A}, {A}, {A}), never
    )
    assert found.all
    assert len(found.ways) == 1


def test_more_ways_than_are_told_apart():
    found = find_divisions(
        12, automaton(Plus(Str(A) | Str(B, B) | Str(B))), lambda i, T: True, never
    )
    assert not found.all
    assert len(set(found.ways)) == len(found.ways) == 64


def test_wholes_may_be_empty_or_long():
    part = Str(A) & B
    optional = Str() & C
    found = automaton(Str(part, optional, star(part)))

    def fits_whole(start, end, T):
        return end - start == (0 if T is optional else 1)

    division = find_divisions(2, found, among({A}, {A}), fits_whole)
    (way,) = division.ways
    assert [(piece.start, piece.end) for piece in way] == [(0, 1), (1, 1), (1, 2)]


def test_whether_there_is_a_way():
    found = automaton(Plus(Str(A, B)))
    assert accepts(4, found, lambda number, T: True)
    assert not accepts(3, found, lambda number, T: True)
    assert not accepts(2, found, lambda number, T: T is A)


def test_strings_shortest_first_but_long_enough():
    found = automaton(Plus(A | Str(B, B)))
    assert list(islice(shortest_words(found), 3)) == [(A,), (A, A), (B, B)]
    assert next(iter(shortest_words(found, 4))) == (A, A, A, A)
    assert list(shortest_words(automaton(Str(A) | Str(B, B)), 5)) == [(B, B), (A,)]
    assert list(shortest_words(automaton(Str(A) & Str(A, A)))) == []
