"""Laws of budgets: the end of one never becomes a yes, a no or another type."""

from __future__ import annotations

from generators import types
from hypothesis import given
from hypothesis import strategies as st

import ttr
from ttr import merge, subtype
from ttr.errors import TooLargeError


@given(types(), types(), st.integers(1, 400))
def test_a_budget_only_ever_turns_an_answer_into_unknown(S, T, steps):
    whole = subtype(S, T)
    with ttr.budget(steps=steps):
        short = subtype(S, T)
    assert short.verdict in (whole.verdict, "unknown")
    assert subtype(S, T).verdict == whole.verdict  # nothing half done was kept


@given(types(), types(), st.integers(1, 400))
def test_a_merge_is_the_whole_one_or_none(S, T, steps):
    whole = merge(S, T)
    try:
        with ttr.budget(steps=steps):
            assert merge(S, T) is whole
    except TooLargeError:
        assert merge(S, T) is whole
