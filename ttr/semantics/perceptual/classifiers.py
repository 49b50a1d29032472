"""What is in the field `clf` of a meaning: a method, and what it looks at.

A method is a pure function of parameters and a percept. It also says how parameters
change when the word was rightly said of the percept, or wrongly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from ttr.errors import TTRError
from ttr.semantics.argument_checks import in_notation
from ttr.types.objects import Unresolved
from ttr.types.printing import notation
from ttr.types.substitution import along
from ttr.types.syntax import Object, Record

__all__ = ["Classifier", "Method"]


class Method(Protocol):
    """A way to classify, and to learn from feedback; it holds nothing that changes."""

    def degree(self, params: Record, x: Object, /) -> object:
        """How far the word holds of the percept: in [0, 1], or an interval."""
        ...

    def confirmed(self, params: Record, x: Object, /) -> Record:
        """The parameters after the word was rightly said of the percept."""
        ...

    def rejected(self, params: Record, x: Object, /) -> Record:
        """The parameters after the word was wrongly said of the percept."""
        ...


@dataclass(frozen=True)
class Classifier:
    """A method, and the paths of a situation at which its percept is found.

    What is at the paths is the percept, or what `through` makes of it: as a function
    from handles to what was sensed. None from it means that nothing can be seen.
    """

    method: Method
    of: tuple[str, ...]
    through: Callable[..., object] | None = None

    def __post_init__(self) -> None:
        lacking = [
            name
            for name in ("degree", "confirmed", "rejected")
            if not callable(getattr(self.method, name, None))
        ]
        if lacking:
            raise TTRError(
                "a method of classifying has degree, confirmed and rejected, "
                f"but {in_notation(self.method)} lacks {', '.join(lacking)}"
            )
        if not _are_paths(self.of):
            raise TTRError(
                "a percept is found at a path or a tuple of paths, as in 'pos', "
                f"found {in_notation(self.of)}"
            )
        if self.through is not None and not callable(self.through):
            raise TTRError(
                "a percept is seen through a function, "
                f"found {in_notation(self.through)}"
            )

    def __str__(self) -> str:
        return f"of {', '.join(self.of)} by {self.method}"

    def has_percept(self, r: Record) -> bool:
        """Whether a situation has something at each of the paths."""
        try:
            return all(_at(r, path) is not None for path in self.of)
        except TTRError:
            return False

    def percept(self, r: Record) -> Object | None:
        """What the method is to judge in a situation.

        Raises `TTRError` for a situation that lacks a path, and where `through` fails.
        """
        found = [_at(r, path) for path in self.of]
        return self.sensed(*found)

    def sensed(self, *found: Object) -> Object | None:
        """The percept, of what is found at the paths."""
        if self.through is None:
            return found[0] if len(found) == 1 else tuple(found)
        try:
            return self.through(*found)
        except TTRError:
            raise
        except Exception as error:
            shown = ", ".join(map(notation, found))
            raise TTRError(
                f"what is seen of {shown} cannot be told: "
                f"{type(error).__name__}: {error}"
            ) from error


def _are_paths(value: object) -> bool:
    return (
        isinstance(value, tuple)
        and len(value) > 0
        and all(isinstance(path, str) for path in value)
    )


def _at(r: Record, path: str) -> Object:
    try:
        return along(r, tuple(path.split(".")))
    except Unresolved:
        raise TTRError(
            f"the percept is looked for at {path}, which {notation(r)} lacks"
        ) from None
