"""The condition of an axiom that one content is below another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ttr.building.relabelled_subtyping import subtype_up_to_relabelling
from ttr.computing.subtyping import Answer, subtype
from ttr.signature.signature import Condition, Signature, format_argument, value_of
from ttr.types.objects import Object, Path
from ttr.types.paths import free_paths
from ttr.types.syntax import as_type


@dataclass(frozen=True)
class IsBelow(Condition):
    """The condition that S <= T, perhaps up to relabelling; paths are variables."""

    lower: Object
    upper: Object
    relabelled: bool = False

    @property
    def terms(self) -> tuple[Object, ...]:
        """Both sides."""
        return self.lower, self.upper

    def with_values(self, bound: Mapping[Path, Object]) -> IsBelow:
        """The condition on the values of its variables."""
        lower, upper = value_of(self.lower, bound), value_of(self.upper, bound)
        return IsBelow(lower, upper, self.relabelled)

    def narrowest(self, bound: Mapping[Path, Object]) -> Mapping[Path, Object]:
        """The narrowest value of the upper side, where it is still open: the lower."""
        if not isinstance(self.upper, Path) or self.upper in bound:
            return {}
        lower = value_of(self.lower, bound)
        return {} if isinstance(lower, Path) else {self.upper: lower}

    @property
    def holds_by_form(self) -> bool:
        """Are both sides the same?"""
        return self.lower is self.upper

    def compare(self, theory: Signature) -> tuple[str, str]:
        """The verdict on S <= T, and why, or by which relabelling.

        Where paths lead out of S or T it is left open: they are about other records.

        >>> from ttr import Ind, rectype
        >>> IsBelow(rectype(x=Ind), rectype(y=Ind), True).compare(Signature())
        ('yes', 'with y as x')
        """
        S, T = as_type(self.lower), as_type(self.upper)
        if free_paths(S) or free_paths(T):
            verdict = "yes" if S is T else "unknown"
            return verdict, f"{S} or {T} is about something outside"
        ask = subtype_up_to_relabelling if self.relabelled else subtype
        found: Answer = ask(S, T, theory)
        return found.verdict, found.why

    def __str__(self) -> str:
        relabelled = " up to relabelling" * self.relabelled
        pair = f"{format_argument(self.lower)} <= {format_argument(self.upper)}"
        return pair + relabelled
