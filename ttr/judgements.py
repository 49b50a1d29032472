"""Austinian judgements, and the derivations that say why they hold or fail."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from ttr.errors import Undecided
from ttr.printing import notation
from ttr.probability import CERTAIN, REFUTED, Degree
from ttr.syntax import Basic, Object, PType, TypeNode, identity

if TYPE_CHECKING:
    from ttr.models import Model

__all__ = ["Claim", "Judgement", "Why"]

Claim: TypeAlias = tuple[object, Basic | PType]
"""An atomic judgement: the identity of an object, and the type it is asked to be of."""


@dataclass(frozen=True, eq=False)
class Why:
    """A step of a derivation: what is claimed, how probable, by which rule, from what.

    `where` is the path of the field this step is about, from the one above.
    """

    sit: Object
    type: TypeNode
    p: Degree
    rule: str
    parts: tuple[Why, ...] = ()
    where: str = ""
    atom: Claim | None = None

    def atoms(self) -> Iterator[tuple[Claim, Degree]]:
        """The atomic judgements it rests on, in order, as often as they occur."""
        waiting = [self]
        while waiting:
            step = waiting.pop()
            if step.atom is not None:
                yield step.atom, step.p
            waiting.extend(reversed(step.parts))

    def failure(self) -> Why | None:
        """The step at the bottom that fails first, or None where all is certain.

        What is refuted fails before what is only uncertain.
        """
        if self.p == CERTAIN:
            return None
        failing = self._failing()
        return failing.failure() if failing else self

    def path(self) -> str:
        """The path of the field that fails first, or the empty string."""
        failing = self._failing()
        if failing is None:
            return ""
        return ".".join(filter(None, (failing.where, failing.path())))

    def _failing(self) -> Why | None:
        uncertain = [part for part in self.parts if part.p != CERTAIN]
        refuted = [part for part in uncertain if part.p == REFUTED]
        return next(iter([*refuted, *uncertain]), None)

    def __str__(self) -> str:
        """The derivation as an indented tree, what is claimed before its grounds."""
        return "\n".join(self._lines(""))

    def _lines(self, indent: str) -> Iterator[str]:
        where = f"{self.where}: " if self.where else ""
        claim = f"{notation(self.sit)} : {self.type}"
        yield f"{indent}{_mark(self.p)} {where}{claim}   ({self.rule})"
        for part in self.parts:
            yield from part._lines(indent + "  ")


def _mark(p: Degree) -> str:
    if p == CERTAIN:
        return "✓"
    return "✗" if p == REFUTED else f"p = {p}"


@dataclass(frozen=True, eq=False)
class Judgement:
    """s : T with a probability: a situation, a type, an interval and the reason.

    Two judgements are equal when situation, type and probability are the same. `model`
    is the model that has what was judged on the way.
    """

    sit: Object
    type: TypeNode
    p: Degree
    why: Why
    model: Model = field(repr=False)

    @property
    def holds(self) -> bool:
        """True at [1, 1], False at [0, 0]; else it raises `Undecided`."""
        if self.p in (CERTAIN, REFUTED):
            return self.p == CERTAIN
        raise Undecided(
            f"{self} is neither certain nor refuted",
            hint="ask for a degree with j.at_least(q), or look at j.p",
        )

    def at_least(self, q: float) -> bool:
        """Whether the probability is surely q or more."""
        return self.p.lo >= q

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
