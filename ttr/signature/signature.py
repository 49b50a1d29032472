"""What a theory assumes: axioms, exclusions, open types, judgements that are given."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

from ttr.aliases import Alias
from ttr.errors import IllFormedError, Span
from ttr.escapes import json_text
from ttr.persistent_maps import Map
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree
from ttr.types.interning import as_notation
from ttr.types.objects import Object, Path, Record
from ttr.types.printing import Scope
from ttr.types.syntax import Basic, Pred, PType, RecordType, TypeNode, kind_of

if TYPE_CHECKING:
    from ttr.judging.assignments import Assignment
    from ttr.updates.update_strategies import Algorithm

Head: TypeAlias = Basic | Pred
"""What an axiom is about: a basic type, or the predicate of a ptype."""

Interval = tuple[float, float]
"""An interval of probability [lo, hi] with 0 <= lo <= hi <= 1."""


class Condition(ABC):
    """A condition under which an axiom holds, on types and variables.

    What it takes to answer it lies above this room: it is a value that can be asked.
    """

    @property
    @abstractmethod
    def terms(self) -> tuple[Object, ...]:
        """What it is about: types, and paths for variables."""

    @abstractmethod
    def with_values(self, bound: Mapping[Path, Object]) -> Condition:
        """The condition on the values of its variables."""

    def narrowest(self, bound: Mapping[Path, Object]) -> Mapping[Path, Object]:
        """For a variable that may have any value above another's, that one."""
        return {}

    @property
    def holds_by_form(self) -> bool:
        """Does it hold whatever the theory and the model?"""
        return False

    @abstractmethod
    def compare(self, theory: Signature) -> tuple[str, str]:
        """Is it derivable or refuted in every model: yes, no or unknown; and why."""

    def degree(self, facts: Assignment) -> tuple[Degree, str]:
        """How certain it is in a model, and why."""
        verdict, why = self.compare(facts.theory)
        return {"yes": CERTAIN, "no": REFUTED}.get(verdict, UNKNOWN), why


def value_of(term: Object, bound: Mapping[Path, Object]) -> Object:
    """The value of a variable, if it has one; any other term itself."""
    return bound.get(term, term) if isinstance(term, Path) else term


@dataclass(frozen=True)
class Axiom:
    """A declared subtyping S <: T; paths in it are schematic variables.

    `right(x, y) <: left(y, x)` says that every situation in which x is right of y is
    one in which y is left of x, whatever x and y are. With conditions `when` it says so
    only of those values of the variables for which they hold; with conditions `only`
    there is such a situation only where these hold.
    """

    lower: Basic | PType
    upper: Basic | PType
    when: tuple[Condition, ...] = ()
    only: tuple[Condition, ...] = ()

    @cached_property
    def variables(self) -> frozenset[Object]:
        """The schematic variables."""
        terms = [
            arg for T in (self.lower, self.upper) for arg in getattr(T, "args", ())
        ]
        conditions = (*self.when, *self.only)
        terms += [term for condition in conditions for term in condition.terms]
        return frozenset(term for term in terms if isinstance(term, Path))

    def __str__(self) -> str:
        pair = f"{_format_schema(self.lower)} <: {_format_schema(self.upper)}"
        for word, conditions in ((" if ", self.when), (" only if ", self.only)):
            if conditions:
                pair += word + ", ".join(map(str, conditions))
        return pair


@dataclass(frozen=True)
class Exclusion:
    """A declared S <: ~T: nothing is of both; paths in it are schematic variables.

    `dog(x) <: ~cat(x)` says that no situation makes x a dog and a cat.
    """

    left: Basic | PType
    right: Basic | PType

    def __str__(self) -> str:
        return f"{_format_schema(self.left)} <: ~{_format_schema(self.right)}"


def _format_schema(T: Basic | PType) -> str:
    """The type with its variables bare and the names of objects quoted."""
    if isinstance(T, Basic):
        return T.name
    return f"{T.pred.name}({', '.join(map(format_argument, T.args))})"


def format_argument(arg: Object) -> str:
    """A variable bare, the name of an object quoted, anything else as notation."""
    match arg:
        case Path(_, labels):
            return labels[0]
        case str():
            return json_text(arg)
    return as_notation(arg)


