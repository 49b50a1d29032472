"""Learners of any make as classifiers: {labels, learner} are then the parameters.

A learner has `learn_one(x, y)` and `predict_proba_one(x)`, which gives a mapping from
labels to degrees that sum to 1 at most. It is an object that changes, and a meaning
does not: so every lesson is given to a copy.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from ttr.errors import TTRError, Unsupported
from ttr.semantics.argument_checks import as_tuple, in_notation, in_one_line
from ttr.types.printing import notation
from ttr.types.syntax import Object, Record, freeze, record

__all__ = ["ByLearner", "Handle", "Learner", "learner_params"]

_SLACK = 1e-6
"""How far rounding may take degrees out of [0, 1]."""


class Learner(Protocol):
    """What learns from one example at a time, and says how far each label fits."""

    def learn_one(self, x: Any, y: Any, /) -> object:
        """Take x as an example of the label."""
        ...

    def predict_proba_one(self, x: Any, /) -> Mapping[Any, float]:
        """The degree of each label for x; nothing where there is nothing to say."""
        ...


def learner_params(
    learner: Learner,
    labels: Iterable[object] | None = None,
    *,
    copied: Callable[[Any], Any] = copy.deepcopy,
) -> Record:
    """The parameters {labels, learner} of meanings that a learner classifies for.

    `labels` are those that it has degrees for already: by default its attribute
    `labels`, or none. `copied` makes the copy that the next lesson is given to; what
    copies without what was learned, as `clone` of scikit-learn and river does, is not
    for it. Raises `TTRError` for what is no learner.
    """
    lacking = [
        name
        for name in ("learn_one", "predict_proba_one")
        if not callable(getattr(learner, name, None))
    ]
    if lacking:
        raise TTRError(
            f"a learner has the methods learn_one and predict_proba_one, "
            f"but {notation(learner)} lacks {' and '.join(lacking)}"
        )
    known = getattr(learner, "labels", ()) if labels is None else labels
    mine = Handle(learner, 0, copied).copy()
    return record(labels=as_tuple(known, "labels"), learner=mine)


@dataclass(frozen=True, eq=False)
class Handle:
    """A learner, and how many lessons it had since; nobody else may teach it."""

    learner: Learner
    lessons: int
    copied: Callable[[Any], Any]

    def __str__(self) -> str:
        if not self.lessons:
            return self._name
        return f"{self._name} + {self.lessons} lesson{'s' * (self.lessons > 1)}"

    def degrees(self, x: Object, labels: tuple[Object, ...]) -> Mapping[Object, float]:
        """The degree of each of its labels for x, or nothing.

        Raises `TTRError` for what are no degrees, and for other labels than these.
        """
        found = self.learner.predict_proba_one(x)
        if not isinstance(found, Mapping):
            raise TTRError(
                f"{self._name} is to answer with a mapping from labels to degrees, "
                f"found {in_notation(found)}"
            )
        degrees = {label: self._number(label, p) for label, p in found.items()}
        if sum(degrees.values()) > 1 + _SLACK:
            raise TTRError(
                f"the degrees of {self._name} sum to 1 at most, "
                f"found {sum(degrees.values()):g}"
            )
        if degrees and degrees.keys() != set(labels):
            raise TTRError(
                f"{self._name} has the labels {_listed(labels)}, but answered for "
                f"{_listed(degrees)}",
                hint="what it has besides those it is taught, learner_params is told",
            )
        return degrees

    def taught(self, x: Object, label: object) -> Handle:
        """A copy of the learner after one more lesson."""
        pupil = self.copy().learner
        pupil.learn_one(x, label)
        return Handle(pupil, self.lessons + 1, self.copied)

    def copy(self) -> Handle:
        """A copy of the learner; `TTRError` where there is none."""
        try:
            pupil = self.copied(self.learner)
        except Exception as error:
            raise TTRError(
                f"{self._name} cannot be copied: {type(error).__name__}: {error}",
                hint="say how it can: learner_params(learner, copied=function)",
            ) from error
        if pupil is self.learner:
            raise TTRError(f"the copy of {self._name} is the learner itself")
        return Handle(pupil, self.lessons, self.copied)

    @property
    def _name(self) -> str:
        return str(getattr(self.learner, "name", type(self.learner).__name__))

    def _number(self, label: object, p: object) -> float:
        try:
            found = math.nan if isinstance(p, str) else float(p)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            found = math.nan
        if not -_SLACK <= found <= 1 + _SLACK:
            raise TTRError(
                f"{self._name} is to give {notation(label)} a degree in [0, 1], "
                f"found {in_one_line(p)}"
            )
        return min(max(found, 0.0), 1.0)


@dataclass(frozen=True)
class ByLearner:
    """As far as a learner gives the word's label; what it knows is in the parameters.

    A label that it was never taught may have what the others leave. To confirm is to
    teach the label, to reject is to teach the label `other`: where there is none a
    rejection alone teaches nothing, and raises `Unsupported`. Whoever says what it is
    instead teaches that.
    """

    label: object
    other: object | None = None

    def __str__(self) -> str:
        return f"a learner, as {notation(self.label)}"

    def degree(self, params: Record, x: Object, /) -> float | tuple[float, float]:
        """The degree of the label; [0, 1] where the learner says nothing."""
        handle, labels = _parts(params)
        degrees = handle.degrees(x, labels)
        if self.label in degrees:
            return degrees[self.label]
        return 0.0, max(0.0, 1.0 - sum(degrees.values()))

    def confirmed(self, params: Record, x: Object, /) -> Record:
        """The parameters with a learner that had one more example of the label."""
        return _taught(params, x, self.label)

    def rejected(self, params: Record, x: Object, /) -> Record:
        """The parameters with a learner that had one more example of the other."""
        if self.other is None:
            raise Unsupported(
                f"that it is not {notation(self.label)} teaches this learner nothing",
                hint="say what it is instead, or give ByLearner a label for the others",
            )
        return _taught(params, x, self.other)


def _taught(params: Record, x: Object, label: object) -> Record:
    handle, labels = _parts(params)
    if label not in labels:
        labels = (*labels, freeze(label))
    fields = {**params._fields, "labels": labels, "learner": handle.taught(x, label)}
    return Record(fields)


def _parts(params: Record) -> tuple[Handle, tuple[Object, ...]]:
    fields = params._fields if isinstance(params, Record) else {}
    handle, labels = fields.get("learner"), fields.get("labels")
    if isinstance(handle, Handle) and isinstance(labels, tuple):
        return handle, labels
    raise TTRError(
        "the parameters of a learner are made by learner_params, "
        f"found {in_notation(params)}"
    )


def _listed(labels: Iterable[object]) -> str:
    return ", ".join(sorted(map(notation, labels))) or "(none)"
