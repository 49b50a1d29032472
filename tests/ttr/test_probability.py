"""Degrees: intervals, and what they print as."""

import pytest

from ttr import Degree, TTRError
from ttr.probability import conjunction, degree


@pytest.mark.parametrize(
    ("value", "p"),
    [(1, (1, 1)), (False, (0, 0)), ([0.1, 0.2], (0.1, 0.2)), (0.5, (0.5, 0.5))],
)
def test_degrees(value, p):
    assert degree(value) == p


@pytest.mark.parametrize(
    "value", ["1", b"1", None, (0.2, 0.1), (0.1,), (0, 0.5, 1), 2, -0.1, float("inf")]
)
def test_what_is_no_degree(value):
    with pytest.raises(TTRError, match=r"it is a number in \[0, 1\] or an interval"):
        degree(value, "it")


@pytest.mark.parametrize(
    ("p", "text"),
    [
        (Degree(1, 1), "1"),
        (Degree(0.99999, 1), "[0.99999, 1]"),
        (Degree(1e-9, 1e-9), "1e-09"),
        (Degree(1 / 3, 0.5), "[0.3333, 0.5]"),
    ],
)
def test_only_what_is_certain_prints_as_certain(p, text):
    assert str(p) == text


def test_conjunction():
    assert conjunction([]) == (1, 1)
    assert conjunction([Degree(0.5, 1)] * 100_000) == (0, 1)
