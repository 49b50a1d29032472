"""Running an update algorithm: events through rules, with a trace.

The state is checked against its declared type after every rule. If a rule fails, or a
state is not of its type, nothing is changed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from time import perf_counter
from typing import Generic, NamedTuple, TypeAlias, TypeVar

from ttr.errors import EndlessError, UpdateError
from ttr.judging.certainty import is_certain_given
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.probability import CERTAIN, Degree
from ttr.safety.budgets import within_budget
from ttr.showing import (
    Fold,
    NotebookValue,
    Part,
    Text,
    Value,
    as_html,
    below,
    beside,
    count_of,
    table,
)
from ttr.types.objects import FiniteSet, Object, Record, freeze
from ttr.types.printing import notation
from ttr.types.records import NOTHING, Difference, differences, find_differences
from ttr.types.syntax import RecordType, TypeNode, kind_of
from ttr.updates.effect_application import apply_effect
from ttr.updates.matching import find_bindings
from ttr.updates.nbest import MatchedEvent, NBest, match_event
from ttr.updates.rules import Rule
from ttr.updates.states import check_state, is_still_of
from ttr.updates.update_strategies import (
    Algorithm,
    All,
    Ask,
    ByClass,
    First,
    Maybe,
    Measure,
    Repeat,
    Seq,
    check_strategies,
)
from ttr.updates.user_functions import blame, excerpt

ROUNDS = 1000
"""How often a repetition without times and measure is repeated at most."""


@dataclass(frozen=True, eq=False)
class Step(NotebookValue):
    """One rule that was applied: to what, what it bound, and what it changed.

    `event` is the event that the rule took, with probability `p`, and `given` the
    uncertain event that it comes from. `created` are the paths of what had to be
    created, as the rule gave only its type; `seconds` is how long the rule took.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> start = record(qud=["q2", "q1"])
    >>> after = run(talk.rules["drop"], start, type=talk.Board, model=Model(talk))
    >>> print(after.trace[0])
    drop
      qud: − q2
    """

    rule: Rule
    event: Object
    p: Degree
    bindings: Mapping[str, Object]
    before: Record
    after: Record
    created: tuple[str, ...]
    seconds: float
    model: Model
    given: Object | NBest

    @cached_property
    def licence(self) -> Judgement:
        """The judgement that the state was of the rule's condition."""
        return self.model.judge(self.before, self.rule.when)

    @cached_property
    def changes(self) -> tuple[str, ...]:
        """The differences between the states, path by path."""
        return tuple(differences(self.before, self.after))

    def __str__(self) -> str:
        doc = self.rule.doc.split("\n")[0]
        lines = [f"{self.rule.name}: {doc}" if doc else self.rule.name]
        if self.p.lo < 1.0:
            lines.append(f"  on {notation(self.event)}   p = {self.p}")
        lines += [f"  with {k} = {notation(v)}" for k, v in self.bindings.items()]
        for change in self.changes:
            path = change.partition(":")[0]
            made = any(_is_within(path, one) for one in self.created)
            lines.append(f"  {change}" + "   (created)" * made)
        return "\n".join(lines)

    def _shown_as_(self) -> Part:
        event = None if self.rule.on is None else self.event
        taken = below(_probability(self.p), Fold("the event", Value(event)))
        doc = Text(self.rule.doc.split("\n")[0]) if self.rule.doc else None
        return below(
            beside(Text(self.rule.name, "strong"), doc),
            None if event is None else taken,
            bindings_shown(self.bindings),
            differences_shown(self.before, self.after, self.created),
            Fold("the state after it", Value(self.after, before=self.before)),
        )


def bindings_shown(bindings: Mapping[str, Object]) -> Part | None:
    """What a rule bound."""
    bound = [
        beside(Text("with", "quiet"), Text(f"{name} ="), Value(value))
        for name, value in bindings.items()
    ]
    return below(*bound) if bound else None


def differences_shown(
    before: Record, after: Record, created: Sequence[str] = ()
) -> Part:
    """What differs between two states, path by path, as a table."""
    found = list(find_differences(before, after))
    if not found:
        return Text("nothing changed", "quiet")

    def row(it: Difference) -> tuple[Part, ...]:
        made = any(_is_within(it.path, one) for one in created)
        now = _shown_or_nothing(it.after, it.listed, "+")
        if made:
            now = beside(now, Text("created", "quiet"))
        was = _shown_or_nothing(it.before, it.listed, "−")
        return Text(it.path, "code"), was, now

    return table(("path", "before", "after"), found, row)


