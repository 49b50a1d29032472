"""What effects written in Python read and write, by their syntax trees.

What cannot be followed is ignored: names that are set more than once, labels that are
tested for before they are used, and what functions of other files do.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from functools import cached_property
from types import FunctionType
from typing import NamedTuple, TypeAlias

from ttr.building import constructors
from ttr.errors import Span, TTRError
from ttr.types import records
from ttr.types.objects import Path, freeze
from ttr.types.syntax import Rec, RecordType, TypeNode
from ttr.updates.checks.effect_summaries import (
    Access,
    Built,
    EffectSummary,
    Outcome,
    Write,
)
from ttr.updates.checks.python_sources import (
    Source,
    assigned_names,
    guarded_labels,
    may_fall_through,
    prefixes,
    returned_values,
    source_of,
    tested_expressions,
    walk_untried,
)
from ttr.updates.checks.state_layout import Labels, Term, leaf_fields
from ttr.updates.rules import Rule

DEPTH = 4
"""How many calls, and names that stand for others, are followed."""


def summarise_python(source: Source, rule: Rule) -> EffectSummary:
    """Summarise a rule's effect by its source."""
    bound = [name for name in rule.where or () if name in rule.takes]
    roles = {name: name for name in (*rule.names, *bound)}
    scope = _Scope(source, roles, rule.names[0])
    results = tuple(_results(scope))
    return EffectSummary(
        reads=tuple(dict.fromkeys(_reads(scope))),
        outcomes=tuple(one for one in results if isinstance(one, tuple)),
        complete=not {_Unknown.STATE, _Unknown.ANYTHING}.intersection(results),
        may_refuse=not {_Unknown.NONE, _Unknown.ANYTHING}.isdisjoint(results),
        replaced=tuple(
            dict.fromkeys((*_paths_replaced_in(scope), *_replaced_in_result(scope)))
        ),
        undefined=tuple(dict.fromkeys(_undefined_names(scope))),
        built=tuple(_built_types(scope)),
    )


# --- what names stand for ------------------------------------------------------------


class _Change(NamedTuple):
    """What a call of `replace` or `rectype` sets: the path, its place, and to what."""

    path: Labels
    span: Span
    value: ast.expr


