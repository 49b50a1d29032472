"""Forms of types: fields in one order, T*, functions from one type to another."""

from __future__ import annotations

from collections.abc import Mapping
from heapq import heapify, heappop, heappush

from ttr.safety.budgets import spend
from ttr.types.paths import labels_mentioned, shift_paths
from ttr.types.syntax import FunType, Plus, Str, TypeNode, as_function_type, join


def order_fields(fields: Mapping[str, TypeNode]) -> tuple[tuple[str, TypeNode], ...]:
    """The fields ordered by (depth of dependency, label), cyclic ones last."""
    spend(len(fields))
    waits: dict[str, int] = {}
    needed_by: dict[str, list[str]] = {}
    for label, T in fields.items():
        needs = labels_mentioned(T)
        needs &= fields.keys()
        waits[label] = len(needs)
        for need in needs:
            needed_by.setdefault(need, []).append(label)
    ready = [(0, label) for label, count in waits.items() if count == 0]
    heapify(ready)
    order: list[str] = []
    while ready:
        depth, label = heappop(ready)
        order.append(label)
        for waiting in needed_by.get(label, ()):
            waits[waiting] -= 1
            if waits[waiting] == 0:
                heappush(ready, (depth + 1, waiting))
    order += sorted(fields.keys() - order)
    return tuple((label, fields[label]) for label in order)


def star(T: TypeNode, /) -> TypeNode:
    """T*, the strings that are none or more strings or events of T in a row.

    Source: Fernando 2007.

    >>> from ttr import Ind
    >>> print(star(Ind))
    plus(Ind) \\/ str()
    """
    return join(Str(), Plus(T))


def function_type(domain: TypeNode, result: TypeNode) -> FunType:
    """(S → T), the functions from S to T.

    >>> from ttr import Ind, Type
    >>> print(function_type(Ind, Type))
    (Ind -> Type)
    """
    return FunType(domain, shift_paths(result, 1))


as_function_type.provided_by(function_type)