def _shown_or_nothing(value: Object, listed: bool, sign: str) -> Part:
    """An object of a difference, with a sign if it came into or left a list."""
    if value is NOTHING:
        return Text("" if listed else "nothing", "quiet")
    return beside(Text(sign), Value(value)) if listed else Value(value)


def _probability(p: Degree) -> Part | None:
    return Text(f"p = {p}", "quiet") if p.lo < 1.0 else None


def trace_shown(steps: Sequence[Step]) -> Part:
    """The rules that were applied, as a table."""
    if not steps:
        return Text("no rule applied", "quiet")

    def row(numbered: tuple[int, Step]) -> tuple[Part, ...]:
        number, step = numbered
        return (
            Text(str(number), "quiet"),
            beside(Text(step.rule.name, "strong"), _probability(step.p)),
            below(
                bindings_shown(step.bindings),
                differences_shown(step.before, step.after, step.created),
            ),
        )

    return table(
        ("", "rule", "what it did"), enumerate(steps, 1), row, count=len(steps)
    )


def _is_within(path: str, outer: str) -> bool:
    return path == outer or path.startswith(f"{outer}.")


Watch: TypeAlias = Callable[[Step], object]
"""Somebody who is given each step before a run goes on from it."""


class Run(NamedTuple):
    """The state and the model after a run, and the steps that led there.

    >>> from ttr import Model, Theory, record
    >>> from ttr.updates import run
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule drop(s : [qud : nelist(Question)]) :=
    ...         [qud = rst(s.qud) : list(Question)]
    ... ''')
    >>> drop, start = talk.rules["drop"], record(qud=["q2", "q1"])
    >>> state, M, trace = run(drop, start, type=talk.Board, model=Model(talk))
    >>> print(state, len(trace))
    {qud = [q1]} 1
    """

    state: Record
    model: Model
    trace: tuple[Step, ...]

    def _shown_as_(self) -> Part:
        before = self.trace[0].before if self.trace else None
        return below(
            Value(self.state, before=before),
            Fold(count_of(len(self.trace), "rule"), trace_shown(self.trace)),
        )

    def _repr_html_(self) -> str:  # a named tuple has no base class
        return as_html(self)

    def _repr_latex_(self) -> str | None:
        return NotebookValue._repr_latex_(self)  # type: ignore[arg-type]


def run(
    algorithm: Algorithm,
    state: Record,
    *,
    type: RecordType,
    model: Model,
    events: Iterable[object] = (),
) -> Run:
    """Play events through an algorithm; if there are none, run it once.

    If no rule applies to an event, the state stays as it is. Raises `UpdateError`:
    `NoStateError` if the state is not of its type before the first or after any rule,
    `RuleFailedError` if a rule fails, `EndlessError` if a repetition does not end. The
    state and the model that are given never change.

    >>> from ttr import Theory, record
    >>> talk = Theory.parse('''
    ...     basic Question
    ...     object q1, q2 : Question
    ...     Board := [qud : list(Question)]
    ...     rule push(s : Board, q : Question) :=
    ...         [qud = [q] + s.qud : list(Question)]
    ... ''')
    >>> start = record(qud=[])
    >>> push, asked = talk.rules["push"], ["q1", "q2"]
    >>> after = run(push, start, type=talk.Board, model=Model(talk), events=asked)
    >>> print(after.state)
    {qud = [q2, q1]}
    """
    check_strategies("run", (algorithm,))
    if isinstance(events, str | bytes | NBest | Record | Mapping | TypeNode):
        raise UpdateError(
            f"events are a list of objects, found the one {excerpt(events)}"
        )
    if not isinstance(events, Iterable):
        raise UpdateError(f"events are a list of objects, found {kind_of(events)}")
    if not isinstance(model, Model):
        raise UpdateError(f"a run is in a model, found {kind_of(model)}")
    state = freeze(state)
    played = [one if isinstance(one, NBest) else freeze(one) for one in events]
    check_state(state, type, model, "before the first rule")
    trace: list[Step] = []
    for event in played or (None,):
        after = continue_run(algorithm, Run(state, model, ()), event, type)
        state, model = after.state, after.model
        trace += after.trace
    return Run(state, model, tuple(trace))


@within_budget
def continue_run(
    algorithm: Algorithm,
    so_far: Run,
    event: Object | NBest,
    type: RecordType,
    watch: Watch | None = None,
) -> Run:
    """The run after one more event, or the same run if no rule applies to it.

    The state so far has to be of the type; it is not checked again. `watch` is given
    each step before the run goes on from it.
    """
    return _Player(type, event, watch).play(algorithm, so_far) or so_far


# --- playing -------------------------------------------------------------------------


