"""Austinian judgements, and the derivations that say why they hold or fail."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Literal, TypeAlias, assert_never

from ttr.errors import UndecidedError
from ttr.probability import (
    CERTAIN,
    REFUTED,
    All,
    AnyOf,
    Atomic,
    Degree,
    Event,
    Not,
    degree,
)
from ttr.showing import NotebookValue
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.short_notation import shorten_notation
from ttr.types.syntax import Basic, PType, TypeNode

if TYPE_CHECKING:
    from ttr.judging.assignments import Assignment
    from ttr.judging.models import Model

How: TypeAlias = Literal["all", "any", "none"]
"""What a claim needs of its grounds: that all of them hold, or any, or none."""

SHOWN = 3
"""The number of types or objects that a remedy names."""

_ROOM = 80
"""The columns that an object, or its type, has in a line of a derivation."""


@dataclass(frozen=True, eq=False)
class Why(NotebookValue):
    """A step of a derivation: the claim, its probability, the rule and the grounds.

    `where` is the label of the field that the step is about, and `how` what the claim
    needs of its `parts`. A claim that fails has the `facts` that it failed by.
    `reckoned` says how the degree follows from those of the parts, and `alone` is the
    degree of a judgement before others that it depends on were taken into account.
    """

    sit: Object
    type: TypeNode
    p: Degree
    rule: str
    parts: Sequence[Why] = ()
    where: str = ""
    how: How = "all"
    facts: Assignment | None = field(default=None, repr=False)
    reckoned: Callable[[], str] | None = field(default=None, repr=False)
    alone: Degree | None = field(default=None, repr=False)

    def event(self) -> Event:
        """The claim as an event made of the uncertain judgements that it rests on."""
        if self.p == CERTAIN:
            return All(())
        if self.p == REFUTED:
            return AnyOf(())
        if not self.parts:
            return Atomic((identity(self.sit), self.type), self.p)
        return combine_events(self.how, self.parts)

    def uncertain(self) -> Iterator[Why]:
        """The uncertain judgements that it rests on, in order, with repetitions."""
        waiting = [self]
        while waiting:
            step = waiting.pop()
            if step.p in (CERTAIN, REFUTED):
                continue
            if not step.parts:
                yield step
            waiting.extend(reversed(step.parts))

    @property
    def because(self) -> str:
        """The rule, the arithmetic and, where the claim fails, a remedy."""
        reckoning = self.reckoned() if self.reckoned else ""
        return "; ".join(filter(None, (self.rule, reckoning, self.remedy())))

    def failure(self) -> Why | None:
        """The first failing step that rests on no other; None where all is certain.

        What is refuted fails before what is only uncertain.
        """
        if self.p == CERTAIN:
            return None
        failing = self._first_failing_part()
        return failing.failure() if failing else self

    def path(self) -> str:
        """The path of the first field that fails, or the empty string."""
        failing = self._first_failing_part()
        if failing is None:
            return ""
        return ".".join(filter(None, (failing.where, failing.path())))

    def remedy(self) -> str:
        """For a claim that fails: what the object is of, and which objects would do.

        >>> from ttr import Ind, Model, Pred
        >>> dog = Pred("dog", Ind)
        >>> M = Model().given("s1", dog("fido")).given("s2", dog("sam"))
        >>> M.judge("s2", dog("fido")).why.remedy()
        's2 is of dog(sam); s1 would do'
        """
        if self.facts is None:
            return ""
        found = (
            _describe_types(self.facts, self.sit),
            _describe_remedy(self.facts, self.type),
        )
        return "; ".join(filter(None, found))

    def _first_failing_part(self) -> Why | None:
        if self.how == "none":
            return None
        uncertain = [part for part in self.parts if part.p != CERTAIN]
        refuted = [part for part in uncertain if part.p == REFUTED]
        return next(iter([*refuted, *uncertain]), None)

    def __str__(self) -> str:
        """The derivation as an indented tree, what is claimed before its grounds.

        What is long is shortened, as its parts have it in steps of their own;
        `ttr.box(why)` draws all of it.
        """
        return "\n".join(self._lines(""))

    def _lines(self, indent: str) -> Iterator[str]:
        where = f"{self.where}: " if self.where else ""
        sit, kind = (
            shorten_notation(it, _ROOM) for it in (notation(self.sit), str(self.type))
        )
        claim = f"{sit} : {kind}"
        yield f"{indent}{mark(self.p)} {where}{claim}   ({self.because})"
        for part in self.parts:
            yield from part._lines(indent + "  ")


def combine_events(how: How, parts: Sequence[Why]) -> Event:
    """The event that all of the parts hold, or any, or none."""
    events = tuple([part.event() for part in parts])
    match how:
        case "all":
            return All(events)
        case "any":
            return AnyOf(events)
        case "none":
            return Not(AnyOf(events))
    raise assert_never(how)


def degree_if_decided(how: How, degrees: Sequence[Degree | None]) -> Degree | None:
    """The degree of a claim if its certain or refuted grounds decide it; else None.

    None among the degrees is one that is not known.
    """
    if how == "all":
        if REFUTED in degrees:
            return REFUTED
        return CERTAIN if all(p == CERTAIN for p in degrees) else None
    some = CERTAIN in degrees
    if not some and any(p != REFUTED for p in degrees):
        return None
    return CERTAIN if some == (how == "any") else REFUTED


def _describe_types(facts: Assignment, sit: Object) -> str:
    kinds = [
        shorten_notation(it, _ROOM) for it in sorted(map(str, facts.types_of(sit)))
    ]
    shown = ", ".join(kinds[:SHOWN]) + ", …" * (len(kinds) > SHOWN)
    return f"{shorten_notation(notation(sit), _ROOM)} is of {shown}" if kinds else ""


def _describe_remedy(facts: Assignment, T: TypeNode) -> str:
    if not isinstance(T, Basic | PType):
        return ""
    some = list(islice(facts.witnesses(T), SHOWN + 1))
    names = ", ".join(map(notation, some[:SHOWN])) + ", …" * (len(some) > SHOWN)
    return f"{names} would do" if some else ""


def mark(p: Degree) -> str:
    """The sign before a step of a derivation: ✓, ✗ or the degree.

    >>> mark(CERTAIN), mark(Degree(0.5, 0.5))
    ('✓', 'p = 0.5')
    """
    if p == CERTAIN:
        return "✓"
    return "✗" if p == REFUTED else f"p = {p}"


@dataclass(frozen=True, eq=False)
class Judgement(NotebookValue):
    """s : T with a probability: a situation, a type, an interval and the reason.

    Two judgements are equal if situation, type and probability are. `model` is the
    model with all that was judged on the way. The reason may be derived only when it is
    first asked for.
    """

    sit: Object
    type: TypeNode
    p: Degree
    reason: Why | Callable[[], Why] = field(repr=False)
    model: Model = field(repr=False)

    @cached_property
    def why(self) -> Why:
        """The derivation."""
        return self.reason if isinstance(self.reason, Why) else self.reason()

    @property
    def holds(self) -> bool:
        """True at [1, 1], False at [0, 0]; else it raises `UndecidedError`."""
        if self.p in (CERTAIN, REFUTED):
            return self.p == CERTAIN
        raise UndecidedError(
            f"{self} is neither certain nor refuted",
            hint="ask for a degree with j.at_least(q), or look at j.p",
        )

    def at_least(self, q: float) -> bool:
        """Is the probability certainly q or more?

        >>> from ttr import Ind, Model
        >>> j = Model().given("a", Ind, (0.2, 0.4)).judge("a", Ind)
        >>> j.at_least(0.2), j.at_least(0.3)
        (True, False)
        """
        return self.p.lo >= degree(q, "what a judgement is asked for").hi

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Judgement):
            return NotImplemented
        return self._content() == other._content()

    def __hash__(self) -> int:
        return hash(self._content())

    def _content(self) -> tuple[object, ...]:
        return identity(self.sit), self.type, self.p

    def __bool__(self) -> bool:
        raise TypeError("a judgement has a degree: ask j.holds or j.at_least(q)")

    def __str__(self) -> str:
        return f"{notation(self.sit)} : {self.type}   p = {self.p}"
