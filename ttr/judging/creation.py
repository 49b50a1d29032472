"""Creating witnesses of types, and adding judgements to an assignment."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from functools import partial, reduce
from itertools import count, cycle, islice, product
from typing import assert_never

from ttr.building.merging import merge
from ttr.computing.case_analysis import cases, cases_or_whole
from ttr.computing.case_search import open_cases
from ttr.computing.generic_witness import ITSELF, GenericWitness, step
from ttr.computing.path_cycles import describe_cycle
from ttr.computing.strings.automata import automaton_above
from ttr.computing.strings.automaton_runs import shortest_words
from ttr.computing.strings.pieces import (
    alternatives,
    events_of,
    is_of_strings,
    string_of,
)
from ttr.errors import RefusedError, TTRError
from ttr.judging.assignments import Assignment
from ttr.judging.certainty import is_certain
from ttr.judging.evaluator import (
    derivation,
    is_reduced,
    make_witness,
    reduce_applications,
    reduce_atom,
)
from ttr.judging.open_terms import TermFinder
from ttr.judging.truth_of_types import IsTrue
from ttr.probability import CERTAIN, REFUTED
from ttr.safety.budgets import spend
from ttr.types.derived_types import order_fields
from ttr.types.interning import identity
from ttr.types.objects import (
    BOUND,
    EventString,
    FiniteSet,
    Object,
    Path,
    Record,
    UnresolvedError,
    sort_canonically,
)
from ttr.types.paths import (
    free_paths,
    mentions,
    paths_to_types,
    replace_paths,
    shift_paths,
    subterms,
)
from ttr.types.printing import notation
from ttr.types.records import field_at
from ttr.types.substitution import resolve_paths
from ttr.types.syntax import (
    Application,
    Basic,
    Function,
    FunType,
    Ind,
    Join,
    ListOf,
    Meet,
    Negation,
    NonEmpty,
    Plus,
    PType,
    Rec,
    RecordType,
    RecType,
    SetOf,
    Singleton,
    Str,
    TypeAt,
    TypeNode,
    Universe,
    as_type,
    join,
    meet,
)


def with_judgement(facts: Assignment, sit: Object, T: TypeNode) -> Assignment:
    """The assignment in which also sit : T, taken apart into judgements of atoms.

    No path leads out of T. Raises `RefusedError` where sit cannot be of T.
    """
    match T:
        case Basic() | PType():
            return facts.with_fact(sit, reduce_atom(facts, T), CERTAIN)
        case Meet(parts):
            for part in parts:
                facts = with_judgement(facts, sit, part)
            return facts
        case Singleton(base, value) if identity(value) == identity(sit):
            return with_judgement(facts, sit, base)
        case ListOf(item) | NonEmpty(item) if isinstance(sit, tuple) and sit:
            return _with_each(facts, sit, item)
        case SetOf(item) if isinstance(sit, FiniteSet):
            return _with_each(facts, sit, item)
        case Str(items) if _has_events(sit, T):
            for event, item in zip(sit, items, strict=True):
                facts = with_judgement(facts, event, item)
            return facts
        case RecordType() if isinstance(sit, Record):
            return _with_fields(facts, sit, T)
        case Negation(body):
            return _with_denial(facts, sit, body)
        case Application():
            return with_judgement(facts, sit, _reduce_to_type(facts, T))
    why = derivation(facts, sit, T)
    if why.p != CERTAIN:
        raise RefusedError(f"{notation(sit)} : {T} cannot be given: {why.rule}")
    return facts


def _has_events(sit: Object, T: Str) -> bool:
    """Is it plain which events of a string are to be of which types?"""
    events = events_of(T)
    return (
        isinstance(sit, EventString) and events is not None and len(sit) == len(events)
    )


def _with_each(facts: Assignment, sit: Iterable[Object], T: TypeNode) -> Assignment:
    for element in sit:
        facts = with_judgement(facts, element, T)
    return facts


def _with_denial(facts: Assignment, sit: Object, T: TypeNode) -> Assignment:
    """The assignment in which also sit is not of T."""
    match T:
        case Basic() | PType():
            try:
                atom = reduce_atom(facts, T)
            except RefusedError:
                return facts  # as nothing is of it
            return facts.with_fact(sit, atom, REFUTED)
        case Negation(body):
            return with_judgement(facts, sit, body)
        case Join(parts):
            for part in parts:
                facts = _with_denial(facts, sit, part)
            return facts
    if derivation(facts, sit, T).p == REFUTED:
        return facts
    raise RefusedError(
        f"{notation(sit)} : {Negation(T)} cannot be given: only of atoms"
    )


def _reduce_to_type(facts: Assignment, T: Application) -> TypeNode:
    """The type that a function gives; raises `RefusedError` where it gives none."""
    found = reduce_applications(facts, T)
    if isinstance(found, TypeNode) and not isinstance(found, Application):
        return found
    raise RefusedError(f"{T} is no type, so nothing is of it")


def _with_fields(facts: Assignment, sit: Record, T: RecordType) -> Assignment:
    for label, field in T.fields:
        if label not in sit:
            raise RefusedError(
                f"{notation(sit)} : {T} cannot be given: there is no {label}"
            )
        try:
            ground = resolve_paths(field, (sit._fields,))
        except UnresolvedError as unresolved:
            raise RefusedError(
                f"{notation(sit)} : {T} cannot be given: {unresolved.message}"
            ) from unresolved
        facts = with_judgement(facts, sit._fields[label], ground)
    return facts


@make_witness.provided_by
def create_witness(
    facts: Assignment, T: TypeNode, size: int = 0
) -> tuple[Object, Assignment]:
    """A new witness of T, and the assignment that has it.

    `size` is the number of elements of the lists, sets and repetitions in it, where T
    leaves that open; elements of a join take turns. From 2 on, a record has one label
    more than it needs. No path leads out of T. Raises `RefusedError` where there is
    none.
    """
    sit, facts = _WitnessMaker(size).make(facts, T)
    if mentions(T, Negation):
        _check(facts, sit, T)
    return sit, facts


def _settle_fields(T: RecordType) -> RecordType:
    """The type with each field made manifest whose value other fields determine."""
    witness = GenericWitness(T)
    fields: dict[str, TypeNode] = {}
    for label, field in T.fields:
        place = step(ITSELF, label)
        value = witness.normalise(place)
        fields[label] = field
        inside = all(path.labels[0] == ITSELF.labels[0] for path in free_paths(value))
        if value is not place and inside and not isinstance(field, Singleton):
            fields[label] = Singleton(field, replace_paths(value, _from_witness))
    return RecordType(order_fields(fields))


def _choose_types(T: RecordType) -> Iterator[RecordType]:
    """The type with each field that other fields have as their type made manifest."""
    used = {path for _, field in T.fields for path in paths_to_types(field)}
    places = sorted({path.labels for path in used if path.up == 0})
    open_ = [
        (place, field)
        for place in places
        if isinstance(field := field_at(T, place), Universe)
    ]
    basics = [part for part in subterms([T]) if isinstance(part, Basic)]
    known = tuple(dict.fromkeys((Ind, Rec, *sort_canonically(basics))))
    choices = [(*known, _type(field, 1)) for _, field in open_]
    for chosen in islice(product(*choices), TRIED) if open_ else ():
        found = T
        for (place, field), one in zip(open_, chosen, strict=True):
            found = _with_field_at(found, place, Singleton(field, one))
        yield found


def _with_field_at(
    T: RecordType, place: tuple[str, ...], field: TypeNode
) -> RecordType:
    """The record type with another field at a place in it."""
    first, *rest = place
    inner = T[first]
    if isinstance(inner, RecordType) and rest:
        field = _with_field_at(inner, tuple(rest), field)
    return RecordType(order_fields({**dict(T.fields), first: field}))


def _from_witness(place: Path) -> Path:
    """A place in the witness as a path from one of its fields."""
    return Path(0, place.labels[1:])


def _check(facts: Assignment, sit: Object, T: TypeNode) -> None:
    """Raise `RefusedError` where the facts contradict what T denies of its witness."""
    if derivation(facts, sit, T).p != CERTAIN:
        raise RefusedError(
            f"a witness of {T} cannot be made up: it denies what it says"
        )


Made = tuple[Object, Assignment]
"""A witness, and the assignment in which it is one."""


class _WitnessMaker:
    """Makes new witnesses; lists and sets in them have `size` elements."""

    def __init__(self, size: int) -> None:
        self._size = size

    def make(self, facts: Assignment, T: TypeNode) -> Made:
        """A new witness of T, and the assignment that has it."""
        match T:
            case Basic():
                sit, facts = facts.with_new("a")
                return sit, with_judgement(facts, sit, T)
            case PType():
                facts = self._with_requirements(facts, T)
                sit, facts = facts.with_new("s")
                return sit, with_judgement(facts, sit, T)
            case Meet() | Join() | Negation():
                return self._make_case(facts, T)
            case Singleton(base, value):
                value = reduce_applications(facts, value)
                return value, _with_certainty(facts, value, base)
            case ListOf(item):
                return self._list(facts, item, self._size)
            case NonEmpty(item):
                return self._list(facts, item, max(1, self._size))
            case SetOf(item):
                items, facts = self._list(facts, item, self._size)
                return FiniteSet(*items), facts
            case Str() | Plus():
                return self._string_or_another(facts, T)
            case FunType():
                return self._function(facts, T)
            case RecordType():
                return self._record_or_settled(facts, T)
            case Universe():
                return _type(T, self._size), facts
            case Application():
                return self.make(facts, _reduce_to_type(facts, T))
            case TypeAt():
                raise RefusedError(f"{T} is no type, so nothing is of it")
        raise assert_never(T)  # type: ignore[arg-type]

    def _with_requirements(self, facts: Assignment, T: PType) -> Assignment:
        """The facts with a witness of every type that is to be true for one of T."""
        for _, condition in facts.requirements(T):
            p, _ = condition.degree(facts)
            if isinstance(condition, IsTrue) and p != CERTAIN:
                _, facts = self.make(facts, as_type(condition.type))
        return facts

    # --- lists, strings, records ---

    def _list(self, facts: Assignment, item: TypeNode, size: int) -> Made:
        if size == 0:
            return (), facts
        spend(size)
        items: list[Object] = []
        for _, kind in zip(range(size), cycle(cases_or_whole(item)), strict=False):
            made, facts = self.make(facts, kind)
            items.append(made)
        return tuple(items), facts

    def _string_or_another(self, facts: Assignment, T: Str | Plus) -> Made:
        """A string of the first alternatives; if there is none, of other ones."""
        try:
            return self._make_string(facts, T)
        except RefusedError:
            if isinstance(T, Str) and events_of(T) is not None:
                raise
            return self._by_events(facts, T)

    def _make_string(self, facts: Assignment, T: Str | Plus) -> Made:
        items = T.items if isinstance(T, Str) else self._piece_types(T)
        pieces: list[Object] = []
        for item in items:
            piece, facts = self.make(facts, item)
            pieces.append(piece)
        return string_of(items, pieces), facts

    def _piece_types(self, T: Plus) -> list[TypeNode]:
        """The types of `size` pieces; the parts of a join take turns."""
        kinds = [case for one in alternatives(T.item) for case in cases_or_whole(one)]
        return list(islice(cycle(kinds), max(1, self._size)))

    def _record_or_settled(self, facts: Assignment, T: RecordType) -> Made:
        """A record, field by field, or else by what fields say of each other."""
        try:
            return self._record(facts, T)
        except RefusedError as error:
            refused = error
        settled = _settle_fields(T)
        for other in (settled, *_choose_types(settled)):
            if other is T:
                continue
            try:
                return self._record(facts, other)
            except RefusedError as error:
                refused = error
        raise refused

    def _record(self, facts: Assignment, T: RecordType) -> Made:
        spend(1 + len(T.fields))
        fields: dict[str, Object] = {}
        for label, field in T.fields:
            if type(field) is Singleton and is_reduced(field):
                fields[label] = value = field.value
                empty = type(value) is tuple and not value
                if not (empty and isinstance(field.base, ListOf)):
                    facts = _with_certainty(facts, value, field.base)
                continue
            if type(field) is ListOf and self._size == 0 and is_reduced(field):
                fields[label] = ()
                continue
            try:
                ground = resolve_paths(field, (fields,))
            except UnresolvedError as unresolved:
                around = describe_cycle(T)
                why = f"its fields go in a circle: {around}" * bool(around)
                raise RefusedError(
                    f"the field {label} cannot be created: {why or unresolved.message}",
                    hint="fields on a cycle can be judged, but not created",
                ) from unresolved
            fields[label], facts = self.make(facts, ground)
        if self._size > 1:
            fields[_another(fields)], facts = facts.with_new("a")
        return Record(fields), facts

    # --- functions ---

    def _function(self, facts: Assignment, T: FunType) -> Made:
        """The first of some functions that is of T."""
        for body, known in self._bodies(facts, T):
            made = Function(T.domain, body)
            if derivation(known, made, T).p == CERTAIN:
                return made, known
        with suppress(RefusedError):
            made, known = TermFinder(self.make).function(facts, T)
            if derivation(known, made, T).p == CERTAIN:
                return made, known
        raise RefusedError(f"a function of {T} cannot be made up, only be given")

    def _bodies(self, facts: Assignment, T: FunType) -> Iterator[Made]:
        """Bodies to try; constants come last where lists have one element."""
        constants = partial(self._constants, facts, T)
        x = Path(0, (BOUND,))
        of_x = RecordType(
            (("i", Singleton(shift_paths(T.domain, 2), Path(1, x.labels))),)
        )
        if self._size != 1:
            yield from constants()
        yield from ((x, facts), (of_x, facts))
        yield from constants()

    def _constants(self, facts: Assignment, T: FunType) -> Iterator[Made]:
        """A body that is the same for every argument, or that the type prescribes."""
        if isinstance(T.result, Singleton):
            yield T.result.value, facts
        if all(path.up > 0 for path in free_paths(T.result)):
            yield self.make(facts, shift_paths(T.result, -1))

    # --- meets, joins, negations ---

    def _make_case(self, facts: Assignment, T: TypeNode) -> Made:
        """A witness of the first case that has one."""
        refused = RefusedError(f"a witness of {T} cannot be made up, only be given")
        for case in _each_case(T, facts):
            try:
                sit, known = self._case(facts, case)
                _check(known, sit, case)
                return sit, known
            except TTRError as error:
                refused = RefusedError(error.message, hint=error.hint)
        raise refused

    def _case(self, facts: Assignment, T: TypeNode) -> Made:
        if not isinstance(T, Meet | Negation):
            return self.make(facts, T)
        parts = T.parts if isinstance(T, Meet) else (T,)
        values = [part.value for part in parts if isinstance(part, Singleton)]
        if values:
            value = reduce_applications(facts, values[0])
            return value, _with_certainty(facts, value, T)
        if any(map(is_of_strings, parts)):
            return self._by_events(facts, T)
        shapes = [part for part in parts if not isinstance(part, _FORMLESS)]
        if not shapes:
            sit, facts = facts.with_new("a" if _individual(parts) else "s")
            return sit, _with_certainty(facts, sit, T)
        if all(isinstance(shape, RecordType) for shape in shapes):
            shapes = [reduce(partial(_merge, facts), shapes)]
        functions = [shape for shape in shapes if isinstance(shape, FunType)]
        if len(functions) == len(shapes):
            shapes = [_one_function_type(functions)]
        sit, facts = self.make(facts, min(shapes, key=lambda U: type(U) in _VAGUE))
        return sit, _with_certainty(facts, sit, T)

    def _by_events(self, facts: Assignment, T: TypeNode) -> Made:
        """A string as an automaton above T says, judged to be of the rest of T, too."""
        refused = RefusedError(f"a witness of {T} cannot be made up, only be given")
        found = automaton_above(T)
        for labels in islice(shortest_words(found, self._size), TRIED):
            try:
                sit, known = self._make_string(facts, Str(*labels))
                return sit, _with_certainty(known, sit, T)
            except TTRError as error:
                refused = RefusedError(error.message, hint=error.hint)
        raise refused


def _each_case(T: TypeNode, facts: Assignment) -> Iterable[TypeNode]:
    """The cases of a type; the first that a search finds where they are too many."""
    found = cases(T)
    if found is not None:
        return found
    return islice(open_cases(T, None, facts.theory, lambda case: False), CASES)


_FORMLESS = (Basic, PType, Negation)
"""Types that do not determine the form of their witnesses."""

_VAGUE = (ListOf,)
"""Types of collections that leave the number of elements open."""

CASES = 16
"""The number of cases that are tried of a type that has very many."""

TRIED = 16
"""The number of strings that are tried for a meet, the shortest first."""


def _individual(parts: tuple[TypeNode, ...]) -> bool:
    return not any(isinstance(part, PType) for part in parts)


def _type(T: Universe, size: int) -> TypeNode:
    """A type of the universe: Rec, or for other sizes one of no lower universe."""
    if size == 0 or T is RecType:
        return Rec
    if T.level == 0:
        return Ind
    lower = Universe(T.name, T.level - 1)
    return lower if T.name == "Type" else RecordType((("type", lower),))


def _another(labels: Collection[str]) -> str:
    """A label that is not among these."""
    return next(one for one in map("more{}".format, count()) if one not in labels)


def _one_function_type(types: list[FunType]) -> FunType:
    """A type of functions that are of all these types."""
    domain = join(*[T.domain for T in types])
    return FunType(domain, meet(*[T.result for T in types]))


def _with_certainty(facts: Assignment, sit: Object, T: TypeNode) -> Assignment:
    """The assignment itself if sit is certainly of T, else one in which it is."""
    return facts if is_certain(facts, sit, T) else with_judgement(facts, sit, T)


def _merge(facts: Assignment, S: TypeNode, T: TypeNode) -> TypeNode:
    return merge(S, T, facts.theory)
