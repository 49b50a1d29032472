"""Summaries of effects: what they read and write, and whether they may refuse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ttr.errors import Span
from ttr.types.syntax import RecordType, TypeNode
from ttr.updates.checks.state_layout import Labels, Term


@dataclass(frozen=True)
class Access:
    """A path that is used: the variable it starts at, and labels with their places."""

    variable: str
    path: Labels
    spans: tuple[Span | None, ...]


@dataclass(frozen=True)
class Write:
    """A path of the state that is set: to which term, of which type, if that is known.

    Where neither term nor type is known, it may be set to anything.
    """

    path: Labels
    term: Term | None = None
    type: TypeNode | None = None
    span: Span | None = None


@dataclass(frozen=True)
class Built:
    """A record type that a Python effect builds and returns, with its labels' places.

    Its fields are record types where the effect builds those, too, and `Rec` elsewhere.
    """

    type: RecordType
    places: tuple[tuple[Labels, Span], ...]


Outcome: TypeAlias = tuple[Write, ...]
"""What is written in one of the states that an effect may return."""


@dataclass(frozen=True)
class EffectSummary:
    """What is known of an effect without running it.

    Each of the `outcomes` is what one of the states that it may return has written in
    it; unless the summary is `complete` there may be others. `may_refuse` says that it
    may return None. `replaced` are the paths that are replaced in the state, the event
    or a binding, `undefined` the names that nothing binds, and `built` the record types
    that it returns.
    """

    reads: tuple[Access, ...] = ()
    outcomes: tuple[Outcome, ...] = ()
    complete: bool = False
    may_refuse: bool = True
    replaced: tuple[Access, ...] = ()
    undefined: tuple[tuple[str, Span | None], ...] = ()
    built: tuple[Built, ...] = ()

    @property
    def writes(self) -> tuple[Write, ...]:
        """What is written in any of the outcomes."""
        return tuple(write for outcome in self.outcomes for write in outcome)


UNKNOWN_EFFECT = EffectSummary()
"""The summary of an effect whose source cannot be read."""
