"""How probable it is that something is of a type, or that any one object is.

p(T) is the probability that something is of T; p(T | S) that something is, given that
something is of S; and p(T || S) that any one object is of T, given that it is of S
(Cooper, Dobnik, Lappin and Larsson 2015). Of an open type there may be more objects
than are known; `ttr.semantics.quantifiers.truth`, which is for quantified types, takes
the known ones for all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from ttr.computing.normalisation import normal_type
from ttr.computing.subtyping import subtype
from ttr.errors import RefusedError, UnsupportedError
from ttr.judging.assignments import Assignment
from ttr.judging.conditioning import derive_conditional
from ttr.judging.degrees_of_claims import probability_of
from ttr.judging.dependence_analysis import dependence
from ttr.judging.evaluator import claims_of, derivation
from ttr.judging.judgements import Why
from ttr.judging.witnesses import (
    can_be_listed,
    candidates,
    listed_type,
    some_candidates,
    witnesses,
)
from ttr.probability import (
    CERTAIN,
    REFUTED,
    UNKNOWN,
    AnyOf,
    Atomic,
    Degree,
    Event,
    ImpossibleError,
)
from ttr.probability.events import SURE
from ttr.signature.signature import (
    Condition,
    Signature,
    format_argument,
    value_of,
)
from ttr.types.objects import Object, Path
from ttr.types.printing import notation
from ttr.types.syntax import TypeNode, as_type, meet

TRIED = 1_000
"""The number of objects that are judged one by one; any others may be of the type."""

SHOWN = 3
"""The number of objects that are named at each end of the range."""


@dataclass(frozen=True)
class Range:
    """p(T || S): from the least to the most probable object, each with its reason."""

    type: TypeNode
    when: tuple[TypeNode, ...]
    p: Degree
    whys: tuple[Why, ...]

    def __str__(self) -> str:
        """The probability, then the objects one by one, the least probable first."""
        whys = sorted(self.whys, key=lambda why: why.p)
        ends = dict.fromkeys([*whys[:SHOWN], *whys[-SHOWN:]])
        given = ", ".join(map(str, self.when))
        head = f"P({self.type} || {given}) = {self.p}   ({_count_objects(len(whys))})"
        return "\n".join([head, *(f"  {why.p}: {notation(why.sit)}" for why in ends)])


def _count_objects(number: int) -> str:
    return "1 object" if number == 1 else f"{number} objects"


def probability_of_any(
    facts: Assignment,
    T: TypeNode,
    when: Sequence[TypeNode],
    among: Iterable[Object] | None = None,
) -> Range:
    """p(T || S, …): how probable it is that any one object of every S is of T.

    The objects are the known ones that may be of every S, or those in `among`. The
    answer is certain where S is a subtype of T, refuted where it is a subtype of ~T,
    and unknown where there is no such object.
    """
    S = meet(*when)
    if subtype(S, T, facts.theory).yes:
        return Range(T, tuple(when), CERTAIN, ())
    if subtype(S, ~T, facts.theory).yes:
        return Range(T, tuple(when), REFUTED, ())
    objects = facts.objects() if among is None else among
    whys = []
    for sit in objects:
        if derivation(facts, sit, S).p != REFUTED:
            whys.append(derive_conditional(facts, sit, T, [(sit, S)]))
    if not whys:
        return Range(T, tuple(when), UNKNOWN, ())
    lo, hi = min(why.p.lo for why in whys), max(why.p.hi for why in whys)
    return Range(T, tuple(when), Degree(lo, hi), tuple(whys))


def probability_of_some(
    facts: Assignment,
    T: TypeNode,
    when: TypeNode | None = None,
    among: Iterable[Object] | None = None,
) -> Degree:
    """p(T), or p(T | S): how probable it is that something is of T.

    If T is closed, this is one of the known objects; if T is open, there may be others,
    and also where there is no end of what may be of it, as with negations. With `among`
    it is one of these objects. Raises `RefusedError` where nothing can be of S.
    """
    if when is not None and subtype(when, T, facts.theory).yes:
        return CERTAIN
    objects = None if among is None else list(among)
    is_listed = can_be_listed(T)
    if when is None and objects is None and is_listed:
        known = next(witnesses(facts, T), None)
        if known is not None:
            return CERTAIN
    whys, event = _some_event(facts, T, objects)
    more, given = _some_event(facts, when, objects) if when is not None else ([], None)
    known = dependence(facts, claims_of([*whys, *more]))
    try:
        found = probability_of(event, known, SURE if given is None else given)
    except ImpossibleError:
        raise RefusedError(
            f"nothing is of {when}, so nothing follows from it"
        ) from None
    if objects is not None or is_listed:
        return found.p
    return Degree(found.p.lo, min(found.p.hi, _most_probable(facts, T, when)))


def _most_probable(facts: Assignment, T: TypeNode, when: TypeNode | None) -> float:
    """How probable T is at most, as far as what can be listed of it goes."""
    above = listed_type(T)
    return 1.0 if above is None else probability_of_some(facts, above, when).hi


@dataclass(frozen=True)
class IsTrue(Condition):
    """The condition of an axiom that something is of T; a path is a variable."""

    type: Object

    @property
    def terms(self) -> tuple[Object, ...]:
        """The type, or the variable for it."""
        return (self.type,)

    def with_values(self, bound: Mapping[Path, Object]) -> IsTrue:
        """The condition on the value of its variable."""
        return IsTrue(value_of(self.type, bound))

    def compare(self, theory: Signature) -> tuple[str, str]:
        """Unknown: of what there is something depends on the model."""
        return "unknown", f"{self} depends on what there is"

    def degree(self, facts: Assignment) -> tuple[Degree, str]:
        """p(T); unknown where the objects of T cannot be listed."""
        T = normal_type(as_type(self.type), facts.theory)
        try:
            p = probability_of_some(facts, T)
        except UnsupportedError:
            p = UNKNOWN
        return p, f"{T} is true" if p == CERTAIN else f"P({T}) = {p}"

    def __str__(self) -> str:
        return f"true({format_argument(self.type)})"


def _some_event(
    facts: Assignment, T: TypeNode, among: Sequence[Object] | None
) -> tuple[list[Why], Event]:
    """The event that something is of T, with a derivation for each object."""
    is_listed = among is not None or can_be_listed(T)
    listing = candidates if is_listed else some_candidates
    objects = listing(facts, T) if among is None else iter(among)
    whys = [derivation(facts, sit, T) for sit in islice(objects, TRIED)]
    events = [why.event() for why in whys if why.p != REFUTED]
    more = next(objects, None) is not None
    if more or not is_listed or (among is None and facts.leaves_open(T)):
        events.append(Atomic(("another object", T), UNKNOWN))
    return whys, AnyOf(tuple(events))
