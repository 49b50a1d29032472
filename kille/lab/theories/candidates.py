"""The methods that take part in a comparison: by name, or from a user's own module.

Anything with `learn_one(x, word)` and `predict_proba_one(x)` may take part. Whatever it
raises, and whatever it gives that is no degree, is told as a `MethodFailedError`, so
that the others can go on without it.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from reprlib import repr as brief
from typing import Any, TypeAlias

from kille.extras import MissingExtraError
from kille.lab.results import ExperimentError
from kille.lab.settings import suggest_name
from kille.lab.user_code import (
    WRITTEN,
    OwnCodeError,
    describe_exception,
    load_maker,
)
from kille.perception.learners import check_degrees
from ttr.aliases import former_names
from ttr.safety.consent import Consent

__all__ = ["Make", "Methods", "MethodFailedError", "candidates"]

__getattr__ = former_names(__name__, {"MethodFailed": "MethodFailedError"})

Make: TypeAlias = Callable[[], Any]
"""Gives a learner that has learned nothing.

>>> from kille.lab.theories.candidates import Make
>>> from kille.perception.objects import ObjectMemory
>>> make: Make = ObjectMemory
>>> make().labels
()
"""

Methods: TypeAlias = Mapping[str, Make]
"""The methods that there are, by name.

>>> from kille.lab.theories.candidates import Methods
>>> from kille.perception.methods import OBJECTS
>>> known: Methods = OBJECTS
>>> "default" in known
True
"""


class MethodFailedError(ExperimentError):
    """A learner failed, or gave wrong degrees; `name` is that of the method.

    >>> raise MethodFailedError("mine.py:Forest", "it gave no degrees")
    Traceback (most recent call last):
        ...
    kille.lab.theories.candidates.MethodFailedError: the method mine.py:Forest failed:
    it gave no degrees
    """

    def __init__(self, name: str, trouble: str) -> None:
        super().__init__(f"the method {name} failed: {trouble}")
        self.name = name


def candidates(
    names: Sequence[str], known: Methods, consent: Consent | None = None
) -> dict[str, Make]:
    """The methods of these names, each guarded; ExperimentError for an unknown one.

    A name with a colon is of the user's own: `FILE.py:NAME` or `MODULE:NAME`, where
    NAME is a class, or a function that makes a learner. Who calls this names them; for
    names that were found in a file, `consent` says which Python may be run.

    >>> from kille.perception.methods import RELATIONS
    >>> [*candidates(["default", "angle"], RELATIONS)]
    ['default', 'angle']
    """
    return {name: _guard(name, _maker(name, known, consent)) for name in names}


def _maker(name: str, known: Methods, consent: Consent | None) -> Make:
    if name in known:
        return known[name]
    if ":" not in name:
        hint = suggest_name(name, known)
        told = f"there is no method {name}: {hint}{'' if hint.endswith('?') else '.'}"
        raise ExperimentError(f"{told} Your own is named {WRITTEN}")
    try:
        return load_maker(name, Path(), "_measured_", consent, "learner")
    except OwnCodeError as error:
        raise ExperimentError(error.message) from (error.__cause__ or error)


def degrees_of(learner: Any, x: object) -> Mapping[str, float]:
    """How well each word fits by itself, if the learner can tell; else its share."""
    judge = getattr(learner, "degrees", learner.predict_proba_one)
    degrees: Mapping[str, float] = judge(x)
    return degrees


# --- the guard -----------------------------------------------------------------------


def _guard(name: str, make: Make) -> Make:
    def made() -> _Guarded:
        with _failing_as(name, "it cannot be made"):
            return _Guarded(name, make())

    return made


class _Guarded:
    """A learner whose failures carry its name."""

    def __init__(self, name: str, learner: Any) -> None:
        for needed in ("learn_one", "predict_proba_one"):
            if not callable(getattr(learner, needed, None)):
                raise MethodFailedError(name, f"a learner needs {needed}, it has none")
        self._name = name
        self._learner = learner
        self._takes_key = _takes_key(learner.learn_one)

    def learn_one(self, x: object, label: str, *, key: object = None) -> None:
        """Teach it; the key is handed on to those who take one."""
        named = {"key": key} if self._takes_key and key is not None else {}
        with _failing_as(self._name, "learn_one"):
            self._learner.learn_one(x, label, **named)

    def predict_proba_one(self, x: object) -> dict[str, float]:
        """Its degrees, which are in [0, 1] and sum to 1 at most."""
        with _failing_as(self._name, "predict_proba_one"):
            return self._degrees(self._learner.predict_proba_one(x))

    def __getattr__(self, attribute: str) -> Any:
        """Everything else is handed on to the learner."""
        found = getattr(self._learner, attribute)
        if not callable(found):
            return found

        def call(*given: Any, **named: Any) -> Any:
            with _failing_as(self._name, attribute):
                return found(*given, **named)

        return call

    def _degrees(self, given: object) -> dict[str, float]:
        if not isinstance(given, Mapping):
            raise MethodFailedError(
                self._name,
                "predict_proba_one gives a degree for each word, "
                f"not {_article(type(given).__name__)}",
            )
        for word, degree in given.items():
            self._check_degree(word, degree)
        degrees = {word: float(degree) for word, degree in given.items()}
        try:
            check_degrees(degrees)
        except AssertionError as broken:
            told = f"predict_proba_one: {broken}, not to {sum(degrees.values()):.3g}"
            raise MethodFailedError(self._name, told) from None
        return degrees

    def _check_degree(self, word: object, degree: Any) -> None:
        try:
            check_degrees({"": degree})
            fine = isinstance(word, str)
        except (AssertionError, TypeError, ValueError):
            fine = False
        if not fine:
            raise MethodFailedError(
                self._name,
                f"predict_proba_one gave {brief(word)} the degree {brief(degree)}",
            )


def _takes_key(method: Callable[..., Any]) -> bool:
    try:
        taken = inspect.signature(method).parameters.values()
    except (TypeError, ValueError):
        return False
    return any(it.name == "key" or it.kind is it.VAR_KEYWORD for it in taken)


@contextmanager
def _failing_as(name: str, doing: str) -> Iterator[None]:
    try:
        yield
    except MethodFailedError:
        raise
    except MissingExtraError as error:
        raise MethodFailedError(name, str(error)) from error
    except (Exception, SystemExit) as error:
        raise MethodFailedError(
            name, f"{doing}: {describe_exception(error)}"
        ) from error


def _article(noun: str) -> str:
    return (
        "nothing"
        if noun == "NoneType"
        else f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"
    )
