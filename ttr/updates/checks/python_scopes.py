"""What the names in an effect in Python stand for, and what can be followed of it.

What cannot be followed is left alone: names that are set again, labels that are asked
for before they are used, and what functions of other files do.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import FunctionType
from typing import NamedTuple

from ttr.building import constructors
from ttr.errors import Span
from ttr.types import records
from ttr.updates.checks.accounts import Access
from ttr.updates.checks.python_sources import Source, source_of
from ttr.updates.checks.python_trees import asked_for, examined, nodes, stored
from ttr.updates.checks.state_layout import Labels

__all__ = ["DEPTH", "Change", "Scope", "labels_of"]

DEPTH = 4
"""How many calls, and names that stand for others, are followed."""

_END = "()"
"""What a path ends with that goes on to what is no label."""


class Change(NamedTuple):
    """What a call of `replace` or `rectype` sets: the path, its place, and to what."""

    path: Labels
    span: Span
    value: ast.expr


@dataclass(frozen=True, eq=False)
class Scope:
    """An effect, or a function that it calls, with what its parameters are.

    `roles` says which of its parameters are the rule's state, event and bindings, by
    their names in the rule; `state` is that of the state. What was asked for, up to the
    call, is in `known`; `callers` are the functions that have called it.
    """

    source: Source
    roles: Mapping[str, str]
    state: str
    known: frozenset[str] = frozenset()
    callers: tuple[FunctionType, ...] = ()

    @cached_property
    def variables(self) -> Mapping[str, str]:
        """The parameters that are not set again, and what they are in the rule."""
        again = set(stored(self.source.node))
        return {name: role for name, role in self.roles.items() if name not in again}

    @cached_property
    def assigned(self) -> dict[str, ast.expr]:
        """What the names that are set once are set to."""
        values: dict[str, ast.expr] = {}
        for node in nodes(self.source.body):
            match node:
                case (
                    ast.Assign([ast.Name(name)], value)
                    | ast.AnnAssign(ast.Name(name), value=ast.expr() as value)
                    | ast.NamedExpr(ast.Name(name), value)
                ):
                    values[name] = value
        often = Counter(stored(self.source.node))
        return {name: v for name, v in values.items() if often[name] == 1}

    # --- other functions --------------------------------------------------------------

    @cached_property
    def helpers(self) -> Sequence[Scope]:
        """The functions of the same file that are called with variables."""
        calls = (node for node in nodes(self.source.body) if isinstance(node, ast.Call))
        found = (self.helper(call) for call in calls)
        return [helper for helper in found if helper is not None]

    def helper(self, call: ast.Call) -> Scope | None:
        """The reader of the function that is called, if it gets a variable."""
        source = source_of(self.source.meant(call.func))
        callers = (*self.callers, self.source.function)
        if source is None or source.file != self.source.file:
            return None
        if source.function in callers or len(callers) > DEPTH:
            return None
        given = [*zip(source.parameters, call.args, strict=False)]
        given += [(one.arg, one.value) for one in call.keywords if one.arg]
        roles = {
            name: self.variables[value.id]
            for name, value in given
            if isinstance(value, ast.Name) and value.id in self.variables
        }
        if not roles or any(isinstance(one, ast.Starred) for one in call.args):
            return None
        return Scope(source, roles, self.state, self.guarded, callers)

    # --- paths ------------------------------------------------------------------------

    def access(self, node: ast.expr, depth: int = 0) -> Access | None:
        """The path that an expression begins with, if it begins with a variable."""
        match node:
            case ast.Name(name) if name in self.variables:
                return Access(self.variables[name], (), ())
            case ast.Name(name) if name in self.assigned and depth < DEPTH:
                return self.access(self.assigned[name], depth + 1)
            case ast.Attribute(value, label):
                found, steps = self.access(value, depth), [label]
                spans = [self.source.span(node, len(label))]
            case ast.Subscript(value, ast.Constant(str(text)) as key):
                found, steps = self.access(value, depth), text.split(".")
                spans = [self.source.span(key)] * len(steps)
            case ast.Subscript(value) | ast.Call(value):
                return _ended(self.access(value, depth))
            case _:
                return None
        if found is None or _has_ended(found):
            return found
        if any(not step.isidentifier() or step.startswith("_") for step in steps):
            return _ended(found)
        return Access(found.variable, (*found.path, *steps), (*found.spans, *spans))

    @cached_property
    def guarded(self) -> frozenset[str]:
        """The labels that are asked for before they are used."""
        return self.known.union(asked_for(self.source.body))

    @cached_property
    def examined(self) -> Sequence[Access]:
        """What the effect finds out the type of before it uses it."""
        found = map(self.access, examined(self.source.body))
        return [access for access in found if access is not None]

    def is_left_alone(self, found: Access) -> bool:
        """Whether the effect itself sees to it that there is such a path."""
        if self.guarded.intersection(found.path):
            return True
        return any(
            one.variable == found.variable and found.path[: len(one.path)] == one.path
            for one in self.examined
        )

    # --- calls of replace -------------------------------------------------------------

    def is_replace(self, node: ast.Call) -> bool:
        """Whether it is `ttr.replace` that is called."""
        return bool(node.args) and self.source.meant(node.func) is records.replace

    def is_rectype(self, node: ast.Call) -> bool:
        """Whether it is `ttr.rectype` that is called."""
        return self.source.meant(node.func) is constructors.rectype

    def changes(self, node: ast.Call) -> list[Change] | None:
        """What a call of `replace` or `rectype` sets, and to what; None if not told."""
        first = 0 if self.is_rectype(node) else 1
        found = [self._changed(self.followed(one)) for one in node.args[first:]]
        found.append(self._named(node.keywords))
        if any(one is None for one in found):
            return None
        return [change for some in found for change in some or ()]

    def _changed(self, mapping: ast.expr) -> list[Change] | None:
        """What a mapping sets: {"x": …}, or dict(x=…)."""
        if isinstance(mapping, ast.Call):
            plain = not mapping.args and self.source.meant(mapping.func) is dict
            return self._named(mapping.keywords) if plain else None
        if not isinstance(mapping, ast.Dict):
            return None
        found: list[Change] = []
        for key, value in zip(mapping.keys, mapping.values, strict=True):
            if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
                return None
            path = tuple(key.value.split("."))
            found.append(Change(path, self.source.span(key), value))
        return found

    def _named(self, keywords: list[ast.keyword]) -> list[Change] | None:
        """What keyword arguments set: x=…, or **{"x": …}."""
        found: list[Change] = []
        for keyword in keywords:
            if keyword.arg is None:
                inner = self._changed(self.followed(keyword.value))
                if inner is None:
                    return None
                found += inner
                continue
            span = self.source.opening(keyword, keyword.arg)
            found.append(Change((keyword.arg,), span, keyword.value))
        return found

    def followed(self, node: ast.expr) -> ast.expr:
        """What a name that is set once stands for; else the expression itself."""
        if isinstance(node, ast.Name):
            return self.assigned.get(node.id, node)
        return node


def _ended(found: Access | None) -> Access | None:
    """A path beyond which an expression goes, to an element or a result."""
    if found is None or _has_ended(found):
        return found
    return Access(found.variable, (*found.path, _END), (*found.spans, None))


def _has_ended(found: Access) -> bool:
    return found.path[-1:] == (_END,)


def labels_of(found: Access) -> Access:
    """The path without its end."""
    if not _has_ended(found):
        return found
    return Access(found.variable, found.path[:-1], found.spans[:-1])
