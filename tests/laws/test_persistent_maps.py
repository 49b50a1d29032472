"""Laws of persistent maps: a map is as a dictionary is, and never changes.

They hold of maps in plain Python and, where it is installed, of those of `immutables`.
"""

import copy
import pickle
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr.persistent_maps import BITS, DEEPEST, LEAF, Map, PlainMap

MAPS = sorted({Map, PlainMap}, key=lambda kind: kind.__module__)
of_each_kind = pytest.mark.parametrize("kind", MAPS, ids=lambda kind: kind.__module__)


@dataclass(frozen=True)
class Clash:
    """A key that shares its hash, or all but the last bits of it, with many others."""

    name: int
    hashed: int

    def __hash__(self):
        return self.hashed


keys = st.one_of(
    st.integers(-1000, 1000),
    st.builds(Clash, st.integers(0, 200), st.sampled_from([-1, 0, 7, 1 << 40])),
    st.builds(lambda n: n << BITS * (DEEPEST - 1), st.integers(0, 60)),
)
changes = st.lists(st.tuples(keys, st.none() | st.integers(0, 3)), max_size=4 * LEAF)
starts = st.dictionaries(keys, st.integers(0, 3), max_size=4 * LEAF)


@of_each_kind
@given(starts, changes)
def test_a_map_is_as_a_dictionary_is(kind, start, changes):
    entries, changed = dict(start), kind(start)
    for key, value in changes:
        before, was = changed, dict(changed.items())
        if value is not None:
            changed = changed.set(key, value)
            entries[key] = value
        elif key in entries:
            changed = changed.delete(key)
            del entries[key]
        else:
            with pytest.raises(KeyError):
                changed.delete(key)
        assert dict(before.items()) == was
    assert changed == kind(entries)
    assert dict(changed) == entries
    assert hash(changed) == hash(kind(entries))
    assert len(changed) == len(entries)
    assert set(changed) == set(changed.keys()) == set(entries)
    assert sorted(changed.values()) == sorted(entries.values())
    for key, _ in changes:
        assert (key in changed) == (key in entries)
        assert changed.get(key) == entries.get(key)
        assert changed.get(key, -1) == entries.get(key, -1)
    for key, value in entries.items():
        assert changed[key] == value


@of_each_kind
@given(starts, starts)
def test_updating_sets_every_entry(kind, one, other):
    assert dict(kind(one).update(other)) == {**one, **other}


@of_each_kind
@given(starts)
def test_a_map_is_copied_and_pickled_as_a_value(kind, entries):
    whole = kind(entries)
    assert pickle.loads(pickle.dumps(whole)) == copy.deepcopy(whole) == whole


@given(starts)
def test_a_plain_map_prints_as_python_reads_it(entries):
    whole = PlainMap(entries)
    assert eval(repr(whole), {"PlainMap": PlainMap, "Clash": Clash}) == whole


@of_each_kind
@given(starts, keys)
def test_maps_of_other_entries_are_not_equal(kind, entries, key):
    whole = kind(entries)
    assert whole.set(key, "another value") != whole
    others = {k: v for k, v in entries.items() if k != key}
    assert whole.set(key, 0).delete(key) == kind(others)


@given(st.lists(st.text(), unique=True, max_size=LEAF))
def test_a_small_map_keeps_the_order_in_which_keys_were_set(keys):
    whole = PlainMap()
    for key in keys:
        whole = whole.set(key, 0)
    for key in keys:
        whole = whole.set(key, 1)
    assert list(whole) == keys


@of_each_kind
def test_a_missing_key_and_a_key_without_a_hash_are_errors(kind):
    many = kind((n, n) for n in range(10 * LEAF))
    for whole in (kind(), many):
        with pytest.raises(KeyError):
            whole["missing"]
        with pytest.raises(TypeError):
            whole.set([], 1)
        with pytest.raises(TypeError):
            PlainMap(whole).get([])
