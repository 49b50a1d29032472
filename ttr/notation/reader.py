r"""From syntax trees to types and objects: what each name in a text means.

As an argument, a name is the innermost variable or label of that name around it, or
else an object; a dot or carets make it a path in any case. Where a type is needed, a
name is a type. Before a bracket it is a variable, or else a predicate, or else anything
that is a function.

>>> from ttr import Ind, Pred
>>> dog = Pred("dog", Ind)
>>> parse("[x : Ind, c : dog(x)]", using=[Ind, dog])
rectype(x=Basic('Ind'), c=Pred('dog', Basic('Ind'))(this.x))
>>> print(parse(r"[x : Ind, c : dog(x) /\ dog('x')]", using=[Ind, dog]))
[x : Ind, c : dog(x) /\ dog("x")]
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn, TypeVar

from ttr.building.constructors import Pi, fun, rectype
from ttr.building.merging import amerge
from ttr.errors import IllFormedError, NotationError, TTRError, suggestion
from ttr.notation.error_location import is_ill_formed, locate_error, locate_misfit
from ttr.notation.names import Names, is_declared, meaning_of, vocabulary_of
from ttr.notation.parser import parse_term
from ttr.notation.syntax_errors import excerpt
from ttr.notation.syntax_trees import (
    Abstraction,
    Arrow,
    Braces,
    Concatenation,
    Conjunction,
    Degree,
    Denial,
    Disjunction,
    Elements,
    Events,
    Expectation,
    Fields,
    Items,
    Literal,
    Name,
    Part,
    Probability,
    Restriction,
    Source,
    Term,
    Word,
)
from ttr.notation.syntax_trees import Application as Call
from ttr.probability import degree
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Interval, Signature
from ttr.types.derived_types import function_type, star
from ttr.types.interning import Node
from ttr.types.merges import merge_terms
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Object,
    Operation,
    Path,
    Record,
    UnresolvedError,
    check_label,
    concat,
)
from ttr.types.printing import (
    Scope,
    Spelling,
    TypeVariable,
    Written,
    hides_type,
    is_of_types,
    labels_with,
    may_hold_types,
)
from ttr.types.reserved_words import LIST_OPERATIONS, LOGICAL, RESERVED, WORDS
from ttr.types.substitution import follow_path
from ttr.types.syntax import (
    Application,
    Function,
    FunType,
    Negation,
    Pred,
    Rec,
    RecordType,
    Singleton,
    Str,
    TypeNode,
    Universe,
    apply_to,
    as_type,
    join,
    kind_of,
    meet,
)

_TYPE_CONSTRUCTORS: Mapping[str, Callable[[TypeNode], TypeNode]] = {
    **{word: kind for kind, word in WORDS.items() if kind is not Str},
    "star": star,
}
"""Words that make a type of a type in brackets."""

_TYPE_OPERATIONS = ("merge", "amerge")
"""Words that make a type of two types in brackets."""

_NOT_RESERVED = frozenset(("star", *_TYPE_OPERATIONS))
"""Words that a theory may declare: then they mean what it says."""

_BUILT_IN = ("str", *_TYPE_CONSTRUCTORS, *_TYPE_OPERATIONS, *LIST_OPERATIONS)

_B = TypeVar("_B", Function, FunType)

_LEVEL = re.compile(r"(Type|RecType)[_^]([0-9]{1,3})")


def parse(text: str, using: Iterable[object] = ()) -> Object:
    """The type or object that a text stands for.

    `using` lists the basic types, predicates and object names that it may mention, or
    types and objects in which they occur. Raises `NotationError` if the text is no
    notation, and `IllFormedError` if the type is ill-formed.

    >>> from ttr import Ind, ListOf
    >>> parse("list(Ind)", using=[Ind]) is ListOf(Ind)
    True
    """
    return read_term(text, vocabulary_of(*_as_tuple(using)))


def _as_tuple(using: Iterable[object]) -> tuple[object, ...]:
    """What a text may mention, as a tuple; a single type or name is no list."""
    with suppress(TypeError):
        if not isinstance(using, str | TypeNode):
            return tuple(using)
    raise NotationError(
        f"using is a list of what the text may mention, found {kind_of(using)}",
        hint="write brackets, as in using=[Ind, dog]",
    )


@within_budget
def read_term(text: str, theory: Names, source: str = "<text>") -> Object:
    """The type or object that a text stands for in a theory; raises `NotationError`."""
    place = Source.of(text, source)
    try:
        return Reader(theory, place).object(parse_term(place), ())
    except RecursionError:
        span = place.span(Part(0, len(place.text)))
        raise NotationError("this nests too deep to be read here", span=span) from None


@dataclass(frozen=True)
class Reader:
    """Reads the terms of one text in one theory.

    `later` has the line of each declaration that is still to come, `way_out` the hint
    for a name that means nothing. What is read notes in `written` how it is written.
    """

    theory: Names
    source: Source
    later: Mapping[str, int] = field(default_factory=dict)
    way_out: str = "declare it first"
    written: dict[Node, Written] = field(default_factory=dict)

    # --- where an object or a type may stand ---

    def object(self, term: Term, scope: Scope) -> Object:
        """The term as an object; a type is an object as well."""
        match term:
            case Literal():
                return term.value
            case Name():
                return self._named_object(term, scope)
            case Call():
                return self._call(term, scope)
            case Items(_, _, items):
                return self._objects(items, scope)
            case Elements(_, _, items):
                return FiniteSet(*self._objects(items, scope))
            case Events():
                return self._event_string(term, scope)
            case Braces():
                return self._record(term, scope)
            case Abstraction():
                return self._function(term, scope)
            case Concatenation(_, _, parts):
                return self._apply(term, concat, self._objects(parts, scope))
        return self.type(term, scope)

    def _objects(self, terms: tuple[Term, ...], scope: Scope) -> tuple[Object, ...]:
        return tuple([self.object(term, scope) for term in terms])

    def _record(self, term: Braces, scope: Scope) -> Record:
        self.check_distinct([label for label, _ in term.settings])
        pairs = [(k.text, self.object(v, scope)) for k, v in term.settings]
        return Record(dict(pairs))

    def _event_string(self, term: Events, scope: Scope) -> EventString:
        match term.items:
            case (Name(_, _, (kind,), None), _) if self._is_unknown(kind, scope):
                self.refuse(
                    term,
                    f"an object that prints as {self.text_of(term)} has no notation, "
                    "so it cannot be read",
                    f"if it is a string of events, declare {kind} first",
                )
        return EventString(*self._objects(term.items, scope))

    def _is_unknown(self, name: str, scope: Scope) -> bool:
        """Is a name undeclared, and unlike every declared one?"""
        if is_declared(self.theory, name) or _is_bound(name, scope):
            return False
        if self._value_of(name) is not None:
            return False
        return not suggestion(
            name, {*_names_of_terms(self.theory), *_bound_names(scope)}
        )

    def _function(self, term: Abstraction, scope: Scope) -> Function:
        name = self._variable(term.variable)
        domain = self.type(term.domain, scope)
        body = self.object(term.body, (_as_scope(name, domain), *scope))
        found = self._bind(fun, name, domain, term.body, body)
        self.written.setdefault(found, name)
        return found

    def _apply(
        self, term: Term, operation: Callable[..., Object], args: tuple[Object, ...]
    ) -> Object:
        try:
            return operation(*args)
        except TTRError as error:
            raise error.at(self.source.span(term)) from None

    def _named_object(self, name: Name, scope: Scope) -> Object:
        head, rest = name.labels[0], name.labels[1:]
        if name.up is not None:
            return self._path(name, name.up, scope)
        for up, names in enumerate(scope):
            if head == names:
                return Path(up, (BOUND, *rest))
            if isinstance(names, frozenset) and head in names:
                return Path(up, name.labels)
        is_object = head in self.theory.objects and head not in RESERVED
        if is_object and not rest:
            return head
        value = self._value_of(head)
        if is_object:
            self.refuse(name, f"{head} is an object without labels")
        if value is None:
            quoted = f"quote it to name an object: '{excerpt(head)}'"
            way_out = self.way_out.format(name=head)
            self._refuse_unknown(name, head, scope, f"{way_out}, or {quoted}")
        try:
            return follow_path(value, rest)
        except UnresolvedError as error:
            raise error.at(self.source.span(name)) from None

    def _path(self, name: Name, carets: int, scope: Scope) -> Path:
        """A path from `carets` record types further out; functions do not count."""
        records = [up for up, names in enumerate(scope) if not isinstance(names, str)]
        if carets < len(records):
            return Path(records[carets], name.labels)
        if not records:
            self.refuse(name, "a path stands in a record type, but there is none")
        around = f"is {len(records)}" if len(records) == 1 else f"are {len(records)}"
        self.refuse(
            name,
            "the path goes out of every record type around it",
            f"each ^ goes out of one record type, and there {around} around it",
        )

    # --- what stands before a bracket ---

    def _call(self, term: Call, scope: Scope) -> Object:
        match term.head:
            case Name(_, _, (name,), None) if self._is_built_in(name, scope):
                return self._built_in(term, name, scope)
            case Name(_, _, (name,), None) as head:
                function = self._function_named(term, head, name, scope)
            case head:
                function = self.object(head, scope)
        args = self._objects(term.args, scope)
        match function:
            case Pred():
                return self._apply(term, function, args)
            case Path() | Function() | Application() | Operation() | str():
                return self._apply(term, apply_to, (function, *args))
        written = self.text_of(term.head)
        kind = "a type" if isinstance(function, TypeNode) else "no function"
        self.refuse(
            term,
            f"{written} is {kind} and takes no arguments: only predicates and "
            "functions do",
        )

    def _is_built_in(self, name: str, scope: Scope) -> bool:
        """Is a name before a bracket one of the words of the notation, such as list?"""
        if name not in _NOT_RESERVED:
            return name in _BUILT_IN
        declared = name in self.theory.objects or self._value_of(name) is not None
        return not (declared or _is_bound(name, scope))

    def _function_named(
        self, term: Call, head: Name, name: str, scope: Scope
    ) -> Object:
        """What a name before a bracket means; a variable hides a predicate."""
        for up, names in enumerate(scope):
            if name == names:
                return Path(up, (BOUND,))
        if name in self.theory.predicates:
            return self.theory.predicates[name]
        known = _is_bound(name, scope) or name in self.theory.objects
        if not known and self._value_of(name) is None:
            self._refuse_predicate(term, name, scope)
        return self._named_object(head, scope)

    def _built_in(self, term: Call, word: str, scope: Scope) -> Object:
        if word == "str":
            return Str(*[self.type(arg, scope) for arg in term.args])
        if word in _TYPE_OPERATIONS:
            return self._merge_of(term, word, scope)
        if len(term.args) != 1:
            kind = "type" if word in _TYPE_CONSTRUCTORS else "list"
            self.refuse(term, f"{word} takes one {kind}, but has {len(term.args)}")
        if word in _TYPE_CONSTRUCTORS:
            return _TYPE_CONSTRUCTORS[word](self.type(term.args[0], scope))
        return self._apply(term, LIST_OPERATIONS[word], self._objects(term.args, scope))

    def _merge_of(self, term: Call, word: str, scope: Scope) -> TypeNode:
        """merge(S, T), of two types or more, or amerge(S, T)."""
        if len(term.args) < 2 or (len(term.args) > 2 and word == "amerge"):
            self.refuse(term, f"{word} takes two types, but has {len(term.args)}")
        types = [self.type(arg, scope) for arg in term.args]
        try:
            if word == "merge":
                return merge_terms(*types)
            S, T = types
            return amerge(S, T, self.theory.signature)
        except TTRError as error:
            raise error.at(self.source.span(term)) from None

    # --- where a type must stand ---

    def type(self, term: Term, scope: Scope) -> TypeNode:
        """The term as a type; raises `NotationError` if it is none."""
        match term:
            case Name():
                return self._named_type(term, scope)
            case Literal(_, _, str() as name) if hides_type(scope, name):
                return self._declared_type(term, name)
            case Call():
                found = self._call(term, scope)
                if isinstance(found, Operation) and found.name == "fst":
                    return as_type(found)
                return (
                    found if isinstance(found, TypeNode) else self._refuse_as_type(term)
                )
            case Fields():
                return self._record_type(term, scope)
            case Restriction():
                base = self.type(term.base, scope)
                return Singleton(base, self.object(term.value, scope))
            case Conjunction():
                return meet(*[self.type(part, scope) for part in term.parts])
            case Disjunction():
                return join(*[self.type(part, scope) for part in term.parts])
            case Denial():
                return Negation(self.type(term.body, scope))
            case Arrow():
                return self._function_type(term, scope)
            case Items(_, _, ()):
                return Rec
        return self._refuse_as_type(term)

    def _named_type(self, name: Name, scope: Scope) -> TypeNode:
        head, rest = name.labels[0], name.labels[1:]
        hidden = hides_type(scope, head) and head not in RESERVED
        if hidden or name.up is not None:
            return as_type(self._named_object(name, scope))
        value = self._value_of(head)
        if isinstance(value, Pred) and not rest:
            self.refuse(
                name,
                f"expected a type, found the predicate {head} without arguments",
                f"apply it to objects of {_format_arities(value)}",
            )
        if isinstance(value, Record):
            value = self._named_object(name, ())
        elif rest:
            value = None
        if isinstance(value, TypeNode):
            return value
        if _is_bound(head, scope):
            return as_type(self._named_object(name, scope))
        if value is not None or head in self.theory.objects:
            self._refuse_as_type(name)
        self._refuse_unknown(name, head, scope, "declare it first")

    def _declared_type(self, term: Literal, name: str) -> TypeNode:
        """The declared type of a name in quotes, where a label around hides it."""
        value = self._value_of(name)
        return value if isinstance(value, TypeNode) else self._refuse_as_type(term)

    def _function_type(self, term: Arrow, scope: Scope) -> FunType:
        domain = self.type(term.domain, scope)
        if term.variable is None:
            return function_type(domain, self.type(term.result, scope))
        name = self._variable(term.variable)
        result = self.type(term.result, (_as_scope(name, domain), *scope))
        found = self._bind(Pi, name, domain, term.result, result)
        self.written.setdefault(found, name)
        return found

    def _bind(
        self,
        kind: Callable[..., Callable[[Any], _B]],
        name: str,
        domain: TypeNode,
        term: Term,
        inside: Object,
    ) -> _B:
        """The function or function type with this body; an error says where it is."""
        variable = {name: domain}
        try:
            return kind(variable, self.theory.signature)(inside)
        except IllFormedError as error:
            build = kind(variable, self._theory_as_written())
            wrong = locate_error(
                term, inside, lambda T: is_ill_formed(lambda: build(T))
            )
            as_written = _error_of(lambda: build(inside)) or error
            raise as_written.at(self.source.span(wrong)) from None

    def _theory_as_written(self) -> Signature:
        """The theory, with the order and the names of this text for its errors."""
        return replace(self.theory.signature, spelling=(Spelling(self.written),))

    def _record_type(self, term: Fields, scope: Scope) -> RecordType:
        self.check_distinct([f.label for f in term.fields])
        labels = [field.label.text for field in term.fields]
        of_types = frozenset(
            [f.label.text for f in term.fields if self._is_of_types(f.type, scope)]
        )
        scope = (labels_with(labels, of_types), *scope)
        found: dict[str, TypeNode] = {}
        for part in term.fields:
            kind = self.type(part.type, scope)
            if part.value is not None:
                kind = Singleton(kind, self.object(part.value, scope))
            found[part.label.text] = kind
        try:
            T = rectype(found, self.theory.signature)
        except IllFormedError as error:
            wrong = locate_misfit(term, found, self.theory.signature)
            theory = self._theory_as_written()
            as_written = _error_of(lambda: rectype(found, theory)) or error
            raise as_written.at(self.source.span(wrong)) from None
        self.written.setdefault(T, tuple(labels))
        return T

    def _is_of_types(self, term: Term, scope: Scope) -> bool:
        """Is the type of a field written as a type of types?"""
        match term:
            case Restriction():
                return self._is_of_types(term.base, scope)
            case Name(_, _, (name,), None) if not hides_type(scope, name):
                value = self._value_of(name)
                return isinstance(value, TypeNode) and is_of_types(value)
        return False

    # --- where a degree must stand ---

    def degree(self, tree: Degree) -> Interval:
        """The probability or interval; raises `TTRError` if it is none."""
        value = self.object(tree.value, ())
        try:
            lo, hi = degree(value)
        except TTRError as error:
            raise error.at(self.source.span(tree.value)) from None
        return lo, hi

    def claimed_probability(
        self, tree: Probability | Expectation
    ) -> tuple[str, Interval]:
        """The sign, = or in, and the probability after it; raises `NotationError`."""
        if tree.degree is None:
            self.refuse(
                tree,
                "this does not say what the probability is",
                "write P(a : T) = p or P(a : T) in [lo, hi]",
            )
        return tree.degree.relation, self.degree(tree.degree)

    # --- names ---

    def _value_of(self, name: str) -> Object | None:
        """What a name stands for if it is no object: a type, a definition, …"""
        if name in LOGICAL:
            return LOGICAL[name]
        found = meaning_of(self.theory, name)
        if found is not None:
            return found
        level = _LEVEL.fullmatch(name)
        return Universe(level[1], int(level[2])) if level else None

    def _refuse_unknown(
        self, part: Part, name: str, scope: Scope, way_out: str
    ) -> NoReturn:
        """Refuse an unknown name; the hint is a similar name, or else the way out."""
        self._refuse_played(part, name)
        if name in self.later:
            self.refuse_too_early(part, name)
        known = [*_names_of_terms(self.theory), *RESERVED, *_bound_names(scope)]
        self.refuse(
            part,
            f"nothing is called {excerpt(name)} here",
            suggestion(name, known) or way_out,
        )

    def _refuse_played(self, part: Part, name: str) -> None:
        """Refuse the name of a rule, strategy or game: it is no type or object."""
        theory = self.theory
        kinds = {
            "rule": theory.rules,
            "strategy": theory.strategies,
            "game": theory.openings,
        }
        for kind, names in kinds.items():
            if name in names:
                told = f"{name} is a {kind}, which is no type, object or predicate"
                self.refuse(part, told)

    def refuse_too_early(self, part: Part, name: str) -> NoReturn:
        """Refuse a name that is declared further down."""
        self.refuse(
            part,
            f"{name} is used before its definition in line {self.later[name]}",
            "move the definition up",
        )

    def _refuse_predicate(self, term: Call, name: str, scope: Scope) -> NoReturn:
        self._refuse_played(term.head, name)
        if name in self.later:
            self.refuse_too_early(term.head, name)
        known = {*_names_of_terms(self.theory), *_BUILT_IN, *_bound_names(scope)} - {
            *self.theory.basics
        }
        arity = ", ".join(["…"] * len(term.args[:5]))
        self.refuse(
            term.head,
            f"there is no predicate {excerpt(name)}",
            suggestion(name, known)
            or f"declare it first: pred {excerpt(name)}({arity})",
        )

    def _refuse_as_type(self, term: Term) -> NoReturn:
        written = self.text_of(term)
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
            case Elements():
                kind = f"the set {written}"
            case Events():
                kind = f"the string of events {written}"
            case Abstraction():
                kind = f"the function {written}"
            case _:
                kind = f"the object {written}"
        self.refuse(term, f"expected a type, found {kind}")

    # --- errors ---

    def check_distinct(self, labels: list[Word]) -> None:
        """Refuse what is no label, and a label that occurs twice."""
        seen: set[str] = set()
        for label in labels:
            if label.text in seen:
                told = f"the label {excerpt(label.text)} is there twice"
                raise IllFormedError(told, span=self.source.span(label))
            try:
                check_label(label.text)
            except IllFormedError as error:
                raise error.at(self.source.span(label)) from None
            seen.add(label.text)

    def _variable(self, word: Word) -> str:
        self.check_distinct([word])
        return word.text

    def text_of(self, part: Part) -> str:
        """The text of a part, to be shown in an error."""
        return excerpt(self.source.text[part.start : part.end])

    def refuse(self, part: Part, message: str, hint: str = "") -> NoReturn:
        """Raise a `NotationError` at a part of the text."""
        raise NotationError(message, span=self.source.span(part), hint=hint)


def _names_of_terms(theory: Names) -> Iterator[str]:
    """The names of types, objects and predicates."""
    yield from theory.objects
    yield from theory.definitions
    yield from theory.basics
    yield from theory.predicates


def _error_of(build: Callable[[], object]) -> IllFormedError | None:
    """The error that building something raises, or None."""
    try:
        build()
    except IllFormedError as error:
        return error
    return None


def _as_scope(name: str, domain: TypeNode) -> str:
    """The name of a variable, as a scope."""
    return TypeVariable(name) if may_hold_types(domain) else name


def _bound_names(scope: Scope) -> Iterator[str]:
    """The labels and variables in scope."""
    for names in scope:
        if not isinstance(names, Spelling):
            yield from (names,) if isinstance(names, str) else names


def _is_bound(name: str, scope: Scope) -> bool:
    return name in _bound_names(scope)


def _format_arities(pred: Pred) -> str:
    arities = (", ".join(map(str, arity)) for arity in pred.arities)
    return " or ".join(f"({arity})" for arity in arities)
