"""Accounts of effects in Python, by reading their syntax trees."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ttr.errors import Span, TTRError
from ttr.types.syntax import Path, Rec, RecordType, TypeNode, freeze
from ttr.updates.checks.accounts import Access, Account, Built, Outcome, Write
from ttr.updates.checks.python_scopes import DEPTH, Change, Scope, labels_of
from ttr.updates.checks.python_sources import Source
from ttr.updates.checks.python_trees import falls_through, heads, nodes, returned
from ttr.updates.checks.state_layout import Labels, Term, leaves
from ttr.updates.rules import EXTRAS, Rule

__all__ = ["read"]


def read(source: Source, rule: Rule) -> Account:
    """The account of a rule's effect, by its source."""
    bound = [name for name in rule.where or () if name in rule.takes]
    others = (*EXTRAS, *bound)
    plain = [name for name in source.parameters if name not in others]
    names = rule.names[: 1 + (rule.on is not None)]
    roles = {**dict(zip(plain, names, strict=False)), **{b: b for b in bound}}
    scope = Scope(source, roles, rule.names[0])
    outcomes = _outcomes(scope)
    return Account(
        reads=tuple(dict.fromkeys(_reads(scope))),
        outcomes=tuple(one for one in outcomes if one is not None),
        whole=None not in outcomes,
        refuses=_refuses(scope),
        replaced=tuple(dict.fromkeys((*_replaced(scope), *_in_result(scope)))),
        undefined=tuple(dict.fromkeys(_undefined(scope))),
        built=tuple(_built(scope)),
    )


# --- what is read --------------------------------------------------------------------


def _reads(scope: Scope) -> Iterator[Access]:
    inner: set[int] = set()
    for node in nodes(scope.source.body):
        if id(node) in inner or not isinstance(node, ast.Attribute | ast.Subscript):
            continue
        if not isinstance(node.ctx, ast.Load):
            continue
        inner |= {id(one) for one in heads(node)}
        found = scope.access(node)
        if found and found.path and not scope.is_left_alone(found):
            yield labels_of(found)
    for helper in scope.helpers:
        yield from _reads(helper)


def _undefined(scope: Scope) -> Iterator[tuple[str, Span]]:
    """The names that nothing binds, each where it is used first."""
    for name in dict.fromkeys(scope.source.undefined()):
        for node in nodes(scope.source.body):
            if isinstance(node, ast.Name) and node.id == name:
                yield name, scope.source.span(node)
                break
    for helper in scope.helpers:
        yield from _undefined(helper)


# --- what is replaced ----------------------------------------------------------------


def _replaced(scope: Scope) -> Iterator[Access]:
    """The paths that are replaced in a variable."""
    for node in nodes(scope.source.body):
        match node:
            case ast.Call(_, [ast.Name(name), *_]) if name in scope.variables:
                if scope.is_replace(node):
                    yield from _paths(scope, node, scope.variables[name])
    for helper in scope.helpers:
        yield from _replaced(helper)


def _in_result(scope: Scope) -> Iterator[Access]:
    """The paths that are replaced in what is given, which has to be a state."""
    for value in returned(scope.source.body):
        for call in _resulting(scope, value):
            yield from _paths(scope, call, scope.state)


def _resulting(
    scope: Scope, node: ast.expr | None, depth: int = 0
) -> Iterator[ast.Call]:
    """The calls of `replace` whose result is given, one inside another."""
    match node:
        case ast.IfExp(_, one, other):
            yield from _resulting(scope, one, depth)
            yield from _resulting(scope, other, depth)
        case ast.Tuple([state, _]):
            yield from _resulting(scope, state, depth)
        case ast.Name(name) if name in scope.assigned and depth < DEPTH:
            yield from _resulting(scope, scope.assigned[name], depth + 1)
        case ast.Call() if scope.is_replace(node):
            yield node
            yield from _resulting(scope, node.args[0], depth)


def _paths(scope: Scope, call: ast.Call, variable: str) -> Iterator[Access]:
    """The paths that a call of `replace` sets in a variable."""
    for path, span, _ in scope.changes(call) or ():
        found = Access(variable, path, (span,) * len(path))
        if not scope.is_left_alone(found):
            yield found


