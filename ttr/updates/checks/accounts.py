"""Accounts of rules: what effects read and write, and whether they may refuse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ttr.errors import Span
from ttr.types.syntax import RecordType, TypeNode
from ttr.updates.checks.state_layout import Labels, Term

__all__ = ["OPAQUE", "Access", "Account", "Built", "Outcome", "Write"]


@dataclass(frozen=True)
class Access:
    """A path that is read: the variable it starts at, and labels with their places."""

    variable: str
    path: Labels
    spans: tuple[Span | None, ...]


@dataclass(frozen=True)
class Write:
    """A path of the state that is set: to what, and of which type, where that is told.

    Where neither a term nor a type is told, it may be set to anything.
    """

    path: Labels
    term: Term | None = None
    type: TypeNode | None = None
    span: Span | None = None


@dataclass(frozen=True)
class Built:
    """A record type that an effect builds and gives: its labels, with their places.

    Its fields are record types where those are built, too, and else `Rec`.
    """

    type: RecordType
    places: tuple[tuple[Labels, Span], ...]


Outcome: TypeAlias = tuple[Write, ...]
"""What is written in a state that an effect may give."""


@dataclass(frozen=True)
class Account:
    """What is known of an effect without running it.

    Each of the `outcomes` is what is written in a state that it may give; where `whole`
    is false, it may write other things, too. `refuses` says that it may give None;
    `replaced` are the paths that are replaced in the state, the event or a binding,
    wherever that is done, `undefined` the names that nothing binds, and `built` the
    record types that it gives.
    """

    reads: tuple[Access, ...] = ()
    outcomes: tuple[Outcome, ...] = ()
    whole: bool = False
    refuses: bool = True
    replaced: tuple[Access, ...] = ()
    undefined: tuple[tuple[str, Span | None], ...] = ()
    built: tuple[Built, ...] = ()

    @property
    def writes(self) -> tuple[Write, ...]:
        """What is written in any of the outcomes."""
        return tuple(write for outcome in self.outcomes for write in outcome)


OPAQUE = Account()
"""The account of an effect that cannot be looked into."""
