"""Finding what a rule binds: what `where` asks of state, event and model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache

from ttr.errors import Refused
from ttr.judging.certainty import certainly
from ttr.judging.evaluator import reduced
from ttr.judging.models import Model
from ttr.safety.budgets import spend
from ttr.types.objects import Unresolved
from ttr.types.paths import escaping
from ttr.types.substitution import grounded
from ttr.types.syntax import Object, PType, RecordType, Singleton, TypeNode

__all__ = ["Found", "found"]

Found = tuple[Mapping[str, Object], Model]
"""The bindings, and the model that has the situations seen for them."""


def found(
    where: RecordType, variables: Mapping[str, Object], model: Model
) -> Found | None:
    """What the fields of `where` are bound to, so that each is certainly of its type.

    A manifest field is worked out; another one is the first known object of its type
    with which the other fields come out, too. What a witness function says yes to, and
    nothing is known to be, gets a fresh situation.
    """
    whole = _found(_in_order(where), {}, variables, model)
    if whole is None:
        return None
    bound, extended = whole
    return {label: bound[label] for label in where}, extended


@lru_cache
def _in_order(where: RecordType) -> tuple[tuple[str, TypeNode], ...]:
    """The fields, each claim as soon as what it is about is bound.

    So what cannot be is seen before more objects are tried. What claims are about comes
    before the rest, what the claim that needs least is about before that of others.
    """
    waiting, ordered = dict(where.fields), dict[str, TypeNode]()
    while waiting:
        needs = {k: _needs(T) & waiting.keys() for k, T in waiting.items()}
        claims = [k for k, T in waiting.items() if isinstance(T, Singleton | PType)]
        label = min(claims, key=lambda k: len(needs[k]), default=next(iter(waiting)))
        for _ in waiting:  # more steps than there are would go round in a circle
            label = min(needs[label], default=label)
        ordered[label] = waiting.pop(label)
    return tuple(ordered.items())


def _needs(T: TypeNode) -> set[str]:
    """The labels of the bindings that a field mentions."""
    return {path.labels[0] for path in escaping(T) if path.up == 0}


def _found(
    fields: tuple[tuple[str, TypeNode], ...],
    bound: Mapping[str, Object],
    variables: Mapping[str, Object],
    model: Model,
) -> Found | None:
    spend()
    if not fields:
        return bound, model
    (label, field), *rest = fields
    for value, extended in _candidates(field, bound, variables, model):
        whole = _found(tuple(rest), {**bound, label: value}, variables, extended)
        if whole is not None:
            return whole
    return None


def _candidates(
    field: TypeNode,
    bound: Mapping[str, Object],
    variables: Mapping[str, Object],
    model: Model,
) -> Iterable[tuple[Object, Model]]:
    try:
        around = (bound, variables)
        if isinstance(field, Singleton):
            value = reduced(model.facts, grounded(field.value, around))
            base = grounded(field.base, around)
            return [(value, model)] if certainly(model.facts, value, base) else []
        T = reduced(model.facts, grounded(field, around))
        known = [(one, model) for one in model.witnesses(T)]
        return known or _seen(T, model)
    except (Unresolved, Refused):
        return []


def _seen(T: TypeNode, model: Model) -> Iterable[tuple[Object, Model]]:
    """A fresh situation of a ptype that a witness function is certain of."""
    if not isinstance(T, PType) or T.pred not in model.facts.functions:
        return []
    try:
        seen, extended = model.create(T)
    except Refused:
        return []
    return [(seen, extended)] if certainly(extended.facts, seen, T) else []