@dataclass(frozen=True, eq=False)
class _Scope:
    """An effect, or a function that it calls, with what its parameters are.

    `roles` says which of its parameters are the rule's state, event and bindings, by
    their names in the rule; `state` is the name of the state. `known` are the labels
    that the callers have tested for, `callers` the functions that lead to this one.
    """

    source: Source
    roles: Mapping[str, str]
    state: str
    known: frozenset[str] = frozenset()
    callers: tuple[FunctionType, ...] = ()

    @cached_property
    def variables(self) -> Mapping[str, str]:
        """The parameters that are not set again, and what they are in the rule."""
        again = set(assigned_names(self.source.node))
        return {name: role for name, role in self.roles.items() if name not in again}

    @cached_property
    def assignments(self) -> dict[str, ast.expr]:
        """The values of the names that are set exactly once."""
        values: dict[str, ast.expr] = {}
        for node in walk_untried(self.source.body):
            match node:
                case (
                    ast.Assign([ast.Name(name)], value)
                    | ast.AnnAssign(ast.Name(name), value=ast.expr() as value)
                    | ast.NamedExpr(ast.Name(name), value)
                ):
                    values[name] = value
        times = Counter(assigned_names(self.source.node))
        return {name: v for name, v in values.items() if times[name] == 1}

    def follow(self, node: ast.expr) -> ast.expr:
        """The value of a name that is set once; any other expression itself."""
        if isinstance(node, ast.Name):
            return self.assignments.get(node.id, node)
        return node

    # --- other functions --------------------------------------------------------------

    @cached_property
    def helpers(self) -> Sequence[_Scope]:
        """The functions of the same file that are called with variables."""
        nodes = walk_untried(self.source.body)
        calls = (node for node in nodes if isinstance(node, ast.Call))
        found = (self.helper(call) for call in calls)
        return [helper for helper in found if helper is not None]

    def helper(self, call: ast.Call) -> _Scope | None:
        """The scope of the function that is called, if it gets a variable."""
        source = source_of(self.source.value_of(call.func))
        callers = (*self.callers, self.source.function)
        if source is None or source.file != self.source.file:
            return None
        if source.function in callers or len(callers) > DEPTH:
            return None
        arguments = [*zip(source.parameters, call.args, strict=False)]
        arguments += [(one.arg, one.value) for one in call.keywords if one.arg]
        roles = {
            name: self.variables[value.id]
            for name, value in arguments
            if isinstance(value, ast.Name) and value.id in self.variables
        }
        if not roles or any(isinstance(one, ast.Starred) for one in call.args):
            return None
        return _Scope(source, roles, self.state, self._guarded_labels, callers)

    # --- paths ------------------------------------------------------------------------

    def access(self, node: ast.expr, depth: int = 0) -> _Chain | None:
        """The path that an expression starts with, if it starts at a variable."""
        match node:
            case ast.Name(name) if name in self.variables:
                return _Chain(Access(self.variables[name], (), ()))
            case ast.Name(name) if name in self.assignments and depth < DEPTH:
                return self.access(self.assignments[name], depth + 1)
            case ast.Attribute(value, label):
                chain, steps = self.access(value, depth), [label]
                spans = [self.source.span(node, len(label))]
            case ast.Subscript(value, ast.Constant(str(text)) as key):
                chain, steps = self.access(value, depth), text.split(".")
                spans = [self.source.span(key)] * len(steps)
            case ast.Subscript(value) | ast.Call(value):
                chain = self.access(value, depth)
                return chain and _Chain(chain.access, whole=False)
            case _:
                return None
        if chain is None or not chain.whole:
            return chain
        if any(not step.isidentifier() or step.startswith("_") for step in steps):
            return _Chain(chain.access, whole=False)
        start = chain.access
        path, places = (*start.path, *steps), (*start.spans, *spans)
        return _Chain(Access(start.variable, path, places))

    @cached_property
    def _guarded_labels(self) -> frozenset[str]:
        """The labels that are tested for before they are used."""
        return self.known.union(guarded_labels(self.source.body))

    @cached_property
    def _tested_paths(self) -> Sequence[_Chain]:
        """The paths whose type is tested before they are used."""
        found = map(self.access, tested_expressions(self.source.body))
        return [chain for chain in found if chain is not None]

    def is_guarded(self, access: Access) -> bool:
        """Does the effect itself make sure that there is such a path?"""
        if self._guarded_labels.intersection(access.path):
            return True
        return any(
            chain.whole
            and chain.access.variable == access.variable
            and access.path[: len(chain.access.path)] == chain.access.path
            for chain in self._tested_paths
        )

    # --- calls of replace and rectype -------------------------------------------------

    def is_replace(self, node: ast.Call) -> bool:
        """Is it `ttr.replace` that is called?"""
        return bool(node.args) and self.source.value_of(node.func) is records.replace

    def is_rectype(self, node: ast.Call) -> bool:
        """Is it `ttr.rectype` that is called?"""
        return self.source.value_of(node.func) is constructors.rectype

    def changes(self, node: ast.Call) -> list[_Change] | None:
        """What a call of `replace` or `rectype` sets; None if that is not known."""
        first = 0 if self.is_rectype(node) else 1
        found = [self._set_by_mapping(self.follow(one)) for one in node.args[first:]]
        found.append(self._set_by_keywords(node.keywords))
        if any(one is None for one in found):
            return None
        return [change for some in found for change in some or ()]

    def _set_by_mapping(self, mapping: ast.expr) -> list[_Change] | None:
        """What a mapping sets: {"x": …}, or dict(x=…)."""
        if isinstance(mapping, ast.Call):
            plain = not mapping.args and self.source.value_of(mapping.func) is dict
            return self._set_by_keywords(mapping.keywords) if plain else None
        if not isinstance(mapping, ast.Dict):
            return None
        found: list[_Change] = []
        for key, value in zip(mapping.keys, mapping.values, strict=True):
            if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
                return None
            path = tuple(key.value.split("."))
            found.append(_Change(path, self.source.span(key), value))
        return found

    def _set_by_keywords(self, keywords: list[ast.keyword]) -> list[_Change] | None:
        """What keyword arguments set: x=…, or **{"x": …}."""
        found: list[_Change] = []
        for keyword in keywords:
            if keyword.arg is None:
                inner = self._set_by_mapping(self.follow(keyword.value))
                if inner is None:
                    return None
                found += inner
                continue
            span = self.source.label_span(keyword, keyword.arg)
            found.append(_Change((keyword.arg,), span, keyword.value))
        return found


