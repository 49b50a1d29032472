"""Budgets of steps: how much work a question may take before it is given up.

Types are small to write and can be large to answer questions about: each line of a
theory may double the type of the line before. So every question counts its steps, and
one that takes more than its budget ends honestly: with `unknown` where that is an
answer, else with a `TooLargeError`. It never becomes a yes or a no.

A question that is asked in order to answer another spends the budget of the outermost
one. `BudgetSpentError` is no `Exception`, so that no handler on the way out takes it
for an error of the types and goes on; and nothing unfinished is remembered. Steps are
counted, not seconds, and building a type that exists already counts as if it were new:
so the answers are the same on every machine.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from typing import Any, ParamSpec, TypeVar, overload

from ttr.errors import TooLargeError, TTRError, UnsupportedError

STEPS = 1_000_000
"""How many steps a question may take by default: some seconds of work."""

SEVERAL = 4
"""How many budgets the questions of one file may spend together."""

EACH = 1_000
"""How many more steps each of these questions adds; most take a few hundred."""


class BudgetSpentError(BaseException):
    """The budget is used up; only the question that opened it catches this.

    `asked` is the question that was being asked when it ended.
    """

    asked: str = ""


class Purse:
    """What is left of a budget; without `__init__`, for every question makes one."""

    __slots__ = ("kept", "left")

    left: int
    kept: dict[object, Any]
    """What was worked out for the question, by `cache_in_question`."""


class SharedPurse(Purse):
    """What is left of the budget that the questions of one file share."""

    __slots__ = ("steps",)

    def __init__(self, steps: int) -> None:
        self.steps = self.left = steps

    def allow(self, questions: int) -> None:
        """Adds the steps of this many more questions of the same file."""
        self.steps += EACH * questions
        self.left += EACH * questions


def _too_large(reason: str, asked: str) -> TooLargeError:
    where = f", and ended in {asked}" if asked else ""
    return TooLargeError(
        f"too large: {reason}{where}",
        hint="ask for less, or allow more steps (ttr.budget, or --steps)",
    )


_IN_WORDS = {"__str__": "printing", "__repr__": "printing"}


def _name_of(function: Callable[..., object]) -> str:
    """The name of a question; empty for what users do not know."""
    name = getattr(function, "__name__", "")
    return _IN_WORDS.get(name, "" if name.startswith("_") else f"`{name}`")


_purse: ContextVar[Purse | None] = ContextVar("purse", default=None)
_allowed: ContextVar[int] = ContextVar("steps", default=STEPS)

open_purse = _purse.get
"""The budget being spent; None while no question is being asked."""


def spend(steps: int = 1) -> None:
    """Counts steps of the question being asked, if there is one."""
    purse = open_purse()
    if purse is not None:
        purse.left -= steps
        if purse.left < 0:
            raise BudgetSpentError


def steps_allowed() -> int:
    """How many steps a question asked here may take."""
    return _allowed.get()


@contextmanager
def budget(*, steps: int) -> Iterator[None]:
    """Lets each question asked inside take this many steps.

    The default of 1,000,000 is some seconds. A question that takes more is answered
    `unknown`; what has no such answer raises `TooLargeError`.

    >>> from ttr import Basic, ListOf, subtype
    >>> A = ListOf(Basic("A"))
    >>> with budget(steps=2):
    ...     print(subtype(A, ListOf(A)))
    unknown: too large: it takes more than 2 steps, and ended in `subtype`
    >>> subtype(A, ListOf(A)).no
    True
    """
    if isinstance(steps, bool) or not isinstance(steps, int) or steps < 1:
        raise TTRError(f"a budget is a whole number of steps from 1, found {steps!r}")
    token = _allowed.set(steps)
    try:
        yield
    finally:
        _allowed.reset(token)


def purse_of_several(questions: int = 0) -> SharedPurse:
    """The budget that this many questions of one file share."""
    purse = SharedPurse(SEVERAL * steps_allowed())
    purse.allow(questions)
    return purse


@contextmanager
def one_of_several(purse: SharedPurse) -> Iterator[None]:
    """Asks one of several questions that share a budget, besides the one it has.

    Raises `TooLargeError` where it takes more than its own, or than the others left.
    """
    around = open_purse()
    left = purse.left if around is None else min(purse.left, around.left)
    allowed = steps_allowed()
    own = Purse()
    own.left = mine = max(0, min(allowed, left))
    token = _purse.set(own)
    try:
        yield
    except BudgetSpentError as end:
        reason = f"it takes more than {mine:,} steps"
        if mine != allowed:
            reason = f"with what comes before, it takes more than {purse.steps:,} steps"
        raise _too_large(reason, end.asked) from None
    finally:
        _purse.reset(token)
        spent = mine - own.left
        purse.left -= spent
        if around is not None:
            around.left -= spent


P = ParamSpec("P")
R = TypeVar("R")


@overload
def within_budget(function: Callable[P, R], /) -> Callable[P, R]: ...


@overload
def within_budget(
    *, otherwise: Callable[..., R]
) -> Callable[[Callable[P, R]], Callable[P, R]]: ...


def within_budget(
    function: Callable[P, R] | None = None,
    /,
    *,
    otherwise: Callable[..., R] | None = None,
) -> Callable[P, R] | Callable[[Callable[P, R]], Callable[P, R]]:
    """Makes a function a question, which ends when its budget is spent.

    It then raises `TooLargeError`, or returns `otherwise(error, …)`, given that error
    and the arguments. Inside another question it spends that one's budget. Raises
    `UnsupportedError` where types nest too deep.
    """
    if function is None:
        return lambda decorated: _within_budget(decorated, otherwise)
    return _within_budget(function, otherwise)


def _within_budget(
    function: Callable[P, R], otherwise: Callable[..., R] | None
) -> Callable[P, R]:
    allowed = _allowed.get

    @wraps(function)
    def asked(*args: P.args, **kwargs: P.kwargs) -> R:
        if open_purse() is not None:
            try:
                return function(*args, **kwargs)
            except RecursionError:
                raise _nests_too_deep() from None
            except BudgetSpentError as end:
                end.asked = end.asked or _name_of(function)
                raise
        purse = Purse()
        purse.left = steps = allowed()
        token = _purse.set(purse)
        try:
            return function(*args, **kwargs)
        except RecursionError:
            raise _nests_too_deep() from None
        except BudgetSpentError as end:
            asked_last = end.asked or _name_of(function)
            error = _too_large(f"it takes more than {steps:,} steps", asked_last)
        finally:
            _purse.reset(token)
        if otherwise is None:
            raise error
        return otherwise(error, *args, **kwargs)

    return asked


def cache_in_question(function: Callable[P, R]) -> Callable[P, R]:
    """Keep the results of a pure function until the outermost question is answered.

    Arguments are the same if they are the same objects. What is kept goes with the
    question, so that nothing outlives it; where no question is asked nothing is kept.

    >>> @cache_in_question
    ... def double(a):
    ...     return [*a, *a]
    >>> @within_budget
    ... def ask(a):
    ...     return double(a) is double(a)
    >>> ask([1]), double([1])
    (True, [1, 1])
    """

    @wraps(function)
    def look_up(*args: P.args, **named: P.kwargs) -> R:
        purse = open_purse()
        if purse is None:
            return function(*args, **named)
        try:
            kept = purse.kept
        except AttributeError:
            kept = purse.kept = {}
        key = (function, *map(id, args), *named, *map(id, named.values()))
        found = kept.get(key)
        if found is None:  # with the arguments, so that no other gets their addresses
            found = kept[key] = function(*args, **named), args, named
        result: R = found[0]
        return result

    return look_up


def _nests_too_deep() -> UnsupportedError:
    return UnsupportedError(
        "this nests deeper than can be followed",
        hint="put fewer records, lists and types inside one another",
    )
