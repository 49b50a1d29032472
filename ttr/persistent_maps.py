"""Persistent maps: immutable mappings that are cheap to extend.

`Map` is that of the library `immutables` where it is installed, and `PlainMap` where it
is not: it is in C, and has no wheel for the newest versions of Python.

A plain map is a tree whose leaves are dictionaries of at most `LEAF` entries; the bits
of the hash of a key choose the way to its leaf. An extended map copies one leaf and the
nodes above it, and shares the rest with the map that it was made from. A small map is
one dictionary.
"""

from __future__ import annotations

from collections.abc import (
    ItemsView,
    Iterable,
    Iterator,
    KeysView,
    Mapping,
    ValuesView,
)
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, overload

K = TypeVar("K")
V = TypeVar("V")
D = TypeVar("D")

LEAF = 32
"""The number of entries above which a leaf is split."""

BITS = 5
"""The number of bits of a hash that choose one branch."""

BRANCHES = 1 << BITS

DEEPEST = 64 // BITS
"""The depth at which hashes are used up, so that a leaf may have any size."""

Leaf: TypeAlias = dict[Any, Any]
Node: TypeAlias = "Leaf | tuple[Node, ...]"


class PlainMap(Mapping[K, V]):
    """An immutable mapping, of which extended and reduced copies are cheap.

    Maps with the same entries are equal. A map of at most `LEAF` entries has them in
    the order in which they were set, a larger map in no particular order.

    >>> one = PlainMap({"a": 1})
    >>> two = one.set("b", 2)
    >>> one, two, two.delete("a")
    (PlainMap({'a': 1}), PlainMap({'a': 1, 'b': 2}), PlainMap({'b': 2}))
    """

    __slots__ = ("__weakref__", "_root", "_size")

    _root: Node
    _size: int

    def __init__(self, entries: Mapping[K, V] | Iterable[tuple[K, V]] = ()) -> None:
        leaf = dict(entries)
        self._root = _split(leaf, 0)
        self._size = len(leaf)

    @overload
    def get(self, key: K, /) -> V | None: ...
    @overload
    def get(self, key: K, default: V | D, /) -> V | D: ...
    def get(self, key: K, default: V | D | None = None, /) -> V | D | None:
        """The value of a key, or the default."""
        root = self._root
        leaf = root if isinstance(root, dict) else _leaf(root, key)
        return leaf.get(key, default)

    def __getitem__(self, key: K) -> V:
        value: V = _leaf(self._root, key)[key]
        return value

    def __contains__(self, key: object) -> bool:
        root = self._root
        return key in (root if isinstance(root, dict) else _leaf(root, key))

    def __len__(self) -> int:
        return self._size

    def __iter__(self) -> Iterator[K]:
        return iter(self._entries())

    def keys(self) -> KeysView[K]:
        """The keys, of all entries at once."""
        return self._entries().keys()

    def values(self) -> ValuesView[V]:
        """The values, of all entries at once."""
        return self._entries().values()

    def items(self) -> ItemsView[K, V]:
        """The keys with their values, of all entries at once."""
        return self._entries().items()

    def __hash__(self) -> int:
        return hash(frozenset(self.items()))

    def __repr__(self) -> str:
        return f"PlainMap({self._entries()!r})"

    def __reduce__(self) -> tuple[type[PlainMap[K, V]], tuple[dict[K, V]]]:
        return PlainMap, (self._entries(),)

    def set(self, key: K, value: V) -> PlainMap[K, V]:
        """The map in which a key has this value."""
        root = self._root
        if isinstance(root, dict):
            leaf = {**root, key: value}
            return _map(_split(leaf, 0), len(leaf))
        size = self._size + (key not in self)
        return _map(_with_entry(root, hash(key), 0, key, value), size)

    def delete(self, key: K) -> PlainMap[K, V]:
        """The map without a key; raises `KeyError` where it is not in the map."""
        return _map(_without_entry(self._root, hash(key), key), self._size - 1)

    def update(self, entries: Mapping[K, V]) -> PlainMap[K, V]:
        """The map with all these entries."""
        new = self
        for key, value in entries.items():
            new = new.set(key, value)
        return new

    def _entries(self) -> dict[K, V]:
        """All entries, in a dictionary that nobody may change."""
        root = self._root
        if isinstance(root, dict):
            return root
        entries: dict[K, V] = {}
        for leaf in _leaves(root):
            entries.update(leaf)
        return entries


def _map(root: Node, size: int) -> PlainMap[Any, Any]:
    new: PlainMap[Any, Any] = object.__new__(PlainMap)
    new._root = root
    new._size = size
    return new


def _leaf(node: Node, key: object) -> Leaf:
    """The leaf that a key belongs to."""
    bits = hash(key)
    while not isinstance(node, dict):
        node = node[bits % BRANCHES]
        bits >>= BITS
    return node


def _leaves(node: Node) -> Iterator[Leaf]:
    if isinstance(node, dict):
        yield node
    else:
        for branch in node:
            yield from _leaves(branch)


def _split(leaf: Leaf, depth: int) -> Node:
    """The leaf itself, or the node of what it splits into if it has grown too large."""
    if len(leaf) <= LEAF or depth == DEEPEST:
        return leaf
    branches: list[Leaf] = [{} for _ in range(BRANCHES)]
    for key, value in leaf.items():
        branches[(hash(key) >> depth * BITS) % BRANCHES][key] = value
    return tuple([_split(branch, depth + 1) for branch in branches])


def _with_entry(node: Node, bits: int, depth: int, key: object, value: object) -> Node:
    """The node with an entry more; `bits` are those that are left of the key's hash."""
    if isinstance(node, dict):
        return _split({**node, key: value}, depth)
    branches = list(node)
    branch = bits % BRANCHES
    rest = bits >> BITS
    branches[branch] = _with_entry(node[branch], rest, depth + 1, key, value)
    return tuple(branches)


def _without_entry(node: Node, bits: int, key: object) -> Node:
    if isinstance(node, dict):
        leaf = node.copy()
        del leaf[key]
        return leaf
    branches = list(node)
    branch = bits % BRANCHES
    branches[branch] = _without_entry(node[branch], bits >> BITS, key)
    return tuple(branches)


if TYPE_CHECKING:
    Map = PlainMap
else:
    try:
        from immutables import Map
    except ImportError:
        Map = PlainMap