class _Chain(NamedTuple):
    """The path that an expression starts with; is it the `whole` expression?

    The path of `s.qud[0].x` is s.qud: what an element has, is no matter of labels.
    """

    access: Access
    whole: bool = True


# --- what is read --------------------------------------------------------------------


def _reads(scope: _Scope) -> Iterator[Access]:
    inner: set[int] = set()
    for node in walk_untried(scope.source.body):
        if id(node) in inner or not isinstance(node, ast.Attribute | ast.Subscript):
            continue
        if not isinstance(node.ctx, ast.Load):
            continue
        inner |= {id(one) for one in prefixes(node)}
        chain = scope.access(node)
        if chain and chain.access.path and not scope.is_guarded(chain.access):
            yield chain.access
    for helper in scope.helpers:
        yield from _reads(helper)


def _undefined_names(scope: _Scope) -> Iterator[tuple[str, Span]]:
    """The names that nothing binds, each where it is used first."""
    for name in dict.fromkeys(scope.source.undefined_names()):
        for node in walk_untried(scope.source.body):
            if isinstance(node, ast.Name) and node.id == name:
                yield name, scope.source.span(node)
                break
    for helper in scope.helpers:
        yield from _undefined_names(helper)


# --- what is replaced ----------------------------------------------------------------


def _paths_replaced_in(scope: _Scope) -> Iterator[Access]:
    """The paths that are replaced in a variable."""
    for node in walk_untried(scope.source.body):
        match node:
            case ast.Call(_, [ast.Name(name), *_]) if name in scope.variables:
                if scope.is_replace(node):
                    yield from _replaced_paths(scope, node, scope.variables[name])
    for helper in scope.helpers:
        yield from _paths_replaced_in(helper)


def _replaced_in_result(scope: _Scope) -> Iterator[Access]:
    """The paths that are replaced in what is returned, which has to be a state."""
    for value in returned_values(scope.source.body):
        for call in _returned_replacements(scope, value):
            yield from _replaced_paths(scope, call, scope.state)


def _returned_replacements(
    scope: _Scope, node: ast.expr | None, depth: int = 0
) -> Iterator[ast.Call]:
    """The calls of `replace` whose result is returned, also one inside another."""
    match node:
        case ast.IfExp(_, one, other):
            yield from _returned_replacements(scope, one, depth)
            yield from _returned_replacements(scope, other, depth)
        case ast.Tuple([state, _]):
            yield from _returned_replacements(scope, state, depth)
        case ast.Name(name) if name in scope.assignments and depth < DEPTH:
            yield from _returned_replacements(scope, scope.assignments[name], depth + 1)
        case ast.Call() if scope.is_replace(node):
            yield node
            yield from _returned_replacements(scope, node.args[0], depth)


def _replaced_paths(scope: _Scope, call: ast.Call, variable: str) -> Iterator[Access]:
    """The paths that a call of `replace` sets in a variable."""
    for path, span, _ in scope.changes(call) or ():
        access = Access(variable, path, (span,) * len(path))
        if not scope.is_guarded(access):
            yield access


# --- types that are built ------------------------------------------------------------


def _built_types(scope: _Scope) -> Iterator[Built]:
    """The record types that are returned, where they are built in the effect itself."""
    for value in returned_values(scope.source.body):
        for node in _alternatives(scope, value):
            if isinstance(node, ast.Call) and scope.is_rectype(node):
                yield _type_built_by(scope, node)


