"""Cycles: do the fields of a record type depend on each other in a circle?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter

from ttr.safety.budgets import spend
from ttr.types.derived_types import order_fields
from ttr.types.objects import Object
from ttr.types.paths import free_paths, labels_mentioned, map_parts, subterms
from ttr.types.syntax import RecordType, Singleton, TypeNode

Address = tuple[str, ...]
"""A field of a record type or of one nested in it: the labels that lead to it."""


def describe_cycle(T: TypeNode) -> str:
    """The fields that depend on one another in a circle, or the empty string.

    A field depends on another if its type or value mentions a path to it, to something
    inside it, or to something around it. Judgements of such a type can be checked, but
    no witness of it can be created.

    >>> from ttr import Ind, rectype, this
    >>> describe_cycle(rectype(x=Ind @ this.y, y=Ind @ this.x))
    'x → y → x'
    >>> describe_cycle(rectype(x=Ind, y=Ind @ this.x))
    ''
    """
    return " → ".join(find_cycle(T))


def find_cycle(T: TypeNode) -> tuple[str, ...]:
    """The paths of the fields on a cycle, the first repeated at the end; or none.

    >>> from ttr import Ind, rectype, this
    >>> find_cycle(rectype(x=Ind @ this.x)), find_cycle(rectype(x=Ind))
    (('x', 'x'), ())
    """
    leaves = dict(_leaves(T, ()))
    return _cycle_of(leaves, leaves)


def find_cycle_of_values(T: TypeNode) -> tuple[str, ...]:
    """The paths of the manifest fields that are set to each other in a circle, or none.

    >>> from ttr import Ind, outer, rectype
    >>> r, s = rectype(x=Ind @ outer.s.x), rectype(x=Ind @ outer.r.x)
    >>> find_cycle_of_values(rectype(r=r, s=s))
    ('r.x', 's.x', 'r.x')
    """
    leaves = dict(_leaves(T, ()))
    manifest = {k: T.value for k, T in leaves.items() if isinstance(T, Singleton)}
    return _cycle_of(leaves, manifest)


def _cycle_of(
    leaves: Iterable[Address], mentioning: Mapping[Address, Object]
) -> tuple[str, ...]:
    """The paths on a cycle among the fields that mention others in these values."""
    inner: dict[Address, list[Address]] = {}
    for leaf in leaves:
        for length, _ in enumerate(leaf, start=1):
            inner.setdefault(leaf[:length], []).append(leaf)
    needs = {
        leaf: [
            near
            for target in _target_addresses(leaf, value)
            for near in _leaves_near(target, inner)
            if near in mentioning
        ]
        for leaf, value in mentioning.items()
    }
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as error:
        return tuple(".".join(leaf) for leaf in reversed(error.args[1]))
    return ()


def has_fields_in_order(T: TypeNode) -> bool:
    """Does each field, at every depth, depend only on fields before it?

    Then there is no cycle.
    """
    return all(
        _has_fields_in_order(part)
        for part in subterms([T])
        if isinstance(part, RecordType)
    )


def _has_fields_in_order(T: RecordType) -> bool:
    before: set[str] = set()
    for label, field in T.fields:
        for path in free_paths(field):
            if path.up == 0 and path.labels[0] not in before:
                return False
        before.add(label)
    return True


def break_cycles(T: TypeNode) -> TypeNode:
    """T without the equations that close a cycle.

    >>> from ttr import Ind, rectype, this
    >>> print(break_cycles(rectype(x=Ind @ this.y, y=Ind @ this.x)))
    [x : Ind, y = x : Ind]
    """
    found: TypeNode = _break_cycles(T)
    return found


def _break_cycles(value: Object) -> Object:
    spend()
    value = map_parts(value, lambda part, _: _break_cycles(part))
    if not isinstance(value, RecordType):
        return value
    fields: dict[str, TypeNode] = {}
    for label, field in value.fields:
        needs = labels_mentioned(field)
        if isinstance(field, Singleton) and not needs <= fields.keys():
            field = field.base
        fields[label] = field
    return RecordType(order_fields(fields))


def _leaves(T: TypeNode, at: Address) -> Iterator[tuple[Address, TypeNode]]:
    if not isinstance(T, RecordType):
        return
    for label, field in T.fields:
        address = (*at, label)
        spend(len(address))
        if isinstance(field, RecordType) and field.fields:
            yield from _leaves(field, address)
        else:
            yield address, field


def _target_addresses(leaf: Address, field: Object) -> list[Address]:
    """Where the paths of a field lead; those that leave the whole type lead nowhere."""
    inside = [path for path in free_paths(field) if path.up < len(leaf)]
    return sorted(leaf[: len(leaf) - 1 - path.up] + path.labels for path in inside)


def _leaves_near(target: Address, inner: dict[Address, list[Address]]) -> list[Address]:
    """The leaves inside the field at an address, or the leaf around it."""
    for length in range(len(target), 0, -1):
        if target[:length] in inner:
            return inner[target[:length]]
    return []
