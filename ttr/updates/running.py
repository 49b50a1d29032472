"""Running an update algorithm: events through rules, each state checked, with a trace.

The state is checked against its declared type after every rule, so that a rule that
fails, or a state that leaves its type, changes nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from time import perf_counter
from typing import NamedTuple

from ttr.errors import Endless, UpdateError
from ttr.judging.certainty import certainly_also
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.probability import CERTAIN, Degree
from ttr.safety.budgets import within_budget
from ttr.types.printing import notation
from ttr.types.records import differences
from ttr.types.syntax import (
    FiniteSet,
    Object,
    Record,
    RecordType,
    TypeNode,
    freeze,
    kind_of,
)
from ttr.updates.algorithms import (
    Algorithm,
    All,
    Ask,
    ByClass,
    First,
    Maybe,
    Measure,
    Repeat,
    Seq,
    checked,
)
from ttr.updates.effect_application import settled
from ttr.updates.matching import found
from ttr.updates.nbest import Heard, NBest, heard
from ttr.updates.rules import Rule
from ttr.updates.states import check_state, still_of
from ttr.updates.user_functions import failing, in_short

__all__ = ["Run", "Step", "continued", "run"]

ROUNDS = 1000
"""How often anything is repeated at most, where neither times nor measure are given."""


@dataclass(frozen=True, eq=False)
class Step:
    """One rule that was applied: to what, what it bound, and what it changed.

    `event` is what the rule took of what happened, with probability `p`, and `given`
    all that may have happened; `created` are the paths of what the rule only typed and
    had to be made up; `seconds` is how long it took.
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
        """The judgement that allowed the rule: that the state was of its condition."""
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


def _is_within(path: str, outer: str) -> bool:
    return path == outer or path.startswith(f"{outer}.")


class Run(NamedTuple):
    """The state and the model after a run, and the steps that led there."""

    state: Record
    model: Model
    trace: tuple[Step, ...]


