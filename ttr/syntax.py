"""What may be written: types, predicates and record types, as immutable values.

Nodes are interned: two nodes of the same structure are the same Python object, so that
`is` is structural identity, a hash is an address and a type can be a key. The classes
with capital letters only hold data, to be matched on; types are built with `rectype`,
`meet`, `Pred.__call__` and the operators, which normalise and refuse the ill-formed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

from ttr.errors import IllFormed
from ttr.interning import Node, identity, node
from ttr.objects import (
    Object,
    Path,
    Record,
    check_label,
    freeze,
    labelled,
    outer,
    record,
    this,
)

if TYPE_CHECKING:
    from ttr.theories import Signature

__all__ = [
    "Basic",
    "Ind",
    "ListOf",
    "Meet",
    "Object",
    "PType",
    "Path",
    "Pred",
    "Rec",
    "RecType",
    "Record",
    "RecordType",
    "Singleton",
    "Type",
    "TypeNode",
    "Universe",
    "as_type",
    "escaping",
    "freeze",
    "identity",
    "meet",
    "outer",
    "record",
    "rectype",
    "this",
]


class TypeNode(Node):
    """A type. `S <= T` asks for subtyping; `S & T` is the meet, `T @ a` a singleton."""

    __slots__ = ("_escaping",)

    _escaping: frozenset[Path]

    def __le__(self, other: object) -> bool:
        from ttr.subtyping import subtype

        return subtype(self, as_type(other)).yes

    def __ge__(self, other: object) -> bool:
        return as_type(other) <= self

    def __and__(self, other: object) -> TypeNode:
        return meet(self, as_type(other))

    def __matmul__(self, value: object) -> TypeNode:
        return Singleton(self, freeze(value))


def as_type(value: object) -> TypeNode:
    """The value, if it is a type; else `IllFormed` says what it is."""
    if isinstance(value, TypeNode):
        return value
    raise IllFormed(f"expected a type, found {_kind(value)}")


def _kind(value: object) -> str:
    """What a value is, in a word or two, for an error."""
    match value:
        case Pred():
            example = ", ".join(map(str, value.arities[0]))
            return (
                f"the predicate {value.name}: apply it, as in {value.name}({example})"
            )
        case Record():
            return f"the record {value}"
        case str():
            return f"the object {value!r}"
    return f"{type(value).__name__} {value!r}"


@node
class Basic(TypeNode):
    """A basic type: a name, and whatever a model judges to be of it."""

    name: str

    @staticmethod
    def _normal(name: str) -> tuple[str]:
        if not isinstance(name, str) or not name:
            raise IllFormed(f"a basic type is named by a string, found {_kind(name)}")
        return (str(name),)


@node
class Universe(TypeNode):
    """Typeⁿ, RecTypeⁿ: the types of level n at most, and the record types among them.

    A type is of level 0 if it mentions no type of types, and of level n + 1 if the
    highest that it mentions is of level n. So Type itself is of Type^1, not of Type.
    """

    name: str
    level: int = 0

    @staticmethod
    def _normal(name: str, level: int = 0) -> tuple[str, int]:
        if not isinstance(name, str) or name not in ("Type", "RecType"):
            raise IllFormed(f"a type of types is Type or RecType, found {_kind(name)}")
        if type(level) is not int or level < 0:
            raise IllFormed(f"a level of types is 0 or more, found {level!r}")
        return name, level


@node
class PType(TypeNode):
    """p(a₁, …, aₙ): the type of the situations that make a predication true."""

    pred: Pred
    args: tuple[Object, ...]

    @staticmethod
    def _normal(pred: Pred, args: object) -> tuple[object, ...]:
        if not isinstance(pred, Pred):
            raise IllFormed(f"a ptype is of a predicate, found {_kind(pred)}")
        if not isinstance(args, tuple | list):
            raise IllFormed(f"the arguments of {pred} are a tuple, found {_kind(args)}")
        frozen = tuple(map(freeze, args))
        if not any(len(arity) == len(frozen) for arity in pred.arities):
            raise IllFormed(_wrong_arity(pred, len(frozen)))
        return pred, frozen


def _wrong_arity(pred: Pred, found: int) -> str:
    wanted = " or ".join(
        f"{len(arity)} argument{'s' * (len(arity) != 1)} ({', '.join(map(str, arity))})"
        for arity in pred.arities
    )
    return f"{pred.name} takes {wanted}, but has {found}"


@node
class Singleton(TypeNode):
    """T@a, T restricted to a: b is of it iff b is of T and b is a."""

    base: TypeNode
    value: Object

    @staticmethod
    def _normal(base: TypeNode, value: object) -> tuple[object, ...]:
        return as_type(base), freeze(value)


@node
class Meet(TypeNode):
    """S ∧ T: a is of it iff a is of every part. Built by `meet`."""

    parts: tuple[TypeNode, ...]

    @staticmethod
    def _key(parts: tuple[TypeNode, ...]) -> tuple[object, ...]:
        return (frozenset(parts),)


@node
class ListOf(TypeNode):
    """list(T): the type of the finite lists of objects of T."""

    item: TypeNode

    @staticmethod
    def _normal(item: TypeNode) -> tuple[object, ...]:
        return (as_type(item),)


@node
class RecordType(TypeNode):
    """[ℓ₁ : T₁, …]: r is of it iff each r.ℓᵢ is of Tᵢ. Built by `rectype`.

    Paths in a field's type start in the record where the field stands.
    """

    fields: tuple[tuple[str, TypeNode], ...]
    _types: Mapping[str, TypeNode] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_types", dict(self.fields))

    def __getitem__(self, label: str) -> TypeNode:
        """The type of the field with this label; raises `KeyError` if there is none.

        >>> rectype(x=Ind)["x"]
        Basic('Ind')
        """
        return self._types[label]

    def get(self, label: str) -> TypeNode | None:
        """The type of the field with this label, or None if there is none."""
        return self._types.get(label)

    def __contains__(self, label: object) -> bool:
        return label in self._types

    def __iter__(self) -> Iterator[str]:
        return iter(self._types)

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels, dependencies first."""
        return tuple(self._types)


