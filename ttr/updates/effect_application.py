"""From what a rule gives to the next state.

A rule gives a state, a state and a model, or a record type. Then the next state is of
the asymmetric merge of the state's own type with it: what the type sets is set, what it
only types is created, and everything else stays.
"""

from __future__ import annotations

from typing import NamedTuple

from ttr.errors import RuleFailed, TTRError
from ttr.judging.certainty import certainly
from ttr.judging.evaluator import derivation, reduced
from ttr.judging.models import Model
from ttr.types.printing import notation
from ttr.types.substitution import Around, grounded
from ttr.types.syntax import Object, Record, RecordType, Singleton, TypeNode
from ttr.updates.rules import Rule
from ttr.updates.user_functions import in_short

__all__ = ["Settled", "settled"]


class Settled(NamedTuple):
    """A next state, its model, and the paths of what had to be created."""

    state: Record
    model: Model
    created: tuple[str, ...] = ()


def settled(rule: Rule, effect: object, state: Record, model: Model) -> Settled:
    """The next state, whatever of the three kinds the effect is; else `RuleFailed`."""
    match effect:
        case Record():
            return Settled(effect, model)
        case (Record() as after, Model() as extended):
            return Settled(after, extended)
        case RecordType():
            try:
                return _realised(effect, state, model, (), "")
            except TTRError as error:
                raise RuleFailed(
                    f"no state can be made of what the rule {rule} gave: "
                    f"{error.message}",
                    hint=error.hint,
                ) from error
    raise RuleFailed(
        f"the rule {rule} gives a state, a state and a model, a record type or None, "
        f"but it gave {in_short(effect)}"
    )


def _realised(
    T: RecordType, old: Record, model: Model, around: Around, path: str
) -> Settled:
    """The record with the fields of T as T has them, and its other fields as before."""
    kept = {label: value for label, value in old._fields.items() if label not in T}
    fields: dict[str, Object] = kept
    created: list[str] = []
    for label, field in T.fields:
        inner = f"{path}.{label}" if path else label
        before = old._fields.get(label)
        scope = (fields, *around)
        if isinstance(field, RecordType) and isinstance(before, Record):
            one = _realised(field, before, model, scope, inner)
            fields[label], model = one.state, one.model
            created += one.created
            continue
        fields[label], model, is_new = _made(field, model, scope, inner)
        created += [inner] * is_new
    return Settled(Record({**old._fields, **fields}), model, tuple(created))


def _made(
    field: TypeNode, model: Model, around: Around, path: str
) -> tuple[Object, Model, bool]:
    """What a field is set to, or something created for it; and whether it was."""
    T = reduced(model.facts, grounded(field, around))
    if not isinstance(T, Singleton):
        value, model = model.create(T)
        return value, model, True
    value = T.value
    if certainly(model.facts, value, T.base):
        return value, model, False
    why = derivation(model.facts, value, T.base)
    failed = why.failure() or why
    at = ".".join(filter(None, (path, why.path())))
    raise RuleFailed(
        f"at {at}: {notation(failed.sit)} : {failed.type}, {failed.because}"
    )
