"""Laws of subtyping: sound, refutable, reflexive, transitive."""

from generators import chains, models, record_types, records, related, relatives, types
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Basic, Model, Refused, merge, record, rectype, subtype


def made_up(T, M=None):
    """A witness made up for T, and the model in which it is."""
    try:
        return (M or Model()).create(T)
    except Refused:
        return assume(False)


@given(related())
def test_the_answer_is_that_of_a_witness_made_up_for_it(pair):
    S, T = pair
    witness, M = made_up(S)
    assert subtype(S, T).yes == M.judge(witness, T).holds
    assert not subtype(S, T).unknown


@given(related(), models())
def test_a_witness_of_a_subtype_is_one_of_the_type(pair, M):
    S, T = pair
    assume(subtype(S, T).yes)
    witness, M = made_up(S, M)
    assert M.judge(witness, T).holds


@given(st.data(), models())
def test_a_record_of_a_subtype_is_one_of_the_type(data, M):
    T = data.draw(record_types())
    S = merge(T, data.draw(relatives(T)))
    r = data.draw(records())
    assert subtype(S, T).yes
    if M.judge(r, S).holds:
        assert M.judge(r, T).holds


@given(chains(), models(), records())
def test_subtyping_is_sound_for_every_constructor(chain, M, r):
    T, S, _ = chain
    for a in (r, "a", "x", (), ("a", "b"), (r,), record(l=[r]), rectype()):
        if subtype(S, T).yes and M.judge(a, S).holds:
            assert M.judge(a, T).holds


@given(types())
def test_reflexive(T):
    assert subtype(T, T).yes


@given(st.data())
def test_transitive(data):
    S = data.draw(record_types())
    T = data.draw(relatives(S))
    U = data.draw(relatives(T))
    assume(subtype(S, T).yes and subtype(T, U).yes)
    assert subtype(S, U).yes


@given(chains())
def test_transitive_for_every_constructor(chain):
    U, T, S = chain
    if subtype(S, T).yes and subtype(T, U).yes:
        assert subtype(S, U).yes


@given(types(), types())
def test_a_meet_is_below_both(S, T):
    assert S & T <= S
    assert S & T <= T


@given(chains())
def test_what_is_below_both_is_below_the_meet(chain):
    S, T, U = chain
    assert (U <= S & T) == (U <= S and U <= T)


@given(types(), types())
def test_equal_answers_where_one_is_asked_twice(S, T):
    assert str(subtype(S, T)) == str(subtype(S, T))


@given(record_types())
def test_rec_is_above_every_record_type(T):
    assert subtype(T, rectype()).yes
    assert subtype(T, Basic("Elsewhere")).verdict in ("no", "unknown")
