"""Interned nodes: two nodes of the same structure are the same Python object.

So `is` is structural identity, a hash is an address, and a node can be a key.
`identity` says when two objects are the same; the pool of nodes is keyed by it.
"""

from __future__ import annotations

import inspect
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import update_wrapper
from threading import RLock
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, dataclass_transform
from weakref import ref

from ttr.errors import IllFormedError, TTRError
from ttr.hooks import hook
from ttr.safety.budgets import BudgetSpentError, open_purse, within_budget
from ttr.showing import NotebookValue


@hook
def as_notation(value: object) -> str:
    """The value in one line, as on the blackboard: `ttr.types.printing.notation`."""
    raise NotImplementedError


@hook
def as_python(value: object) -> str:
    """The value as Python that evaluates back: `ttr.types.printing.python`."""
    raise NotImplementedError


class _Entry(ref):  # type: ignore[type-arg]
    """A weak reference to a node that knows the node's key."""

    __slots__ = ("key",)

    key: tuple[object, ...]


_pool: dict[tuple[object, ...], _Entry] = {}
_lock = RLock()


def _wrong_arguments(cls: type) -> IllFormedError:
    """The error for arguments of a node that are too few, too many or misnamed."""
    wanted = inspect.signature(cls._normal)  # type: ignore[attr-defined]
    names = [name for name in wanted.parameters if name != "args"]
    return IllFormedError(
        f"{cls.__name__} takes {', '.join(names) or 'other arguments'}"
    )


def _remove_from_pool(entry: _Entry, pool: Any = _pool, lock: Any = _lock) -> None:
    """Remove a node that is gone from the pool, unless another has taken its place.

    The pool is a default argument, as nodes may outlive the names of this module.
    """
    with lock:
        if pool.get(entry.key) is entry:
            del pool[entry.key]


class _Interning(type):
    """Gives one instance per structure: same class, same fields, same node."""

    if not TYPE_CHECKING:

        def __call__(cls, *args, **kwargs):
            try:
                values = cls._normal(*args, **kwargs)
            except TypeError as error:
                if error.__traceback__.tb_next is not None:
                    raise
                raise _wrong_arguments(cls) from None
            purse = open_purse()
            if purse is not None:  # as `spend` does; this is the busiest place of all
                purse.left -= 1
                if purse.left < 0:
                    raise BudgetSpentError
            key = (cls, *cls._key(*values))
            entry = _pool.get(key)
            found = None if entry is None else entry()
            if found is not None:
                return found
            with _lock:
                entry = _pool.get(key)
                found = None if entry is None else entry()
                if found is None:
                    found = super().__call__(*values)
                    entry = _pool[key] = _Entry(found, _remove_from_pool)
                    entry.key = key
            return found


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def node(cls: type[Node]) -> Any:
    """Makes an interned, immutable node class of annotated fields."""
    made: Any = dataclass(frozen=True, eq=False, repr=False, slots=True)(cls)
    made.__setattr__, made.__delattr__ = _refuse_setting, _refuse_deleting
    return made


def _refuse_setting(_: Node, name: str, value: object) -> None:
    raise TTRError(f"types and predicates do not change, so {name} cannot be set")


def _refuse_deleting(_: Node, name: str) -> None:
    raise TTRError(f"types and predicates do not change, so {name} cannot be deleted")


class Node(NotebookValue, metaclass=_Interning):
    """An interned value: it prints as notation, and its repr as Python."""

    __slots__ = ("__weakref__", "_cache")
    __match_args__: tuple[str, ...] = ()
    _cache: dict[object, Any]
    _sign: ClassVar[str] = ""
    """The sign before the first part, as the canonical order sees it."""

    @staticmethod
    def _normal(*args: Any) -> tuple[Any, ...]:
        """The arguments in canonical form; a class may refuse them here."""
        return args

    @staticmethod
    def _key(*args: Any) -> tuple[object, ...]:
        """What makes two nodes of the class the same."""
        return tuple(map(identity, args))

    @within_budget
    def __str__(self) -> str:
        return as_notation(self)

    @within_budget
    def __repr__(self) -> str:
        return as_python(self)

    def __copy__(self) -> Node:
        return self

    def __deepcopy__(self, memo: object) -> Node:
        return self

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), tuple(getattr(self, name) for name in self.__match_args__)


_N = TypeVar("_N", bound=Node)
_R = TypeVar("_R")


def cache_on_node(function: Callable[[_N], _R]) -> Callable[[_N], _R]:
    """Keep the results of a function on the nodes, as long as these live.

    Nodes never change, so the results do not either.
    """

    def look_up(node: _N) -> _R:
        try:
            return node._cache[function]  # type: ignore[no-any-return]
        except AttributeError:
            object.__setattr__(node, "_cache", {})
        except KeyError:
            pass
        found = node._cache[function] = function(node)
        return found

    return update_wrapper(look_up, function)


@dataclass(frozen=True, slots=True, eq=False)
class _ByAddress:
    """An object without a hash; it is kept alive, so its address stays its own."""

    value: object

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _ByAddress) and self.value is other.value

    def __hash__(self) -> int:
        return id(self.value)


def identity(value: object) -> object:
    """What makes two objects the same: equal values of one class, arrays by address.

    >>> identity(1) == identity(1.0), identity(0.0) == identity(-0.0)
    (False, False)
    >>> identity([1]) == identity([1])
    False
    """
    kind = type(value)
    if kind is str or isinstance(value, Node):
        return value
    if kind is tuple:
        purse = open_purse()
        if purse is not None:
            purse.left -= len(value)  # type: ignore[arg-type]
            if purse.left < 0:
                raise BudgetSpentError
        return (tuple, *map(identity, value))  # type: ignore[call-overload]
    if kind is float:
        return (float, struct.pack("<d", value))
    try:
        hash(value)
    except TypeError:
        return _ByAddress(value)
    return (kind, value)
