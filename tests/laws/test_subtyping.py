"""Laws of subtyping: sound, refutable, reflexive, transitive."""

import pytest
from generators import (
    chains,
    has_negations_or_function_types,
    made_up,
    models,
    record_types,
    records,
    related,
    relatives,
    samples,
    types,
)
from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, Model, join, merge, record, rectype, subtype

# --- soundness -----------------------------------------------------------------------


@given(related(), models())
def test_the_answer_is_that_of_a_witness_made_up_for_it(pair, M):
    """For record types of basic types and ptypes, subtyping is decided."""
    S, T = pair
    found = made_up(S, Model())
    if found is None:
        return
    witness, M = found
    assert subtype(S, T).yes == M.judge(witness, T).holds
    assert not subtype(S, T).unknown


@given(st.data(), models())
def test_a_record_of_a_subtype_is_one_of_the_type(data, M):
    T = data.draw(record_types())
    S = merge(T, data.draw(relatives(T)))
    r = data.draw(records())
    assert subtype(S, T).yes
    if M.judge(r, S).holds:
        assert M.judge(r, T).holds


@given(chains(), models(), samples())
def test_subtyping_is_sound_for_every_constructor(chain, M, sample):
    T, S, _ = chain
    if not subtype(S, T).yes:
        return
    for a in (sample, "a", "x", (), ("a", "b"), (sample,), record(x=sample), rectype()):
        if M.judge(a, S).p == (1, 1):
            assert M.judge(a, T).holds


@pytest.mark.slow
@given(chains(), models())
def test_a_made_up_witness_of_a_subtype_is_one_of_the_type(chain, M):
    T, S, _ = chain
    found = made_up(S, M) if subtype(S, T).yes else None
    if found is not None:
        witness, M = found
        assert M.judge(witness, T).holds


@given(types(), types(), models())
def test_what_is_below_by_chance_is_so_of_a_made_up_witness(S, T, M):
    found = made_up(S, M) if subtype(S, T).yes else None
    if found is not None:
        witness, M = found
        assert M.judge(witness, T).holds


# --- refutation ----------------------------------------------------------------------


@given(chains())
def test_a_refutation_has_a_counter_assignment(chain):
    S, T, _ = chain
    answer = subtype(S, T)
    if answer.no:
        against = answer.counter
        assert against.type is T
        assert against.p == (0, 0)
        assert against.model.judge(against.sit, S).p == (1, 1)
    else:
        assert answer.counter is None


@given(types(), types())
def test_any_refutation_has_a_counter_assignment(S, T):
    answer = subtype(S, T)
    if answer.no:
        against = answer.counter
        assert against.model.judge(against.sit, S).p == (1, 1)
        assert against.model.judge(against.sit, T).p == (0, 0)


# --- order ---------------------------------------------------------------------------


@given(types())
def test_reflexive(T):
    assert subtype(T, T).yes


@given(st.data())
def test_transitive(data):
    S = data.draw(record_types())
    T = data.draw(relatives(S))
    U = data.draw(relatives(T))
    if subtype(S, T).yes and subtype(T, U).yes:
        assert subtype(S, U).yes


@given(chains())
def test_transitive_for_every_constructor(chain):
    """What follows is never refuted, and is yes but for negations and functions."""
    for S, T, U in (chain, chain[::-1]):
        if subtype(S, T).yes and subtype(T, U).yes:
            assert not subtype(S, U).no
            if not has_negations_or_function_types(S, T, U):
                assert subtype(S, U).yes


@given(types(), types())
def test_a_meet_is_below_both(S, T):
    assert S & T <= S
    assert S & T <= T


@given(types(), types())
def test_a_join_is_above_both(S, T):
    assert S | T >= S
    assert S | T >= T


@given(chains())
def test_what_is_below_both_is_below_the_meet(chain):
    S, T, U = chain
    assert (U <= S & T) == (U <= S and U <= T)


@pytest.mark.slow
@given(chains())
def test_what_is_above_both_is_above_the_join(chain):
    S, T, U = chain
    if not has_negations_or_function_types(S, T, U):
        assert (join(S, T) <= U) == (S <= U and T <= U)


@given(types(), types())
def test_equal_answers_where_one_is_asked_twice(S, T):
    assert str(subtype(S, T)) == str(subtype(S, T))


@given(record_types())
def test_rec_is_above_every_record_type(T):
    assert subtype(T, rectype()).yes
    assert subtype(T, Basic("Elsewhere")).verdict in ("no", "unknown")
