"""Laws of persistent maps: a map is as a dictionary is, and never changes."""

import copy
import pickle
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ttr.persistent_maps import BITS, DEEPEST, LEAF, Map


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


@given(starts, changes)
def test_a_map_is_as_a_dictionary_is(start, changes):
    entries, changed = dict(start), Map(start)
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
    assert changed == Map(entries) == entries
    assert hash(changed) == hash(Map(entries))
    assert len(changed) == len(entries)
    assert set(changed) == set(changed.keys()) == set(entries)
    assert sorted(changed.values()) == sorted(entries.values())
    for key, _ in changes:
        assert (key in changed) == (key in entries)
        assert changed.get(key) == entries.get(key)
        assert changed.get(key, -1) == entries.get(key, -1)
    for key, value in entries.items():
        assert changed[key] == value


@given(starts, starts)
def test_updating_sets_every_entry(one, other):
    assert Map(one).update(other) == {**one, **other}


@given(starts)
def test_a_map_is_copied_and_pickled_as_a_value(entries):
    whole = Map(entries)
    assert pickle.loads(pickle.dumps(whole)) == copy.deepcopy(whole) == whole
    assert eval(repr(whole), {"Map": Map, "Clash": Clash}) == whole


@given(starts, keys)
def test_maps_of_other_entries_are_not_equal(entries, key):
    whole = Map(entries)
    assert whole.set(key, "another value") != whole
    assert whole.set(key, 0).delete(key) == {
        k: v for k, v in entries.items() if k != key
    }


@given(st.lists(st.text(), unique=True, max_size=LEAF))
def test_a_small_map_keeps_the_order_in_which_keys_were_set(keys):
    whole = Map()
    for key in keys:
        whole = whole.set(key, 0)
    for key in keys:
        whole = whole.set(key, 1)
    assert list(whole) == keys


def test_a_missing_key_and_a_key_without_a_hash_are_errors():
    many = Map((n, n) for n in range(10 * LEAF))
    for whole in (Map(), many):
        with pytest.raises(KeyError):
            whole["missing"]
        with pytest.raises(TypeError):
            whole.set([], 1)
        with pytest.raises(TypeError):
            whole.get([])