@node
class Pred(Node):
    """A predicate: a name and one or more arities, each a tuple of types.

    >>> Pred("hug", Ind, Ind)("a", "b")
    Pred('hug', Basic('Ind'), Basic('Ind'))('a', 'b')
    >>> Pred("open", (Ind,), (Ind, Ind)).arities[1]
    (Basic('Ind'), Basic('Ind'))
    """

    name: str
    arities: tuple[tuple[TypeNode, ...], ...]

    if TYPE_CHECKING:

        def __init__(self, name: str, *arities: object) -> None: ...

    @staticmethod
    def _normal(name: str, *arities: object) -> tuple[object, ...]:
        if not isinstance(name, str) or not name.isidentifier():
            raise IllFormed(f"a predicate is named by an identifier, found {name!r}")
        several = [arity for arity in arities if isinstance(arity, tuple)]
        if not several or len(several) < len(arities):
            several = [arities]
        found = {tuple(map(as_type, arity)): None for arity in several}
        return str(name), tuple(sorted(found, key=_shortest_first))

    @staticmethod
    def _key(
        name: str, arities: tuple[tuple[TypeNode, ...], ...]
    ) -> tuple[object, ...]:
        return name, frozenset(arities)

    def __call__(self, *args: object) -> PType:
        """The ptype of situations in which the predicate holds of these objects."""
        return PType(self, args)

    def __reduce__(self) -> tuple[object, ...]:
        return Pred, (self.name, *self.arities)


def _shortest_first(arity: tuple[TypeNode, ...]) -> tuple[int, str, str]:
    return len(arity), *_in_print(arity)


def _in_print(value: object) -> tuple[str, str]:
    """A key for putting nodes in an order that does not depend on addresses."""
    return str(value), repr(value)


# --- constructors --------------------------------------------------------------------


