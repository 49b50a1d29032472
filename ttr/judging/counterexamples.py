"""Counterexamples: new witnesses of one type that are not of another."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from itertools import count, product

from ttr.computing.generic_witness import (
    ITSELF,
    Assumption,
    elements,
    is_element,
)
from ttr.computing.path_cycles import break_cycles
from ttr.computing.strings.pieces import is_of_strings
from ttr.computing.subtyping import Refutation, counterexample
from ttr.errors import TTRError
from ttr.judging.assignments import Assignment
from ttr.judging.creation import create_witness, with_judgement
from ttr.judging.judgements import Judgement, Why
from ttr.judging.models import Model
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.safety.budgets import spend
from ttr.signature.signature import Signature
from ttr.types.derived_types import order_fields
from ttr.types.objects import Object, Path, UnresolvedError
from ttr.types.paths import (
    free_paths,
    map_parts,
    mentions,
    paths_to_types,
    replace_paths,
    subterms,
)
from ttr.types.substitution import follow_path
from ttr.types.syntax import (
    Basic,
    ListOf,
    Negation,
    NonEmpty,
    RecordType,
    SetOf,
    Singleton,
    TypeAt,
    TypeNode,
    Universe,
    meet,
)

SIZES = (1, 0, 2)
"""The numbers of elements of lists and sets to try; one shows the most."""


@counterexample.provided_by
def find_counterexample(refutation: Refutation) -> Judgement | None:
    """A judgement of a witness of S that is not of T; None if none was found."""
    T, theory = refutation.T, refutation.theory
    starts = [*_starts(refutation), *_with_what_is_denied(refutation)]
    for size, (S, assumed) in product(SIZES, starts):
        found = _find_witness(S, theory, assumed, size)
        if found is None or _degree(found, refutation.S) != CERTAIN:
            continue
        if _degree(found, T) == REFUTED:
            against = found.model.judge(found.sit, T)
            return replace(against, type=refutation.asked or T)
    return None


Start = tuple[TypeNode, tuple[Assumption, ...]]


def _starts(refutation: Refutation) -> list[Start]:
    """What to make a witness of, and what to tell of it then.

    What was assumed of the whole witness says what form it has; and what was assumed of
    a field, what else that is: a certain object, say, or a string of some length.
    """
    S, assumed = refutation.S, refutation.assumed
    if not assumed:
        starts = (S, break_cycles(S), _tell_types_apart(S))
        return [(one, ()) for one in dict.fromkeys(starts)]
    of_it = [T for term, T in assumed if term is ITSELF]
    others = tuple([pair for pair in assumed if pair[0] is not ITSELF])
    narrower = [one for pair in others if (one := _with_part(S, *pair)) is not None]
    return [*((one, ()) for one in narrower), (meet(S, *of_it), others), (S, ())]


def _tell_types_apart(S: TypeNode) -> TypeNode:
    """S where each field that others have as their type is a basic type of its own."""
    if not isinstance(S, RecordType) or not mentions(S, TypeAt):
        return S
    used = {path.labels for _, field in S.fields for path in paths_to_types(field)}
    taken = {part.name for part in subterms([S]) if isinstance(part, Basic)}
    new = (name for n in count(1) if (name := f"A{n}") not in taken)
    fields = {
        label: Singleton(field, Basic(next(new)))
        if (label,) in used and isinstance(field, Universe)
        else field
        for label, field in S.fields
    }
    return RecordType(order_fields(fields))


def _with_what_is_denied(refutation: Refutation) -> list[Start]:
    """S where also is the case what T denies inside, of values of functions, say."""
    S, T = refutation.S, refutation.T
    if not mentions(T, Negation) or isinstance(T, Negation):
        return []
    return [(meet(S, _affirm(T)), ())]


def _affirm(value: Object) -> TypeNode:
    """The type without the negations in it: what they deny is so."""
    while isinstance(value, Negation):
        value = value.body
    found: TypeNode = map_parts(value, lambda part, _: _affirm(part))
    return found


def _with_part(S: TypeNode, term: Object, T: TypeNode) -> TypeNode | None:
    """S where what is in a field is also of T; None where the term is in no field."""
    if not isinstance(term, Path):
        return None
    first, *labels = term.labels
    if first != ITSELF.labels[0] or not labels:
        return None
    inner = replace_paths(T, partial(_seen_from, labels))
    return None if _leads_outside(inner) else _with_field(S, labels, inner)


def _with_field(S: TypeNode, labels: list[str], T: TypeNode) -> TypeNode | None:
    """S where a field is also of T; None where the labels lead to none.

    A type of strings is put in the place of the other, which it is below.
    """
    if not labels:
        return T if is_of_strings(T) else meet(S, T)
    first, *rest = labels
    if isinstance(S, ListOf | NonEmpty | SetOf) and is_element(first):
        item = _with_field(S.item, rest, T)
        return None if item is None else type(S)(item)
    if not isinstance(S, RecordType) or first not in S:
        return None
    inner = _with_field(S[first], rest, T)
    if inner is None:
        return None
    fields = [(label, inner if label == first else U) for label, U in S.fields]
    return RecordType(tuple(fields))


def _leads_outside(T: TypeNode) -> bool:
    """Does a type mention places that no path from a field leads to?"""
    return any(
        path.up == 0 and path.labels[0].startswith(ITSELF.labels[0])
        for path in free_paths(T)
    )


def _seen_from(at: list[str], place: Path) -> Path:
    """A place in the witness as a path from what is at the end of these labels.

    It starts at the innermost record around both. The place itself if there is none.
    """
    first, *labels = place.labels
    if first != ITSELF.labels[0]:
        return place
    for shared in reversed(range(min(len(at), len(labels)))):
        depth = len([label for label in at[shared:] if not is_element(label)]) - 1
        rest = labels[shared:]
        if at[:shared] == labels[:shared] and depth >= 0:
            return place if any(map(is_element, rest)) else Path(depth, tuple(rest))
    return place


def _degree(found: Judgement, T: TypeNode) -> Degree | None:
    """How certainly the object is of T too; None if T has paths that lead out of it."""
    try:
        return found.model.judge(found.sit, T).p
    except TTRError:
        return None


def _find_witness(
    S: TypeNode,
    theory: Signature,
    assumed: Iterable[Assumption] = (),
    size: int = 1,
) -> Judgement | None:
    """A judgement of a made-up witness of S, of which also this is so, if there is one.

    `size` is how many elements the lists and sets in it have, if they may.
    """
    spend()
    known = Signature(axioms=theory.axioms, exclusions=theory.exclusions)
    facts = Assignment(known).with_assumptions()
    try:
        sit, facts = create_witness(facts, S, size)
        for term, T in assumed:
            facts = _with_assumption(facts, sit, term, T)
    except TTRError:
        return None
    made = Judgement(sit, S, CERTAIN, Why(sit, S, CERTAIN, "made up"), Model.of(facts))
    return made if _degree(made, S) == CERTAIN else None


def _with_assumption(
    facts: Assignment, sit: Object, term: Object, T: TypeNode
) -> Assignment:
    """The assignment in which also a part of the witness, or an object, is of T."""
    if not isinstance(term, Path):
        return with_judgement(facts, term, T)
    if term.labels[0] != ITSELF.labels[0]:
        return facts
    return with_judgement(facts, _part(sit, term.labels[1:]), T)


def _part(sit: Object, labels: tuple[str, ...]) -> Object:
    """Where the labels lead, through elements of lists and sets too."""
    for label in labels:
        inside = elements(sit)
        if inside is None:
            sit = follow_path(sit, (label,))
            continue
        number = int(label) if label.isdigit() else 0
        if number >= len(inside):
            raise UnresolvedError("there is no such element")
        sit = inside[number]
    return sit