# --- types that are built ------------------------------------------------------------


def _built(scope: Scope) -> Iterator[Built]:
    """The record types that are given, where they are built in the effect itself."""
    for value in returned(scope.source.body):
        for node in _either(scope, value):
            if isinstance(node, ast.Call) and scope.is_rectype(node):
                yield _type_of(scope, node)


def _either(scope: Scope, node: ast.expr | None) -> Iterator[ast.expr | None]:
    """What an expression may come to."""
    if isinstance(node, ast.IfExp):
        yield from _either(scope, node.body)
        yield from _either(scope, node.orelse)
    else:
        yield None if node is None else scope.followed(node)


def _type_of(scope: Scope, call: ast.Call, at: Labels = ()) -> Built:
    """The record type that a call of `rectype` builds, with its labels' places."""
    fields: dict[str, TypeNode] = {}
    places: list[tuple[Labels, Span]] = []
    for steps, span, value in scope.changes(call) or ():
        label, value = ".".join(steps), scope.followed(value)
        path = (*at, label)
        places.append((path, span))
        fields[label] = Rec
        if isinstance(value, ast.Call) and scope.is_rectype(value):
            inner = _type_of(scope, value, path)
            fields[label] = inner.type
            places += inner.places
    return Built(RecordType(tuple(fields.items())), tuple(places))


# --- what is given -------------------------------------------------------------------

_UNKNOWN: tuple[Outcome | None, ...] = (None,)
"""That what is written cannot be told."""


def _outcomes(scope: Scope) -> tuple[Outcome | None, ...]:
    """What is written in each of the states that may be given; None where that is not
    told."""
    values = returned(scope.source.body)
    return tuple(one for value in values for one in _written(scope, value))


def _written(
    scope: Scope, node: ast.expr | None, depth: int = 0
) -> tuple[Outcome | None, ...]:
    """What may be written where an expression is given; nothing for None."""
    match node:
        case None | ast.Constant(None):
            return ()
        case ast.IfExp(_, one, other):
            return (*_written(scope, one, depth), *_written(scope, other, depth))
        case ast.Tuple([state, _]):
            return _written(scope, state, depth)
        case ast.Name(name) if scope.variables.get(name) == scope.state:
            return ((),)
        case ast.Name(name) if name in scope.assigned and depth < DEPTH:
            return _written(scope, scope.assigned[name], depth + 1)
        case ast.Call() if scope.is_replace(node):
            changes = scope.changes(node)
            if changes is None:
                return _UNKNOWN
            writes = tuple(_write(scope, change) for change in changes)
            before = _written(scope, node.args[0], depth)
            return tuple(None if one is None else one + writes for one in before)
        case ast.Call() if scope.is_rectype(node):
            built = _type_of(scope, node)
            return (tuple(Write(path) for path, _ in leaves(built.type)),)
        case ast.Call():
            helper = scope.helper(node)
            return _UNKNOWN if helper is None else _outcomes(helper)
    return _UNKNOWN


def _write(scope: Scope, change: Change) -> Write:
    value = scope.followed(change.value)
    found = scope.access(value)
    if found is not None and labels_of(found) is found:
        term = Term(Path(0, (found.variable, *found.path)))
        return Write(change.path, term, span=change.span)
    try:
        term = Term(freeze(ast.literal_eval(value)))
    except (ValueError, TypeError, SyntaxError, MemoryError, TTRError):
        return Write(change.path, span=change.span)
    return Write(change.path, term, span=change.span)


def _refuses(scope: Scope) -> bool:
    """Whether None may be given, for all that is known."""
    body = scope.source.body
    return falls_through(body) or any(_may_be_none(scope, v) for v in returned(body))


def _may_be_none(scope: Scope, node: ast.expr | None) -> bool:
    match node:
        case ast.IfExp(_, one, other):
            return _may_be_none(scope, one) or _may_be_none(scope, other)
        case ast.Tuple():
            return False
        case ast.Name(name):
            return scope.variables.get(name) != scope.state
        case ast.Call() if scope.is_replace(node) or scope.is_rectype(node):
            return False
        case ast.Call():
            helper = scope.helper(node)
            return helper is None or _refuses(helper)
    return True