def run(
    algorithm: Algorithm,
    state: Record,
    *,
    type: RecordType,
    model: Model,
    events: Iterable[object] = (),
) -> Run:
    """Plays the events through the algorithm, or runs it once where there are none.

    An event that nothing applies to leaves the state as it is. Raises `UpdateError`:
    `NoState` where the state is not of its type before the first or after any rule,
    `RuleFailed` where a rule fails, `Endless` where a repetition does not end; the
    caller's state and model stay what they were.
    """
    checked("run", (algorithm,))
    if isinstance(events, str | bytes | NBest | Record | Mapping | TypeNode):
        raise UpdateError(
            f"events are a list of objects, found the one {in_short(events)}"
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
        after = continued(algorithm, Run(state, model, ()), event, type)
        state, model = after.state, after.model
        trace += after.trace
    return Run(state, model, tuple(trace))


@within_budget
def continued(
    algorithm: Algorithm, so_far: Run, event: Object | NBest, type: RecordType
) -> Run:
    """The run after one more event, or the same run where nothing applies to it.

    The state so far has to be of the type; it is not checked again.
    """
    return _Player(type, event).play(algorithm, so_far) or so_far


# --- playing -------------------------------------------------------------------------


class _Asked:
    """Of which conditions one state was found to be or not, in one model."""

    def __init__(self) -> None:
        self._about: tuple[Record, Model] | None = None
        self._answers: dict[TypeNode, bool] = {}

    def about(self, state: Record, model: Model) -> dict[TypeNode, bool]:
        """The answers so far, none where it is another state or model."""
        known = self._about
        if known is None or known[0] is not state or known[1] is not model:
            self._about = (state, model)
            self._answers = {}
        return self._answers


@dataclass(frozen=True)
class _Player:
    """Plays one event; its methods give the run so far, or None if nothing applies."""

    type: RecordType
    event: Object | NBest
    asked: _Asked = field(default_factory=_Asked)

    def play(self, algorithm: Algorithm, so_far: Run) -> Run | None:
        match algorithm:
            case Rule():
                try:
                    return self._apply(algorithm, so_far)
                except UpdateError as error:
                    error.steps = error.steps or so_far.trace
                    raise
            case First(parts):
                for number in algorithm.sieve.left(so_far.state, so_far.model.facts):
                    after = self.play(parts[number], so_far)
                    if after is not None:
                        return after
                return None
            case All(parts):
                return self._each(parts, so_far)
            case ByClass(classes):
                return self._each([r for _, rules in classes for r in rules], so_far)
            case Seq(parts):
                return self._in_turn(parts, so_far)
            case Maybe(part):
                return self.play(part, so_far) or so_far
            case Repeat():
                return self._again(algorithm, so_far)
            case Ask():
                return self._chosen(algorithm, so_far)

    def _each(self, parts: Sequence[Algorithm], so_far: Run) -> Run | None:
        current, applied = so_far, False
        for part in parts:
            after = self.play(part, current)
            if after is not None:
                current, applied = after, True
        return current if applied else None

    def _in_turn(self, parts: Sequence[Algorithm], so_far: Run) -> Run | None:
        current: Run | None = so_far
        for part in parts:
            if current is None:
                return None
            current = self.play(part, current)
        return current

    def _chosen(self, asked: Ask, so_far: Run) -> Run | None:
        tried = [(part, self.play(part, so_far)) for part in asked.parts]
        able = [(str(part), after) for part, after in tried if after is not None]
        if not able:
            return None
        with failing("what chooses"):
            index = asked.choose([name for name, _ in able], so_far.state)
        if index is None:
            return None
        if type(index) is not int or not 0 <= index < len(able):
            raise UpdateError(
                f"what chooses gives an index below {len(able)}, or None, but gave "
                f"{in_short(index)}"
            )
        return able[index][1]

    def _again(self, repeat: Repeat, so_far: Run) -> Run | None:
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
            raise _endless(
                f"a repetition did not end after {rounds - 1} rounds; the last rules: "
                f"{last}",
                before,
            )
        if repeat.measure is None:
            return
        had, has = (_measured(repeat.measure, one.state) for one in (before, after))
        if not 0 <= has < had:
            named = repeat.measure if isinstance(repeat.measure, str) else "the measure"
            raise _endless(
                f"{named} should get smaller each time {repeat.part} is repeated, but "
                f"{after.trace[-1].rule} took it from {had} to {has}",
                after,
            )

    def _refuse_return(self, before: Run, after: Run, seen: dict[Record, int]) -> None:
        """Notes a state with its place in the trace; refuses one met in this model.

        Where a measure gets smaller no state can come back, and this is not asked.
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
        if len(names) == 1 and run.trace[-1].before == run.state:
            raise _endless(
                f"{names[0]} is repeated without changing anything",
                run,
                "let its precondition fail once its work is done",
            )
        raise _endless(
            f"a repetition goes in a circle: {' → '.join([*names, names[0]])}",
            run,
            "let a precondition fail once the work is done",
        )

    # --- one rule ---

    def _apply(self, rule: Rule, so_far: Run) -> Run | None:
        start = perf_counter()
        state, model, trace = so_far
        event = self._heard(rule, model)
        if event is None or not self._holds(rule.when, state, model):
            return None
        bound = self._bound(rule, state, event, model)
        if bound is None:
            return None
        bindings, model = bound
        effect = self._effect(rule, state, event, bindings, model)
        if effect is None:
            return None
        after = settled(rule, effect, state, model)
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
        return Run(after.state, after.model, (*trace, step))

    def _heard(self, rule: Rule, model: Model) -> Heard | None:
        if rule.on is None:
            return self._in_passing
        if self.event is None:
            return None
        return heard(self.event, rule.on, rule.p, model)

    @cached_property
    def _in_passing(self) -> Heard:
        """What a rule that takes no event is told of what happened."""
        return Heard(None if isinstance(self.event, NBest) else self.event, CERTAIN)

    def _holds(self, when: TypeNode, state: Record, model: Model) -> bool:
        """Whether the state is of a condition; several rules may have the same."""
        answers = self.asked.about(state, model)
        known = answers.get(when)
        if known is None:
            known = answers[when] = certainly_also(model.facts, state, when, self.type)
        return known

    def _bound(
        self, rule: Rule, state: Record, event: Heard, model: Model
    ) -> tuple[Mapping[str, Object], Model] | None:
        if rule.where is None:
            return {}, model
        variables = dict(zip(rule.names, (state, event.event), strict=False))
        with failing("the rule", rule):
            return found(rule.where, variables, model)

    def _effect(
        self,
        rule: Rule,
        state: Record,
        event: Heard,
        bindings: Mapping[str, Object],
        model: Model,
    ) -> object:
        args = (state,) if rule.on is None else (state, event.event)
        asked = {}
        if rule.takes:
            extras = {"model": model, "p": event.p, "nbest": self.event, **bindings}
            asked = {name: extras[name] for name in rule.takes}
        with failing("the rule", rule):
            return rule.effect(*args, **asked)

    def _check(self, rule: Rule, so_far: Run, after: Record, model: Model) -> None:
        same = model is so_far.model
        if not same or not still_of(so_far.state, after, self.type, model):
            check_state(after, self.type, model, f"after {rule}")
        if rule.gives is not None:
            check_state(after, rule.gives, model, f"after {rule}, by what it gives,")


def _endless(message: str, run: Run, hint: str = "") -> Endless:
    """That a repetition comes to no end, with the steps up to there."""
    error = Endless(message, hint=hint)
    error.steps = run.trace
    return error


def _measured(measure: Measure, state: Record) -> int:
    """The number that a measure is of a state: a list's length, or a whole number."""
    value: object
    if isinstance(measure, str):
        try:
            value = state[measure]
        except KeyError:
            raise UpdateError(
                f"the measure {measure} is no path of the state {in_short(state, str)}"
            ) from None
    else:
        with failing("the measure"):
            value = measure(state)
    if isinstance(value, list | tuple | FiniteSet):
        return len(value)
    if type(value) is int:
        return value
    raise UpdateError(f"a measure is a list or a whole number, found {in_short(value)}")
