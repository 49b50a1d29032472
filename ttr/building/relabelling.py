"""Relabelling: other labels for the fields of a record type, or of a record."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import overload

from ttr.building.field_addresses import Address, format_address, parse_address
from ttr.errors import IllFormedError, suggestion
from ttr.safety.budgets import spend, within_budget
from ttr.types.derived_types import order_fields
from ttr.types.objects import Object, Path, Record, check_label, combine_labels
from ttr.types.paths import replace_paths
from ttr.types.syntax import (
    Join,
    Meet,
    Negation,
    RecordType,
    Singleton,
    TypeNode,
    join,
    kind_of,
    meet,
)


@overload
def relabel(
    value: RecordType, names: Mapping[str, str] | None = None, /, **labels: str
) -> RecordType: ...


@overload
def relabel(
    value: Record, names: Mapping[str, str] | None = None, /, **labels: str
) -> Record: ...


@within_budget
def relabel(
    value: RecordType | Record,
    names: Mapping[str, str] | None = None,
    /,
    **labels: str,
) -> RecordType | Record:
    """The record type or record with new names for some of its labels.

    A label inside a nested record is named by its path, in a mapping: `{"bg.x": "z"}`
    renames x to z inside bg. All is renamed at once, so that labels can be swapped,
    and paths follow. Raises `IllFormedError` for a label that is not there, where two
    labels would fall together, and where something is said of a record as a whole in
    which a label would change: it would not be the same record any more.
    Law: r : T iff relabel(r, m) : relabel(T, m), for every r that has the labels.

    >>> from ttr import Ind, Pred, record, rectype, this
    >>> hug = Pred("hug", Ind, Ind)
    >>> T = rectype(x=Ind, y=Ind, e=hug(this.x, this.y))
    >>> print(relabel(T, x="y", y="x"))
    [x : Ind, y : Ind, e : hug(y, x)]
    >>> bg = rectype(bg=rectype(x=Ind), c=hug(this.bg.x, this.bg.x))
    >>> print(relabel(bg, {"bg.x": "z"}))
    [bg : [z : Ind], c : hug(bg.z, bg.z)]
    >>> print(relabel(record(x="fido"), x="y"))
    {y = fido}
    """
    renaming = _Renaming()
    for path, name in combine_labels("relabel", names, labels).items():
        check_label(name)
        renaming = renaming.with_name(parse_address(path, "relabel"), name)
    if isinstance(value, Record):
        return _relabel_record(value, renaming, ())
    if isinstance(value, RecordType):
        _check_renaming([value], renaming, ())
        return _relabel_record_type(value, renaming, (), ())
    raise IllFormedError(
        f"relabel takes a record type or a record, found {kind_of(value)}"
    )


@dataclass(frozen=True)
class _Renaming:
    """New names for the labels of a record, and what to rename inside its fields.

    What is inside is found under the old label.
    """

    names: Mapping[str, str] = field(default_factory=dict)
    inner: Mapping[str, _Renaming] = field(default_factory=dict)

    def with_name(self, where: Address, name: str) -> _Renaming:
        """The renaming that also gives this name to the label at an address."""
        label, *rest = where
        if not rest:
            return _Renaming({**self.names, label: name}, self.inner)
        inside = self.at(label).with_name(tuple(rest), name)
        return _Renaming(self.names, {**self.inner, label: inside})

    def at(self, label: str) -> _Renaming:
        """The renaming inside the field with this label."""
        return self.inner.get(label, _NOTHING)

    def new_name(self, label: str) -> str:
        """The new name of a label."""
        return self.names.get(label, label)

    def first(self) -> Address:
        """One of the addresses that are renamed; empty if there are none."""
        if self.names:
            return (min(self.names),)
        labels = sorted(label for label, inside in self.inner.items() if inside.first())
        return (labels[0], *self.inner[labels[0]].first()) if labels else ()


_NOTHING = _Renaming()

_Scopes = tuple[_Renaming, ...]
"""The renamings of the record types around, innermost first."""


# --- in types ------------------------------------------------------------------------


def _relabel_record_type(
    T: RecordType, renaming: _Renaming, around: _Scopes, where: Address
) -> RecordType:
    scopes = (renaming, *around)
    fields = {
        renaming.new_name(label): _relabel_type(
            inside, renaming.at(label), scopes, (*where, label)
        )
        for label, inside in T.fields
    }
    return RecordType(order_fields(fields))


def _relabel_type(
    T: TypeNode, renaming: _Renaming, scopes: _Scopes, where: Address
) -> TypeNode:
    """A type with its labels and paths renamed; it stands in these scopes."""
    spend()
    if not renaming.first():
        followed: TypeNode = _rename_paths(T, scopes, where)
        return followed
    match T:
        case RecordType():
            return _relabel_record_type(T, renaming, scopes, where)
        case Singleton(base, value):
            return Singleton(
                _relabel_type(base, renaming, scopes, where),
                _relabel_object(value, renaming, scopes, where),
            )
        case Meet(parts):
            return meet(
                *[_relabel_type(part, renaming, scopes, where) for part in parts]
            )
        case Join(parts):
            return join(
                *[_relabel_type(part, renaming, scopes, where) for part in parts]
            )
        case Negation(body):
            return Negation(_relabel_type(body, renaming, scopes, where))
    raise _cannot_rename(where, renaming, f"{T} is no record type")


def _relabel_object(
    value: Object, renaming: _Renaming, scopes: _Scopes, where: Address
) -> Object:
    """The value of a manifest field, with the same labels renamed as in its type."""
    spend()
    if not renaming.first():
        return _rename_paths(value, scopes, where)
    match value:
        case Record():
            fields = {
                renaming.new_name(label): _relabel_object(
                    inside, renaming.at(label), scopes, (*where, label)
                )
                for label, inside in value._fields.items()
            }
            return Record(fields)
        case Path(up) if up < len(scopes):
            path, inside = _rename_path(value, scopes)
            if inside == renaming:
                return path
    raise _cannot_rename(where, renaming, f"{format_address(where)} is set to {value}")


def _rename_paths(value: Object, scopes: _Scopes, where: Address) -> Object:
    """A type or object in which nothing but the paths changes."""

    def at(path: Path) -> Path:
        if path.up >= len(scopes):
            return path
        followed, inside = _rename_path(path, scopes)
        if inside.first():
            whole = format_address(path.labels)
            said = f"{format_address(where)} is about {whole} as a whole"
            raise _cannot_rename(path.labels, inside, said)
        return followed

    return replace_paths(value, at)


def _rename_path(path: Path, scopes: _Scopes) -> tuple[Path, _Renaming]:
    """The path in the new names, and what is to be renamed where it leads."""
    renaming = scopes[path.up]
    labels = []
    for label in path.labels:
        labels.append(renaming.new_name(label))
        renaming = renaming.at(label)
    return Path(path.up, tuple(labels)), renaming


def _cannot_rename(where: Address, renaming: _Renaming, why: str) -> IllFormedError:
    path = format_address((*where, *renaming.first()))
    return IllFormedError(f"{path} cannot be renamed: {why}")


# --- in records ----------------------------------------------------------------------


def _relabel_record(value: Object, renaming: _Renaming, where: Address) -> Record:
    if not isinstance(value, Record):
        raise IllFormedError(
            f"{format_address(where)} is no record, so it has no labels to rename"
        )
    _check_labels(value._fields, renaming, where)
    fields = {
        renaming.new_name(label): _relabel_record(
            inside, renaming.at(label), (*where, label)
        )
        if renaming.at(label).first()
        else inside
        for label, inside in value._fields.items()
    }
    return Record(fields)


# --- what can be renamed -------------------------------------------------------------


def _check_renaming(
    kinds: Iterable[Object], renaming: _Renaming, where: Address
) -> None:
    """Refuse labels that are missing, and new names that would coincide.

    `kinds` are all the types of one record: it may have the labels of each.
    """
    spend()
    if not renaming.first():
        return
    inside: dict[str, list[Object]] = {}
    for kind in kinds:
        for label, of in nested_fields(kind):
            inside.setdefault(label, []).append(of)
    _check_labels(inside, renaming, where)
    for label, kinds in inside.items():
        _check_renaming(kinds, renaming.at(label), (*where, label))


def _check_labels(labels: Iterable[str], renaming: _Renaming, where: Address) -> None:
    known = dict.fromkeys(labels)
    for label in (*renaming.names, *renaming.inner):
        if label not in known:
            missing = format_address((*where, label))
            raise IllFormedError(
                f"there is no {missing}, so it cannot be renamed",
                hint=suggestion(label, known),
            )
    old: dict[str, str] = {}
    for label in known:
        other = old.setdefault(renaming.new_name(label), label)
        if other != label:
            both = " and ".join(sorted([other, label]))
            inside = f" in {format_address(where)}" if where else ""
            name = renaming.new_name(label)
            raise IllFormedError(
                f"the labels {both}{inside} would both be called {name}"
            )


def nested_fields(T: Object) -> Iterator[tuple[str, Object]]:
    """The fields of a type, of its parts, and of the value it is restricted to."""
    spend()
    match T:
        case RecordType(fields):
            yield from fields
        case Record():
            yield from T._fields.items()
        case Singleton(base, value):
            yield from nested_fields(base)
            yield from nested_fields(value)
        case Meet(parts) | Join(parts):
            for part in parts:
                yield from nested_fields(part)
        case Negation(body):
            yield from nested_fields(body)
