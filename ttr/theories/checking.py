"""Answers the checks of a theory, and says which of them fail."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, assert_never

from ttr.building.merging import amerge, merge
from ttr.building.relabelled_subtyping import subtype_up_to_relabelling
from ttr.computing.definitional_equality import equal
from ttr.computing.kept_redexes import kept_redexes
from ttr.computing.normalisation import normal_value
from ttr.computing.path_cycles import describe_cycle
from ttr.computing.subtyping import subtype
from ttr.errors import Span, TooLargeError, TTRError, UndecidedError
from ttr.judging.models import model_of
from ttr.probability.degrees import is_within
from ttr.safety.budgets import SharedPurse, one_of_several, purse_of_several
from ttr.signature.signature import Interval
from ttr.theories.check_reports import Failure, Report
from ttr.theories.queries import (
    Check,
    Creates,
    Expects,
    HasDegree,
    IsBelow,
    IsBelowRelabelled,
    IsOf,
    IsSame,
    IsTrue,
    IsWellFormed,
    Merges,
    Query,
    Updates,
)
from ttr.theories.theory import Theory
from ttr.types.interning import identity
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.types.syntax import Application, Function, TypeNode, kind_of
from ttr.updates.checks import Fault, faults_alone, faults_of
from ttr.updates.rule_application import apply_rule
from ttr.updates.rules import Rule

if TYPE_CHECKING:
    from ttr.judging.judgements import Why
    from ttr.judging.models import Model


@dataclass(frozen=True)
class Answer:
    """An answer (yes, no, unknown or error), what was found, and why.

    `derivation` is the reasons as a tree, where a judgement gives the answer.
    """

    verdict: str
    found: str
    why: str = ""
    derivation: Why | None = None


def check(theory: Theory) -> Report:
    """Answer the theory's checks, in the model in which its givens are judged.

    Its rules are checked without running them: those of each game together, the others
    one by one. That a definition only comes to an application whose argument is not
    known to fit is a warning. Raises `RefusedError` if the givens contradict one
    another, and `UpdateError` if the start of a game is not of its type.

    >>> theory = Theory.parse("basic A, B\\nA <: B\\ncheck A <= B\\ncheck not B <= A")
    >>> print(check(theory))
    2 checks hold
    """
    report = answer_checks(theory)
    rules = [one for one in theory.rules.values() if _is_own(one.span, theory)]
    found = (*_stuck_definitions(theory), *_faults(theory, rules))
    return replace(report, rules=len(rules), faults=found)


def answer_checks(theory: Theory, model: Model | None = None) -> Report:
    """Answer the theory's checks, but do not check its rules; raises as `check`.

    `model` is the model of the theory's givens, where it is known already.
    """
    if not isinstance(theory, Theory):
        raise TTRError(f"check takes a theory, found {kind_of(theory)}")
    failures = [
        Failure(asked, answer.found, answer.why, answer.derivation)
        for asked, answer in answers(theory, model)
        if answer.verdict != asked.expected
    ]
    return Report(len(theory.checks), tuple(failures))


def answers(
    theory: Theory, model: Model | None = None
) -> tuple[tuple[Check, Answer], ...]:
    """Each check of the theory with its answer, also where that is the expected one.

    For `model` and errors see `answer_checks`.

    >>> theory = Theory.parse("basic A, B\\nA <: B\\ncheck not B <= A")
    >>> [(asked.expected, answer.verdict) for asked, answer in answers(theory)]
    [('no', 'no')]
    """
    purse = purse_of_several(len(theory.givens) + len(theory.checks))
    model = model_of(theory, purse) if model is None else model
    return tuple(
        (one, _answer(one.query, theory, model, purse)) for one in theory.checks
    )


def _faults(theory: Theory, rules: list[Rule]) -> tuple[Fault, ...]:
    """The faults of the rules and games that are declared here, not imported."""
    own = [k for k, one in theory.openings.items() if _is_own(one.span, theory)]
    games = [theory.games[name] for name in own]
    played = {id(one) for game in games for one in game.rules}
    alone = [one for one in rules if id(one) not in played]
    found = [fault for game in games for fault in faults_of(game)]
    found += [fault for one in alone for fault in faults_alone(one)]
    return tuple({(one.message, one.span): one for one in found}.values())


def _stuck_definitions(theory: Theory) -> Iterator[Fault]:
    """Warnings of definitions that compute to an application that is kept."""
    composed = {
        name: (value, span)
        for name, span in theory.defined_at.items()
        if _is_own(span, theory)
        and isinstance(value := theory.definitions[name], Application)
    }
    purse = purse_of_several(len(composed))
    for name, (value, span) in composed.items():
        try:
            with one_of_several(purse):
                computed = normal_value(value, theory)
        except TTRError:
            continue  # too large to be computed
        if not isinstance(computed, Application):
            continue
        for kept in kept_redexes(computed):
            if any(map(_is_kept, (kept.function, kept.argument))):
                continue  # the cause is further in
            assert isinstance(kept.function, Function)
            argument = _name_of(kept.argument, theory)
            domain = _name_of(kept.function.domain, theory)
            function = _name_of(kept.function, theory)
            message = (
                f"{name} does not compute: {function} takes what is of {domain}, "
                f"and it is not known that {argument} is"
            )
            hint = f"whether {name} is a type is asked by: check {name} : RecType"
            yield Fault(None, "uncomputed", message, hint, span, "warning")
            break


def _is_kept(value: Object) -> bool:
    return next(kept_redexes(value), None) is not None


def _name_of(value: Object, theory: Theory) -> str:
    """The name by which the theory defines a value, or else its notation."""
    for name, one in theory.definitions.items():
        if identity(one) == identity(value):
            return name
    return notation(value, theory.spelling)


def _is_own(span: Span | None, theory: Theory) -> bool:
    return span is not None and span.source == theory.source


def _answer(
    query: Query | TTRError, theory: Theory, model: Model, purse: SharedPurse
) -> Answer:
    if isinstance(query, TTRError):
        return _answer_of_error(query)
    try:
        with one_of_several(purse):
            return _evaluate(_reduce(query, theory, model), theory, model)
    except TTRError as error:
        return _answer_of_error(error)
    except RecursionError:
        return Answer("error", "error", "the types nest too deep to be compared here")


def _answer_of_error(error: TTRError) -> Answer:
    verdict = "unknown" if isinstance(error, TooLargeError) else "error"
    return Answer(verdict, verdict, error.message)


def _reduce(query: Query, theory: Theory, model: Model) -> Query:
    """The query with every application in it worked out.

    Raises `RefusedError` if an argument is not in the domain of its function.
    """
    if isinstance(query, IsWellFormed | Updates):
        return query
    inside = {part.name: getattr(query, part.name) for part in fields(query)}
    computed = {k: normal_value(v, theory) for k, v in inside.items()}
    return replace(query, **{k: model.reduce(v) for k, v in computed.items()})


def _evaluate(query: Query, theory: Theory, model: Model) -> Answer:
    match query:
        case IsOf():
            return _is_of(query, model)
        case IsBelow(lower, upper):
            answer = subtype(lower, upper, theory)
            return Answer(answer.verdict, answer.verdict, answer.why)
        case IsBelowRelabelled(lower, upper):
            answer = subtype_up_to_relabelling(lower, upper, theory)
            return Answer(answer.verdict, answer.verdict, answer.why)
        case IsSame(left, right):
            answer = equal(left, right, theory)
            return Answer(answer.verdict, answer.verdict, answer.why)
        case Merges():
            return _merges(query, theory)
        case Creates(T):
            model.create(T)
            return Answer("yes", "yes")
        case IsWellFormed(T):
            return _is_well_formed(T)
        case HasDegree():
            judgement = model.judge(query.sit, query.type, when=query.when)
            degree = _has_degree(query, judgement.p, str(judgement.why))
            return replace(degree, derivation=judgement.why)
        case Expects(T, when):
            found = model.chance(T, when=when)
            return _has_degree(query, found.p, str(found))
        case IsTrue(T, interval):
            p = model.true(T)
            why = f"{'a' if p.lo == 1.0 else 'no'} certain witness of {T} is known"
            return Answer(
                "yes" if _is_same(p, interval) else "no", _format_interval(p), why
            )
        case Updates():
            return _updates(query, model)
    assert_never(query)


def _yes_or_no(holds: bool, why_not: str) -> Answer:
    return Answer("yes", "yes") if holds else Answer("no", "no", why_not)


def _is_of(query: IsOf, model: Model) -> Answer:
    judgement = model.judge(query.sit, query.type)
    try:
        verdict = "yes" if judgement.holds else "no"
    except UndecidedError:
        verdict = "unknown"
    found = (
        verdict if verdict != "unknown" else f"unknown, {_format_interval(judgement.p)}"
    )
    return Answer(verdict, found, str(judgement.why), judgement.why)


def _merges(query: Merges, theory: Theory) -> Answer:
    operations: dict[str, Callable[[], TypeNode]] = {
        "merge": lambda: merge(query.left, query.right, theory),
        "amerge": lambda: amerge(query.left, query.right, theory),
    }
    merged = operations[query.operation]()
    if normal_value(merged, theory) is query.result:
        return Answer("yes", "yes")
    return Answer("no", str(merged), f"it is not {query.result}")


def _updates(query: Updates, model: Model) -> Answer:
    """Does the rule give this state? Raises `TTRError` if it does not apply."""
    wanted = model.reduce(query.result)
    after = apply_rule(query.rule, [*map(model.reduce, query.args)], model).state
    if identity(after) == identity(wanted):
        return Answer("yes", "yes")
    return Answer("no", notation(after), "\n".join(differences(wanted, after)))


def _is_well_formed(T: TypeNode | TTRError) -> Answer:
    if isinstance(T, TTRError):
        return Answer("no", "no", T.message)
    return _yes_or_no(
        not describe_cycle(T), f"its paths go in a circle: {describe_cycle(T)}"
    )


def _has_degree(query: HasDegree | Expects, p: Interval, why: str) -> Answer:
    wanted = query.interval
    holds = _is_same(p, wanted) if query.relation == "=" else is_within(p, wanted)
    return Answer("yes" if holds else "no", _format_interval(p), why)


def _is_same(p: Interval, wanted: Interval) -> bool:
    """Are both ends the same, up to rounding?"""
    return is_within(p, wanted) and is_within(wanted, p)


def _format_interval(p: Interval) -> str:
    """p = 0.5 if the interval is a number, or else p in [0.2, 0.4].

    >>> _format_interval((0.5, 0.5)), _format_interval((0.0, 1.0))
    ('p = 0.5', 'p in [0, 1]')
    """
    lo, hi = p
    return f"p = {lo:.6g}" if lo == hi else f"p in [{lo:.6g}, {hi:.6g}]"
