"""Learners of any make as classifiers, in parameters {labels, learner}.

A learner has `learn_one(x, y)` and `predict_proba_one(x)`, which gives a mapping from
labels to degrees that sum to at most 1. A learner changes and a meaning does not, so
each lesson is given to a copy.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from ttr.errors import TTRError, UnsupportedError, describe_error
from ttr.semantics.argument_checks import (
    as_tuple,
    in_notation,
    in_one_line,
    missing_methods,
)
from ttr.types.objects import Object, Record, freeze, record
from ttr.types.printing import notation

_SLACK = 1e-6
"""How far degrees may lie outside [0, 1] by rounding."""


class Learner(Protocol):
    """An object that learns from one example at a time, and gives degrees to labels.

    >>> from ttr.semantics.perceptual import learner_params
    >>> class Majority:
    ...     def __init__(self):
    ...         self.seen = []
    ...     def learn_one(self, x, y):
    ...         self.seen.append(y)
    ...     def predict_proba_one(self, x):
    ...         return {y: self.seen.count(y) / len(self.seen) for y in self.seen}
    >>> learner: Learner = Majority()
    >>> learner.learn_one((9.0,), "cup")
    >>> learner.predict_proba_one((8.0,))
    {'cup': 1.0}
    """

    def learn_one(self, x: Any, y: Any, /) -> object:
        """Take x as an example of the label."""
        ...

    def predict_proba_one(self, x: Any, /) -> Mapping[Any, float]:
        """The degree of each label for x; an empty mapping where it knows nothing."""
        ...


def learner_params(
    learner: Learner,
    labels: Iterable[object] | None = None,
    *,
    copied: Callable[[Any], Any] = copy.deepcopy,
) -> Record:
    """The parameters {labels, learner} of meanings with this learner as classifier.

    `labels` are those that it already has degrees for; by default its attribute
    `labels`, or none. `copied` makes the copy that is given the next lesson; it has to
    copy what was learned, which `clone` of scikit-learn and river does not. Raises
    `TTRError` for what is no learner.

    >>> from sklearn.naive_bayes import GaussianNB
    >>> from ttr.semantics.perceptual import as_learner
    >>> params = learner_params(as_learner(GaussianNB(), classes=["bowl", "cup"]))
    >>> print(sorted(params))
    ['labels', 'learner']
    """
    lacking = missing_methods(learner, "learn_one", "predict_proba_one")
    if lacking:
        raise TTRError(
            f"a learner has the methods learn_one and predict_proba_one, "
            f"but {notation(learner)} lacks {' and '.join(lacking)}",
            hint=_hint_to_estimator(learner),
        )
    known = getattr(learner, "labels", ()) if labels is None else labels
    mine = Handle(learner, 0, copied).copy()
    return record(labels=as_tuple(known, "labels"), learner=mine)


def _hint_to_estimator(found: object) -> str:
    """A hint for an estimator of scikit-learn, which has other methods."""
    if isinstance(found, type):
        return f"give one that is made, as {found.__name__}()"
    if callable(getattr(found, "fit", None)):
        return f"make a learner of it: as_learner({type(found).__name__}(…))"
    return ""


@dataclass(frozen=True, eq=False)
class Handle:
    """A learner and how many lessons it was given here; nobody else may teach it."""

    learner: Learner
    lessons: int
    copied: Callable[[Any], Any]

    def __str__(self) -> str:
        if not self.lessons:
            return self._name
        return f"{self._name} + {self.lessons} lesson{'s' * (self.lessons > 1)}"

    def degrees(self, x: Object, labels: tuple[Object, ...]) -> Mapping[Object, float]:
        """The degrees of the labels for x, or none at all.

        Raises `TTRError` for an answer that is no degrees, or has other labels.
        """
        found = self.learner.predict_proba_one(x)
        if not isinstance(found, Mapping):
            raise TTRError(
                f"{self._name} must answer with a mapping from labels to degrees, "
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
                f"{self._name} has the labels {_names_of(labels)}, but answered for "
                f"{_names_of(degrees)}",
                hint="give learner_params the labels that it has beforehand",
            )
        return degrees

    def teach(self, x: Object, label: object) -> Handle:
        """The handle of a copy of the learner after one more lesson."""
        pupil = self.copy().learner
        pupil.learn_one(x, label)
        return Handle(pupil, self.lessons + 1, self.copied)

    def copy(self) -> Handle:
        """The handle of a copy of the learner; `TTRError` where it cannot be copied."""
        try:
            pupil = self.copied(self.learner)
        except Exception as error:
            raise TTRError(
                f"{self._name} cannot be copied: {describe_error(error)}",
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
                f"{self._name} must give {notation(label)} a degree in [0, 1], "
                f"found {in_one_line(p)}"
            )
        return min(max(found, 0.0), 1.0)


@dataclass(frozen=True)
class ByLearner:
    """The degree that a learner gives to the word's label; the parameters hold it.

    A label that it was never taught has a degree between 0 and what the others leave.
    To confirm is to teach the label, to reject is to teach the label `other`. Where
    there is no `other`, a rejection teaches nothing and raises `UnsupportedError`; say
    what the thing is instead.

    >>> from sklearn.naive_bayes import GaussianNB
    >>> from ttr.semantics.perceptual import as_learner
    >>> cup = ByLearner("cup", other="bowl")
    >>> params = learner_params(as_learner(GaussianNB(), classes=["bowl", "cup"]))
    >>> for height in (9.0, 8.0):
    ...     params = cup.confirmed(params, (height,))
    >>> for height in (4.0, 5.0):
    ...     params = cup.rejected(params, (height,))
    >>> cup.degree(params, (8.5,)) > 0.9
    True
    """

    label: object
    other: object | None = None

    def __str__(self) -> str:
        return f"a learner, as {notation(self.label)}"

    def degree(self, params: Record, x: Object, /) -> float | tuple[float, float]:
        """The degree of the label; [0, 1] where the learner gives no degrees."""
        handle, labels = _parts(params)
        degrees = handle.degrees(x, labels)
        if self.label in degrees:
            return degrees[self.label]
        return 0.0, max(0.0, 1.0 - sum(degrees.values()))

    def confirmed(self, params: Record, x: Object, /) -> Record:
        """The parameters with the learner taught one more example of the label."""
        return _teach(params, x, self.label)

    def rejected(self, params: Record, x: Object, /) -> Record:
        """The parameters with the learner taught one more example of `other`."""
        if self.other is None:
            raise UnsupportedError(
                f"that it is not {notation(self.label)} teaches this learner nothing",
                hint="say what it is instead, or give ByLearner a label for the others",
            )
        return _teach(params, x, self.other)


def _teach(params: Record, x: Object, label: object) -> Record:
    handle, labels = _parts(params)
    if label not in labels:
        labels = (*labels, freeze(label))
    fields = {**params._fields, "labels": labels, "learner": handle.teach(x, label)}
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


def _names_of(labels: Iterable[object]) -> str:
    return ", ".join(sorted(map(notation, labels))) or "(none)"
