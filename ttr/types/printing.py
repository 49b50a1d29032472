"""One-line printing: `notation` is the blackboard, `python` evaluates back.

A path is written in the shortest form that reads back to the same path: bare where the
nearest enclosing record type with its first label is the one meant, else with a dot
(`.x`, the record where the field stands) or carets (`^.x`, one record further out).
"""

from __future__ import annotations

import keyword
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import count

from ttr.escapes import json_text
from ttr.safety.budgets import open_purse, spend
from ttr.types.interning import Node, as_notation, as_python, cache_on_node
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Missing,
    Object,
    Operation,
    Path,
    Record,
)
from ttr.types.paths import free_paths, replace_paths, shift_paths, subterms
from ttr.types.paths import parts as contents
from ttr.types.precedence import (
    begins_with_bracket,
    binds,
    holds_as_head,
    is_loose,
    is_loose_beside,
)
from ttr.types.reserved_words import RESERVED, WORDS
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    Merge,
    Negation,
    NonEmpty,
    Plus,
    Pred,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
    Universe,
)

Written = tuple[str, ...] | str
"""How a text writes a node: the labels of a record type, or the name of a variable."""


@dataclass(frozen=True, eq=False, slots=True)
class Spelling:
    """How a text writes what stands in it: the order of fields, the names of variables.

    As the outermost of the scopes it has values printed so. A name that is taken gets a
    number; what the text does not write has its own order and names.
    """

    written: Mapping[Node, Written]


Scope = tuple[frozenset[str] | str | Spelling, ...]
"""The scopes around, innermost first: the labels of a record type, or a variable.

A `Spelling` may be the outermost.
"""


def spelling_of(texts: Iterable[Mapping[Node, Written]]) -> Scope:
    """How texts write what stands in them, as a scope; the first text counts."""
    written: dict[Node, Written] = {}
    for text in texts:
        for value, way in text.items():
            written.setdefault(value, way)
    return (Spelling(written),) if written else ()


def as_written(value: Node, scope: Scope) -> Written | None:
    """How the text writes a node, if there is a text and the node stands in it."""
    if not scope:
        return None
    spelling = scope[-1]
    return spelling.written.get(value) if isinstance(spelling, Spelling) else None


def fields_in_order(T: RecordType, scope: Scope) -> Iterable[tuple[str, TypeNode]]:
    """The fields of a record type, in the order of the text if there is one."""
    labels = as_written(T, scope)
    return T.fields if labels is None else [(label, T[label]) for label in labels]


class Labels(frozenset[str]):
    """The labels of a record type; those `of_types` stand for types, as in T : Type.

    Where a type is needed, they hide the declared types of their names.
    """

    of_types: frozenset[str] = frozenset()


class TypeVariable(str):
    """The name of a variable that may stand for a type, as in λT:Type.

    It hides what is declared like labels `of_types`.
    """

    __slots__ = ()

    @property
    def of_types(self) -> frozenset[str]:
        """The name itself."""
        return frozenset((self,))


@cache_on_node
def labels_of(T: RecordType) -> frozenset[str]:
    """The labels of a record type, as a scope.

    >>> from ttr import Ind, Type, rectype
    >>> sorted(labels_of(rectype(T=Type, x=Ind)).of_types)
    ['T']
    """
    of_types = [k for k, T in T.fields if type(T) in _OF_TYPES and is_of_types(T)]
    return labels_with(T.labels, frozenset(of_types))


_OF_TYPES = (Universe, Singleton)


def labels_with(labels: Iterable[str], of_types: frozenset[str]) -> frozenset[str]:
    """Labels as a scope, of which some stand for types."""
    if not of_types:
        return frozenset(labels)
    found = Labels(labels)
    found.of_types = of_types
    return found


def is_of_types(T: TypeNode) -> bool:
    """Does a field say by its form that a type is at its label, as T : Type does?"""
    while isinstance(T, Singleton):
        T = T.base
    return isinstance(T, Universe)


