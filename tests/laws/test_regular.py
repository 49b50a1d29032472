"""Laws of types of strings: judged, compared and followed as their definition says."""

from itertools import product

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Basic, Model, Plus, Str, Theory, subtype
from ttr.computing.strings.pieces import is_of_strings
from ttr.errors import RefusedError
from ttr.semantics.string_prediction import start_course
from ttr.types import EventString, Join, Meet, Negation
from ttr.types.derived_types import star

A, B = Basic("A"), Basic("B")
EVENTS = {"n": (), "a": (A,), "b": (B,), "c": (A, B)}
"""An event of each kind that two types tell apart."""

M = Model()
for event, kinds in EVENTS.items():
    for kind in kinds:
        M = M.given(event, kind)

WORDS = [word for n in range(4) for word in product(EVENTS, repeat=n)]

single = st.sampled_from([A, B, A, B, A | B, A & B, ~A])


def of_pieces(inner):
    """Types of strings made of others."""
    piece = st.one_of(single, inner)
    return st.one_of(
        st.lists(piece, max_size=3).map(lambda items: Str(*items)),
        piece.map(Plus),
        piece.map(star),
        st.builds(lambda S, T: S | T, inner, inner),
        st.builds(lambda S, T: S & T, inner, inner),
        st.builds(lambda S, T: S & ~T, inner, inner),
    )


strings = st.recursive(
    st.lists(single, max_size=2).map(lambda items: Str(*items)),
    of_pieces,
    max_leaves=5,
)
"""Regular types."""

words = st.sampled_from(WORDS)


# --- the definition, word by word ----------------------------------------------------


def is_of(word, T, kinds) -> bool:
    """Whether a word is of a type of strings, by trying every way to divide it."""
    match T:
        case Str(items):
            return in_row(word, items, kinds)
        case Plus(item):
            rest = ((word[:i], word[i:]) for i in range(1, len(word)))
            return is_piece(word, item, kinds) or any(
                is_piece(first, item, kinds) and is_of(others, T, kinds)
                for first, others in rest
            )
        case Join(parts):
            return any(is_of(word, part, kinds) for part in parts)
        case Meet(parts):
            return all(is_of(word, part, kinds) for part in parts)
        case Negation(body):
            return not is_of(word, body, kinds)
    raise AssertionError(T)


def in_row(word, items, kinds) -> bool:
    if not items:
        return not word
    return any(
        is_piece(word[:i], items[0], kinds) and in_row(word[i:], items[1:], kinds)
        for i in range(len(word) + 1)
    )


def is_piece(word, T, kinds) -> bool:
    if is_of_strings(T):
        return is_of(word, T, kinds)
    return len(word) == 1 and is_event(word[0], T, kinds)


def is_event(event, T, kinds) -> bool:
    match T:
        case Join(parts):
            return any(is_event(event, part, kinds) for part in parts)
        case Meet(parts):
            return all(is_event(event, part, kinds) for part in parts)
        case Negation(body):
            return not is_event(event, body, kinds)
    return T in kinds[event]


def same(S, T) -> bool:
    return subtype(S, T).yes and subtype(T, S).yes


# --- judging -------------------------------------------------------------------------


@given(strings, words)
def test_a_string_is_judged_as_the_definition_says(T, word):
    assert M.judge(EventString(*word), T).holds == is_of(word, T, EVENTS)


@given(strings)
def test_what_is_printed_reads_back_as_the_same_type(T):
    assert Theory.of(T).parse(str(T)) is T


@given(strings)
def test_what_is_created_is_of_the_type(T):
    try:
        made, model = Model().create(T)
    except RefusedError:
        assert not any(is_of(word, T, EVENTS) for word in WORDS)
    else:
        assert model.judge(made, T).holds


# --- subtyping -----------------------------------------------------------------------


@given(strings, strings)
def test_subtyping_agrees_with_strings(S, T):
    answer = subtype(S, T)
    against = [w for w in WORDS if is_of(w, S, EVENTS) and not is_of(w, T, EVENTS)]
    assert not (answer.yes and against)
    if answer.no:
        counter = answer.counter
        assert counter.p == (0, 0)
        assert counter.model.judge(counter.sit, S).holds


@given(strings)
def test_reflexive(T):
    assert subtype(T & T, T).yes
    assert subtype(Str(T), T).yes
    assert subtype(T, Str(T)).yes