def rectype(
    fields: Mapping[str, TypeNode] | None = None,
    theory: Signature | None = None,
    /,
    **labels: TypeNode,
) -> RecordType:
    """The record type with these fields, as keywords or as one mapping.

    Fields are put in the order (depth of dependency, label), so that the order of
    writing never matters; fields on a cycle come last. Raises `IllFormed` for a path
    that leads nowhere in this record type, or to an object of a wrong type; what fits
    by an axiom fits where the theory is given.

    >>> dog = Pred("dog", Ind)
    >>> print(rectype(c=dog(this.x), x=Ind))
    [x : Ind, c : dog(x)]
    >>> rectype(c=dog(this.y), x=Ind)
    Traceback (most recent call last):
    ttr.errors.IllFormed: the path y leads nowhere: [c : dog(.y), x : Ind] has no y
    """
    from ttr.formation import checked

    given = labelled("rectype", fields, labels)
    for label, T in given.items():
        check_label(label)
        if not isinstance(T, TypeNode):
            raise IllFormed(f"the field {label} needs a type, found {_kind(T)}")
    return checked(RecordType(ordered(given)), theory)


def ordered(fields: Mapping[str, TypeNode]) -> tuple[tuple[str, TypeNode], ...]:
    """The fields by (depth of dependency, label); those on or behind a cycle last."""
    waits: dict[str, int] = {}
    needed_by: dict[str, list[str]] = {}
    for label, T in fields.items():
        needs = {path.labels[0] for path in escaping(T) if path.up == 0}
        needs &= fields.keys()
        waits[label] = len(needs)
        for need in needs:
            needed_by.setdefault(need, []).append(label)
    ready = [(0, label) for label, count in waits.items() if count == 0]
    heapify(ready)
    order: list[str] = []
    while ready:
        depth, label = heappop(ready)
        order.append(label)
        for waiting in needed_by.get(label, ()):
            waits[waiting] -= 1
            if waits[waiting] == 0:
                heappush(ready, (depth + 1, waiting))
    order += sorted(fields.keys() - order)
    return tuple((label, fields[label]) for label in order)


def meet(*parts: TypeNode) -> TypeNode:
    """The meet S ∧ T: flat, each part once, in one order whatever the order of writing.

    >>> A, B = Basic("A"), Basic("B")
    >>> meet(B, A) is meet(A, meet(A, B)), meet(A, A) is A
    (True, True)
    """
    flat = {
        piece: None
        for part in parts
        for piece in (part.parts if isinstance(part, Meet) else (as_type(part),))
    }
    if len(flat) == 1:
        return next(iter(flat))
    if not flat:
        raise IllFormed("a meet needs at least one type")
    return Meet(tuple(sorted(flat, key=_in_print)))


# --- paths in types ------------------------------------------------------------------


def escaping(value: Object) -> frozenset[Path]:
    """The paths in a type or object that start outside it.

    Paths are as seen from where the value stands: `up` 0 is the record around it.

    >>> dog = Pred("dog", Ind)
    >>> escaping(dog(this.x)), escaping(rectype(x=Ind, c=dog(this.x)))
    (frozenset({this.x}), frozenset())
    """
    if isinstance(value, TypeNode):
        return _escaping_type(value)
    match value:
        case Path():
            return frozenset((value,))
        case tuple():
            return _union(value)
        case Record():
            return _union(value._fields.values())
    return frozenset()


def _escaping_type(T: TypeNode) -> frozenset[Path]:
    """The paths that escape from a type; remembered, as a type does not change."""
    try:
        return T._escaping
    except AttributeError:
        found = _found_escaping(T)
    object.__setattr__(T, "_escaping", found)
    return found


def _found_escaping(T: TypeNode) -> frozenset[Path]:
    match T:
        case RecordType(fields):
            inner = _union(field for _, field in fields)
            return frozenset(Path(p.up - 1, p.labels) for p in inner if p.up > 0)
        case PType(_, args) | Meet(args):
            return _union(args)
        case Singleton(base, value):
            return escaping(base) | escaping(value)
        case ListOf(item):
            return escaping(item)
    return frozenset()


def _union(values: Iterable[Object]) -> frozenset[Path]:
    return frozenset().union(*map(escaping, values))


Ind = Basic("Ind")
"""The basic type of individuals."""

Type = Universe("Type")
"""The type of all types of level 0, those that mention neither Type nor RecType."""

RecType = Universe("RecType")
"""The type of all record types of level 0."""

Rec = RecordType(())
"""The record type without fields: every record is of it."""