def may_hold_types(T: TypeNode) -> bool:
    """Can a type be of T, as far as the form of T tells?

    >>> from ttr import Ind, Type
    >>> may_hold_types(Type @ Ind), may_hold_types(Ind >> Type)
    (True, False)
    """
    match T:
        case Singleton(base, _):
            return may_hold_types(base)
        case Meet(parts):
            return all(map(may_hold_types, parts))
        case Join(parts):
            return any(map(may_hold_types, parts))
    return isinstance(T, Universe | Negation | Application | TypeAt)


def hides_type(scope: Scope, name: str) -> bool:
    """Does a label or variable around hide the declared type of its name?"""
    for names in scope:
        if isinstance(names, Labels | TypeVariable) and name in names.of_types:
            return True
    return False


def notation(value: Object, scope: Scope = ()) -> str:
    """The value in the notation of the papers, on one line.

    >>> from ttr import Ind, outer, rectype
    >>> run = Pred("run", Ind)
    >>> inner = rectype(x=Ind, c=run(outer.x))
    >>> print(notation(rectype(x=Ind, y=inner)))
    [x : Ind, y : [c : run(^.x), x : Ind]]
    """
    match value:
        case Basic(name):
            return json_text(name) if hides_type(scope, name) else name
        case Universe(name, 0) | Pred(name):
            return name
        case Universe(name, level):
            return f"{name}^{level}"
        case PType(pred, args):
            return f"{pred.name}({_objects(args, scope)})"
        case Path():
            return _path(value, scope)
        case RecordType(()):
            return "Rec"
        case RecordType():
            spend(len(value.fields))
            inner = (labels_of(value), *scope)
            fields = fields_in_order(value, scope)
            return f"[{', '.join(_field(k, f, inner) for k, f in fields)}]"
        case Singleton(base, obj):
            return f"{_bracketed_beside(base, scope)}@{_object_beside(obj, scope)}"
        case Merge(parts):
            return f"merge({', '.join([notation(part, scope) for part in parts])})"
        case Meet(parts):
            return " /\\ ".join(_bracketed_operand(part, scope) for part in parts)
        case Join(parts):
            return " \\/ ".join(_bracketed_operand(part, scope) for part in parts)
        case Negation(body):
            return f"~{_bracketed_operand(body, scope)}"
        case FunType() | Function():
            return _binder(value, scope)
        case Application(function, argument):
            return f"{format_head(function, scope)}({_objects((argument,), scope)})"
        case Operation("+", args):
            return " + ".join([_object_beside(arg, scope) for arg in args])
        case Operation(name, args):
            return f"{name}({_objects(args, scope)})"
        case TypeAt(Path() as path):
            return _path_to_type(path, scope)
        case TypeAt(term):
            return notation(term, scope)
    if type(value) in WORDS:
        types, _ = contents(value)
        spend(len(types))
        inside = ", ".join([notation(T, scope) for T in types])
        return f"{WORDS[type(value)]}({inside})"
    return _object(value, scope)


def _field(label: str, field: TypeNode, scope: Scope) -> str:
    match field:
        case Singleton(base, obj):
            given = notation(as_object(obj, scope), scope)
            return f"{label} = {given} : {notation(base, scope)}"
    return f"{label} : {notation(field, scope)}"


def _bracketed_operand(value: Object, scope: Scope) -> str:
    """A part of a meet, join or negation: in brackets unless it binds closer."""
    spend()
    text = notation(value, scope)
    return f"({text})" if is_loose(value) else text


def _bracketed_beside(value: Object, scope: Scope) -> str:
    """A part beside @, + or an arrow: in brackets unless it holds together."""
    spend()
    text = notation(value, scope)
    return f"({text})" if is_loose_beside(value) else text


# --- where an object stands ----------------------------------------------------------


