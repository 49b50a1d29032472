"""Arbitrary types and objects, drawn with Hypothesis from few names.

They are drawn from outside in: whoever draws in a scope knows the paths that lead out
of it, and the types of what they lead to, so that everything drawn is well-formed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from hypothesis import strategies as st

from ttr.building.constructors import rectype
from ttr.building.well_formedness import check_binder
from ttr.errors import TTRError
from ttr.theories.theory import Theory
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Object,
    Path,
    Record,
    concat,
    fst,
    rst,
)
from ttr.types.paths import free_paths
from ttr.types.printing import is_of_types
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Join,
    ListOf,
    Meet,
    Negation,
    NonEmpty,
    Plus,
    Pred,
    PType,
    Rec,
    RecordType,
    RecType,
    SetOf,
    Singleton,
    Str,
    Type,
    TypeAt,
    TypeNode,
    Universe,
    join,
    kind_of,
    meet,
)

# --- the names to draw from ----------------------------------------------------------

LABELS = ("x", "y", "z", "c", "n", "f")
NAMES = ("a", "b", "s", "t", "x")
"""Objects; x is also a label."""


@dataclass(frozen=True)
class Words:
    """The vocabulary: basic types, predicates, names of objects, and defined types."""

    basics: tuple[Basic, ...]
    predicates: tuple[Pred, ...]
    names: tuple[str, ...]
    defined: tuple[TypeNode, ...] = ()

    @classmethod
    def of(cls, theory: Theory | None) -> Words:
        """The vocabulary of a theory; a small one of our own if there is none.

        >>> Words.of(None).basics
        (Basic('A'), Basic('B'), Basic('C'))
        """
        if theory is None:
            return _FEW
        if not isinstance(theory, Theory):
            raise TTRError(f"types are drawn from a theory, found {kind_of(theory)}")
        defined = theory.definitions.values()
        return cls(
            tuple(theory.basics.values()),
            tuple(theory.predicates.values()),
            tuple(sorted(theory.objects)) or NAMES,
            tuple([T for T in defined if isinstance(T, TypeNode)]),
        )


_A, _B, _C = Basic("A"), Basic("B"), Basic("C")

_FEW = Words(
    (_A, _B, _C),
    (
        Pred("p", (_A,), (_B,)),
        Pred("q", (_A, _A), (_A, _B), (_B, _A), (_B, _B)),
        Pred("r", (), (_C,)),
    ),
    NAMES,
)


# --- what paths can lead to ----------------------------------------------------------

Scopes: TypeAlias = tuple[Mapping[tuple[str, ...], TypeNode], ...]
"""For each enclosing scope, innermost first: its paths and the types they lead to."""


def _visible(scopes: Scopes) -> list[tuple[Path, TypeNode]]:
    return [
        (Path(up, labels), T)
        for up, scope in enumerate(scopes)
        for labels, T in scope.items()
    ]


def _inside(label: str, T: TypeNode) -> dict[tuple[str, ...], TypeNode]:
    """The paths that start at a label or a variable, and the types they lead to."""
    found: dict[tuple[str, ...], TypeNode] = {}
    if not free_paths(T):
        found[label,] = T
    if isinstance(T, RecordType):
        for inner, field in T.fields:
            deeper = _inside(inner, field)
            found |= {(label, *labels): U for labels, U in deeper.items()}
    return found


def _fitting_paths(scopes: Scopes, wanted: TypeNode) -> list[Object]:
    """Paths to what has the form of a type, and the first elements of lists of it."""
    found: list[Object] = []
    for path, T in _visible(scopes):
        if _fits(T, wanted):
            found.append(path)
        elif isinstance(T, ListOf | NonEmpty) and _fits(T.item, wanted):
            found.append(fst(path))
    return found


def _fits(T: TypeNode, wanted: TypeNode) -> bool:
    match T:
        case Singleton(base, _):
            return _fits(base, wanted)
        case Meet(parts):
            return wanted in parts
    return T is wanted


# --- types ---------------------------------------------------------------------------

_Kind: TypeAlias = Callable[[Words, Scopes, int], st.SearchStrategy[Any]]


@st.composite
def types(draw: st.DrawFn, words: Words, scopes: Scopes, depth: int) -> TypeNode:
    """Types of every constructor, nested at most `depth` deep."""
    kind = draw(_ANY_KIND if depth > 0 else _LEAF_KIND)
    found: TypeNode = draw(kind(words, scopes, depth - 1))
    return found


def _atoms(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[TypeNode]:
    return st.sampled_from([*words.basics, *words.defined] or [Rec])


@st.composite
def ptypes(draw: st.DrawFn, words: Words, scopes: Scopes, depth: int) -> TypeNode:
    """Ptypes of names and paths; basic types if there are no predicates."""
    if not words.predicates:
        return draw(_atoms(words, scopes, depth))
    pred = draw(st.sampled_from(words.predicates))
    arity = draw(st.sampled_from(pred.arities))
    return PType(pred, tuple([draw(_arguments(words, scopes, T)) for T in arity]))


def _arguments(words: Words, scopes: Scopes, T: TypeNode) -> st.SearchStrategy[Object]:
    """Names, but mostly paths if there are any."""
    found = _fitting_paths(scopes, T)
    mostly = 3 * len(words.names) // max(1, len(found)) + 1
    return st.sampled_from([*words.names, *found * mostly])


def _universes(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[TypeNode]:
    return _UNIVERSES


_UNIVERSES = st.sampled_from(
    [Type, RecType, Universe("Type", 1), Universe("RecType", 1)]
)


def _types_at(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[TypeNode]:
    """The types that paths lead to; basic types if no path leads to one."""
    found = [TypeAt(path) for path, T in _visible(scopes) if is_of_types(T)]
    return st.sampled_from(found) if found else _atoms(words, scopes, depth)


@st.composite
def _singletons(draw: st.DrawFn, words: Words, scopes: Scopes, depth: int) -> TypeNode:
    base = draw(_COLLECTIONS)(draw(types(words, scopes, depth)))
    return Singleton(base, draw(_values(words, scopes, depth, base)))


def _of_several(make: Callable[..., TypeNode], least: int, most: int) -> _Kind:
    """Types made of other types, such as meets, joins and strings."""

    def kind(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[TypeNode]:
        parts = st.lists(types(words, scopes, depth), min_size=least, max_size=most)
        return parts.map(lambda found: make(*found))

    return kind


@st.composite
def _function_types(
    draw: st.DrawFn, words: Words, scopes: Scopes, depth: int
) -> TypeNode:
    domain = draw(_domains(words, scopes, depth))
    kind = draw(_RESULT_KIND)
    result = draw(kind(words, (_inside(BOUND, domain), *scopes), depth))
    return check_binder(FunType(domain, result))


@st.composite
def _domains(draw: st.DrawFn, words: Words, scopes: Scopes, depth: int) -> TypeNode:
    """Mostly basic types and record types: paths from such a variable are of use."""
    kind = draw(_DOMAIN_KIND) if depth > 0 else _atoms
    found: TypeNode = draw(kind(words, scopes, depth - 1))
    return found


@st.composite
def _applications(
    draw: st.DrawFn, words: Words, scopes: Scopes, depth: int
) -> TypeNode:
    """Applications of functions that give types; of paths to some, if there are any."""
    heads: list[tuple[Object, TypeNode]] = [
        (path, T.domain) for path, T in _visible(scopes) if isinstance(T, FunType)
    ]
    if not heads:
        function = draw(_functions(words, scopes, depth, types))
        heads.append((function, function.domain))
    head, domain = draw(st.sampled_from(heads))
    return Application(head, draw(_of_form(words, scopes, depth, domain)))


@st.composite
def record_types(
    draw: st.DrawFn, words: Words, scopes: Scopes, depth: int
) -> RecordType:
    """Record types: simple fields, perhaps manifest, and fields that depend on them."""
    labels = draw(_SOME_LABELS)
    plain = labels[: draw(st.integers(0, len(labels)))]
    bases = {label: draw(_plain(words)) for label in plain}
    seen: dict[tuple[str, ...], TypeNode] = {}
    for label, base in bases.items():
        seen |= _inside(label, base)
    fields: dict[str, TypeNode] = {
        label: draw(_set_or_not(words, (seen, *scopes), base))
        for label, base in bases.items()
    }
    for label in labels[len(plain) :]:
        kind = draw(_FIELD_KIND)
        fields[label] = draw(kind(words, (dict(seen), *scopes), depth))
        seen |= _inside(label, fields[label])
    return rectype(fields)


@st.composite
def _plain(draw: st.DrawFn, words: Words) -> TypeNode:
    kind = draw(_PLAIN_KIND)
    return draw(_LISTS)(draw(kind(words, (), 0)))


@st.composite
def _set_or_not(
    draw: st.DrawFn, words: Words, scopes: Scopes, base: TypeNode
) -> TypeNode:
    """A field that may be manifest: an object or another field, even in a circle."""
    match draw(_SETTING):
        case "value":
            return Singleton(base, draw(forms(words, scopes, 0, base)))
        case "path":
            paths = [path for path, _ in _visible(scopes)]
            return Singleton(base, draw(st.sampled_from(paths)))
    return base


def _itself(T: TypeNode) -> TypeNode:
    return T


_LABEL = st.sampled_from(LABELS)
_SOME_LABELS = st.lists(_LABEL, unique=True, max_size=5)
_SETTING = st.sampled_from(["plain", "plain", "value", "path"])
_LISTS = st.sampled_from([_itself, _itself, _itself, _itself, ListOf, NonEmpty])
_COLLECTIONS = st.sampled_from([_itself, _itself, _itself, ListOf, SetOf, Plus, Str])

_LEAVES: tuple[_Kind, ...] = (_atoms, ptypes, ptypes, _universes, _types_at)

_LEAF_KIND = st.sampled_from(_LEAVES)
_RESULT_KIND = st.sampled_from([types, ptypes, ptypes, lambda *around: st.just(Type)])
_PLAIN_KIND = st.sampled_from([*[_atoms] * 5, _universes])
_DOMAIN_KIND = st.sampled_from([_atoms, _atoms, types, record_types, _universes])
_FIELD_KIND = st.sampled_from([types, types, ptypes, ptypes, _types_at])
_ANY_KIND = st.sampled_from(
    [
        _atoms,
        ptypes,
        *[record_types] * 4,
        _universes,
        _types_at,
        _singletons,
        _of_several(meet, 1, 3),
        _of_several(join, 1, 3),
        _of_several(Negation, 1, 1),
        _of_several(ListOf, 1, 1),
        _of_several(NonEmpty, 1, 1),
        _of_several(SetOf, 1, 1),
        _of_several(Plus, 1, 1),
        _of_several(Str, 0, 3),
        *[_function_types] * 2,
        _applications,
    ]
)


# --- objects -------------------------------------------------------------------------


@st.composite
def objects(draw: st.DrawFn, words: Words, scopes: Scopes, depth: int) -> Object:
    """Objects of every kind that has a notation, nested at most `depth` deep."""
    kind = draw(_ANY_OBJECT if depth > 0 else _SIMPLE_OBJECT)
    return draw(kind(words, scopes, depth - 1))


def _names(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[Object]:
    paths = [path for path, _ in _visible(scopes)]
    return st.sampled_from([*words.names, *paths])


def _numbers(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[Object]:
    return _NUMBERS


_NUMBERS = st.one_of(
    st.integers(-2, 2), st.floats(allow_nan=False, allow_infinity=False, width=16)
)


def _records(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[Object]:
    inner = objects(words, scopes, depth)
    return st.dictionaries(_LABEL, inner, max_size=2).map(Record)


def _collections(words: Words, scopes: Scopes, depth: int) -> st.SearchStrategy[Object]:
    items = st.lists(objects(words, scopes, depth), max_size=2)
    make = st.sampled_from([tuple, _set_of, _string_of])
    return st.tuples(make, items).map(lambda drawn: drawn[0](drawn[1]))


def _any_functions(
    words: Words, scopes: Scopes, depth: int
) -> st.SearchStrategy[Object]:
    return _functions(words, scopes, depth, objects)


def _set_of(items: list[Object]) -> FiniteSet:
    return FiniteSet(*items)


def _string_of(items: list[Object]) -> EventString:
    return EventString(*items)


@st.composite
def _functions(
    draw: st.DrawFn, words: Words, scopes: Scopes, depth: int, bodies: _Kind
) -> Function:
    domain = draw(_domains(words, scopes, depth))
    within = (_inside(BOUND, domain), *scopes)
    body = draw(bodies(words, within, depth))
    return check_binder(Function(domain, body))


@st.composite
def _values(
    draw: st.DrawFn, words: Words, scopes: Scopes, depth: int, T: TypeNode
) -> Object:
    """Objects of the form that a type asks for, and sometimes others."""
    if draw(_NOW_AND_THEN):
        return draw(objects(words, scopes, depth - 1))
    return draw(_of_form(words, scopes, depth, T))


_NOW_AND_THEN = st.sampled_from([False, False, False, True])


def _of_form(
    words: Words, scopes: Scopes, depth: int, T: TypeNode
) -> st.SearchStrategy[Object]:
    """Objects of the form that a type asks for; half of them paths if there are any."""
    written = forms(words, scopes, depth, T)
    found = _fitting_paths(scopes, T)
    return st.one_of(written, st.sampled_from(found)) if found else written


def forms(
    words: Words, scopes: Scopes, depth: int, T: TypeNode
) -> st.SearchStrategy[Object]:
    """Objects of the form that a type asks for, though not always of the type."""
    match T:
        case Singleton(_, value):
            return st.just(value)
        case Meet(parts) | Join(parts):
            return st.one_of([forms(words, scopes, depth, part) for part in parts])
        case ListOf(item) | NonEmpty(item):
            return _lists(words, scopes, depth, item)
        case SetOf(item):
            return st.lists(_values(words, scopes, 0, item), max_size=2).map(_set_of)
        case Plus(item):
            return st.lists(_values(words, scopes, 0, item), max_size=3).map(_string_of)
        case Str(items):
            events = [_values(words, scopes, 0, item) for item in items]
            return st.tuples(*events).map(list).map(_string_of)
        case RecordType():
            return _record_forms(words, scopes, depth, T)
        case FunType():
            return _functions(words, scopes, depth - 1, objects)
        case Universe():
            return types(words, scopes, depth - 1)
    return st.sampled_from([*words.names, *_NUMBERED])


_NUMBERED = (0, 1, 0.5)
"""Objects that are not names."""


def _record_forms(
    words: Words, scopes: Scopes, depth: int, T: RecordType
) -> st.SearchStrategy[Object]:
    """Records with the labels of a type; their paths do not lead into the record."""
    closed = {k: field for k, field in T.fields if not free_paths(field)}
    parts = {k: forms(words, scopes, depth, field) for k, field in closed.items()}
    others = dict.fromkeys(T.labels, st.sampled_from(words.names))
    return st.fixed_dictionaries({**others, **parts}).map(Record)


@st.composite
def _lists(
    draw: st.DrawFn, words: Words, scopes: Scopes, depth: int, item: TypeNode
) -> Object:
    """Lists, and operations on the lists that paths lead to."""
    written = tuple(draw(st.lists(_values(words, scopes, 0, item), max_size=2)))
    paths = [p for p, T in _visible(scopes) if isinstance(T, ListOf | NonEmpty)]
    if not paths:
        return written
    path = draw(st.sampled_from(paths))
    return draw(st.sampled_from([rst(path), concat(written, path), written]))


_SIMPLE_OBJECT = st.sampled_from([_names, _numbers])
_ANY_OBJECT = st.sampled_from(
    [_names, _numbers, _records, _collections, _collections, _any_functions, types]
)
