"""Laws of relabelling, flattening, subtraction, normal forms and supertypes."""

from contextlib import suppress

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
from hypothesis import strategies as st

from ttr import Record, merge, subtype
from ttr.building.flattening import flatten, unflatten
from ttr.building.generalisation import common_supertype
from ttr.building.relabelling import relabel
from ttr.building.subtraction import subtract
from ttr.computing.normal_forms import join_normal_form, meet_normal_form
from ttr.errors import IllFormedError
from ttr.testing.strategies import record_types as any_record_types
from ttr.testing.strategies import records as any_records

LABELS = ["x", "y", "z", "n", "c", "d", "l", "other"]


def same(one, other):
    """Whether two types say the same."""
    return subtype(one, other).yes and subtype(other, one).yes


def renamings(T):
    """New names for labels of T and of the record type in its field n."""
    paths = list(T) + [f"n.{label}" for label in T.get("n") or ()]
    names = st.permutations(LABELS).map(lambda new: dict(zip(paths, new, strict=False)))
    return st.tuples(names, st.sets(st.sampled_from(paths or ["x"]))).map(
        lambda drawn: {k: v for k, v in drawn[0].items() if k in drawn[1]}
    )


@given(st.data(), models(), records())
def test_relabelling_keeps_judgements(data, M, r):
    T = data.draw(record_types())
    names = data.draw(renamings(T))
    try:
        renamed, other = relabel(T, names), relabel(r, names)
    except IllFormedError:
        return
    assert M.judge(other, renamed).p == M.judge(r, T).p


@given(st.data(), models())
def test_relabelling_keeps_made_up_witnesses(data, M):
    T = data.draw(record_types())
    names = data.draw(renamings(T))
    found = made_up(T, M)
    if found is None:
        return
    r, M = found
    try:
        renamed = relabel(T, names)
    except IllFormedError:
        return
    assert M.judge(relabel(r, names), renamed).holds


@given(st.data(), models())
def test_reshaping_keeps_judgements_for_every_constructor(data, M):
    T = data.draw(any_record_types())
    r = data.draw(any_records(T, M))
    before = M.judge(r, T).p
    names = dict(zip(T, data.draw(st.permutations([*T, "new"])), strict=False))
    with suppress(IllFormedError):
        assert M.judge(relabel(r, names), relabel(T, names)).p == before
    with suppress(IllFormedError):
        assert M.judge(flatten(r, T), flatten(T)).p == before


@given(st.data())
def test_relabelling_can_be_undone(data):
    T = data.draw(record_types())
    labels = list(T)
    names = dict(zip(labels, data.draw(st.permutations(LABELS)), strict=False))
    back = {new: old for old, new in names.items()}
    assert relabel(relabel(T, names), back) is T


@given(record_types(), models(), records())
def test_flattening_keeps_judgements(T, M, r):
    try:
        flat, other = flatten(T), flatten(r, T)
    except IllFormedError:
        return
    assert M.judge(other, flat).p == M.judge(r, T).p


@given(record_types())
def test_flattening_leaves_no_record_type_with_fields_and_can_be_undone(T):
    flat = flatten(T)
    assert not any(dict(getattr(field, "fields", ())) for _, field in flat.fields)
    assert flatten(unflatten(flat)) is flat
    assert same(unflatten(flat), T)


@given(records())
def test_flat_records_can_be_nested_again(r):
    flat = flatten(r)
    assert not any(isinstance(v, Record) and len(v) for v in flat._fields.values())
    assert unflatten(flat) == r


@given(st.data())
def test_subtraction_gives_a_supertype_without_the_path(data):
    T = data.draw(record_types())
    paths = list(T) + [f"n.{label}" for label in T.get("n") or ()]
    path = data.draw(st.sampled_from(paths or ["x"]))
    try:
        rest = subtract(T, path)
    except IllFormedError:
        return
    assert subtype(T, rest).yes
    assert path not in rest.labels


@given(types(), models(), samples())
def test_normal_forms_have_the_same_witnesses(T, M, sample):
    for form in (meet_normal_form(T), join_normal_form(T)):
        for a in (sample, "a", "x", (), ("a", "b")):
            assert M.judge(a, form).p == M.judge(a, T).p


@given(types())
def test_normal_forms_are_their_own(T):
    for normal in (meet_normal_form, join_normal_form):
        assert normal(normal(T)) is normal(T)


@given(types(), types())
def test_a_common_supertype_is_above_both(S, T):
    try:
        U = common_supertype(S, T)
    except IllFormedError:
        return
    assert subtype(S, U).yes
    assert subtype(T, U).yes


@given(related(), record_types())
def test_a_common_supertype_is_below_every_other_one(pair, V):
    S, T = pair
    U = common_supertype(S, T)
    assert same(U, common_supertype(T, S))
    if subtype(S, V).yes and subtype(T, V).yes:
        assert subtype(U, V).yes


@given(record_types(), record_types(), record_types())
def test_what_two_merges_share_is_below_what_was_shared(S, T, V):
    U = common_supertype(merge(S, V), merge(T, V))
    assert subtype(merge(S, V), U).yes
    assert subtype(U, V).yes
