r"""Reading notation: what each name in a text means, and the type or object it builds.

In argument position a bare name is the innermost label of that name in the record types
around it, else an object; a dot or carets start a path explicitly. In type position a
name is a type. `read` turns one term into a value, `parse` a whole text.

>>> from ttr.syntax import Ind, Pred
>>> dog = Pred("dog", Ind)
>>> parse("[x : Ind, c : dog(x)]", using=[Ind, dog])
rectype(x=Basic('Ind'), c=Pred('dog', Basic('Ind'))(this.x))
>>> print(parse(r"[x : Ind, c : dog(x) /\ dog('x')]", using=[Ind, dog]))
[x : Ind, c : dog(x) /\ dog("x")]
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NoReturn

from ttr.errors import IllFormed, NotationError, TTRError, suggestion
from ttr.objects import check_label
from ttr.probability import degree
from ttr.substitution import Unresolved, along
from ttr.syntax import (
    Ind,
    ListOf,
    Object,
    Path,
    Pred,
    Rec,
    Record,
    RecordType,
    RecType,
    Singleton,
    Type,
    TypeNode,
    Universe,
    escaping,
    meet,
    rectype,
)
from ttr.theories import Interval, Theory
from ttr.trees import (
    Application,
    Braces,
    Conjunction,
    Degree,
    Fields,
    Items,
    Literal,
    Name,
    Part,
    Restriction,
    Source,
    Term,
    Word,
)

__all__ = ["Reader", "Scope", "parse", "read"]

Scope = tuple[frozenset[str], ...]
"""The labels of the record types around, innermost first."""

LOGICAL: Mapping[str, TypeNode] = {"Type": Type, "RecType": RecType, "Rec": Rec}
"""The types that every theory has."""

RESERVED = frozenset({*LOGICAL, "list"})
"""Names that no theory may declare."""

_LATER = frozenset({"set", "str", "plus"})

_LEVEL = re.compile(r"(Type|RecType)[_^]([0-9]{1,3})")


def parse(text: str, using: Iterable[object] = ()) -> Object:
    """The type or object that a text stands for.

    `using` are the basic types, predicates and object names that it may mention, or
    types and objects built of them. Raises `NotationError` for what is no notation and
    `IllFormed` for a type that cannot be.

    >>> parse("list(Ind)", using=[Ind]) is ListOf(Ind)
    True
    """
    return read(text, Theory.of(*using))


def read(text: str, theory: Theory, source: str = "<text>") -> Object:
    """The type or object that a text stands for in a theory."""
    from ttr import grammar

    place = Source.of(text, source)
    try:
        return Reader(theory, place).object(grammar.term(place), ())
    except RecursionError:
        raise NotationError("the text nests too deep to be read here") from None


@dataclass(frozen=True)
class Reader:
    """Reads terms of one text in one theory.

    `later` says in which line a name is declared that the theory does not have yet.
    """

    theory: Theory
    source: Source
    later: Mapping[str, int] = field(default_factory=dict)

    # --- where an object or a type may stand ---

    def object(self, term: Term, scope: Scope) -> Object:
        """The term as an object; a type is an object as well."""
        match term:
            case Literal():
                return term.value
            case Name():
                return self._named_object(term, scope)
            case Items():
                return tuple([self.object(item, scope) for item in term.items])
            case Braces():
                return self._record(term, scope)
        return self.type(term, scope)

    def _record(self, term: Braces, scope: Scope) -> Record:
        self._distinct([label for label, _ in term.settings])
        pairs = [(k.text, self.object(v, scope)) for k, v in term.settings]
        return Record(dict(pairs))

    def _named_object(self, name: Name, scope: Scope) -> Object:
        head, rest = name.labels[0], name.labels[1:]
        if name.up is not None:
            return self._path(name, name.up, scope)
        for up, labels in enumerate(scope):
            if head in labels:
                return Path(up, name.labels)
        if not rest and head in self.theory.objects:
            return head
        value = self._value(head)
        if head in self.theory.objects:
            self.refuse(name, f"{head} is an object without labels")
        if value is None:
            self._unknown(name, head, scope)
        try:
            return along(value, rest)
        except Unresolved as error:
            raise error.at(self.source.span(name)) from None

    def _path(self, name: Name, up: int, scope: Scope) -> Path:
        if up < len(scope):
            return Path(up, name.labels)
        if not scope:
            self.refuse(name, "a path stands in a record type, but there is none")
        around = f"{len(scope)} record type{'s' * (len(scope) != 1)}"
        self.refuse(
            name,
            f"the path goes out of {up}, but stands in {around}",
            "each ^ goes out of one record type",
        )

    # --- where a type must stand ---

    def type(self, term: Term, scope: Scope) -> TypeNode:
        """The term as a type; raises `NotationError` where it is none."""
        match term:
            case Name():
                return self._named_type(term, scope)
            case Application():
                return self._application(term, scope)
            case Fields():
                return self._record_type(term, scope)
            case Restriction():
                base = self.type(term.base, scope)
                return Singleton(base, self.object(term.value, scope))
            case Conjunction():
                return meet(*[self.type(part, scope) for part in term.parts])
            case Items(_, _, ()):
                return Rec
        return self._no_type(term)

    def _named_type(self, name: Name, scope: Scope) -> TypeNode:
        head, rest = name.labels[0], name.labels[1:]
        value = self._value(head) if name.up is None else None
        if isinstance(value, Pred) and not rest:
            self.refuse(
                name,
                f"expected a type, found the predicate {head} without arguments",
                f"apply it to objects of {_domains(value)}",
            )
        if isinstance(value, Record):
            value = self._named_object(name, ())
        elif rest:
            value = None
        if isinstance(value, TypeNode):
            return value
        declared = value is not None or head in self.theory.objects
        if declared or name.up is not None or _captured(head, scope):
            self._no_type(name)
        self._unknown(name, head, scope)

    def _application(self, term: Application, scope: Scope) -> TypeNode:
        head = term.head.text
        pred = self.theory.predicates.get(head)
        if head == "list":
            return self._list(term, scope)
        if pred is None:
            self._no_predicate(term, scope)
        args = [self.object(arg, scope) for arg in term.args]
        try:
            return pred(*args)
        except IllFormed as error:
            raise error.at(self.source.span(term)) from None

    def _list(self, term: Application, scope: Scope) -> TypeNode:
        if len(term.args) != 1:
            self.refuse(term, f"list takes one type, but has {len(term.args)}")
        return ListOf(self.type(term.args[0], scope))

    def _record_type(self, term: Fields, scope: Scope) -> RecordType:
        self._distinct([f.label for f in term.fields])
        scope = (frozenset(f.label.text for f in term.fields), *scope)
        found: dict[str, TypeNode] = {}
        for part in term.fields:
            kind = self.type(part.type, scope)
            if part.value is not None:
                kind = Singleton(kind, self.object(part.value, scope))
            found[part.label.text] = kind
        try:
            return rectype(found, self.theory)
        except IllFormed as error:
            culprit = _culprit(term, found, self.theory)
            raise error.at(self.source.span(culprit)) from None

    # --- where a degree must stand ---

    def degree(self, tree: Degree) -> Interval:
        """The probability or interval; raises `TTRError` where it is none."""
        value = self.object(tree.value, ())
        try:
            lo, hi = degree(value)
        except TTRError as error:
            raise error.at(self.source.span(tree.value)) from None
        return lo, hi

    # --- names ---

    def _value(self, name: str) -> Object | None:
        """What a name is declared as, but for objects: a type, a definition, …"""
        if name in LOGICAL:
            return LOGICAL[name]
        for known in (
            self.theory.definitions,
            self.theory.basics,
            self.theory.predicates,
        ):
            if name in known:
                return known[name]
        level = _LEVEL.fullmatch(name)
        return Universe(level[1], int(level[2])) if level else None

    def _unknown(self, part: Part, name: str, scope: Scope) -> NoReturn:
        if name in self.later:
            self.refuse(
                part,
                f"{name} is used before its definition in line {self.later[name]}",
                "move the definition up",
            )
        labels = [label for around in scope for label in around]
        hint = suggestion(name, [*self.theory.names, *RESERVED, *labels])
        self.refuse(
            part,
            f"nothing is called {name} here",
            hint or f"declare it first, or quote it to name an object: '{name}'",
        )

    def _no_predicate(self, term: Application, scope: Scope) -> NoReturn:
        head = term.head.text
        value = self._value(head)
        if isinstance(value, TypeNode):
            self.refuse(
                term, f"{head} is a type and takes no arguments: only predicates do"
            )
        if _captured(head, scope) or head in self.theory.objects:
            self._unsupported(term, f"{head}(…), the application of a function,")
        if head in _LATER:
            self._unsupported(term, f"{head}(…)")
        if value is not None:
            self.refuse(term, f"{head} is {value}, no predicate")
        if head in self.later:
            self._unknown(term.head, head, scope)
        self.refuse(
            term.head,
            f"there is no predicate {head}",
            suggestion(head, [*self.theory.predicates, "list"])
            or f"declare it first: pred {head}({', '.join(['…'] * len(term.args))})",
        )

    def _no_type(self, term: Term) -> NoReturn:
        written = self.source.text[term.start : term.end]
        match term:
            case Name(_, _, _, int()):
                kind = f"the path {written}"
            case Name(_, _, labels) if labels[0] in self.theory.objects:
                kind = f"the object {written}"
            case Name():
                kind = f"{written}, which is no type"
            case Items():
                kind = f"the list {written}"
            case Braces():
                kind = f"the record {written}"
            case _:
                kind = f"the object {written}"
        self.refuse(term, f"expected a type, found {kind}")

    # --- refusing ---

    def _distinct(self, labels: list[Word]) -> None:
        """Refuses what is no label, and a label that is there twice."""
        seen: set[str] = set()
        for label in labels:
            span = self.source.span(label)
            if label.text in seen:
                raise IllFormed(f"the label {label.text} is there twice", span=span)
            try:
                check_label(label.text)
            except IllFormed as error:
                raise error.at(span) from None
            seen.add(label.text)

    def _unsupported(self, part: Part, construct: str) -> NoReturn:
        self.refuse(part, f"{construct} is not part of this version of the notation")

    def refuse(self, part: Part, message: str, hint: str = "") -> NoReturn:
        """Raises a `NotationError` at a part of the text."""
        raise NotationError(message, span=self.source.span(part), hint=hint)


def _captured(name: str, scope: Scope) -> bool:
    return any(name in labels for labels in scope)


def _domains(pred: Pred) -> str:
    arities = (", ".join(map(str, arity)) for arity in pred.arities)
    return " or ".join(f"({arity})" for arity in arities)


def _culprit(term: Fields, fields: Mapping[str, TypeNode], theory: Theory) -> Part:
    """The part of a record type that makes it ill-formed, as far as one field does."""
    for part in term.fields:
        label = part.label.text
        if escaping(fields[label]) and _well_formed({**fields, label: Ind}, theory):
            return part if part.value else part.type
    return term


def _well_formed(fields: Mapping[str, TypeNode], theory: Theory) -> bool:
    try:
        rectype(fields, theory)
    except TTRError:
        return False
    return True
