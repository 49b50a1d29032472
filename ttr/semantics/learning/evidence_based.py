"""What classifiers over types share: they are made of evidence, and nothing else."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Protocol, TypeVar

from ttr.semantics.learning.features import seen
from ttr.types.syntax import TypeNode

if TYPE_CHECKING:
    from ttr.semantics.learning.evidence import Evidence, Key
    from ttr.signature.signature import Signature

__all__ = ["Taught"]


class _Classifier(Protocol):
    """A frozen dataclass with these fields."""

    @property
    def features(self) -> tuple[TypeNode, ...]: ...

    @property
    def theory(self) -> Signature: ...

    @property
    def evidence(self) -> Evidence: ...


C = TypeVar("C", bound=_Classifier)


class Taught:
    """Learns and unlearns by its evidence; a frozen dataclass that adds the rest."""

    def __repr__(self: _Classifier) -> str:
        name, count = type(self).__name__, len(self.features)
        return f"<{name} over {count} features, {self.evidence}>"

    @property
    def labels(self: _Classifier) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        return self.evidence.labels

    def learned(self: C, x: TypeNode, label: str, *, key: Key) -> C:
        """The classifier that has also learned that what is of x is so called.

        Raises `Refused` where nothing can be of x, and `KeyTaken`.
        """
        found = seen(x, self.features, self.theory)
        return replace(self, evidence=self.evidence.learned(found, label, key))  # type: ignore[type-var]

    def retracted(self: C, key: Key) -> C:
        """The classifier that never learned what is known by the key; `NoSuchKey`."""
        return replace(self, evidence=self.evidence.retracted(key))  # type: ignore[type-var]
