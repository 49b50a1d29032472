"""Update strategies as values: which of several rules apply, in which order, how often.

In Larsson and Traum 2000 an update strategy decides which rules are applied: the first
that can be, each in turn, class by class, or the one that somebody chooses.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

from ttr.errors import UpdateError, suggestion
from ttr.judging.rule_index import Demands, RuleIndex, demands_of, demands_of_any
from ttr.types.objects import Record
from ttr.types.syntax import TypeNode, kind_of
from ttr.updates.rules import Rule

Choose: TypeAlias = Callable[[Sequence[str], Record], int | None]
"""Picks one of the names by its index; None to pick none."""

Measure: TypeAlias = str | Callable[[Record], object]
"""The path of a number or list of the state, or a function of the state."""


@dataclass(frozen=True)
class First:
    """The first of these that applies.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> print(First((talk.rules["drop"], talk.rules["ask"])))
    first(drop, ask)
    """

    parts: tuple[Algorithm, ...]

    def __str__(self) -> str:
        return _format_call("first", self.parts)

    @cached_property
    def rule_index(self) -> RuleIndex:
        """An index of the parts that excludes those that cannot apply to a state."""
        return RuleIndex(map(_demands_of_strategy, self.parts))


@dataclass(frozen=True)
class All:
    """Each of these that applies, in order; it applies if any of them does.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> print(All((talk.rules["drop"], talk.rules["ask"])))
    all(drop, ask)
    """

    parts: tuple[Algorithm, ...]

    def __str__(self) -> str:
        return _format_call("all", self.parts)


@dataclass(frozen=True)
class Seq:
    """All of these, one after the other; it applies if all of them do.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> print(Seq((talk.rules["drop"], talk.rules["ask"])))
    seq(drop, ask)
    """

    parts: tuple[Algorithm, ...]

    def __str__(self) -> str:
        return _format_call("seq", self.parts)


@dataclass(frozen=True)
class Maybe:
    """This if it applies, else nothing; it always applies.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> print(Maybe(talk.rules["drop"]))
    maybe(drop)
    """

    part: Algorithm

    def __str__(self) -> str:
        return f"maybe({self.part})"


@dataclass(frozen=True)
class Repeat:
    """This as long as it applies, at least once.

    It applies at most so many `times`, and the `measure` becomes smaller each time.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> print(Repeat(talk.rules["drop"], times=9, measure="qud"))
    repeat(drop, 9, qud)
    """

    part: Algorithm
    times: int | None = None
    measure: Measure | None = None

    def __str__(self) -> str:
        named = self.measure if isinstance(self.measure, str) else None
        bounds = [str(bound) for bound in (self.times, named) if bound is not None]
        return _format_call("repeat", (self.part, *bounds))


@dataclass(frozen=True)
class ByClass:
    """Class after class, each rule that applies; it applies if any rule does.

    The order of the rules within a class is meant not to matter.

    >>> from ttr import Rec
    >>> from ttr.updates import by_class, rule
    >>> @rule(when=Rec, kind="integrate")
    ... def note(s): ...
    >>> @rule(when=Rec, kind="plan")
    ... def reply(s): ...
    >>> order = by_class(reply, note, order=["integrate", "plan"])
    >>> [(kind, [it.name for it in rules]) for kind, rules in order.classes]
    [('integrate', ['note']), ('plan', ['reply'])]
    """

    classes: tuple[tuple[str, tuple[Rule, ...]], ...]

    def __str__(self) -> str:
        return _format_call("by_class", [kind for kind, _ in self.classes])


@dataclass(frozen=True)
class Ask:
    """The one of these that `choose` picks among those that apply.

    >>> from ttr import Theory
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> print(Ask(tuple(talk.rules.values()), choose=lambda names, state: 0))
    ask(drop, ask)
    """

    parts: tuple[Algorithm, ...]
    choose: Choose

    def __str__(self) -> str:
        return _format_call("ask", self.parts)


Algorithm: TypeAlias = Rule | First | All | Seq | Maybe | Repeat | ByClass | Ask
"""A rule, or a combination of rules: what `run` and `Game` play.

