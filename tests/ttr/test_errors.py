"""Errors keep their place and their way out, through pickles too."""

import pickle

import pytest

from ttr import TTRError
from ttr.errors import IllFormedError, RefusedError, Span, UnsupportedError, suggestion
from ttr.safety.budgets import within_budget

TEXT = "basic Ind\nX := [x : Idn]\n"
SPAN = Span.of("a.ttr", TEXT, 20, 23)


def test_the_place_is_drawn():
    error = IllFormedError("nothing is called Idn", hint="did you mean Ind?").at(SPAN)
    assert str(error) == (
        "nothing is called Idn\n"
        "  ┌─ a.ttr:2:11\n"
        "2 │ X := [x : Idn]\n"
        "  │           ^^^\n"
        "help: did you mean Ind?"
    )
    assert isinstance(error, IllFormedError)


def test_the_first_place_stays():
    error = RefusedError("no", span=SPAN)
    assert error.at(Span.of("b.ttr", TEXT, 0, 1)) is error


def test_a_pickled_error_is_whole():
    error = pickle.loads(pickle.dumps(RefusedError("no", span=SPAN, hint="yes")))
    assert (type(error), error.span, error.hint) == (RefusedError, SPAN, "yes")


@pytest.mark.parametrize(
    ("start", "end", "line", "column", "length"),
    [(0, 5, 1, 1, 5), (5, 15, 1, 6, 4), (10, 10, 2, 1, 1), (99, 120, 3, 1, 1)],
)
def test_spans(start, end, line, column, length):
    span = Span.of("a.ttr", TEXT, start, end)
    assert (span.line, span.column, span.length) == (line, column, length)


def test_suggestions():
    assert suggestion("dgo", ["dog", "cat"]) == "did you mean dog?"
    assert suggestion("zebra", ["dog", "cat"]) == ""


def test_too_deep_a_nesting_is_an_error_of_ours():
    @within_budget
    def endless(n):
        return endless.__wrapped__(n + 1)

    with pytest.raises(UnsupportedError, match="nests deeper than can be followed"):
        endless(0)
    assert issubclass(UnsupportedError, TTRError)


def test_a_long_line_is_cut_around_the_place():
    text = "a" * 5_000 + "?" + "b" * 5_000
    place, line, caret = str(Span.of("x.ttr", text, 5_000, 5_001)).splitlines()
    assert place.endswith("x.ttr:1:5001")
    assert len(line) < 140
    assert line.count("…") == 2
    assert line[caret.index("^")] == "?"
