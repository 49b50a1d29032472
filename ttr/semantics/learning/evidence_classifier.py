"""What classifiers over types share: all that they know is their evidence."""

from __future__ import annotations

from dataclasses import replace
from typing import Self

from ttr.semantics.learning.evidence import Evidence, Key
from ttr.semantics.learning.features import features_below, features_of
from ttr.signature.signature import Signature, signature_of
from ttr.types.syntax import TypeNode


class EvidenceBased:
    """Base class: a frozen dataclass that learns and unlearns by its evidence."""

    features: tuple[TypeNode, ...]
    theory: Signature
    evidence: Evidence

    def __post_init__(self) -> None:
        object.__setattr__(self, "features", features_of(self.features))
        object.__setattr__(self, "theory", signature_of(self.theory))

    def __repr__(self) -> str:
        name, count = type(self).__name__, len(self.features)
        return f"<{name} over {count} features, {self.evidence}>"

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels that were learned, in alphabetical order."""
        return self.evidence.labels

    def learned(self, x: TypeNode, label: str, *, key: Key) -> Self:
        """The classifier after a lesson: what is of x has this label.

        Raises `RefusedError` where nothing can be of x, and `KeyTakenError`.
        """
        found = features_below(x, self.features, self.theory)
        return self._with(self.evidence.learned(found, label, key))

    def retracted(self, key: Key) -> Self:
        """The classifier without the lesson of a key; raises `NoSuchKeyError`."""
        return self._with(self.evidence.retracted(key))

    def _with(self, evidence: Evidence) -> Self:
        return replace(self, evidence=evidence)  # type: ignore[type-var]
