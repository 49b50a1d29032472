"""What a theory claims of itself, `check …`, and whether it holds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, TypeAlias, assert_never

from ttr.circles import circle
from ttr.errors import Span, TTRError, Undecided
from ttr.merging import amerge, merge
from ttr.printing import notation
from ttr.subtyping import subtype
from ttr.syntax import Object, TypeNode, identity, kind_of
from ttr.theories import Interval, Theory

if TYPE_CHECKING:
    from ttr.models import Model

__all__ = [
    "Check",
    "Creates",
    "Expects",
    "Failure",
    "HasDegree",
    "IsOf",
    "IsBelow",
    "IsSame",
    "IsTrue",
    "IsWellFormed",
    "Merges",
    "Query",
    "Report",
    "check",
]

TOLERANCE = 1e-9
"""How far two probabilities may be apart and still count as the same number."""


@dataclass(frozen=True)
class IsOf:
    """a : T."""

    sit: Object
    type: TypeNode


@dataclass(frozen=True)
class IsBelow:
    """S <= T, under the axioms of the theory."""

    lower: TypeNode
    upper: TypeNode


@dataclass(frozen=True)
class IsSame:
    """S = T: the same type, or the same object; f(a) is what the function gives."""

    left: Object
    right: Object


@dataclass(frozen=True)
class Merges:
    """merge(S, T) = U, or amerge(S, T) = U; `operation` is its name."""

    operation: str
    left: TypeNode
    right: TypeNode
    result: Object


@dataclass(frozen=True)
class Creates:
    """create(T): a fresh witness of T can be made."""

    type: TypeNode


@dataclass(frozen=True)
class IsWellFormed:
    """wellformed(T): every path leads to a field that fits, and none in a circle.

    Where T cannot even be built, `type` is the error that says why.
    """

    type: TypeNode | TTRError


@dataclass(frozen=True)
class HasDegree:
    """P(a : T | b : S, …) = [lo, hi] (`relation` is "="), or within it (it is "in")."""

    sit: Object
    type: TypeNode
    relation: str
    interval: Interval
    when: tuple[tuple[Object, TypeNode], ...] = ()


@dataclass(frozen=True)
class Expects:
    """P(T || S, …) = [lo, hi], or within it: of any known object."""

    type: TypeNode
    when: tuple[TypeNode, ...]
    relation: str
    interval: Interval


@dataclass(frozen=True)
class IsTrue:
    """P(T) = [lo, hi]: so certainly something is of T."""

    type: TypeNode
    interval: Interval


Query: TypeAlias = (
    IsOf
    | IsBelow
    | IsSame
    | Merges
    | Creates
    | IsWellFormed
    | HasDegree
    | Expects
    | IsTrue
)


@dataclass(frozen=True)
class Check:
    """A claim: the query's answer is the expected one, yes, no, unknown or error.

    Where the query mentions a type that cannot be built, `query` is the error.
    """

    expected: str
    query: Query | TTRError
    span: Span
    text: str


@dataclass(frozen=True)
class Failure:
    """A check that does not hold: what was expected, what was found, and why."""

    check: Check
    found: str
    why: str

    def __str__(self) -> str:
        """The failure as the command prints it.

        >>> theory = Theory.parse("basic A, B\\ncheck A <= B", "ab.ttr")
        >>> print(check(theory).failures[0])
        failed: check A <= B
          ┌─ ab.ttr:2:1
        2 │ check A <= B
          │ ^^^^^^^^^^^^
        expected: yes
        found:    no
        why:      A is not below B
        """
        why = self.why.strip().replace("\n", "\n          ")
        return (
            f"failed: {self.check.text}\n{self.check.span}\n"
            f"expected: {self.check.expected}\nfound:    {self.found}"
            + f"\nwhy:      {why}"
            * bool(why)
        )


@dataclass(frozen=True)
class Report:
    """What became of a theory's checks: how many were asked, and those that failed."""

    asked: int
    failures: tuple[Failure, ...]

    @property
    def holds(self) -> bool:
        """Whether no check failed."""
        return not self.failures

    def __str__(self) -> str:
        if self.failures:
            return "\n\n".join(map(str, self.failures))
        verb = "check holds" if self.asked == 1 else "checks hold"
        return f"{self.asked} {verb}"


@dataclass(frozen=True)
class _Answer:
    """An answer yes, no, unknown or error, what was found, and why."""

    verdict: str
    found: str
    why: str = ""


