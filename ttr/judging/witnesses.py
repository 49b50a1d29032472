"""The known witnesses of a type: the objects that by the facts are of it, or may be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from functools import reduce
from itertools import product
from typing import cast

from ttr.building.merging import merge
from ttr.computing.strings.pieces import string_of
from ttr.errors import RefusedError, UnsupportedError
from ttr.judging.assignments import Assignment
from ttr.judging.evaluator import derivation, reduce_applications, reduce_atom
from ttr.judging.fact_index import FactIndex
from ttr.probability import Degree
from ttr.safety.budgets import spend
from ttr.types.derived_types import order_fields
from ttr.types.interning import identity
from ttr.types.objects import (
    EventString,
    FiniteSet,
    Object,
    Record,
    UnresolvedError,
)
from ttr.types.paths import labels_mentioned
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import (
    Application,
    Basic,
    Join,
    Meet,
    NonEmpty,
    Plus,
    PType,
    Rec,
    RecordType,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
)

_ANYTHING: tuple[Object, ...] = ((), FiniteSet(), EventString(), Rec)
"""Objects that may be of a type without an end, whatever is known."""

_TRIED_PER_INDEXED = 8
"""How many facts are indexed in the time that one field takes to be tried."""


def witnesses(facts: Assignment, T: TypeNode) -> Iterator[Object]:
    """The known objects that are certainly of T, each once, in the order of the facts.

    No path leads out of T. Raises `UnsupportedError` where there may be infinitely
    many: for types of lists, sets, functions and types, and for negations.
    """
    yield from _Listing(facts, 1.0).of(T)


def candidates(facts: Assignment, T: TypeNode) -> Iterator[Object]:
    """The known objects that are of T with a degree above 0, as by `witnesses`."""
    yield from _Listing(facts, 0.0).of(T)


def some_witnesses(facts: Assignment, T: TypeNode) -> Iterator[Object]:
    """Some known objects that are certainly of T, also where they cannot be listed.

    Of a type of which there is no end they are what is empty, Rec, and the objects that
    facts are about; of one of lists or strings, those with one element.

    >>> from ttr import Ind, Model, rectype
    >>> facts = Model().given("fido", Ind).facts
    >>> print(next(some_witnesses(facts, rectype(x=Ind, y=~(Ind @ "fido")))))
    {x = fido, y = []}
    """
    yield from _Listing(facts, 1.0, is_partial=True).of(T)


def some_candidates(facts: Assignment, T: TypeNode) -> Iterator[Object]:
    """The same, but those that are of T with a degree above 0."""
    yield from _Listing(facts, 0.0, is_partial=True).of(T)


def listed_type(T: TypeNode) -> TypeNode | None:
    """A type that can be listed, and of which something is if something is of T.

    >>> from ttr import Ind, ListOf, rectype
    >>> print(listed_type(rectype(x=Ind, y=ListOf(Ind))))
    [x : Ind]
    """
    match T:
        case NonEmpty(item) | Plus(item) if can_be_listed(item):
            return item
        case Meet(parts):
            return next(filter(None, map(listed_type, parts)), None)
        case RecordType(fields):
            kept: dict[str, TypeNode] = {}
            needed = {label for _, field in fields for label in labels_mentioned(field)}
            for label, field in fields:
                found = listed_type(field)
                whole = found is field or label not in needed
                if found is not None and whole and labels_mentioned(field) <= set(kept):
                    kept[label] = found
            return RecordType(order_fields(kept))
    return T if can_be_listed(T) else None


def can_be_listed(T: TypeNode) -> bool:
    """Can the known objects of T be listed, as far as the form of T tells?

    >>> from ttr import Ind, ListOf, rectype
    >>> can_be_listed(rectype(x=Ind)), can_be_listed(rectype(x=ListOf(Ind)))
    (True, False)
    """
    waiting = [T]
    while waiting:
        match waiting.pop():
            case Basic() | PType() | Singleton() | Application() | TypeAt():
                pass
            case Join(parts) | Str(parts):
                waiting += parts
            case Meet(parts):
                waiting.append(_listed_part(parts))
            case RecordType(fields):
                waiting += (field for _, field in fields)
            case _:
                return False
    return True


class _Listing:
    """Lists what is of a type with a degree above 0 that is at least `least`.

    If it is partial, it lists some objects of types of which there is no end.
    """

    def __init__(
        self, facts: Assignment, least: float, *, is_partial: bool = False
    ) -> None:
        self.facts, self.least, self.is_partial = facts, least, is_partial
        self._index = FactIndex(facts)
        self._extents: dict[Basic, _Extent] = {}
        self._tried = 0

    def of(self, T: TypeNode) -> Iterator[Object]:
        spend()
        facts = self.facts
        match T:
            case Basic() | PType():
                try:
                    atom = reduce_atom(facts, T)
                except RefusedError:
                    return
                yield from facts.told_of(atom, self._enough)
            case Singleton(_, value):
                try:
                    value = reduce_applications(facts, value)
                except RefusedError:
                    return
                if self._is_of(value, T):
                    yield value
            case Join(parts):
                found = [sit for part in parts for sit in self.of(part)]
                yield from {identity(sit): sit for sit in found}.values()
            case Meet(parts):
                source = _listed_part(parts)
                yield from (sit for sit in self.of(source) if self._is_of(sit, T))
            case Str(items):
                choices = [tuple(self.of(item)) for item in items]
                found = [string_of(items, pieces) for pieces in product(*choices)]
                yield from {identity(sit): sit for sit in found}.values()
            case RecordType():
                yield from map(Record, self._fillings(T))
            case TypeAt():
                return  # what is no type
            case Application():
                yield from self._of_application(T)
            case NonEmpty(item) if self.is_partial:
                yield from ((sit,) for sit in self.of(item))
            case Plus(item) if self.is_partial:
                yield from (string_of((item,), (sit,)) for sit in self.of(item))
            case _ if self.is_partial:
                known = (*_ANYTHING, *self.facts.objects())
                yield from (sit for sit in known if self._is_of(sit, T))
            case _:
                raise UnsupportedError(
                    f"what is of {T} cannot be listed, as there may be no end of it",
                    hint="judge an object, or create a witness",
                )

    def _of_application(self, T: Application) -> Iterator[Object]:
        """The objects of the type that a function gives, if it gives one."""
        try:
            value = reduce_applications(self.facts, T)
        except RefusedError:
            return
        if isinstance(value, TypeNode):
            yield from self.of(value)

    def _is_of(self, sit: Object, T: TypeNode) -> bool:
        return self._enough(derivation(self.facts, sit, T).p)

    def _enough(self, p: Degree) -> bool:
        return p.hi > 0.0 and p.lo >= self.least

    def _fillings(self, T: RecordType) -> Iterator[dict[str, Object]]:
        """The ways to fill the fields, one after the other, without recursion."""
        labels = T.labels
        waiting: list[Iterator[dict[str, Object]]] = [iter(({},))]
        while waiting:
            fields = next(waiting[-1], None)
            if fields is None:
                waiting.pop()
            elif len(fields) == len(labels):
                yield fields
            else:
                waiting.append(self._extensions(T, labels[len(fields)], fields))

    def _extensions(
        self, T: RecordType, label: str, fields: dict[str, Object]
    ) -> Iterator[dict[str, Object]]:
        """The fields extended by each witness of the next field."""
        spend(4)
        try:
            field = resolve_paths(T[label], (fields,))
        except UnresolvedError as unresolved:
            if self.is_partial:
                return
            raise UnsupportedError(
                f"the records of {T} cannot be listed: {unresolved.message}",
                hint="fields on a cycle can be judged, but not listed",
            ) from None
        for sit in self._witnesses_among(
            field, self._values_that_fit(T, label, fields)
        ):
            spend(4)
            self._tried += 1
            yield {**fields, label: sit}

    def _values_that_fit(
        self, T: RecordType, label: str, fields: dict[str, Object]
    ) -> Set[object] | None:
        """The identities of what a label may have; None if that is not worth asking.

        To index the facts takes as long as trying some of them.
        """
        if self._tried * _TRIED_PER_INDEXED < len(self.facts.told):
            return None
        return self._index.values_that_fit(T, label, fields)

    def _witnesses_among(
        self, T: TypeNode, fitting: Set[object] | None
    ) -> Iterator[Object]:
        """What is of T, if it is among what fits; in the order of the facts."""
        if fitting is None:
            yield from self.of(T)
        elif isinstance(T, Basic):
            if T not in self._extents:
                self._extents[T] = _Extent(self.facts.told_in_order(T))
            for sit in self._extents[T].only(fitting):
                if self._enough(self.facts.degree_of(sit, T)[0]):
                    yield sit
        else:
            yield from (sit for sit in self.of(T) if identity(sit) in fitting)


class _Extent:
    """The objects with a fact for a type, in the order of the facts."""

    def __init__(self, objects: Sequence[Object]) -> None:
        self._objects = objects
        self._place = {identity(sit): number for number, sit in enumerate(objects)}

    def only(self, wanted: Set[object]) -> Iterator[Object]:
        """The wanted ones among them."""
        spend(1 + len(wanted) // 8)
        places = sorted(self._place[one] for one in wanted if one in self._place)
        for place in places:
            yield self._objects[place]


def _listed_part(parts: tuple[TypeNode, ...]) -> TypeNode:
    """The part of a meet that is listed; its record types are merged into one."""
    records = [part for part in parts if isinstance(part, RecordType)]
    if records:
        return reduce(merge, records[1:], cast(TypeNode, records[0]))
    return next(filter(_is_listed, parts), parts[0])


def _is_listed(T: TypeNode) -> bool:
    return isinstance(T, Basic | PType | Singleton | RecordType | Str)
