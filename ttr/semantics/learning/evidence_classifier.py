"""What classifiers over types share: all that they know is their evidence."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Protocol, TypeVar

from ttr.semantics.learning.features import features_below
from ttr.types.syntax import TypeNode

if TYPE_CHECKING:
    from ttr.semantics.learning.evidence import Evidence, Key
    from ttr.signature.signature import Signature


class _WithEvidence(Protocol):
    """A frozen dataclass with these fields."""

    @property
    def features(self) -> tuple[TypeNode, ...]: ...

    @property
    def theory(self) -> Signature: ...

    @property
    def evidence(self) -> Evidence: ...


C = TypeVar("C", bound=_WithEvidence)


class EvidenceBased:
    """Base class: a frozen dataclass that learns and unlearns by its evidence."""

    def __repr__(self: _WithEvidence) -> str:
        name, count = type(self).__name__, len(self.features)
        return f"<{name} over {count} features, {self.evidence}>"

    @property
    def labels(self: _WithEvidence) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        return self.evidence.labels

    def learned(self: C, x: TypeNode, label: str, *, key: Key) -> C:
        """The classifier after a lesson: what is of x has this label.

        Raises `RefusedError` where nothing can be of x, and `KeyTakenError`.
        """
        found = features_below(x, self.features, self.theory)
        return replace(self, evidence=self.evidence.learned(found, label, key))  # type: ignore[type-var]

    def retracted(self: C, key: Key) -> C:
        """The classifier without the lesson of a key; raises `NoSuchKeyError`."""
        return replace(self, evidence=self.evidence.retracted(key))  # type: ignore[type-var]
