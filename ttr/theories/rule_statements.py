"""Reads update rules: `rule name(s : S, e : E) where [x = s.y : T] := body`.

The state, the event and what `where` binds are variables: each path begins with the
name of one of them. A path that leads nowhere by the types of the variables is refused
where it is written.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NoReturn

from ttr.building.merging import merge
from ttr.building.well_formedness import check_value, field_at_path
from ttr.errors import IllFormedError, TTRError
from ttr.notation.error_location import is_ill_formed, locate_error
from ttr.notation.reader import Reader
from ttr.notation.syntax_trees import (
    Degree,
    Fields,
    Items,
    Name,
    Parameter,
    Part,
    RuleStatement,
    Term,
    Word,
    inside,
)
from ttr.probability import CERTAIN
from ttr.probability import Degree as Probability
from ttr.types.objects import Object, Path, Record
from ttr.types.paths import free_paths, replace_paths
from ttr.types.syntax import Application, Meet, RecordType, Singleton, TypeNode
from ttr.updates.rules import Body, Rule

_MODEL = "model"
"""The parameter by which rules in Python get the model, so no variable is called so."""

_BIND = "bind it: where [{name} = … : T]"


def read_rule(tree: RuleStatement, reader: Reader) -> Rule:
    """The rule that a statement declares; raises `NotationError` or
    `IllFormedError`.
    """
    return _RuleReader(tree, reader).rule()


def read_state_type(term: Term, reader: Reader) -> RecordType:
    """The term as a record type, which may be written as a meet of record types."""
    found = _merge_meet(reader.type(term, ()), reader)
    if isinstance(found, RecordType):
        return found
    reader.refuse(
        term,
        f"a state is a record, but {reader.text_of(term)} is no record type",
        "write a record type, [x : T], or the name of one",
    )


def _merge_meet(value: Object, reader: Reader) -> Object:
    """A meet of record types as one record type; any other value as it is."""
    match value:
        case Meet((first, *rest)):
            for part in rest:
                first = merge(first, part, reader.theory.signature)
            return first
    return value


@dataclass(frozen=True)
class _RuleReader:
    """Reads one rule."""

    tree: RuleStatement
    reader: Reader

    @property
    def given(self) -> tuple[Parameter, ...]:
        """The parameters: the state and the event."""
        return self.tree.parameters

    @property
    def within(self) -> Reader:
        """Reads terms with variables; its hint says how to bind one more."""
        way_out = _BIND if len(self.given) > 1 else f"name the event so, or {_BIND}"
        return replace(self.reader, way_out=way_out)

    def rule(self) -> Rule:
        """The rule; raises `NotationError` or `IllFormedError` if its parts do not
        fit.
        """
        tree = self.tree
        when, on, p = self._parameters()
        names = tuple(one.name.text for one in self.given)
        types = (when,) if on is None else (when, on)
        around = RecordType(tuple(zip(names, types, strict=True)))
        where = self._where(around)
        if where is not None:
            around = RecordType((*around.fields, *_bindings_as_fields(where)))
        return Rule(
            tree.name.text,
            Body(self._body(around), names),
            when,
            on=on,
            where=where,
            kind=tree.kind.text if tree.kind else "",
            p=p,
            takes=frozenset((_MODEL, *(where or ()))),
            names=names,
            doc=str(tree.doc.value) if tree.doc else "",
            place=self.reader.source.span(tree.name),
            text=self.reader.source.text[tree.name.start : tree.end],
        )

    # --- the state and the event ---

    def _parameters(self) -> tuple[RecordType, TypeNode | None, Probability]:
        state, *events = self.given
        for parameter in self.given:
            self._check_name(parameter.name)
        self.reader.check_distinct([one.name for one in self.given])
        if len(events) > 1:
            self.reader.refuse(
                events[1],
                "a rule takes the state and at most one event",
                "what else it needs is bound by where [x = … : T]",
            )
        if state.degree is not None:
            self.reader.refuse(
                state.degree,
                "the state is certain: only the event has a probability",
            )
        when = read_state_type(state.type, self.reader)
        if not events:
            return when, None, CERTAIN
        return (
            when,
            self._event_type(events[0].type, state.name),
            self._event_probability(events[0]),
        )

    def _event_type(self, term: Term, state: Word) -> TypeNode:
        """The type of the events, which must not depend on the state."""
        found = self.reader.type(term, (frozenset((state.text,)),))
        for path in sorted(free_paths(found), key=lambda one: one.labels):
            self.reader.refuse(
                _locate_path(term, path),
                "the type of an event cannot mention the state, found "
                f"{'.'.join(path.labels)}",
                "ask it of the event: where [c = e : T]; an object is quoted: 'a'",
            )
        return found

    def _event_probability(self, event: Parameter) -> Probability:
        """The probability with which an event must be of its type."""
        match event.degree:
            case None:
                return CERTAIN
            case Degree(_, _, _, Items(_, _, (_, _))):
                return Probability(*self.reader.degree(event.degree))
        self.reader.refuse(
            event.degree.value,
            "how probable the event must be is an interval",
            "write e : E in [0.7, 1] for 0.7 at least",
        )

    def _check_name(self, word: Word) -> None:
        if word.text == _MODEL:
            self.reader.refuse(
                word,
                f"{_MODEL} has a meaning of its own in rules",
                "choose another name, such as m",
            )

    # --- what is bound ---

    def _where(self, around: RecordType) -> RecordType | None:
        """The bindings: a record type with paths to the state and the event."""
        term = self.tree.where
        if term is None:
            return None
        for part in term.fields:
            self._check_name(part.label)
        given = [one.name for one in self.given]
        self.reader.check_distinct([*given, *(part.label for part in term.fields)])
        found = self.within.type(term, (frozenset(around),))
        assert isinstance(found, RecordType)
        self._check_fits(term, found, around)
        return found

    # --- the effect ---

    def _body(self, around: RecordType) -> Object:
        """What the rule gives: a record type, a record, or a term that becomes one."""
        try:
            return self._read_body(around)
        except IllFormedError as error:
            raise self._explain_hiding(error, around) from None

    def _read_body(self, around: RecordType) -> Object:
        term = self.tree.value
        found = self.within.object(term, (frozenset(around),))
        found = _merge_meet(found, self.reader)
        if not isinstance(found, RecordType | Record | Path | Application):
            self.reader.refuse(
                term,
                f"a rule gives a record type or the next state, found "
                f"{self.reader.text_of(term)}",
                "write what is new: [x = a : T] changes x and leaves the rest",
            )
        self._check_fits(term, found, around)
        self._check_not_itself(term, found, around)
        return found

    # --- paths ---

    def _check_fits(self, term: Term, value: Object, around: RecordType) -> None:
        """Refuse a path that leads nowhere, or to a value of the wrong type."""
        signature = self.reader.theory.signature
        for path in sorted(free_paths(value), key=lambda one: one.labels):
            try:
                field_at_path(path, around)
            except IllFormedError as error:
                self._refuse_path(term, path, error)
        try:
            check_value(value, around, signature)
        except IllFormedError as error:

            def is_wrong(part: Object) -> bool:
                return is_ill_formed(lambda: check_value(part, around, signature))

            wrong = locate_error(term, value, is_wrong)
            raise error.at(self.reader.source.span(wrong)) from None

    def _check_not_itself(self, term: Term, value: Object, around: RecordType) -> None:
        """Refuse a field that is set to itself, as in [x = x : T].

        Most often the label hides a variable of the rule with the same name.
        """
        for path in _self_references(value):
            label = path.labels[0]
            hidden = f"it hides {label} of the rule: choose another name for that"
            self.reader.refuse(
                _locate_path(term, path),
                f"the field {label} is set to itself: here {label} is the label",
                hidden if label in around else "say what it is set to",
            )

    def _explain_hiding(self, error: TTRError, around: RecordType) -> TTRError:
        """An error about a path, with a hint if a label hides a variable in it."""
        scopes = [it for it in inside(self.tree.value) if isinstance(it, Fields)]
        for name in inside(self.tree.value):
            if not isinstance(name, Name) or name.labels[0] not in around:
                continue
            variable, written = name.labels[0], ".".join(name.labels)
            if not error.message.startswith(f"the path {written} leads nowhere"):
                continue
            above = [it for it in scopes if it.start <= name.start < it.end]
            meant = _field_or_none(Path(0, name.labels), around)
            if meant is None or not above:
                continue
            out = f"{len(above)} record{'s' * (len(above) > 1)} further out"
            cause = f"{self._describe(variable)} is {out}"
            if any(variable in _labels_of(scope) for scope in above):
                cause = f"the label {variable} hides {self._describe(variable)}"
            hint = (
                f"{cause}: bind it, where [it = {written} : {meant}], "
                f"or write {'^' * len(above)}.{written}"
            )
            span = self.reader.source.span(name)
            return type(error)(error.message, hint=hint, span=span)
        return error

    def _describe(self, variable: str) -> str:
        """A variable of the rule, as what it is: the state s, the event e."""
        names = [one.name.text for one in self.given]
        if variable not in names:
            return f"what where binds as {variable}"
        return f"the {('state', 'event')[names.index(variable)]} {variable}"

    def _refuse_path(self, term: Term, path: Path, error: TTRError) -> NoReturn:
        """Refuse a path where it is written, and say where its type comes from."""
        variable = path.labels[0]
        if not error.hint and variable in [one.name.text for one in self.given]:
            hint = f"what {variable} has is said in the brackets: {variable} : [x : T]"
            error = type(error)(error.message, hint=hint)
        raise error.at(self.reader.source.span(_locate_path(term, path))) from None


def _labels_of(scope: Fields) -> Iterator[str]:
    return (field.label.text for field in scope.fields)


def _field_or_none(path: Path, T: RecordType) -> TypeNode | None:
    try:
        return field_at_path(path, T)
    except IllFormedError:
        return None


def _self_references(value: Object) -> Iterator[Path]:
    """The paths in a record type that lead from a field to this field itself."""
    if not isinstance(value, RecordType):
        return
    for label, field in value.fields:
        if isinstance(field, RecordType):
            yield from _self_references(field)
        for path in sorted(free_paths(field), key=lambda one: one.labels):
            if (path.up, path.labels[0]) == (0, label):
                yield path


def _locate_path(term: Term, path: Path) -> Part:
    """The place where a path is written in a term."""
    names = (part for part in inside(term) if isinstance(part, Name))
    return next((one for one in names if one.labels == path.labels), term)


def _bindings_as_fields(where: RecordType) -> Iterator[tuple[str, TypeNode]]:
    """The bindings as fields of the record type that has the state and the event."""

    def at(path: Path) -> Path:
        return Path(0, path.labels)

    for label, field in where.fields:
        T = field.base if isinstance(field, Singleton) else field
        moved = replace_paths(T, at)
        assert isinstance(moved, TypeNode)
        yield label, moved
