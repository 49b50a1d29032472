"""The parts of types and objects, and the paths in them that lead out.

A record type and a binder are scopes: what stands in them stands one scope further in,
and a path says how many scopes out it starts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import chain

from ttr.hooks import hook
from ttr.safety.budgets import spend
from ttr.types.interning import cache_on_node
from ttr.types.objects import (
    EventString,
    FiniteSet,
    Object,
    Operation,
    Path,
    Record,
    UnresolvedError,
    concat,
)
from ttr.types.reserved_words import LIST_OPERATIONS
from ttr.types.syntax import (
    Application,
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
    join,
    meet,
    type_at,
)

Parts = tuple[Object, ...]


@hook
def merge_by_form(*parts: Object) -> TypeNode:
    """The merge of types by their form: `ttr.types.merges.merge_terms`."""
    raise NotImplementedError


def parts(value: Object) -> tuple[Parts, Parts]:
    """The parts that stand in the same scope as the value, and those one further in.

    >>> from ttr import Ind
    >>> parts(Function(Ind, "a"))
    ((Basic('Ind'),), ('a',))
    """
    match value:
        case PType(_, inner) | Meet(inner) | Join(inner) | Str(inner):
            spend(len(inner))
            return inner, ()
        case RecordType(fields):
            spend(len(fields))
            return (), tuple([T for _, T in fields])
        case Singleton(base, obj):
            return (base, obj), ()
        case ListOf(item) | NonEmpty(item) | SetOf(item) | Plus(item) | Negation(item):
            spend()
            return (item,), ()
        case FunType(domain, inside) | Function(domain, inside):
            spend()
            return (domain,), (inside,)
        case Application(function, argument):
            spend()
            return (function, argument), ()
        case TypeAt(term):
            spend()
            return (term,), ()
        case EventString(inner) | FiniteSet(inner) | Operation(_, inner):
            spend(len(inner))
            return inner, ()
        case Record():
            spend(len(value))
            return tuple(value._fields.values()), ()
        case tuple():
            spend(len(value))
            return value, ()
    return (), ()


def map_parts(value: Object, change: Callable[[Object, int], Object]) -> Object:
    """The value rebuilt with change(part, deeper) in place of each of its parts.

    `deeper` is 1 for a part that stands one scope further in, else 0. The fields of a
    record type keep their order: no change may add a dependency.
    """
    match value:
        case PType(pred, args):
            return PType(pred, tuple([change(arg, 0) for arg in args]))
        case RecordType(fields):
            return RecordType(tuple([(k, change(T, 1)) for k, T in fields]))
        case Singleton(base, obj):
            return Singleton(change(base, 0), change(obj, 0))
        case Merge(inner):
            return merge_by_form(*[change(part, 0) for part in inner])
        case Meet(inner):
            return meet(*[change(part, 0) for part in inner])
        case Join(inner):
            return join(*[change(part, 0) for part in inner])
        case ListOf() | NonEmpty() | SetOf() | Plus():
            return type(value)(change(value.item, 0))
        case Negation(body):
            return Negation(change(body, 0))
        case Str(inner) | EventString(inner) | FiniteSet(inner):
            return type(value)(*[change(part, 0) for part in inner])
        case FunType(domain, inside) | Function(domain, inside):
            return type(value)(change(domain, 0), change(inside, 1))
        case Application(function, argument):
            return Application(change(function, 0), change(argument, 0))
        case TypeAt(term):
            return type_at(change(term, 0))
        case Operation(name, args):
            return _apply_operation(name, tuple([change(arg, 0) for arg in args]))
        case Record():
            return Record({k: change(v, 0) for k, v in value._fields.items()})
        case tuple():
            return tuple([change(part, 0) for part in value])
    return value


_OPERATIONS: dict[str, Callable[..., Object]] = {"+": concat, **LIST_OPERATIONS}


def _apply_operation(name: str, args: Parts) -> Object:
    """The result of an operation; if there is none, the operation itself."""
    try:
        return _OPERATIONS[name](*args)
    except UnresolvedError:
        return Operation(name, args)


def subterms(values: Iterable[Object]) -> Iterator[Object]:
    """The values and everything in them, each node once; without recursion."""
    waiting, seen = list(values), set()
    while waiting:
        value = waiting.pop()
        if isinstance(value, TypeNode | Pred | Function):
            if value in seen:
                continue
            seen.add(value)
        yield value
        same, inner = parts(value)
        waiting += same
        waiting += inner
        if isinstance(value, PType):
            waiting.append(value.pred)
        if isinstance(value, Pred):
            waiting += (T for arity in value.arities for T in arity)


_KEEPING = (TypeNode, Function)
"""What keeps the kinds and the paths that are in it; it may be large, and shared."""


def mentions(value: Object, kind: type[TypeNode]) -> bool:
    """Does a type of this kind stand in the value, or is it one?

    >>> from ttr import Ind
    >>> mentions(ListOf(~Ind), Negation), mentions(ListOf(Ind), Negation)
    (True, False)
    """
    return kind in _kinds(value)


def mentions_any(value: Object, kinds: frozenset[type]) -> bool:
    """Does a type of one of these kinds stand in the value, or is it one?

    >>> from ttr import Ind
    >>> mentions_any(ListOf(~Ind), frozenset((Negation, Meet)))
    True
    """
    return not kinds.isdisjoint(_kinds(value))


def _kinds(value: Object) -> frozenset[type]:
    """The kinds of the types in a value, its own included."""
    if type(value) is str:
        return _NO_KINDS
    return _kinds_in(value) if isinstance(value, _KEEPING) else _kinds_of(value)


def _kinds_of(value: Object) -> frozenset[type]:
    same, inner = parts(value)
    return frozenset((type(value),)).union(*map(_kinds, same), *map(_kinds, inner))


_kinds_in: Callable[[TypeNode | Function], frozenset[type]] = cache_on_node(_kinds_of)

_NO_KINDS: frozenset[type] = frozenset()


# --- paths that lead out -------------------------------------------------------------


def free_paths(value: Object) -> frozenset[Path]:
    """The paths in a type or object that start outside it.

    Paths are as seen from where the value stands: `up` 0 is the scope around it.

    >>> from ttr import Ind, this
    >>> dog = Pred("dog", Ind)
    >>> free_paths(dog(this.x))
    frozenset({this.x})
    >>> free_paths(RecordType((("x", Ind), ("c", dog(this.x)))))
    frozenset()
    """
    if type(value) is str:
        return _NO_PATHS
    if isinstance(value, _KEEPING):
        return _free_paths_of_type(value)
    return frozenset((value,)) if isinstance(value, Path) else _find_free_paths(value)


def _find_free_paths(value: Object) -> frozenset[Path]:
    same, inner = parts(value)
    found = frozenset[Path]().union(*map(free_paths, same)) if same else _NO_PATHS
    if inner:
        further = _NO_PATHS.union(*map(free_paths, inner))
        found |= {Path(path.up - 1, path.labels) for path in further if path.up > 0}
    return found


_free_paths_of_type: Callable[[TypeNode | Function], frozenset[Path]] = cache_on_node(
    _find_free_paths
)

_NO_PATHS: frozenset[Path] = frozenset()


def paths_to_types(value: Object) -> frozenset[Path]:
    """The paths that start outside of a value and stand in it for types.

    >>> from ttr import ListOf, Type, this
    >>> paths_to_types(RecordType((("T", Type), ("x", ListOf(this.T)))))
    frozenset()
    >>> paths_to_types(ListOf(this.T))
    frozenset({this.T})
    """
    if not mentions(value, TypeAt):
        return _NO_PATHS
    if isinstance(value, TypeAt):
        return free_paths(value)
    same, inner = parts(value)
    found = _NO_PATHS.union(*map(paths_to_types, same))
    further = _NO_PATHS.union(*map(paths_to_types, inner))
    return found | {Path(p.up - 1, p.labels) for p in further if p.up > 0}


def paths_with_arguments(value: Object) -> frozenset[tuple[Path, int]]:
    """The paths that start outside of a value, each with how many arguments it gets.

    >>> from ttr import Ind, this
    >>> of_two = Application(Application(this.f, "a"), this.x)
    >>> sorted((str(path), number) for path, number in paths_with_arguments(of_two))
    [('.f', 2), ('.x', 0)]
    """
    if not free_paths(value):
        return frozenset()
    head, arguments = value, list[Object]()
    while isinstance(head, Application):
        arguments.append(head.argument)
        head = head.function
    if isinstance(head, TypeAt):
        head = head.term
    if isinstance(head, Path):
        here = frozenset([(head, len(arguments))])
        return here.union(*map(paths_with_arguments, arguments))
    same, inner = parts(value)
    found = frozenset[tuple[Path, int]]().union(*map(paths_with_arguments, same))
    further = chain.from_iterable(map(paths_with_arguments, inner))
    return found | {(Path(p.up - 1, p.labels), n) for p, n in further if p.up > 0}


def labels_mentioned(field: Object) -> set[str]:
    """The labels of the record in which a field stands that the field mentions.

    >>> from ttr import Ind, this
    >>> labels_mentioned(Pred("dog", Ind)(this.x))
    {'x'}
    """
    return {path.labels[0] for path in free_paths(field) if path.up == 0}


def replace_paths(
    value: Object, at: Callable[[Path], Object], depth: int = 0
) -> Object:
    """The value with every path that escapes it replaced by at(path).

    `at` sees a path as from where the value stands and gives what stands for it there;
    further in, the replacement is moved along, so that nothing captures it. A type that
    stands in several places is rebuilt once.
    """
    return _replace(value, at, depth, {})


def _replace(
    value: Object,
    at: Callable[[Path], Object],
    depth: int,
    made: dict[tuple[TypeNode | Function, int], Object],
) -> Object:
    if isinstance(value, Path):
        if depth == 0:
            return at(value)
        if value.up < depth:
            return value
        return shift_paths(at(Path(value.up - depth, value.labels)), depth)
    if isinstance(value, str):
        return value

    def change(part: Object, deeper: int) -> Object:
        return _replace(part, at, depth + deeper, made)

    if not isinstance(value, _KEEPING):
        return map_parts(value, change)
    if not _reaches_out(value, depth):
        return value
    found = made.get((value, depth))
    if found is None:
        found = made[value, depth] = map_parts(value, change)
    return found


def _reaches_out(T: TypeNode | Function, depth: int) -> bool:
    """Does a path in T lead at least so many scopes out?"""
    found = free_paths(T)
    return bool(found) and (depth == 0 or any(path.up >= depth for path in found))


def shift_paths(value: Object, depth: int) -> Object:
    """The value as it must be written `depth` scopes further in; out, below 0."""
    if depth == 0:
        return value
    return replace_paths(value, lambda path: Path(path.up + depth, path.labels))
