"""Applying one rule to one state, or explaining why it does not apply."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.errors import UpdateError
from ttr.judging.models import Model
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.syntax import Rec, RecordType, TypeNode
from ttr.updates.matching import find_bindings
from ttr.updates.nbest import NBest, match_event
from ttr.updates.rules import Rule
from ttr.updates.running import Run, run

__all__ = ["apply_rule", "why_not"]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)


def apply_rule(rule: Rule, args: Sequence[Object], model: Model) -> Run:
    """Apply a rule to a state and, if it takes one, an event.

    The state may be of any record type, as only a game says which one. Raises
    `UpdateError` if the rule does not apply, and says why.

    >>> from ttr import Theory, record
    >>> count = Theory.parse('''
    ...     basic Int
    ...     Board := [told : list(Int)]
    ...     rule forget(s : [told : nelist(Int)]) := [told = rst(s.told) : list(Int)]
    ... ''')
    >>> M, forget = Model(count).given(1, count.Int), count.rules["forget"]
    >>> print(apply_rule(forget, [record(told=[1])], M).state)
    {told = []}
    >>> apply_rule(forget, [record(told=[])], M)
    Traceback (most recent call last):
    ttr.errors.UpdateError: forget does not apply: told: [] : nelist(Int), it is empty
    """
    state, *events = args
    if not isinstance(state, Record):
        raise UpdateError(f"a state is a record, found {notation(state)}")
    after = run(rule, state, type=Rec, model=model, events=events)
    if after.trace:
        return after
    reason = why_not(rule, state, events[0] if events else None, model)
    raise UpdateError(f"{rule} does not apply: {reason}")


def why_not(rule: Rule, state: Record, event: Object | NBest, model: Model) -> str:
    """Why a rule does not apply to a state and an event; empty if it may apply.

    >>> from ttr import Theory, record
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> why_not(talk.rules["drop"], record(qud=[]), None, Model(talk))
    'qud: [] : nelist(Question), it is empty'
    """
    if rule.on is not None:
        if event is None:
            return f"it waits for an event of {rule.on}"
        if match_event(event, rule.on, rule.p, model) is None:
            return _why_not_taken(event, rule, rule.on, model)
    return _why_not_of_type(state, rule.when, model) or _why_not_bound(
        rule, state, event, model
    )


def _why_not_taken(
    event: Object | NBest, rule: Rule, on: TypeNode, model: Model
) -> str:
    """Why an event is not taken: it is not of the type, or not probably enough."""
    failed = "" if isinstance(event, NBest) else _why_not_of_type(event, on, model)
    return failed or f"an event of {on} is not as probable as {rule.p}"


def _why_not_of_type(value: Object, T: TypeNode, model: Model) -> str:
    """The step at which a judgement fails; empty if it is certain."""
    why = model.judge(value, T).why
    failed = why.failure()
    if failed is None:
        return ""
    where = f"{why.path()}: " if why.path() else ""
    return f"{where}{notation(failed.sit)} : {failed.type}, {failed.because}"


def _why_not_bound(
    rule: Rule, state: Record, event: Object | NBest, model: Model
) -> str:
    """The first field that cannot be bound together with those before it."""
    if rule.where is None:
        return ""
    if rule.on is not None:
        taken = match_event(event, rule.on, rule.p, model)
        event = taken.event if taken else None
    variables = dict(zip(rule.names, (state, event), strict=False))
    for count, (label, field) in enumerate(rule.where.fields, start=1):
        some = RecordType(rule.where.fields[:count])
        if find_bindings(some, variables, model) is None:
            scope = (frozenset(rule.where), frozenset(rule.names))
            return f"nothing is found for {label} : {notation(field, scope)}"
    return ""
