"""Laws of rules that give types: what they set is set, and nothing else changes."""

from generators import record_types
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import Model, amerge, rectype
from ttr.building.merging import singleton_type
from ttr.errors import RefusedError, UpdateError
from ttr.types import Singleton
from ttr.types.paths import free_paths
from ttr.updates import rule, run

draws = st.data()


def made(T):
    """A state of a type, another one, and the model that has both."""
    try:
        state, M = Model().create(T)
        other, M = M.create(T)
    except RefusedError:
        assume(False)
    return state, other, M


def setting(T, labels, values):
    """The type that sets some fields of T to these values."""
    fields = {k: Singleton(T[k], values[k]) for k in labels if not free_paths(T[k])}
    return rectype(fields)


def updated(T, effect, state, M):
    return run(rule(when=T)(lambda s: effect), state, type=T, model=M)


@given(record_types(), draws)
def test_a_type_sets_what_it_mentions_and_nothing_else(T, data):
    state, other, M = made(T)
    labels = data.draw(st.sets(st.sampled_from(sorted(T))) if T.labels else st.just(()))
    effect = setting(T, labels, other)
    try:
        after, _, _ = updated(T, effect, state, M)
    except UpdateError:
        return  # what depends on it was left behind
    for label in T:
        assert after[label] == (other if label in effect else state)[label]


@given(record_types(), draws)
def test_the_next_state_is_of_the_asymmetric_merge(T, data):
    state, other, M = made(T)
    labels = data.draw(st.sets(st.sampled_from(sorted(T))) if T.labels else st.just(()))
    effect = setting(T, labels, other)
    try:
        after, model, _ = updated(T, effect, state, M)
    except UpdateError:
        return
    merged = amerge(singleton_type(state, T), effect)
    assert model.judge(after, merged).holds


@given(record_types())
def test_the_fields_of_a_type_are_created_anew(T):
    state, _, M = made(T)
    try:
        after, model, _ = updated(T, T, state, M)
    except UpdateError:
        return
    assert model.judge(after, T).holds