_Asked = TypeVar("_Asked")
_Answer = TypeVar("_Answer")


class _AnswerCache(Generic[_Asked, _Answer]):
    """The answers to questions about one value, a state or an event, in one model."""

    def __init__(self) -> None:
        self._about: tuple[object, Model] | None = None
        self._answers: dict[_Asked, _Answer] = {}

    def about(self, value: object, model: Model) -> dict[_Asked, _Answer]:
        """The answers so far; none for another value or model."""
        known = self._about
        if known is None or known[0] is not value or known[1] is not model:
            self._about = (value, model)
            self._answers = {}
        return self._answers


@dataclass(frozen=True)
class _Player:
    """Plays one event; its methods give the run so far, or None if no rule applies."""

    type: RecordType
    event: Object | NBest
    watch: Watch | None = None
    conditions: _AnswerCache[TypeNode, bool] = field(default_factory=_AnswerCache)
    """Which conditions hold of the latest state."""
    matches: _AnswerCache[tuple[TypeNode, Degree], MatchedEvent | None] = field(
        default_factory=_AnswerCache
    )
    """As what the event is taken by the rules that wait for it."""

    def play(self, algorithm: Algorithm, so_far: Run) -> Run | None:
        match algorithm:
            case Rule():
                try:
                    return self._apply(algorithm, so_far)
                except UpdateError as error:
                    error.steps = error.steps or so_far.trace
                    raise
            case First(parts):
                for number in algorithm.rule_index.possible_demands(
                    so_far.state, so_far.model.facts
                ):
                    after = self.play(parts[number], so_far)
                    if after is not None:
                        return after
                return None
            case All(parts):
                return self._play_each(parts, so_far)
            case ByClass(classes):
                return self._play_each(
                    [r for _, rules in classes for r in rules], so_far
                )
            case Seq(parts):
                return self._play_in_sequence(parts, so_far)
            case Maybe(part):
                return self.play(part, so_far) or so_far
            case Repeat():
                return self._play_repeatedly(algorithm, so_far)
            case Ask():
                return self._play_chosen(algorithm, so_far)

    def _play_each(self, parts: Sequence[Algorithm], so_far: Run) -> Run | None:
        current, applied = so_far, False
        for part in parts:
            after = self.play(part, current)
            if after is not None:
                current, applied = after, True
        return current if applied else None

    def _play_in_sequence(self, parts: Sequence[Algorithm], so_far: Run) -> Run | None:
        current: Run | None = so_far
        for part in parts:
            if current is None:
                return None
            current = self.play(part, current)
        return current

    def _play_chosen(self, asked: Ask, so_far: Run) -> Run | None:
        tried = [(part, self.play(part, so_far)) for part in asked.parts]
        able = [(str(part), after) for part, after in tried if after is not None]
        if not able:
            return None
        with blame("what chooses"):
            index = asked.choose([name for name, _ in able], so_far.state)
        if index is None:
            return None
        if type(index) is not int or not 0 <= index < len(able):
            raise UpdateError(
                f"what chooses gives an index below {len(able)}, or None, but gave "
                f"{excerpt(index)}"
            )
        return able[index][1]

    def _play_repeatedly(self, repeat: Repeat, so_far: Run) -> Run | None:
        current, rounds = so_far, 0
        seen: dict[Record, int] = {}
        while True:
            following = self.play(repeat.part, current)
            if following is None:
                return None if rounds == 0 else current
            if following is current:
                return current
            rounds += 1
            self._check_progress(repeat, current, following, rounds)
            if repeat.measure is None:
                self._refuse_return(current, following, seen)
            current = following

    def _check_progress(
        self, repeat: Repeat, before: Run, after: Run, rounds: int
    ) -> None:
        most = repeat.times or (ROUNDS if repeat.measure is None else inf)
        if rounds > most:
            last = ", ".join(str(step.rule) for step in before.trace[-3:])
            raise endless(
                f"a repetition did not end after {rounds - 1} rounds; the last rules: "
                f"{last}",
                before,
            )
        if repeat.measure is None:
            return
        had, has = (_measure_of(repeat.measure, one.state) for one in (before, after))
        if not 0 <= has < had:
            named = repeat.measure if isinstance(repeat.measure, str) else "the measure"
            raise endless(
                f"{named} should get smaller each time {repeat.part} is repeated, but "
                f"{after.trace[-1].rule} took it from {had} to {has}",
                after,
            )

    def _refuse_return(self, before: Run, after: Run, seen: dict[Record, int]) -> None:
        """Refuse a state that occurred before in this model; otherwise remember it.

        This is not needed with a measure, as no state can occur again then.
        """
        if after.model is not before.model:
            seen.clear()
        elif not seen:
            seen[before.state] = len(before.trace)
        if after.state in seen:
            self._refuse_circle(after, seen)
        seen[after.state] = len(after.trace)

    def _refuse_circle(self, run: Run, seen: Mapping[Record, int]) -> None:
        steps = run.trace[seen[run.state] :]
        names = [str(step.rule) for step in steps]
        if len(names) == 1:
            raise endless(
                f"{names[0]} is repeated without changing anything",
                run,
                "let its precondition fail once its work is done",
            )
        raise endless(
            f"a repetition goes in a circle: {' → '.join([*names, names[0]])}",
            run,
            "let a precondition fail once the work is done",
        )

    # --- one rule ---

    def _apply(self, rule: Rule, so_far: Run) -> Run | None:
        start = perf_counter()
        state, model, trace = so_far
        event = self._match_event(rule, model)
        if event is None or not self._holds(rule.when, state, model):
            return None
        bound = self._find_bindings(rule, state, event, model)
        if bound is None:
            return None
        bindings, model = bound
        effect = self._call_effect(rule, state, event, bindings, model)
        if effect is None:
            return None
        after = apply_effect(rule, effect, state, model)
        self._check(rule, so_far, after.state, after.model)
        step = Step(
            rule,
            event.event,
            event.p,
            bindings,
            state,
            after.state,
            after.created,
            perf_counter() - start,
            so_far.model,
            event.event if rule.on is None else self.event,
        )
        if self.watch is not None:
            self.watch(step)
        return Run(after.state, after.model, (*trace, step))

    def _match_event(self, rule: Rule, model: Model) -> MatchedEvent | None:
        """The event as the rule takes it. Several rules may wait for the same one."""
        if rule.on is None:
            return self._event_in_passing
        if self.event is None:
            return None
        answers = self.matches.about(self.event, model)
        asked = rule.on, rule.p
        if asked not in answers:
            answers[asked] = match_event(self.event, rule.on, rule.p, model)
        return answers[asked]

    @cached_property
    def _event_in_passing(self) -> MatchedEvent:
        """The event as it appears in the step of a rule that takes none."""
        return MatchedEvent(
            None if isinstance(self.event, NBest) else self.event, CERTAIN
        )

    def _holds(self, when: TypeNode, state: Record, model: Model) -> bool:
        """Is the state of a condition? Several rules may have the same one."""
        answers = self.conditions.about(state, model)
        known = answers.get(when)
        if known is None:
            known = answers[when] = is_certain_given(
                model.facts, state, when, self.type
            )
        return known

    def _find_bindings(
        self, rule: Rule, state: Record, event: MatchedEvent, model: Model
    ) -> tuple[Mapping[str, Object], Model] | None:
        if rule.where is None:
            return {}, model
        variables = dict(zip(rule.names, (state, event.event), strict=False))
        with blame("the rule", rule):
            return find_bindings(rule.where, variables, model)

    def _call_effect(
        self,
        rule: Rule,
        state: Record,
        event: MatchedEvent,
        bindings: Mapping[str, Object],
        model: Model,
    ) -> object:
        args = (state,) if rule.on is None else (state, event.event)
        asked: dict[str, object] = {}
        for name in rule.takes:
            if name in bindings:
                asked[name] = bindings[name]
            elif name == "model":
                asked[name] = model
            else:
                asked[name] = event.p if name == "p" else self.event
        with blame("the rule", rule):
            return rule.effect(*args, **asked)

    def _check(self, rule: Rule, so_far: Run, after: Record, model: Model) -> None:
        same = model is so_far.model
        if not same or not is_still_of(so_far.state, after, self.type, model):
            check_state(after, self.type, model, f"after {rule}")
        if rule.gives is not None:
            check_state(after, rule.gives, model, f"after {rule}, by what it gives,")


def endless(message: str, run: Run, hint: str = "") -> EndlessError:
    """The error that something does not end, with the steps up to there."""
    error = EndlessError(message, hint=hint)
    error.steps = run.trace
    return error


def _measure_of(measure: Measure, state: Record) -> int:
    """The measure of a state as a number: a list's length, or a whole number."""
    value: object
    if isinstance(measure, str):
        try:
            value = state[measure]
        except KeyError:
            raise UpdateError(
                f"the measure {measure} is no path of the state {excerpt(state, str)}"
            ) from None
    else:
        with blame("the measure"):
            value = measure(state)
    if isinstance(value, list | tuple | FiniteSet):
        return len(value)
    if type(value) is int:
        return value
    raise UpdateError(f"a measure is a list or a whole number, found {excerpt(value)}")