def check(theory: Theory) -> Report:
    """Asks the theory's checks, of the model in which just its givens are judged.

    Raises `Refused` where the givens contradict one another.

    >>> theory = Theory.parse("basic A, B\\nA <: B\\ncheck A <= B\\ncheck not B <= A")
    >>> print(check(theory))
    2 checks hold
    """
    if not isinstance(theory, Theory):
        raise TTRError(f"check takes a theory, found {kind_of(theory)}")
    model = _model(theory)
    failures = []
    for one in theory.checks:
        answer = _answered(one.query, theory, model)
        if answer.verdict != one.expected:
            failures.append(Failure(one, answer.found, answer.why))
    return Report(len(theory.checks), tuple(failures))


def _model(theory: Theory) -> Model:
    """The model of just the givens; an error tells which of them it was."""
    from ttr.models import Model

    model = Model(replace(theory, givens=()))
    for given in theory.givens:
        try:
            model = model.stated(given)
        except TTRError as error:
            raise error.at(given.span) if given.span else error from None
    return model


def _answered(query: Query | TTRError, theory: Theory, model: Model) -> _Answer:
    if isinstance(query, TTRError):
        return _Answer("error", "error", query.message)
    try:
        return _asked(_reduced(query, model), theory, model)
    except TTRError as error:
        return _Answer("error", "error", error.message)
    except RecursionError:
        return _Answer("error", "error", "the types nest too deep to be compared here")


def _reduced(query: Query, model: Model) -> Query:
    """The query with every application in it worked out.

    Raises `Refused` where an argument is not of the domain of the function.
    """
    if isinstance(query, IsWellFormed):
        return query
    inside = {part.name: getattr(query, part.name) for part in fields(query)}
    return replace(query, **{k: model.reduced(v) for k, v in inside.items()})


def _asked(query: Query, theory: Theory, model: Model) -> _Answer:
    match query:
        case IsOf():
            return _is_of(query, model)
        case IsBelow(lower, upper):
            answer = subtype(lower, upper, theory)
            return _Answer(answer.verdict, answer.verdict, answer.why)
        case IsSame(left, right):
            same = identity(left) == identity(right)
            return _yes_or_no(same, f"{notation(left)} is not {notation(right)}")
        case Merges():
            return _merges(query, theory)
        case Creates(T):
            model.create(T)
            return _Answer("yes", "yes")
        case IsWellFormed(T):
            return _is_well_formed(T)
        case HasDegree():
            judgement = model.judge(query.sit, query.type, when=query.when)
            return _has_degree(query, judgement.p, str(judgement.why))
        case Expects(T, when):
            found = model.chance(T, when=when)
            return _has_degree(query, found.p, str(found))
        case IsTrue(T, interval):
            p = model.true(T)
            why = f"{'a' if p.lo == 1.0 else 'no'} certain witness of {T} is known"
            return _Answer("yes" if _same(p, interval) else "no", _interval(p), why)
    assert_never(query)


def _yes_or_no(holds: bool, why_not: str) -> _Answer:
    return _Answer("yes", "yes") if holds else _Answer("no", "no", why_not)


def _is_of(query: IsOf, model: Model) -> _Answer:
    judgement = model.judge(query.sit, query.type)
    try:
        verdict = "yes" if judgement.holds else "no"
    except Undecided:
        verdict = "unknown"
    found = verdict if verdict != "unknown" else f"unknown, {_interval(judgement.p)}"
    return _Answer(verdict, found, str(judgement.why))


def _merges(query: Merges, theory: Theory) -> _Answer:
    operations: dict[str, Callable[[], TypeNode]] = {
        "merge": lambda: merge(query.left, query.right, theory),
        "amerge": lambda: amerge(query.left, query.right, theory),
    }
    merged = operations[query.operation]()
    if merged is query.result:
        return _Answer("yes", "yes")
    return _Answer("no", str(merged), f"it is not {query.result}")


def _is_well_formed(T: TypeNode | TTRError) -> _Answer:
    if isinstance(T, TTRError):
        return _Answer("no", "no", T.message)
    return _yes_or_no(not circle(T), f"its paths go in a circle: {circle(T)}")


def _has_degree(query: HasDegree | Expects, p: Interval, why: str) -> _Answer:
    least, most = query.interval
    if query.relation == "=":
        holds = _same(p, query.interval)
    else:
        holds = least - TOLERANCE <= p[0] and p[1] <= most + TOLERANCE
    return _Answer("yes" if holds else "no", _interval(p), why)


def _same(p: Interval, wanted: Interval) -> bool:
    """Whether both ends are the same, but for rounding."""
    ends = zip(p, wanted, strict=True)
    return all(abs(end - other) <= TOLERANCE for end, other in ends)


def _interval(p: Interval) -> str:
    """p = 0.5 where the interval is a number, else p in [0.2, 0.4].

    >>> _interval((0.5, 0.5)), _interval((0.0, 1.0))
    ('p = 0.5', 'p in [0, 1]')
    """
    lo, hi = p
    return f"p = {lo:.6g}" if lo == hi else f"p in [{lo:.6g}, {hi:.6g}]"