def as_object(value: Object, scope: Scope) -> Object:
    """What to write for a value as an argument, or after `=` or `@`.

    There a label or variable with the name of a type hides the type. Then T ∧ T is
    written, which is T: names in a meet are types.

    >>> from ttr import Ind
    >>> near, far = frozenset({"x"}), frozenset({"Ind"})
    >>> print(as_object(Ind, (near,)))
    Ind
    >>> print(as_object(Ind, (near, far)))
    Ind /\\ Ind
    """
    if not isinstance(value, TypeNode):
        return value
    match value:
        case Basic(name) | Universe(name, 0) if _is_hidden(scope, name):
            return Meet((value, value))
        case RecordType(()) if _is_hidden(scope, "Rec"):
            return Meet((value, value))
    return value


def _is_hidden(scope: Scope, name: str) -> bool:
    return any(name == names or name in _labels(names) for names in scope)


def _objects(values: Sequence[Object], scope: Scope) -> str:
    spend(len(values))
    return ", ".join([notation(as_object(v, scope), scope) for v in values])


def _object_beside(value: Object, scope: Scope) -> str:
    return _bracketed_beside(as_object(value, scope), scope)


# --- functions and their variables ---------------------------------------------------


def _binder(value: FunType | Function, scope: Scope) -> str:
    match value:
        case Function(domain, body):
            name = variable(value, scope)
            inside = (name, *scope)
            inner = notation(as_object(body, inside), inside)
            return f"\\{name}:{_bracketed_beside(domain, scope)}. {inner}"
        case FunType(domain, result):
            if not binds(result):
                inner = _bracketed_operand(result, ("", *scope))
                return f"({_bracketed_beside(domain, scope)} -> {inner})"
            name = variable(value, scope)
            inner = _bracketed_operand(result, (name, *scope))
            return f"(({name} : {notation(domain, scope)}) -> {inner})"


def variable(value: FunType | Function, scope: Scope) -> str:
    """The name to write for the variable: the first that is free of those for its type.

    Taken are the names of the variables around, of the labels, predicates and basic
    types in the body, and of the labels further out that it is about. Types are called
    T, U, …, properties P, Q, …, other functions f, g, …, records r, s, … and anything
    else x, y, z. Where the scope has the spelling of a text, the variable is called as
    it is there.

    >>> from ttr import Ind, Pi, Type, fun, this
    >>> print(fun(v=Ind)(fun(w=Ind)(this.w)), Pi(v=Ind >> Type)(this.v("a")))
    \\x:Ind. \\y:Ind. y ((P : (Ind -> Type)) -> P(a))
    """
    inside = value.body if isinstance(value, Function) else value.result
    taken = {name for name in scope if isinstance(name, str)} | RESERVED
    taken.update(path.labels[0] for path in free_paths(inside) if path.up > 0)
    for part in subterms([inside]):
        match part:
            case RecordType():
                taken.update(part)
            case Pred(name) | Basic(name):
                taken.add(name)
    written = as_written(value, scope)
    names = [written] if isinstance(written, str) else usual_names(value.domain)
    for name in names:
        if name not in taken:
            return name
    return next(name for n in count(1) if (name := f"{names[0]}{n}") not in taken)


def usual_names(domain: TypeNode) -> str:
    """What variables of a domain are usually called, a letter each."""
    match domain:
        case Universe():
            return "TUVW"
        case FunType(_, result):
            return "PQR" if usual_names(result) in ("TUVW", "PQR") else "fgh"
        case RecordType():
            return "rstu"
        case Singleton(base, _):
            return usual_names(base)
        case Meet(parts) if any(isinstance(part, RecordType) for part in parts):
            return "rstu"
    return "xyz"


def format_head(function: Object, scope: Scope) -> str:
    """The notation of a function before its argument.

    A path has a dot and a name has quotes, so that neither is read as a predicate.

    >>> print(format_head(Path(0, ("f",)), (frozenset({"f"}),)))
    .f
    >>> print(format_head("f", ()), format_head(3, ()))
    "f" (3)
    """
    match function:
        case Path(up, labels) if labels[0] != BOUND:
            return _dotted_path(up, labels, scope)
        case str():
            return json_text(function)
    text = notation(function, scope)
    return text if holds_as_head(function) else f"({text})"