def _alternatives(scope: _Scope, node: ast.expr | None) -> Iterator[ast.expr | None]:
    """The expressions, one of which is the value of this one."""
    if isinstance(node, ast.IfExp):
        yield from _alternatives(scope, node.body)
        yield from _alternatives(scope, node.orelse)
    else:
        yield None if node is None else scope.follow(node)


def _type_built_by(scope: _Scope, call: ast.Call, at: Labels = ()) -> Built:
    """The record type that a call of `rectype` builds, with its labels' places."""
    fields: dict[str, TypeNode] = {}
    places: list[tuple[Labels, Span]] = []
    for steps, span, value in scope.changes(call) or ():
        label, value = ".".join(steps), scope.follow(value)
        path = (*at, label)
        places.append((path, span))
        fields[label] = Rec
        if isinstance(value, ast.Call) and scope.is_rectype(value):
            inner = _type_built_by(scope, value, path)
            fields[label] = inner.type
            places += inner.places
    return Built(RecordType(tuple(fields.items())), tuple(places))


# --- what is returned ----------------------------------------------------------------


class _Unknown(Enum):
    """Results of an effect of which it is not known what they write."""

    NONE = auto()
    """None: the rule does not apply after all."""
    STATE = auto()
    """A state, but which is not known."""
    ANYTHING = auto()
    """A state or None."""


_Result: TypeAlias = Outcome | _Unknown


def _results(scope: _Scope) -> Iterator[_Result]:
    """What an effect may return: what it writes in each case, so far as is known."""
    for value in returned_values(scope.source.body):
        yield from _results_of(scope, value)
    if may_fall_through(scope.source.body):
        yield _Unknown.NONE


def _results_of(
    scope: _Scope, node: ast.expr | None, depth: int = 0
) -> Iterator[_Result]:
    """What an effect may return by an expression."""
    match node:
        case None | ast.Constant(None):
            yield _Unknown.NONE
        case ast.IfExp(_, one, other):
            yield from _results_of(scope, one, depth)
            yield from _results_of(scope, other, depth)
        case ast.Tuple([state, _]):
            yield from map(_not_none, _results_of(scope, state, depth))
        case ast.Name(name) if scope.variables.get(name) == scope.state:
            yield ()
        case ast.Name(name) if name in scope.assignments and depth < DEPTH:
            yield from _results_of(scope, scope.assignments[name], depth + 1)
        case ast.Call() if scope.is_replace(node):
            yield from _results_of_replace(scope, node, depth)
        case ast.Call() if scope.is_rectype(node):
            built = _type_built_by(scope, node).type
            yield tuple(Write(path) for path, _ in leaf_fields(built))
        case ast.Call() if helper := scope.helper(node):
            yield from _results(helper)
        case _:
            yield _Unknown.ANYTHING


def _results_of_replace(scope: _Scope, call: ast.Call, depth: int) -> Iterator[_Result]:
    """What a call of `replace` may return: a state, with these paths set."""
    changes = scope.changes(call)
    if changes is None:
        yield _Unknown.STATE
        return
    writes = tuple(_write(scope, change) for change in changes)
    for before in map(_not_none, _results_of(scope, call.args[0], depth)):
        yield before + writes if isinstance(before, tuple) else before


def _not_none(result: _Result) -> _Result:
    """A result that has to be a state."""
    return _Unknown.STATE if isinstance(result, _Unknown) else result


def _write(scope: _Scope, change: _Change) -> Write:
    value = scope.follow(change.value)
    chain = scope.access(value)
    if chain is not None and chain.whole:
        path = Path(0, (chain.access.variable, *chain.access.path))
        return Write(change.path, Term(path), span=change.span)
    try:
        constant = freeze(ast.literal_eval(value))
    except (ValueError, TypeError, SyntaxError, MemoryError, TTRError):
        return Write(change.path, span=change.span)
    return Write(change.path, Term(constant), span=change.span)
