"""From the result of an effect to the next state.

An effect gives a state, a state and a model, or a record type. If it gives a type, the
next state is of the asymmetric merge of the state's own type with it: manifest fields
are set, witnesses of the other fields are created, and everything else stays.
"""

from __future__ import annotations

from typing import NamedTuple

from ttr.errors import RuleFailedError, TTRError
from ttr.judging.certainty import is_certain
from ttr.judging.evaluator import derivation, reduce_applications
from ttr.judging.models import Model
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.substitution import Around, resolve_paths
from ttr.types.syntax import RecordType, Singleton, TypeNode
from ttr.updates.rules import Rule
from ttr.updates.user_functions import excerpt


class NextState(NamedTuple):
    """The next state, its model, and the paths of what had to be created."""

    state: Record
    model: Model
    created: tuple[str, ...] = ()


def apply_effect(rule: Rule, effect: object, state: Record, model: Model) -> NextState:
    """The next state, by the result of a rule's effect.

    Raises `RuleFailedError` for a result of another kind, or if no state can be made of
    it.
    """
    match effect:
        case Record():
            return NextState(effect, model)
        case (Record() as after, Model() as extended):
            return NextState(after, extended)
        case RecordType():
            try:
                return _realise(effect, state, model, (), "")
            except TTRError as error:
                raise RuleFailedError(
                    f"no state can be made of what the rule {rule} gave: "
                    f"{error.message}",
                    hint=error.hint,
                ) from error
    raise RuleFailedError(
        f"the rule {rule} gives a state, a state and a model, a record type or None, "
        f"but it gave {excerpt(effect)}"
    )


def _realise(
    T: RecordType, old: Record, model: Model, around: Around, path: str
) -> NextState:
    """The old record with the fields of T set or created as T says."""
    kept = {label: value for label, value in old._fields.items() if label not in T}
    fields: dict[str, Object] = kept
    created: list[str] = []
    for label, field in T.fields:
        inner = f"{path}.{label}" if path else label
        before = old._fields.get(label)
        scope = (fields, *around)
        if isinstance(field, RecordType) and isinstance(before, Record):
            one = _realise(field, before, model, scope, inner)
            fields[label], model = one.state, one.model
            created += one.created
            continue
        fields[label], model, is_new = _realise_field(field, model, scope, inner)
        created += [inner] * is_new
    return NextState(Record({**old._fields, **fields}), model, tuple(created))


def _realise_field(
    field: TypeNode, model: Model, around: Around, path: str
) -> tuple[Object, Model, bool]:
    """The value of a field, set or created; the model; and was it created?"""
    T = reduce_applications(model.facts, resolve_paths(field, around))
    if not isinstance(T, Singleton):
        value, model = model.create(T)
        return value, model, True
    value = T.value
    if is_certain(model.facts, value, T.base):
        return value, model, False
    why = derivation(model.facts, value, T.base)
    failed = why.failure() or why
    at = ".".join(filter(None, (path, why.path())))
    raise RuleFailedError(
        f"at {at}: {notation(failed.sit)} : {failed.type}, {failed.because}"
    )
