"""Automata: states are what is left of a type, labels are types of events."""

import pytest

from ttr import Basic, Model, Plus, Str, join, subtype
from ttr.computing.strings import automaton_steps
from ttr.computing.strings.automata import automaton, automaton_above
from ttr.computing.strings.automaton_steps import intersect
from ttr.errors import UnsupportedError
from ttr.types import EventString
from ttr.types.derived_types import star

A, B, C = map(Basic, "ABC")


def steps(T):
    """What a string of a type may begin with, and what is left after that."""
    found = automaton(T)
    edges = found.edges[found.start]
    return {(str(edge.label), str(found.rest_of(edge.target))) for edge in edges}


def test_a_step_takes_an_event_off():
    assert steps(Str(A, B)) == {("A", "str(B)")}
    assert steps(Str(A)) == {("A", "str()")}
    assert steps(Str()) == set()


def test_a_repetition_goes_on_or_not():
    assert steps(Plus(A)) == {("A", r"plus(A) \/ str()")}
    assert steps(Str(star(A), B)) == {
        ("A", r"str(plus(A) \/ str(), B)"),
        ("B", "str()"),
    }


def test_what_follows_an_optional_piece_may_come_at_once():
    found = automaton(Str(star(A), star(B)))
    assert found.labels(found.start) == (A, B)
    assert found.start in found.final


def test_a_meet_goes_on_with_both():
    assert steps(Plus(A) & Str(B, C)) == {(r"A /\ B", r"(plus(A) \/ str()) /\ str(C)")}


def test_what_is_denied_is_told_apart():
    assert steps(Plus(A) & ~Str(B)) == {
        (r"A /\ B", r"(plus(A) \/ str()) /\ ~str()"),
        (r"A /\ ~B", r"plus(A) \/ str()"),
    }


def test_steps_that_lead_nowhere_are_left_out():
    assert automaton(Str(A) & Str(A, A)).empty
    assert steps(Str(A, Str(B) & Str(B, B)) | Str(C)) == {("C", "str()")}


def test_states_are_no_more_than_events():
    kinds = [Basic(f"T{number}") for number in range(20)]
    assert len(automaton(Plus(Str(*kinds))).edges) == 21


def test_what_is_asked_of_a_whole_is_a_step_of_its_own():
    found = automaton(Plus(Str(A) & B))
    assert [str(edge.label) for edge in found.wholes[found.start]] == [r"B /\ str(A)"]
    above = automaton_above(Plus(Str(A) & B))
    assert above.labels(above.start) == (A,)
    assert not any(above.wholes.values())


def test_a_meet_may_have_too_many_states():
    kinds = [Basic(f"T{number}") for number in range(8)]
    assert automaton(Plus(A) & ~Plus(join(*map(Str, kinds[:4])))).edges
    many = Plus(A) & ~Plus(join(*map(Str, kinds)))
    found = automaton(Str(many, B))
    assert [edge.label for edge in found.wholes[found.start]] == [many]
    with pytest.raises(UnsupportedError, match="too many cases to be followed"):
        automaton_above(Str(many, B))


def test_a_meet_may_have_just_as_many_edges_as_are_followed(monkeypatch):
    both = [automaton(Str(A, B, C)), automaton(Str(C, A, B))]
    monkeypatch.setattr(automaton_steps, "EDGES", 3)
    assert sum(map(len, intersect(both, []).edges.values())) == 3
    monkeypatch.setattr(automaton_steps, "EDGES", 2)
    with pytest.raises(UnsupportedError, match="too many cases to be followed"):
        intersect(both, [])


def test_what_has_too_many_states_is_judged_all_the_same():
    kinds = [Basic(f"T{number}") for number in range(8)]
    T = Str(Plus(A) & ~Plus(join(*map(Str, kinds))), B)
    model = Model().given("a", A).given("b", B).given("t", A).given("t", kinds[5])
    assert model.judge(EventString("t", "a", "b"), T).holds
    assert model.judge(EventString("t", "t", "b"), T).holds is False
    assert subtype(T, Plus(A | B)).verdict in ("yes", "unknown")