def _path(path: Path, scope: Scope) -> str:
    if path.labels[0] == BOUND:
        return _bound_path(path, scope)
    for up, names in enumerate(scope):
        if path.labels[0] == names or path.labels[0] in _labels(names):
            if up == path.up:
                return ".".join(path.labels)
            break
    return _dotted_path(path.up, path.labels, scope)


def _path_to_type(path: Path, scope: Scope) -> str:
    """A path where a type is needed: bare where it cannot be read as another type."""
    first = path.labels[0]
    if first == BOUND or (hides_type(scope, first) and first not in RESERVED):
        return _path(path, scope)
    return _dotted_path(path.up, path.labels, scope)


def _bound_path(path: Path, scope: Scope) -> str:
    """A variable, or a path from it; where it is bound outside, a dot says so."""
    around = scope[path.up] if path.up < len(scope) else ""
    name = around if isinstance(around, str) else ""
    return ".".join([name or BOUND, *path.labels[1:]])


def _dotted_path(up: int, labels: tuple[str, ...], scope: Scope) -> str:
    """The path with a caret for each record type that it leads out of."""
    binders = sum(isinstance(names, str) for names in scope[:up])
    return f"{'^' * (up - binders)}.{'.'.join(labels)}"


def _labels(names: frozenset[str] | str | Spelling) -> frozenset[str]:
    return names if isinstance(names, frozenset) else frozenset()


# --- other objects -------------------------------------------------------------------


def _object(value: Object, scope: Scope) -> str:
    kind = type(value)
    if kind is str:
        return _name(value, scope)
    if kind is tuple:
        return f"[{_objects(value, scope)}]"
    if kind is int or (kind is float and math.isfinite(value)):
        return repr(value)
    match value:
        case Record():
            spend(len(value))
            items = sorted(value._fields.items())
            inside = [f"{k} = {notation(as_object(v, scope), scope)}" for k, v in items]
            return f"{{{', '.join(inside)}}}"
        case Missing():
            return "nothing"
        case FiniteSet(items):
            return f"{'' if items else 'set'}{{{_objects(items, scope)}}}"
        case EventString(items):
            return _string([as_object(item, scope) for item in items], scope)
    return f"<{kind.__name__} {_size(value)}>"


def _string(events: list[Object], scope: Scope) -> str:
    """<a b>, with commas where an event could be read as an argument of the last."""
    between = ", " if any(map(begins_with_bracket, events)) else " "
    return f"<{between.join([_bracketed_beside(event, scope) for event in events])}>"


def _name(name: str, scope: Scope) -> str:
    """A name, quoted where it would be read as a label or as something else."""
    bare = name.isidentifier() and name not in RESERVED
    if bare and not _is_hidden(scope, name):
        return name
    return json_text(name)


def _size(value: object) -> object:
    """The length of an object without notation; if it has none, the object itself."""
    try:
        return len(value)  # type: ignore[arg-type]
    except TypeError:
        return value


def python(value: Object) -> str:
    """The value as Python that evaluates back, with the names of `ttr` and `ttr.types`.

    >>> from ttr import *
    >>> T = rectype(x=Ind, c=Pred("run", Ind)(this.x))
    >>> T
    rectype(x=Basic('Ind'), c=Pred('run', Basic('Ind'))(this.x))
    >>> eval(repr(T)) is T
    True
    """
    spend(2)
    match value:
        case Basic(name):
            return f"Basic({name!r})"
        case Universe(name, 0):
            return name
        case Universe(name, level):
            return f"Universe({name!r}, {level})"
        case Pred(name, arities):
            return f"Pred({', '.join([repr(name), *_arities(arities)])})"
        case TypeAt(term):
            return f"TypeAt({python(term)})"
        case PType(pred, args):
            return f"{python(pred)}({', '.join(map(python, args))})"
        case Singleton(base, obj):
            return f"Singleton({python(base)}, {python(obj)})"
        case Merge(parts):
            return f"merge_terms({', '.join(map(python, parts))})"
        case Meet(parts) | Join(parts):
            return f"{type(value).__name__.lower()}({', '.join(map(python, parts))})"
        case ListOf() | NonEmpty() | SetOf() | Plus() | Negation():
            ((part,), _) = contents(value)
            return f"{type(value).__name__}({python(part)})"
        case Str(items) | EventString(items) | FiniteSet(items):
            return f"{type(value).__name__}({', '.join(map(python, items))})"
        case FunType() | Function():
            return _python_binder(value)
        case Application(function, argument):
            return f"Application({python(function)}, {python(argument)})"
        case Operation(name, args):
            call = "concat" if name == "+" else name
            return f"{call}({', '.join(map(python, args))})"
        case Missing():
            return "Missing()"
        case RecordType(()):
            return "Rec"
        case RecordType(fields):
            return f"rectype({_keywords(fields)})"
        case Path(up, labels):
            return _python_path(up, labels)
        case Record():
            return f"record({_keywords(sorted(value._fields.items()))})"
        case tuple() if type(value) is tuple:
            inner = ", ".join(map(python, value))
            return f"({inner}{',' * (len(value) == 1)})"
    return repr(value)


