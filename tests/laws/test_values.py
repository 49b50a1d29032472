"""Laws of types and records as values: one node for each structure, out and back."""

import copy
import pickle

import pytest
from generators import record_types, records, types
from hypothesis import given
from hypothesis import strategies as st

import ttr
from ttr import meet, record, rectype

NAMES = {name: getattr(ttr, name) for name in ttr.__all__}


@given(types())
def test_repr_evaluates_back_to_the_same_type(T):
    assert eval(repr(T), dict(NAMES)) is T


@given(records())
def test_repr_evaluates_back_to_an_equal_record(r):
    assert eval(repr(r), dict(NAMES)) == r


@given(types())
def test_pickle_and_copies_give_the_same_type(T):
    assert pickle.loads(pickle.dumps(T)) is T
    assert copy.copy(T) is T
    assert copy.deepcopy([T]) == [T]


@given(records())
def test_pickle_and_copies_give_an_equal_record(r):
    assert pickle.loads(pickle.dumps(r)) == r
    assert copy.deepcopy(r) == r
    assert hash(pickle.loads(pickle.dumps(r))) == hash(r)


@given(record_types(), st.randoms(use_true_random=False))
def test_the_order_of_writing_does_not_matter(T, random):
    fields = list(T.fields)
    random.shuffle(fields)
    assert rectype(dict(fields)) is T


@given(records(), st.randoms(use_true_random=False))
def test_the_order_of_labels_does_not_matter(r, random):
    labels = list(r)
    random.shuffle(labels)
    other = record({label: r[label] for label in labels})
    assert (other, hash(other), str(other)) == (r, hash(r), str(r))


@given(st.lists(types(), min_size=1, max_size=4), st.randoms(use_true_random=False))
def test_a_meet_has_no_order_and_no_brackets(parts, random):
    whole = meet(*parts)
    random.shuffle(parts)
    assert meet(*parts) is whole
    assert meet(parts[0], meet(*parts)) is whole


@given(record_types())
def test_fields_stand_behind_what_they_depend_on(T):
    seen = set()
    circular = False
    for label, field in T.fields:
        needs = {path.labels[0] for path in ttr.syntax.escaping(field) if path.up == 0}
        circular = circular or not needs <= seen
        assert circular or needs <= seen
        seen.add(label)


@pytest.mark.parametrize("seed", range(3))
def test_dependent_fields_are_sorted_by_depth_then_label(seed):
    from ttr import Ind, Pred, this

    p = Pred("p", Ind)
    T = rectype(b=p(this.z), a=p(this.z), z=Ind, y=Ind)
    assert T.labels == ("y", "z", "a", "b")