@given(strings, strings, strings)
def test_transitive(S, T, U):
    if subtype(S, T).yes and subtype(T, U).yes:
        assert subtype(S, U).yes


@given(strings, strings)
def test_a_join_is_above_its_parts_and_a_meet_below(S, T):
    assert subtype(S, S | T).yes
    assert subtype(S & T, T).yes


# --- concatenation, repetition -------------------------------------------------------


@given(strings, strings, strings)
def test_concatenation_is_associative(R, S, T):
    assert Str(Str(R, S), T) is Str(R, Str(S, T))
    assert Str(R, Str(), S) is Str(R, S)


@given(strings, strings, strings)
def test_concatenation_goes_into_a_join(R, S, T):
    assert same(Str(R | S, T), Str(R, T) | Str(S, T))


@given(strings)
def test_laws_of_star_and_plus(T):
    assert same(Plus(T), Str(T, star(T)))
    assert same(Plus(T), Str(star(T), T))
    assert same(Plus(Plus(T)), Plus(T))
    assert same(star(star(T)), star(T))
    assert same(star(Plus(T)), star(T))


@given(strings, strings)
def test_repetition_keeps_the_order(S, T):
    assume(subtype(S, T).yes)
    assert subtype(Plus(S), Plus(T)).yes
    assert subtype(star(S), star(T)).yes


# --- courses -------------------------------------------------------------------------


@given(strings, words)
def test_following_agrees_with_judging(T, word):
    course = start_course(T, M)
    try:
        for event in word:
            course = course.seen(event)
    except RefusedError:
        assert not is_of(word, T, EVENTS)
    else:
        assert course.may_end == M.judge(EventString(*word), T).p


@given(strings, st.sampled_from(sorted(EVENTS)), words)
def test_the_rest_is_of_what_was_left(T, event, word):
    course = start_course(T, M)
    if course.expects(event) == (0, 0):
        assert not is_of((event, *word), T, EVENTS)
        return
    rest = course.seen(event).rest
    assert is_of((event, *word), T, EVENTS) == is_of(word, rest, EVENTS)


@given(strings, st.sampled_from(sorted(EVENTS)))
def test_what_is_expected_is_what_fits(T, event):
    course = start_course(T, M)
    expected = course.expected
    fits = expected is not None and M.judge(event, expected).holds
    assert (course.expects(event) == (1, 1)) == fits


ends = st.sampled_from([0.0, 0.25, 0.5, 0.75, 1.0])
intervals = st.tuples(ends, ends).map(sorted).map(tuple)


@given(strings, st.lists(st.sampled_from("xyz"), max_size=3), st.data())
def test_degrees_hold_what_the_cases_come_to(T, word, data):
    """For numbers anywhere in the intervals that are given, the sum over all cases."""
    given_degrees = {
        (event, kind): data.draw(intervals) for event in "xyz" for kind in (A, B)
    }
    model = Model()
    for (event, kind), p in given_degrees.items():
        model = model.given(event, kind, p)
    points = {key: data.draw(st.sampled_from(p)) for key, p in given_degrees.items()}
    total = chance_of(tuple(word), T, points)
    found = [model.judge(EventString(*word), T).p]
    try:
        course = start_course(T, model)
        for event in word:
            course = course.seen(event)
        found.append(course.may_end)
    except RefusedError:
        assert total == 0
    for p in found:
        assert p.lo <= total + 1e-9
        assert total <= p.hi + 1e-9


def chance_of(word, T, points) -> float:
    """The probability, summed over what the events may be of."""
    total = 0.0
    for case in product((True, False), repeat=len(points)):
        p, kinds = 1.0, {event: [] for event, _ in points}
        for (key, chance), so in zip(points.items(), case, strict=True):
            p *= chance if so else 1 - chance
            kinds[key[0]] += [key[1]] * so
        if p and is_of(word, T, kinds):
            total += p
    return total


@given(strings, st.permutations("xyz"), st.lists(ends, min_size=6, max_size=6))
def test_degrees_of_different_events_are_exact(T, word, chances):
    keys = list(product("xyz", (A, B)))
    points = dict(zip(keys, chances, strict=True))
    model, course = Model(), start_course(T, Model())
    for (event, kind), p in points.items():
        model = model.given(event, kind, p)
    course = course.judged_in(model)
    for event in word:
        if course.expects(event) == (0, 0):
            return
        course = course.seen(event)
    assert course.may_end == pytest.approx([chance_of(tuple(word), T, points)] * 2)