def _python_binder(value: FunType | Function) -> str:
    match value:
        case Function(domain, body):
            call, inside = "fun", body
        case FunType(domain, result) if not binds(result):
            return f"({python(domain)} >> {python(shift_paths(result, -1))})"
        case FunType(domain, inside):
            call = "Pi"
    name = usual_names(domain)[0]
    named = replace_paths(inside, lambda path: _name_variable(path, name))
    return f"{call}({_keywords([(name, domain)])})({python(named)})"


def _name_variable(path: Path, variable: str) -> Path:
    """The path, with the name of the variable if it is the innermost one."""
    if path.up > 0 or path.labels[0] != BOUND:
        return path
    return Path(0, (variable, *path.labels[1:]))


def _arities(arities: tuple[tuple[TypeNode, ...], ...]) -> list[str]:
    if len(arities) == 1:
        return [python(T) for T in arities[0]]
    return [python(arity) for arity in arities]


def _keywords(items: Iterable[tuple[str, Object]]) -> str:
    pairs = list(items)
    if any(keyword.iskeyword(label) for label, _ in pairs):
        inner = ", ".join(f"{k!r}: {python(v)}" for k, v in pairs)
        return f"{{{inner}}}"
    return ", ".join(f"{k}={python(v)}" for k, v in pairs)


def _python_path(up: int, labels: tuple[str, ...]) -> str:
    start = {0: "this", 1: "outer"}.get(up, f"outer({up})")
    if any(keyword.iskeyword(label) for label in labels):
        return f"{start}[{'.'.join(labels)!r}]"
    return ".".join([start, *labels])


# --- what is too large to be printed ---


def _refuse_if_too_large(value: object) -> None:
    """Refuse at once what would not be printed within the budget."""
    purse = open_purse()
    if purse is not None and isinstance(value, TypeNode | Function):
        least = _least_steps(value)
        if least > purse.left:
            spend(least)


@as_notation.provided_by
def _print_notation(value: object) -> str:
    _refuse_if_too_large(value)
    return notation(value)


@as_python.provided_by
def _print_python(value: object) -> str:
    _refuse_if_too_large(value)
    return python(value)


@cache_on_node
def _least_steps(value: TypeNode | Function) -> int:
    """No more than the steps that printing a value takes: one for each field in it.

    A type that stands in several places is printed in each of them, and counted once.
    """
    if isinstance(value, RecordType):
        inside = [T for _, T in value.fields if not _is_simple(T)]
        return len(value.fields) + sum(map(_least_steps, inside))
    each = (part for inner in contents(value) for part in inner)
    return sum(_least_steps(it) for it in each if isinstance(it, TypeNode | Function))


def _is_simple(T: TypeNode) -> bool:
    """Is a type a name, or a ptype of names and paths? Then it has no fields."""
    if isinstance(T, PType):
        return _NAMES.issuperset(map(type, T.args))
    return isinstance(T, Basic | Universe)


_NAMES = frozenset((str, Path))
