"""Estimators of scikit-learn as learners, which take one example at a time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from ttr.errors import TTRError, describe_error
from ttr.semantics.argument_checks import as_tuple, in_notation
from ttr.semantics.perceptual.vectors import Vector, vector
from ttr.types.printing import notation


def as_learner(
    estimator: Any, classes: Iterable[object] = ()
) -> Incremental | Refitted:
    """The estimator as a learner with `learn_one` and `predict_proba_one`.

    An estimator with `partial_fit` learns example by example, and needs all its classes
    beforehand. One with only `fit` is fitted anew to all examples each time. Raises
    `TTRError` for what is no probabilistic classifier.

    >>> from sklearn.naive_bayes import GaussianNB
    >>> learner = as_learner(GaussianNB(), classes=["cup", "bowl"])
    >>> for height, word in [(9.0, "cup"), (4.0, "bowl"), (8.0, "cup"), (5.0, "bowl")]:
    ...     learner.learn_one((height,), word)
    >>> {word: round(p, 2) for word, p in learner.predict_proba_one((8.5,)).items()}
    {'bowl': 0.0, 'cup': 1.0}
    """
    if isinstance(estimator, type):
        raise TTRError(
            f"as_learner takes an estimator, found the class {estimator.__name__}",
            hint=f"make one: as_learner({estimator.__name__}())",
        )
    labels = as_tuple(classes, "classes")
    if not callable(getattr(estimator, "predict_proba", None)):
        raise TTRError(
            f"{type(estimator).__name__} has no predict_proba, "
            "so it has no degrees to judge by",
            hint="take one that has, as SVC(probability=True) or LogisticRegression()",
        )
    if callable(getattr(estimator, "partial_fit", None)):
        return Incremental(estimator, labels)
    if callable(getattr(estimator, "fit", None)):
        return Refitted(estimator)
    raise TTRError(f"{type(estimator).__name__} has neither partial_fit nor fit")


class _Learner:
    """A learner made of an estimator."""

    def __init__(self, estimator: Any) -> None:
        self.estimator = estimator

    @property
    def name(self) -> str:
        """The class of the estimator."""
        return type(self.estimator).__name__

    def predict_proba_one(self, x: object) -> dict[Any, float]:
        """The degree of each class; nothing as long as too little was learned."""
        if not hasattr(self.estimator, "classes_"):
            return {}
        with self._reporting_errors():
            (row,) = self.estimator.predict_proba([vector(x)])
        classes = _as_plain_tuple(self.estimator.classes_)
        return dict(zip(classes, map(float, row), strict=True))

    @contextmanager
    def _reporting_errors(self) -> Iterator[None]:
        """Report errors of the estimator as `TTRError`s with its name."""
        try:
            yield
        except TTRError:
            raise
        except Exception as error:
            raise TTRError(f"{self.name} failed: {describe_error(error)}") from error


class Incremental(_Learner):
    """An estimator that learns by `partial_fit`, from lists of numbers."""

    def __init__(self, estimator: Any, classes: Iterable[object] = ()) -> None:
        super().__init__(estimator)
        self.labels = _as_plain_tuple(getattr(estimator, "classes_", tuple(classes)))
        if not self.labels:
            raise TTRError(
                f"{self.name} learns by partial_fit, so it has to know "
                "its classes beforehand: as_learner(estimator, classes)"
            )

    def learn_one(self, x: object, y: object) -> None:
        """Take x as an example of class y; `TTRError` where it has no such class."""
        if not any(y is label or _is_same(y, label) for label in self.labels):
            known = ", ".join(map(notation, self.labels))
            raise TTRError(f"{in_notation(y)} is none of the classes {known}")
        with self._reporting_errors():
            self.estimator.partial_fit([vector(x)], [y], classes=list(self.labels))


class Refitted(_Learner):
    """An estimator that is fitted anew to all examples, which are kept.

    It gives degrees when two classes have examples.
    """

    def __init__(self, estimator: Any) -> None:
        super().__init__(estimator)
        self.examples: tuple[tuple[Vector, object], ...] = ()

    def learn_one(self, x: object, y: object) -> None:
        """Take x as an example of class y, and fit if there are two classes or more.

        Raises `TTRError` where fitting fails; then the example is not kept.
        """
        examples = (*self.examples, (vector(x), y))
        classes = [label for _, label in examples]
        with self._reporting_errors():
            if len(set(classes)) > 1:
                self.estimator.fit([x for x, _ in examples], classes)
        self.examples = examples


def _is_same(one: object, label: object) -> bool:
    """Is a class equal to a label? No for arrays, for which == has no one answer."""
    same = one == label
    return same if isinstance(same, bool) else False


def _as_plain_tuple(classes: Any) -> tuple[Any, ...]:
    """Classes as plain Python objects, also where they are an array."""
    return tuple(classes.tolist() if hasattr(classes, "tolist") else classes)
