"""Linear demands on integers: answers recorded, and what they have to be like."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from ttr.semantics.fragment import integer_feasibility
from ttr.semantics.fragment.integer_feasibility import UndecidedError, integer_solution

RECORDED = json.loads(
    (Path(__file__).parent / "integer_solutions.json").read_text("utf-8")
)
"""Demands of the pairs of sentences, and demands drawn at random, with what a simplex
over fractions, written apart from that of today, and branching made of them."""


@pytest.mark.parametrize("case", RECORDED, ids=range(len(RECORDED)))
def test_demands_have_a_solution_where_they_had_one(case):
    demands = [(weights, bound) for weights, bound in case["demands"]]
    found = integer_solution(demands, case["size"])
    assert (found is None) == (case["solution"] is None)
    if found is not None:
        assert all(isinstance(x, int) and x >= 0 for x in found)
        for weights, bound in demands:
            assert sum(w * x for w, x in zip(weights, found, strict=True)) >= bound


def test_there_are_both_kinds_of_answers():
    solved = sum(case["solution"] is not None for case in RECORDED)
    assert 30 <= solved <= len(RECORDED) - 30


def test_what_takes_too_many_branches_is_undecided(monkeypatch):
    odd = [((2, 1), 3), ((-2, -1), -3), ((0, -1), 0), ((0, 1), 0)]
    assert integer_solution(odd, 2) is None
    monkeypatch.setattr(integer_feasibility, "_NODES", 1)
    with pytest.raises(UndecidedError):
        integer_solution(odd, 2)
