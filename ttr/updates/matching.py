"""Finding the bindings of a rule: what `where` asks of state, event and model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache

from ttr.errors import RefusedError
from ttr.judging.certainty import is_certain
from ttr.judging.evaluator import reduce_applications
from ttr.judging.models import Model
from ttr.safety.budgets import spend
from ttr.types.objects import Object, UnresolvedError
from ttr.types.paths import labels_mentioned
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import PType, RecordType, Singleton, TypeNode

_Bindings = tuple[Mapping[str, Object], Model]
"""Bindings, and the model with the situations that were created for them."""


def find_bindings(
    where: RecordType, variables: Mapping[str, Object], model: Model
) -> _Bindings | None:
    """Bind the fields of `where` so that each is certainly of its type, if possible.

    A manifest field is computed; any other is bound to the first known object of its
    type for which the remaining fields can be bound as well. A ptype of which no
    situation is known, but of which a witness function is certain, gets a new one.
    """
    whole = _search(_in_order_of_need(where), {}, variables, model)
    if whole is None:
        return None
    bound, extended = whole
    return {label: bound[label] for label in where}, extended


@lru_cache
def _in_order_of_need(where: RecordType) -> tuple[tuple[str, TypeNode], ...]:
    """The fields in the order in which they are bound: claims as early as possible.

    A claim, a ptype or a manifest field, comes as soon as what it mentions is bound, so
    that it can fail before more objects are tried. What the claims mention comes before
    the other fields, first what the claim mentions that needs the fewest bindings.
    """
    waiting, ordered = dict(where.fields), dict[str, TypeNode]()
    while waiting:
        needs = {k: labels_mentioned(T) & waiting.keys() for k, T in waiting.items()}
        claims = [k for k, T in waiting.items() if isinstance(T, Singleton | PType)]
        label = min(claims, key=lambda k: len(needs[k]), default=next(iter(waiting)))
        for _ in waiting:  # more steps than there are labels would be a cycle
            label = min(needs[label], default=label)
        ordered[label] = waiting.pop(label)
    return tuple(ordered.items())


def _search(
    fields: tuple[tuple[str, TypeNode], ...],
    bound: Mapping[str, Object],
    variables: Mapping[str, Object],
    model: Model,
) -> _Bindings | None:
    spend()
    if not fields:
        return bound, model
    (label, field), *rest = fields
    for value, extended in _candidates(field, bound, variables, model):
        whole = _search(tuple(rest), {**bound, label: value}, variables, extended)
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
            value = reduce_applications(model.facts, resolve_paths(field.value, around))
            base = resolve_paths(field.base, around)
            return [(value, model)] if is_certain(model.facts, value, base) else []
        T = reduce_applications(model.facts, resolve_paths(field, around))
        known = [(one, model) for one in model.witnesses(T)]
        return known or _situations_seen(T, model)
    except (UnresolvedError, RefusedError):
        return []


def _situations_seen(T: TypeNode, model: Model) -> Iterable[tuple[Object, Model]]:
    """A new situation of a ptype of which a witness function is certain."""
    if not isinstance(T, PType) or T.pred not in model.facts.functions:
        return []
    try:
        seen, extended = model.create(T)
    except RefusedError:
        return []
    return [(seen, extended)] if is_certain(extended.facts, seen, T) else []
