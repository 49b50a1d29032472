"""The field `clf` of a meaning: a method of classification, and where its percept is.

A method gives a degree by parameters and a percept. It also gives the parameters after
feedback: that the word was rightly said of the percept, or wrongly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from ttr.errors import TTRError, describe_error
from ttr.semantics.argument_checks import in_notation, missing_methods
from ttr.types.objects import Object, Record, UnresolvedError
from ttr.types.printing import notation
from ttr.types.records import value_at
from ttr.types.substitution import follow_path


class Method(Protocol):
    """A way to classify and to learn from feedback; it has no state of its own.

    >>> from ttr.semantics.perceptual import Perceptron, blank
    >>> method: Method = Perceptron()
    >>> method.degree(blank(2), (0.9, 0.1)), method.confirmed(blank(2), (0.9, 0.1))["w"]
    (0.0, (0.9, 0.1))
    """

    def degree(self, params: Record, x: Object, /) -> object:
        """The degree of the word for the percept: in [0, 1], or an interval."""
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

    The percept is what is at the paths; or what `through`, a function from handles to
    what was sensed, makes of that. Where it gives None, nothing can be seen.

    >>> from ttr import record
    >>> from ttr.semantics.perceptual import Perceptron
    >>> classifier = Classifier(Perceptron(), ("pos",))
    >>> classifier.percept(record(x="o1", pos=[0.9, 0.1]))
    (0.9, 0.1)
    """

    method: Method
    of: tuple[str, ...]
    through: Callable[..., object] | None = None

    def __post_init__(self) -> None:
        lacking = missing_methods(self.method, "degree", "confirmed", "rejected")
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
        """Has a situation something at each of the paths?"""
        return all(value_at(r, path) is not None for path in self.of)

    def percept(self, r: Record) -> Object | None:
        """The percept in a situation; None where nothing can be seen.

        Raises `TTRError` for a situation that lacks a path, and where `through` fails.
        """
        return self.percept_of(*[_find(r, path) for path in self.of])

    def percept_of(self, *found: Object) -> Object | None:
        """The percept made of what is at the paths; None where nothing can be seen."""
        if self.through is None:
            return found[0] if len(found) == 1 else tuple(found)
        try:
            return self.through(*found)
        except TTRError:
            raise
        except Exception as error:
            shown = ", ".join(map(notation, found))
            raise TTRError(
                f"the percept of {shown} could not be computed: {describe_error(error)}"
            ) from error


def _are_paths(value: object) -> bool:
    return (
        isinstance(value, tuple)
        and len(value) > 0
        and all(isinstance(path, str) for path in value)
    )


def _find(r: Record, path: str) -> Object:
    try:
        return follow_path(r, tuple(path.split(".")))
    except UnresolvedError:
        raise TTRError(
            f"the percept is looked for at {path}, which {notation(r)} lacks"
        ) from None
