"""The most specific type above two types that makes no join of them.

Two record types are generalised together: a term of the one and a term of the other
have a common term if they are the same, or if some path leads to the one here and to
the other there. So [x = a : Ind, c : dog(a)] and [x = b : Ind, c : dog(b)] have
[x : Ind, c : dog(x)] in common.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from ttr.building.constructors import rectype
from ttr.building.field_addresses import to_relative
from ttr.building.merging import merge
from ttr.computing.generic_witness import ITSELF, GenericWitness, step
from ttr.computing.strings.pieces import is_of_strings
from ttr.computing.subtyping import subtype
from ttr.errors import IllFormedError
from ttr.safety.budgets import spend, within_budget
from ttr.signature.axioms import supertypes
from ttr.signature.signature import Signature
from ttr.types.derived_types import function_type, order_fields
from ttr.types.interning import identity
from ttr.types.objects import Object, Path, sort_canonically
from ttr.types.paths import free_paths, map_parts, parts, replace_paths, shift_paths
from ttr.types.syntax import (
    Basic,
    FunType,
    Join,
    ListOf,
    Meet,
    NonEmpty,
    Plus,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeNode,
    as_type,
    meet,
)


@within_budget
def common_supertype(
    S: TypeNode, T: TypeNode, /, theory: Signature | None = None
) -> TypeNode:
    """The most specific type above both that has no join but those they have.

    If one is below the other it is that other one. Of record types it has the labels
    that both have, with types above both; a field depends on others and is set to what
    it is set to as far as it is so in both. Of other types it is the meet of what each
    of them says and the other is below. Raises `IllFormedError` where there is none:
    there is no type of everything.
    Law: S <= common_supertype(S, T), and T <= common_supertype(S, T).

    >>> from ttr import Ind, Pred, this
    >>> dog, run = Pred("dog", Ind), Pred("run", Ind)
    >>> S = rectype(x=Ind @ "a", c=dog("a") & run("a"), d=run("c"))
    >>> print(common_supertype(S, rectype(x=Ind @ "b", c=dog("b"), d=run("d"))))
    [x : Ind, c : dog(x)]
    >>> common_supertype(Ind, Basic("Real"))
    Traceback (most recent call last):
    ttr.errors.IllFormedError: Ind and Real have no common supertype without a join
    """
    found = _common_supertype(as_type(S), as_type(T), theory)
    if found is None:
        raise IllFormedError(f"{S} and {T} have no common supertype without a join")
    return found


def _common_supertype(
    S: TypeNode, T: TypeNode, theory: Signature | None
) -> TypeNode | None:
    higher = [
        upper for lower, upper in ((S, T), (T, S)) if subtype(lower, upper, theory).yes
    ]
    if higher:
        return sort_canonically(higher)[0]
    found = _Generalisation(GenericWitness(S), GenericWitness(T), theory).generalise()
    match found:
        case RecordType():
            return _drop_ill_formed_fields(found, theory)
        case Meet(parts):
            fitting = [
                _drop_ill_formed_fields(part, theory)
                if isinstance(part, RecordType)
                else part
                for part in parts
            ]
            return meet(*fitting)
    return found


def _drop_ill_formed_fields(T: RecordType, theory: Signature | None) -> RecordType:
    """The record type without the fields that no longer fit the others."""
    fields = dict(T.fields)
    try:
        return rectype(fields, theory)
    except IllFormedError:
        kept: dict[str, TypeNode] = {}
    for label, inside in fields.items():
        try:
            kept = dict(rectype({**kept, label: inside}, theory).fields)
        except IllFormedError:
            continue
    return rectype(kept, theory)


# --- both together -------------------------------------------------------------------


_NO_TERM = Path(0, ("",))
"""Stands for "no common term"; a path that leads nowhere."""

_Terms: TypeAlias = tuple[object, object]
"""The identities of a term on the left and a term on the right."""


@dataclass(frozen=True)
class _Generalisation:
    """The generalisation of two types, found from a generic witness of each.

    `paths` are the places that are kept, by their terms on either side; `manifest` are
    those that are set to something, and the places inside them.
    """

    left: GenericWitness
    right: GenericWitness
    theory: Signature | None
    paths: dict[_Terms, list[Path]] = field(default_factory=dict)
    manifest: set[Path] = field(default_factory=set)

    def generalise(self) -> TypeNode | None:
        """The type that both witnesses are of; None if they have nothing in common.

        At first all fields that both have are kept. Then those without a type, and
        those that depend on them, are dropped until all that are left can stay.
        """
        kept = list(self._shared_places(ITSELF))
        for place in kept:
            self.paths.setdefault(self._terms(place), []).append(place)
        while True:
            self.manifest.clear()
            found = self._type(ITSELF)
            still = [place for place in kept if self._is_kept(place)]
            if len(still) == len(kept):
                return found
            kept = still

    def _shared_places(self, place: Path) -> Iterator[Path]:
        """The places of the fields that both have, inside a place."""
        for label in self._labels(place):
            yield step(place, label)
            yield from self._shared_places(step(place, label))

    def _labels(self, place: Path) -> list[str]:
        """The labels that both have at a place."""
        mine, theirs = self._types(self.left, place), self._types(self.right, place)
        there = {label for R in theirs if isinstance(R, RecordType) for label in R}
        here = [label for R in mine if isinstance(R, RecordType) for label in R]
        return [label for label in dict.fromkeys(here) if label in there]

    def _types(self, side: GenericWitness, place: Path) -> list[TypeNode]:
        return side.types_of(side.normalise(place))

    def _terms(self, place: Path) -> _Terms:
        return identity(self.left.normalise(place)), identity(
            self.right.normalise(place)
        )

    def _is_kept(self, place: Path) -> bool:
        return place in self.paths[self._terms(place)]

    # --- what is at a place ---

    def _type(self, place: Path) -> TypeNode | None:
        """The type of what is at a place and what it is set to, as written there."""
        spend()
        value = self._value(place)
        if value is not _NO_TERM:
            self.manifest.add(place)
        parts = self._parts(place)
        if not parts:
            return None
        base = meet(*parts)
        return (
            base
            if value is _NO_TERM
            else Singleton(base, _places_to_paths(value, place))
        )

    def _parts(self, place: Path) -> list[TypeNode]:
        """The types that both have at a place, as a whole and field by field."""
        mine, theirs = self._types(self.left, place), self._types(self.right, place)
        common = self._generalise_meets(
            _others(self.left, mine), _others(self.right, theirs)
        )
        written = [_places_to_paths(part, place) for part in common]
        found = [
            part for part in written if not any(map(_is_in_witness, free_paths(part)))
        ]
        if any(map(_is_record_type, mine)) and any(map(_is_record_type, theirs)):
            found.append(self._record(place))
        return found

    def _record(self, place: Path) -> RecordType:
        fields: dict[str, TypeNode] = {}
        for label in self._labels(place):
            inner = step(place, label)
            found = self._type(inner) if self._is_kept(inner) else None
            if found is not None:
                fields[label] = found
            elif self._is_kept(inner):
                self.paths[self._terms(inner)].remove(inner)
        return RecordType(order_fields(fields))

    def _value(self, place: Path) -> Object:
        """The value to which a field is set on both sides, or `_NO_TERM`.

        It is left out inside a record that is itself set to something.
        """
        if Path(0, place.labels[:-1]) in self.manifest:
            self.manifest.add(place)
            return _NO_TERM
        s, t = self.left.normalise(place), self.right.normalise(place)
        value = self.term(s, t, 0)
        if value is not place:
            return value
        return _NO_TERM if isinstance(s, Path) else self._generalise_parts(s, t, 0)

    # --- types ---

    def common(self, F: TypeNode, G: TypeNode) -> TypeNode | None:
        """The generalisation of two types; None if they have nothing in common."""
        spend()
        found = self._generalise_meets([F], [G])
        return meet(*found) if found else None

    def _generalise_meets(
        self, mine: Iterable[TypeNode], theirs: Iterable[TypeNode]
    ) -> list[TypeNode]:
        """The generalisation of two meets: parts, none of which follows from others."""
        left = [f for T in mine for f in self._implied_types(T)]
        right = [g for T in theirs for g in self._implied_types(T)]
        found = [self._generalise_pair(f, g) for f in left for g in right]
        return self._strongest([part for part in found if part is not None])

    def _implied_types(self, T: TypeNode) -> Iterator[TypeNode]:
        """The type itself, and the types above it by form and by axioms."""
        spend()
        if isinstance(T, Meet):
            for part in T.parts:
                yield from self._implied_types(part)
            return
        yield T
        if isinstance(T, Singleton):
            yield from self._implied_types(T.base)
        if isinstance(T, Basic | PType) and self.theory:
            yield from [upper for _, upper in supertypes(T, self.theory.axioms)]

    def _generalise_pair(self, f: TypeNode, g: TypeNode) -> TypeNode | None:
        """The generalisation of two types that are not meets."""
        spend()
        if f is not g and not free_paths(f) and not free_paths(g):
            higher = self._comparable_supertype(f, g)
            if higher is not None:
                return higher
        match f, g:
            case (Join(several), other) | (other, Join(several)) if f is not g:
                return self._generalise_each((*several, other))
            case (NonEmpty(mine), NonEmpty(theirs)):
                return self._generalise_items(NonEmpty, (mine,), (theirs,))
            case (ListOf(mine) | NonEmpty(mine), ListOf(theirs) | NonEmpty(theirs)):
                return self._generalise_items(ListOf, (mine,), (theirs,))
            case (SetOf(mine), SetOf(theirs)) | (Plus(mine), Plus(theirs)):
                return self._generalise_items(type(f), (mine,), (theirs,))
            case (Str(several), Str(others)) if len(several) == len(others):
                return self._generalise_items(Str, several, others)
        found = self.term(f, g, 0)
        return None if found is _NO_TERM else found

    def _comparable_supertype(self, f: TypeNode, g: TypeNode) -> TypeNode | None:
        """The generalisation of two closed types that are comparable or of one kind."""
        if subtype(f, g, self.theory).yes:
            return g
        if subtype(g, f, self.theory).yes:
            return f
        match f, g:
            case RecordType(), RecordType():
                return _common_supertype(f, g, self.theory)
            case FunType(), FunType():
                return self._function(f, g)
        return None

    def _function(self, f: FunType, g: FunType) -> TypeNode | None:
        """The generalisation of two function types whose results do not depend."""
        if free_paths(f.result) or free_paths(g.result):
            return None
        result = _common_supertype(f.result, g.result, self.theory)
        domain = merge(f.domain, g.domain, self.theory)
        return None if result is None else function_type(domain, result)

    def _generalise_each(self, several: tuple[TypeNode, ...]) -> TypeNode | None:
        first, *others = several
        found: TypeNode | None = first
        for other in others:
            found = None if found is None else self.common(found, other)
        return found

    def _generalise_items(
        self,
        kind: type[TypeNode],
        mine: tuple[TypeNode, ...],
        theirs: tuple[TypeNode, ...],
    ) -> TypeNode | None:
        found = [self.common(f, g) for f, g in zip(mine, theirs, strict=True)]
        several = [one for one in found if one is not None]
        if len(several) < len(found):
            return None
        # Strings of strings and strings of events have nothing in common by their form.
        alike = [
            len(set(map(is_of_strings, parts))) == 1
            for parts in zip(mine, theirs, several, strict=True)
        ]
        fits = kind not in (Str, Plus) or all(alike)
        return kind(*several) if fits else None

    def _strongest(self, found: list[TypeNode]) -> list[TypeNode]:
        """The types without those that lie above another; of equal ones the first."""
        once = list(dict.fromkeys(found))
        kept: list[TypeNode] = []
        for i, T in enumerate(once):
            others = [*kept, *once[i + 1 :]]
            if not any(subtype(other, T, self.theory).yes for other in others):
                kept.append(T)
        return kept

    # --- terms ---

    def term(self, s: Object, t: Object, depth: int) -> Object:
        """A term that is s on the left and t on the right, or `_NO_TERM`.

        Both stand `depth` scopes further in than the fields.
        """
        spend()
        if identity(s) == identity(t) and not _mentions_witness(s, depth):
            return s
        found = self._path(s, t, depth)
        if found is not None:
            return shift_paths(found, depth)
        if type(s) is not type(t) or isinstance(s, Path):
            return _NO_TERM
        return self._generalise_parts(s, t, depth)

    def _path(self, s: Object, t: Object, depth: int) -> Path | None:
        """The first place kept of what is s on the left and t on the right."""
        left, right = _seen_from_outside(s, depth), _seen_from_outside(t, depth)
        if left is _NO_TERM or right is _NO_TERM:
            return None
        known = self.paths.get((identity(left), identity(right)))
        return known[0] if known else None

    def _generalise_parts(self, s: Object, t: Object, depth: int) -> Object:
        """A term of the same form as both, made of generalisations of their parts."""
        mine, mine_inside = parts(s)
        theirs, theirs_inside = parts(t)
        if len(mine) != len(theirs) or len(mine_inside) != len(theirs_inside):
            return _NO_TERM
        pairs = zip(mine, theirs, strict=True)
        inside = zip(mine_inside, theirs_inside, strict=True)
        common = [self.term(a, b, depth) for a, b in pairs]
        common += [self.term(a, b, depth + 1) for a, b in inside]
        if not common or any(one is _NO_TERM for one in common):
            return _NO_TERM
        left, right = _replace_parts(s, common), _replace_parts(t, common)
        return left if identity(left) == identity(right) else _NO_TERM


def _is_record_type(T: TypeNode) -> bool:
    return isinstance(T, RecordType)


def _others(witness: GenericWitness, types: Iterable[TypeNode]) -> list[TypeNode]:
    """The types that are not record types, in normal form."""
    return [witness.normalise(T) for T in types if not _is_record_type(T)]


def _places_to_paths(value: Object, place: Path) -> Object:
    """The value with its places written as paths from the field at a place.

    From the witness itself no path leads inside it.
    """
    here = place.labels[len(ITSELF.labels) :]

    def at(path: Path) -> Path:
        if not _is_in_witness(path):
            return Path(path.up + len(here), path.labels)
        inside = Path(0, path.labels[len(ITSELF.labels) :])
        return to_relative(inside, here[:-1]) if here else path

    return replace_paths(value, at)


def _is_in_witness(path: Path) -> bool:
    return path.up == 0 and path.labels[: len(ITSELF.labels)] == ITSELF.labels


def _mentions_witness(value: Object, depth: int) -> bool:
    """Does a path in a term lead into the witness?"""
    return any(
        path.up == depth and _is_in_witness(Path(0, path.labels))
        for path in free_paths(value)
    )


def _seen_from_outside(value: Object, depth: int) -> Object:
    """The term as seen from `depth` scopes further out, or `_NO_TERM`."""
    if isinstance(value, Path):
        inside = value.up < depth
        return _NO_TERM if inside else Path(value.up - depth, value.labels)
    return value if depth == 0 or not free_paths(value) else _NO_TERM


def _replace_parts(value: Object, common: list[Object]) -> Object:
    waiting = iter(common)
    return map_parts(value, lambda part, deeper: next(waiting))