>>> from ttr.semantics.gameboards import kos
>>> from ttr.updates import Algorithm
>>> isinstance(kos.ALGORITHM, Algorithm)
True
"""


def _format_call(name: str, parts: Sequence[object]) -> str:
    return f"{name}({', '.join(map(str, parts))})"


def first(*parts: Algorithm) -> First:
    """The first of these rules or strategies that applies.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> either = first(talk.rules["drop"], talk.rules["ask"])
    >>> for qud in (["q2", "q1"], []):
    ...     after = run(either, record(qud=qud), type=talk.Board, model=Model(talk))
    ...     print([str(step.rule) for step in after.trace], after.state)
    ['drop'] {qud = [q1]}
    ['ask'] {qud = [q1]}
    """
    return First(check_strategies("first", parts))


def all_(*parts: Algorithm) -> All:
    """Each of these that applies, in order.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> both = all_(talk.rules["drop"], talk.rules["ask"])
    >>> for qud in (["q2", "q1"], []):
    ...     after = run(both, record(qud=qud), type=talk.Board, model=Model(talk))
    ...     print([str(step.rule) for step in after.trace], after.state)
    ['drop', 'ask'] {qud = [q1]}
    ['ask'] {qud = [q1]}
    """
    return All(check_strategies("all_", parts))


def seq(*parts: Algorithm) -> Seq:
    """All of these in order; if one does not apply, none does.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> twice = seq(talk.rules["drop"], talk.rules["drop"])
    >>> for qud in (["q2", "q1"], ["q2"]):
    ...     after = run(twice, record(qud=qud), type=talk.Board, model=Model(talk))
    ...     print(after.state)
    {qud = []}
    {qud = [q2]}
    """
    return Seq(check_strategies("seq", parts))


def maybe(part: Algorithm) -> Maybe:
    """This if it applies, else nothing.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run, seq
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> once_or_twice = seq(talk.rules["drop"], maybe(talk.rules["drop"]))
    >>> start = record(qud=["q2"])
    >>> print(run(once_or_twice, start, type=talk.Board, model=Model(talk)).state)
    {qud = []}
    """
    check_strategies("maybe", (part,))
    return Maybe(part)


def repeat(
    part: Algorithm, *, times: int | None = None, measure: Measure | None = None
) -> Repeat:
    """This again and again as long as it applies.

    It is an error to apply more than `times`, to return to an earlier state, or not to
    make the `measure` smaller. The measure is the path of a list or of a non-negative
    number, or a function from the state to one.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> forget, M = repeat(talk.rules["drop"], measure="qud"), Model(talk)
    >>> after = run(forget, record(qud=["q2", "q1"]), type=talk.Board, model=M)
    >>> print(after.state, len(after.trace))
    {qud = []} 2
    """
    check_strategies("repeat", (part,))
    if times is not None and (type(times) is not int or times < 1):
        raise UpdateError(f"repeat takes how often at most, found times={times!r}")
    if measure is not None and not isinstance(measure, str) and not callable(measure):
        raise UpdateError(
            "a measure is the path of a list or number, or a function of the state, "
            f"found {measure!r}"
        )
    return Repeat(part, times, measure)


def by_class(*rules: Rule, order: Sequence[str]) -> ByClass:
    """The rules class by class, in this order of the classes (their `kind`).

    Raises `UpdateError` if a rule is of no class in the order, or a class has no rule.

    >>> from ttr import Rec
    >>> from ttr.updates import rule
    >>> @rule(when=Rec, kind="integrate")
    ... def note(s): ...
    >>> @rule(when=Rec, kind="plan")
    ... def reply(s): ...
    >>> print(by_class(reply, note, order=["integrate", "plan"]))
    by_class(integrate, plan)
    """
    if isinstance(order, str):
        raise UpdateError(f"the order of classes is a list of words, found {order!r}")
    for one in rules:
        if not isinstance(one, Rule):
            raise UpdateError(f"by_class takes rules, found {kind_of(one)}")
        if one.kind not in order:
            known = suggestion(one.kind, order)
            found = f"is of the class {one.kind}" if one.kind else "has no class"
            raise UpdateError(
                f"the rule {one} {found}; the order is {', '.join(order)}",
                hint=known or "give it a class by kind=",
            )
    classes = {kind: tuple(r for r in rules if r.kind == kind) for kind in order}
    for kind, members in classes.items():
        if not members:
            raise UpdateError(
                f"no rule is of the class {kind}",
                hint=suggestion(kind, [one.kind for one in rules]),
            )
    return ByClass(tuple(classes.items()))


def ask(*parts: Algorithm, choose: Choose) -> Ask:
    """The one that `choose` picks among those that apply.

    `choose` takes the names of those that apply and the state, and gives an index or
    None. Raises `UpdateError` if it cannot be called.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ...     rule ask(s : Board) := [qud = [q1] : list(Question)]
    ... ''')
    >>> last = ask(*talk.rules.values(), choose=lambda names, state: len(names) - 1)
    >>> print(run(last, record(qud=["q2"]), type=talk.Board, model=Model(talk)).state)
    {qud = [q1]}
    """
    if not callable(choose):
        raise UpdateError(f"what chooses is a function, found {choose!r}")
    return Ask(check_strategies("ask", parts), choose)


def check_strategies(name: str, parts: tuple[object, ...]) -> tuple[Algorithm, ...]:
    """The parts, which have to be rules or strategies. Raises `UpdateError`."""
    for part in parts:
        if not isinstance(part, Algorithm):
            raise UpdateError(f"{name} takes rules and strategies, found {part!r}")
    return parts  # type: ignore[return-value]


def rules_of(algorithm: Algorithm) -> tuple[Rule, ...]:
    """The rules in a strategy, each once, in the order in which they stand.

    >>> from ttr import Theory
    >>> from ttr.updates import maybe, seq
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> drop = talk.rules["drop"]
    >>> rules_of(seq(drop, maybe(drop)))
    (<Rule drop>,)
    """
    return tuple(dict.fromkeys(rule_occurrences(algorithm)))


def event_types(rules: Iterable[Rule]) -> tuple[TypeNode, ...]:
    """The types of the events that some rules take, each once."""
    return tuple(dict.fromkeys(rule.on for rule in rules if rule.on is not None))


def rule_occurrences(algorithm: Algorithm) -> Iterator[Rule]:
    """The rules in a strategy, each as often as it occurs."""
    return (one for one in strategies_in(algorithm) if isinstance(one, Rule))


def strategies_in(algorithm: Algorithm) -> Iterator[Algorithm]:
    """The strategy, then all strategies and rules in it, the outer before the inner."""
    yield algorithm
    for part in parts_of(algorithm):
        yield from strategies_in(part)


def parts_of(algorithm: Algorithm) -> tuple[Algorithm, ...]:
    """The strategies and rules that a strategy is made of; a rule is made of none."""
    match algorithm:
        case Rule():
            return ()
        case Maybe(part) | Repeat(part):
            return (part,)
        case ByClass(classes):
            return tuple(rule for _, members in classes for rule in members)
    return algorithm.parts


def replace_rules(algorithm: Algorithm, rules: Mapping[str, Rule]) -> Algorithm:
    """The strategy with these rules in place of those with the same names.

    >>> from dataclasses import replace
    >>> from ttr import Rec
    >>> from ttr.updates import first, rule
    >>> @rule(when=Rec)
    ... def greet(s): ...
    >>> polite = replace(greet, doc="Greet whoever comes.")
    >>> rules_of(replace_rules(first(greet), {"greet": polite}))[0].doc
    'Greet whoever comes.'
    """
    match algorithm:
        case Rule():
            return rules.get(algorithm.name, algorithm)
        case Maybe(part) | Repeat(part):
            return replace(algorithm, part=replace_rules(part, rules))
        case ByClass(classes):
            new = [(k, tuple(rules.get(r.name, r) for r in rs)) for k, rs in classes]
            return ByClass(tuple(new))
    parts = tuple(replace_rules(part, rules) for part in algorithm.parts)
    return replace(algorithm, parts=parts)


def _demands_of_strategy(algorithm: Algorithm) -> Demands:
    """What any state has to have for a strategy to apply to it."""
    match algorithm:
        case Rule(on=None):
            return demands_of(algorithm.when)
        case Repeat(part) | Seq((part, *_)):
            return _demands_of_strategy(part)
        case ByClass(classes):
            return demands_of_any(
                _demands_of_strategy(one) for _, members in classes for one in members
            )
        case First(parts) | All(parts) | Ask(parts) if parts:
            return demands_of_any(map(_demands_of_strategy, parts))
    return {}