@dataclass(frozen=True)
class Given:
    """A judgement that a theory states: a : T with a probability.

    If `when` has other judgements, it is the probability given those.
    """

    sit: Object
    type: TypeNode
    p: Interval = (1.0, 1.0)
    span: Span | None = None
    when: tuple[tuple[Object, TypeNode], ...] = ()


@dataclass(frozen=True)
class Expected:
    """p(T || S₁, …): how probable T is for whatever is of all the conditions."""

    type: TypeNode
    when: tuple[TypeNode, ...]
    p: Interval
    span: Span | None = None


@dataclass(frozen=True)
class Opening:
    """How a theory declares a game: all of it but the model in which it is played.

    `start` is its first state, of `type`; `agenda` is the path of planned moves;
    `hears` are the types of events from outside, where these are restricted, and
    `heard_at` the places where these types are written.
    """

    name: str
    type: RecordType
    start: Record
    algorithm: Algorithm
    agenda: str | None = None
    span: Span | None = None
    hears: tuple[TypeNode, ...] = ()
    heard_at: tuple[Span, ...] = ()


def _no_definitions() -> Mapping[str, Object]:
    return Map()


@dataclass(frozen=True, eq=False)
class Signature:
    """What models and subtyping need of a theory: axioms, open types, judgements."""

    axioms: tuple[Axiom, ...] = ()
    opened: frozenset[Head] = frozenset()
    givens: tuple[Given | Expected, ...] = ()
    definitions: Mapping[str, Object] = field(default_factory=_no_definitions)
    exclusions: tuple[Exclusion, ...] = ()
    declared: Mapping[str, TypeNode] = field(default_factory=dict)
    """The types with which objects are declared: they hold in every model."""

    spelling: Scope = ()
    """How its text writes what it defines; the scope around what is printed of it."""

    @cached_property
    def _memo(self) -> dict[object, Any]:
        """What `ttr.signature.axioms` has derived from the axioms so far."""
        return {}

    @cached_property
    def axiom_heads(self) -> frozenset[Head]:
        """The basic types and predicates that an axiom or an exclusion is about."""
        axioms = [T for one in self.axioms for T in (one.lower, one.upper)]
        exclusions = [T for one in self.exclusions for T in (one.left, one.right)]
        return frozenset(map(head, (*axioms, *exclusions)))

    @cached_property
    def conditional_axioms(self) -> tuple[Axiom, ...]:
        """The axioms that hold under conditions."""
        return tuple([one for one in self.axioms if one.when])

    @cached_property
    def restrictive_axioms(self) -> tuple[Axiom, ...]:
        """The axioms that say on which conditions alone there is a situation."""
        return tuple([one for one in self.axioms if one.only])

    @cached_property
    def conditional_heads(self) -> frozenset[Head]:
        """The basic types and predicates that axioms with conditions may lead to."""
        heads = [head(one.upper) for one in self.conditional_axioms]
        steps = [(head(one.lower), head(one.upper)) for one in self.axioms]
        return frozenset(reachable_heads(heads, steps))

    related = Alias("axiom_heads")

    def __post_init__(self) -> None:
        if not isinstance(self.axioms, tuple):
            raise IllFormedError(
                f"a theory is made of a tuple of axioms, found {kind_of(self.axioms)}",
                hint="to read a text, write Theory.parse(text)",
            )


def head(T: Basic | PType) -> Head:
    """The basic type itself, or the predicate of a ptype."""
    return T if isinstance(T, Basic) else T.pred


def reachable_heads(
    heads: Iterable[Head], steps: Iterable[tuple[Head, Head]]
) -> tuple[Head, ...]:
    """These heads and those to which steps lead from them, the nearest first."""
    following: dict[Head, list[Head]] = {}
    for one, next_ in steps:
        following.setdefault(one, []).append(next_)
    found = dict.fromkeys(heads)
    waiting = list(found)
    for one in waiting:
        new = [it for it in following.get(one, ()) if it not in found]
        found.update(dict.fromkeys(new))
        waiting += dict.fromkeys(new)
    return tuple(found)


def signature_of(theory: object) -> Signature:
    """The theory, or the empty one for None; raises `IllFormedError` for anything
    else.
    """
    if theory is None:
        return _EMPTY
    if not isinstance(theory, Signature):
        raise IllFormedError(f"expected a theory, found {kind_of(theory)}")
    return theory


_EMPTY = Signature()
