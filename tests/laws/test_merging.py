"""Laws of merge and asymmetric merge."""

import pytest
from generators import (
    made_up,
    models,
    record_types,
    records,
    related,
    samples,
    types,
)
from hypothesis import given

from ttr import RecordType, amerge, merge
from ttr.errors import IllFormedError


@given(related(), models(), records())
def test_a_record_is_of_the_merge_iff_of_both(pair, M, r):
    S, T = pair
    both = M.judge(r, S).holds and M.judge(r, T).holds
    assert M.judge(r, merge(S, T)).holds == both


@given(types(), types(), models(), samples())
def test_the_merge_is_the_meet_for_every_constructor(S, T, M, sample):
    for a in (sample, "a", "x", (), ("a", "b"), RecordType(())):
        both = M.judge(a, S & T).p
        assert M.judge(a, merge(S, T)).p == both


@given(types(), types(), models())
def test_a_made_up_witness_of_both_is_one_of_the_merge(S, T, M):
    found = made_up(S & T, M)
    if found is not None:
        witness, M = found
        assert M.judge(witness, merge(S, T)).holds


@given(types(), types(), models())
def test_a_made_up_witness_of_the_merge_is_one_of_both(S, T, M):
    found = made_up(merge(S, T), M)
    if found is not None:
        witness, M = found
        assert M.judge(witness, S).holds
        assert M.judge(witness, T).holds


@given(related())
def test_commutative_and_idempotent(pair):
    S, T = pair
    assert merge(S, T) is merge(T, S)
    assert merge(S, S) is S


@given(types(), types())
def test_commutative_for_every_constructor(S, T):
    assert merge(S, T) is merge(T, S)


@given(types(), types())
def test_merge_is_below_both(S, T):
    assert merge(S, T) <= S
    assert merge(S, T) <= T


@given(record_types(), record_types())
def test_where_one_is_below_the_other_it_is_the_merge(S, T):
    lower = merge(S, T)
    assert merge(lower, S) <= lower
    assert lower <= merge(lower, S)


@given(types(), types())
def test_amerge_takes_the_second_where_one_is_no_record_type(S, T):
    if not (isinstance(S, RecordType) and isinstance(T, RecordType)):
        assert amerge(S, T) is T


@given(related())
def test_amerge_has_the_labels_of_both_and_is_below_the_second_if_flat(pair):
    S, T = pair
    try:
        merged = amerge(S, T)
    except IllFormedError:
        return
    assert set(merged.labels) == {*S.labels, *T.labels}
    assert all(merged[k] is T[k] for k in T.labels if k != "n")
    assert all(merged[k] is S[k] for k in S.labels if k not in T)


def test_amerge_names_the_path_that_would_lead_nowhere():
    from ttr import Ind, Pred, rectype, this

    S = rectype(a=rectype(x=Ind), c=Pred("dog", Ind)(this["a.x"]))
    with pytest.raises(IllFormedError, match=r"the path a\.x leads nowhere"):
        amerge(S, rectype(a=Ind))
