"""An arbitrary witness of a type: what is equal in it, and what is of what.

It is symbolic. Its parts are *places*, paths from the witness itself; manifest fields
make places equal to one another or to objects, and each class of equal places is of the
types that are claimed of any of them. Nothing is judged and nothing is remembered.

What is claimed of an arbitrary element of a list or set holds only where there is one,
so such a claim has a *condition*, the place of that element.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from ttr.computing.strings.pieces import events_of, is_of_strings
from ttr.computing.universe_levels import why_outside
from ttr.safety.budgets import spend
from ttr.types.interning import identity
from ttr.types.objects import EventString, FiniteSet, Object, Operation, Path, Record
from ttr.types.paths import free_paths, mentions, replace_paths
from ttr.types.substitution import field_type, follow_labels, substitute_variable
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    ListOf,
    Meet,
    Negation,
    NonEmpty,
    Plus,
    PType,
    RecordType,
    SetOf,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
    Universe,
)

Assumption = tuple[Object, TypeNode]
"""The assumption that a place or an object is of a type."""


# --- places --------------------------------------------------------------------------

ITSELF = Path(0, ("·",))
"""The place of the witness itself; its name cannot be a label."""

_EACH = "*"
"""The step from a list or set to an arbitrary element of it; not a label."""


def step(place: Path, label: str) -> Path:
    """The place one label further in."""
    return Path(place.up, (*place.labels, label))


def element(place: Path) -> Path:
    """The place of an arbitrary element of the list or set at a place."""
    return step(place, _EACH)


def is_element(label: str) -> bool:
    """Is a step on the way to a place one to an element of a list or set?"""
    return label == _EACH


def event(place: Path, number: int) -> Path:
    """The place of an event of the string at a place; they are counted from 0."""
    return step(place, str(number))


def new_place(number: int) -> Path:
    """A place of which nothing is known: an arbitrary argument, say."""
    return Path(0, (f"{ITSELF.labels[0]}{number}",))


def name_place(place: Path, labels: Collection[str]) -> Path:
    """A place as a path that people can read, from a record with these labels.

    An element of a list is called so, and so is an event; what is inside one is a path
    from it. Places of their own are x1, x2 and so on, or y1 if x1 is a label.

    >>> name_place(step(step(ITSELF, "r"), "x"), ["r"]).labels
    ('r', 'x')
    >>> name_place(step(element(step(ITSELF, "l")), "x"), ["l"]).labels
    ('x',)
    >>> name_place(element(step(ITSELF, "l")), ["l"]).labels
    ('element',)
    >>> name_place(new_place(0), ["x1"]).labels
    ('y1',)
    """
    first, *inside = place.labels
    if not first.startswith(ITSELF.labels[0]):
        return place
    if first != ITSELF.labels[0]:
        number = int(first.removeprefix(ITSELF.labels[0])) + 1
        names = (f"{letter}{number}" for letter in "xyzuvw")
        whole = next((name for name in names if name not in labels), f"x{number}")
        inside = [whole, *inside]
    for at in range(len(inside) - 1, -1, -1):
        if inside[at] == _EACH or inside[at].isdigit():
            whole = "element" if inside[at] == _EACH else "event"
            return Path(place.up, tuple(inside[at + 1 :]) or (whole,))
    return Path(place.up, tuple(inside) or ("it",))


def elements(term: Object) -> tuple[Object, ...] | None:
    """The elements of a list, a set or a string that is written out, else None."""
    if isinstance(term, FiniteSet | EventString):
        return term.items
    return term if isinstance(term, tuple) else None


# --- the witness ---------------------------------------------------------------------


class GenericWitness:
    """An arbitrary witness of S, and whatever else is assumed to be of some type.

    >>> from ttr import Ind, rectype, this
    >>> witness = GenericWitness(rectype(x=Ind, y=Ind @ this.x))
    >>> witness.normalise(step(ITSELF, "y")) is step(ITSELF, "x")
    True
    >>> GenericWitness(Ind @ "a" & Ind @ "b").is_impossible
    True
    """

    def __init__(self, S: TypeNode, assumed: Iterable[Assumption] = ()) -> None:
        self._equal: dict[tuple[str, ...], Object] = {}
        self._unbound: list[tuple[Object, Object]] = []
        self._around_bound: set[tuple[str, ...]] = set()
        self._absent: set[Path | None] = set()
        self._is_complete = True
        self.has_negations = False
        self._classes: dict[object, _EqualityClass] = {}
        self._claims: list[tuple[Path, TypeNode]] = []
        self.strings: list[Object] = []
        self._claim(ITSELF, S)
        written = []
        for term, T in assumed:
            if isinstance(term, Path):
                spend()  # what is assumed is classified anew for each witness
                self._claim(term, T)
            else:
                written.append((term, T))
        self._equate_manifest()
        for place, T in self._claims:
            self._classify(place, T, self._condition(place))
        for term, T in written:
            self._claim_of_term(term, T, None)
        self._find_misfits()

    def normalise(self, value: Object) -> Object:
        """The value with every place replaced by the term that represents it."""
        return replace_paths(value, self._representative) if self._equal else value

    def are_equal(self, term: Object, other: Object) -> bool:
        """Are two normal terms surely equal?"""
        wanted = {identity(term), identity(other)}
        return len(wanted) == 1 or any(
            wanted == {identity(self.normalise(left)), identity(self.normalise(right))}
            for left, right in self._unbound
        )

    def types_of(self, term: Object, given: Collection[Path] = ()) -> list[TypeNode]:
        """The types claimed of a normal term; singletons and meets are taken apart.

        `given` are the list elements that are taken to be there.
        """
        known = self._classes.get(identity(term))
        return known.types(given) if known else []

    @property
    def is_impossible(self) -> bool:
        """Is there no witness of S under any assignment?"""
        return None in self._absent

    @property
    def is_certain(self) -> bool:
        """Does some assignment surely have a witness with just these types?"""
        return self._is_complete and not self._absent

    def is_absent(self, place: Path) -> bool:
        """Can there be no such element, so that its list is empty?"""
        return place in self._absent

    def first_elements(self, given: Collection[Path]) -> frozenset[Path]:
        """The elements that lists surely have: what is so of all is so of these."""
        return frozenset(
            element(known.term)
            for known in self._classes.values()
            if isinstance(known.term, Path)
            and any(isinstance(T, NonEmpty) for T in known.types(given))
        )

    def negations(self, given: Collection[Path]) -> list[Assumption]:
        """The negations that are known: each term with the type that it is not of."""
        return [
            (known.term, T.body)
            for known in self._classes.values()
            for T in known.types(given)
            if isinstance(T, Negation)
        ]

    def atoms(self, given: Collection[Path]) -> Iterator[list[Basic | PType]]:
        """For each term, the basic types and ptypes that it is surely of."""
        for known in self._classes.values():
            yield [T for T in known.types(given) if isinstance(T, Basic | PType)]

    # --- what is claimed, place by place ---

    def _claim(self, place: Path, T: TypeNode) -> None:
        match T:
            case Meet(parts):
                spend(2 * len(parts))
                for part in parts:
                    self._claim(place, part)
                return
            case Singleton(base, _):
                self._claim(place, base)
            case ListOf(item) | NonEmpty(item) | SetOf(item):
                spend(2 + len(place.labels) // 4)
                self._claim(element(place), item)
            case Str(items):
                spend(2 * len(items))
                for number, item in enumerate(events_of(T) or ()):
                    self._claim(event(place, number), item)
            case RecordType(fields):
                # A claim is kept for each field, with a place as long as it is deep.
                spend((2 + len(place.labels) // 4) * len(fields))
                for label, field in fields:
                    self._claim(step(place, label), field_type(field, place))
        self._claims.append((place, T))

    def _classify(self, term: Object, T: TypeNode, condition: Path | None) -> None:
        """Add a claim to the class of its term."""
        if isinstance(T, Singleton):
            return
        term = self.normalise(term)
        known = self._classes.setdefault(identity(term), _EqualityClass(term))
        claimed = T if isinstance(T, RecordType) else self.normalise(T)
        known.claims.append((claimed, condition))
        self.has_negations |= isinstance(claimed, Negation)
        if isinstance(T, TypeAt) and not isinstance(claimed, TypeAt):
            # What it says of other places is not followed up.
            self._is_complete = False
            self._claim_of_term(term, claimed, condition)
        value = _computed_value(claimed)
        if isinstance(value, Basic | PType):
            known.claims.append((value, condition))
        inside = elements(term)
        match T:
            case ListOf(item) | NonEmpty(item) | SetOf(item) if inside is not None:
                for one in inside:
                    self._claim_of_term(one, item, condition)
            case Str() if inside is not None and len(inside) == _length(T):
                for one, item in zip(inside, T.items, strict=True):
                    self._claim_of_term(one, item, condition)
        if isinstance(T, Str | Plus):
            self.strings.append(term)

    def _claim_of_term(self, term: Object, T: TypeNode, condition: Path | None) -> None:
        """Add what a type claims of a term that is written out, and of its parts."""
        spend()
        match T:
            case Meet(parts):
                for part in parts:
                    self._claim_of_term(term, part, condition)
            case Singleton(base, value):
                self._compare_written(term, self.normalise(value), condition)
                self._claim_of_term(term, base, condition)
            case RecordType(fields) if isinstance(term, Record):
                self._classify(term, T, condition)
                for label, field in fields:
                    inner = follow_labels(term, (label,))
                    self._claim_of_term(inner, field_type(field, term), condition)
            case RecordType():
                self._is_complete = False
                self._classify(term, T, condition)
            case _:
                self._classify(term, T, condition)

    def _compare_written(
        self, term: Object, value: Object, condition: Path | None
    ) -> None:
        """Note that a term must be equal to a value."""
        if identity(term) == identity(value):
            return
        if _is_open(term) or _is_open(value):
            self._note_unsolved(term, value)
        else:
            self._absent.add(condition)

    def _condition(self, place: Path) -> Path | None:
        """The innermost list element that a place is, or is inside; else None."""
        if _EACH not in place.labels:
            return None
        labels = _to_element(place)
        found = self.normalise(Path(0, labels[:-1]))
        return element(found) if isinstance(found, Path) else Path(0, labels)

    # --- what is equal ---

    def _equate_manifest(self) -> None:
        """Make manifest places equal to their values, outer places first."""
        manifest = [
            (place, T.value) for place, T in self._claims if isinstance(T, Singleton)
        ]
        for place, value in sorted(manifest, key=lambda pair: len(pair[0].labels)):
            self._equate(place, value, place)

    def _equate(self, left: Object, right: Object, at: Path) -> None:
        spend()
        left, right = self.normalise(left), self.normalise(right)
        if identity(left) == identity(right):
            return
        if isinstance(left, Path) and self._may_bind(left, at):
            self._bind(left, right)
        elif isinstance(right, Path) and self._may_bind(right, at):
            self._bind(right, left)
        elif not _is_open(left) and not _is_open(right):
            self._absent.add(self._condition(at))
        elif _same_form(left, right):
            for mine, theirs in zip(
                _parts_in_order(left), _parts_in_order(right), strict=True
            ):
                self._equate(mine, theirs, at)
        else:
            self._note_unsolved(left, right)

    def _note_unsolved(self, left: Object, right: Object) -> None:
        """Note that two terms are equal although neither can represent the other."""
        self._unbound.append((left, right))
        self._is_complete = False

    def _may_bind(self, place: Path, at: Path) -> bool:
        """May an equation at one place determine what is at another?"""
        needed = self._condition(at)
        inside = needed is None or place.labels[: len(needed.labels)] == needed.labels
        return place.up == 0 and inside

    def _bind(self, place: Path, value: Object) -> None:
        """Let the value represent the class of a free place.

        A place may be equal to something around or inside it, or its parts may have
        been equated before. That is not followed up, so no refutation is certain then.
        """
        labels = place.labels
        if labels in self._around_bound:
            self._is_complete = False
        for path in free_paths(value):
            size = min(len(path.labels), len(labels))
            if path.up == 0 and path.labels[:size] == labels[:size]:
                self._note_unsolved(place, value)
                return
        self._equal[labels] = value
        self._around_bound.update(labels[:size] for size in range(1, len(labels)))

    def _representative(self, path: Path) -> Object:
        """The term that represents a place, found along all equations.

        It is kept for the places on the way, so that no way is followed twice.
        """
        passed: list[tuple[str, ...]] = []
        chosen: Object = path
        while isinstance(chosen, Path) and (length := self._bound_length(chosen)):
            labels = chosen.labels
            if length == len(labels):
                passed.append(labels)
            chosen = follow_labels(self._equal[labels[:length]], labels[length:])
        self._equal.update(dict.fromkeys(passed, chosen))
        return chosen if isinstance(chosen, Path) else self.normalise(chosen)

    def _bound_length(self, path: Path) -> int:
        """How many labels lead to the first bound place of a path; 0 if none."""
        if path.up > 0 or not self._equal:
            return 0
        lengths = range(1, len(path.labels) + 1)
        return next((n for n in lengths if path.labels[:n] in self._equal), 0)

    def _find_misfits(self) -> None:
        """Note the places where nothing can be, as their types have different forms."""
        for known in self._classes.values():
            if isinstance(known.term, Path) and len(known.claims) == 1:
                continue
            if known.mixes_forms():
                self._is_complete = False
            if known.can_be_of([T for T, _ in known.claims]):
                continue
            conditions = dict.fromkeys((None, *(c for _, c in known.claims)))
            absent = [c for c in conditions if not known.can_be_of(known.types((c,)))]
            self._absent.update(absent)
            self._is_complete = False
        for known in self._classes.values() if self._absent else ():
            place = known.term
            if isinstance(place, Path) and element(place) in self._absent:
                self._absent.update(known.conditions(NonEmpty))


class _EqualityClass:
    """The term that represents equal places, and the types claimed of any of them."""

    def __init__(self, term: Object) -> None:
        self.term = term
        self.claims: list[tuple[TypeNode, Path | None]] = []

    def types(self, given: Collection[Path | None]) -> list[TypeNode]:
        """The types claimed where these elements of lists are there."""
        return [T for T, c in self.claims if c is None or c in given]

    def mixes_forms(self) -> bool:
        """Is it claimed to have a form and also to be of atoms?

        There may be such things, but none can be created.
        """
        kinds = {isinstance(T, Basic | PType) for T, _ in self.claims}
        return len(kinds) > 1

    def conditions(self, kind: type[TypeNode]) -> list[Path | None]:
        """The conditions under which a type of this kind is claimed."""
        return [c for T, c in self.claims if isinstance(T, kind)]

    def can_be_of(self, types: list[TypeNode]) -> bool:
        """Can the term be of all the types, as far as their form tells?"""
        shapes = [T for T in types if isinstance(T, _Shape)]
        if isinstance(self.term, Path):
            lengths = {_length(T) for T in shapes if isinstance(T, Str)} - {None}
            return len({_SHAPES[type(T)] for T in shapes}) <= 1 and len(lengths) <= 1
        if isinstance(self.term, Application | Operation):
            return True
        return all(_has_form(self.term, shape) for shape in shapes)


_SHAPES: dict[type[TypeNode], str] = {
    RecordType: "record",
    ListOf: "list",
    NonEmpty: "list",
    SetOf: "set",
    Str: "string",
    Plus: "string",
    FunType: "function",
    Universe: "type",
}
"""The form that all witnesses of such a type have."""

_Shape = tuple(_SHAPES)


def _has_form(term: Object, shape: TypeNode) -> bool:
    match shape:
        case RecordType():
            return isinstance(term, Record) and all(label in term for label in shape)
        case ListOf():
            return isinstance(term, tuple)
        case NonEmpty():
            return isinstance(term, tuple) and len(term) > 0
        case SetOf():
            return isinstance(term, FiniteSet)
        case Str():
            length = _length(shape)
            some = isinstance(term, EventString)
            return some and (length is None or len(term) == length)
        case Plus(item):
            some = isinstance(term, EventString)
            return some and (len(term) > 0 or is_of_strings(item))
        case FunType():
            return isinstance(term, Function)
        case Universe():
            return not why_outside(term, shape)
    return True


def _length(T: Str) -> int | None:
    """The length of all strings of a type, if its form fixes it."""
    events = events_of(T)
    return None if events is None else len(events)


def _computed_value(T: TypeNode) -> Object:
    """The value of an application of a function that is written out, else None.

    If the argument is outside the domain, nothing is of the type anyway.
    """
    match T:
        case Application(Function(_, body), argument):
            return substitute_variable(body, argument)
    return None


def _is_open(value: Object) -> bool:
    """Does the value depend on a place, or on the value of a function?"""
    return bool(free_paths(value)) or mentions(value, Application)


def _same_form(left: Object, right: Object) -> bool:
    """Are two objects equal if and only if their contents are, one by one?"""
    match left, right:
        case Record(), Record():
            return left._fields.keys() == right._fields.keys()
        case (tuple(), tuple()) | (EventString(), EventString()):
            return len(left) == len(right)
    return False


def _parts_in_order(value: Object) -> list[Object]:
    if isinstance(value, Record):
        return [value[label] for label in sorted(value)]
    return list(elements(value) or ())


def _to_element(place: Path) -> tuple[str, ...]:
    """The labels to the innermost list element around a place, or none."""
    labels = place.labels
    lengths = range(len(labels), 0, -1)
    return next((labels[:n] for n in lengths if labels[n - 1] == _EACH), ())
