"""Information-state update: rules, strategies as values, and runs with a trace.

A rule has a precondition, a record type, and an effect, a pure function. A strategy
combines rules: `first`, `maybe`, `repeat`, `seq`. `run` plays events through a strategy
and checks the state against its declared type after every rule, so that a rule that
fails, or a state that leaves its type, changes nothing.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

from ttr.errors import TTRError, UpdateError
from ttr.judgements import Judgement
from ttr.merging import amerge, singleton_type
from ttr.models import Model
from ttr.printing import notation
from ttr.probability import CERTAIN
from ttr.records import differences
from ttr.syntax import Object, Record, RecordType, TypeNode, freeze, kind_of

__all__ = [
    "Algorithm",
    "First",
    "Maybe",
    "Repeat",
    "Rule",
    "Run",
    "Seq",
    "Step",
    "first",
    "maybe",
    "repeat",
    "rule",
    "run",
    "seq",
]

Effect: TypeAlias = Callable[..., object]


@dataclass(frozen=True)
class Rule:
    """An update rule: where `when` holds of the state, `effect` gives the next one.

    A rule with `on` takes an event of that type; one without is tacit. Built by `rule`.
    """

    name: str
    effect: Effect
    when: RecordType
    on: TypeNode | None
    takes_model: bool

    @property
    def doc(self) -> str:
        """What the rule is for, from the docstring of its effect."""
        return inspect.getdoc(self.effect) or ""

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class First:
    """The first of these that applies."""

    parts: tuple[Algorithm, ...]


@dataclass(frozen=True)
class Seq:
    """All of these, one after the other; it applies where all do."""

    parts: tuple[Algorithm, ...]


@dataclass(frozen=True)
class Maybe:
    """This if it applies, else nothing; it always applies."""

    part: Algorithm


@dataclass(frozen=True)
class Repeat:
    """This as long as it applies, once at least, and at most so many times."""

    part: Algorithm
    times: int


Algorithm: TypeAlias = Rule | First | Seq | Maybe | Repeat


def rule(*, when: RecordType, on: TypeNode | None = None) -> Callable[[Effect], Rule]:
    """Makes a rule of a function of the state, and of the event if the rule has one.

    The function may ask for the model by a parameter `model`. It gives the next state,
    or a pair of state and model when it adds facts, or a record type, as in the
    literature: then the next state is of the asymmetric merge of the state's own type
    with it. It gives None where it does not apply after all. Raises `UpdateError` where
    `when` is no record type, `on` no type, or the function's parameters are others.

    >>> from ttr.constructors import rectype
    >>> from ttr.syntax import Ind, record
    >>> from ttr.records import replace
    >>> @rule(when=rectype(spkr=Ind, addr=Ind))
    ... def take_turn(s):
    ...     "Who was spoken to speaks."
    ...     return replace(s, spkr=s.addr, addr=s.spkr)
    >>> M = Model().given("a", Ind).given("b", Ind)
    >>> state = record(spkr="a", addr="b")
    >>> after, M, trace = run(take_turn, state, type=take_turn.when, model=M)
    >>> print(after)
    {addr = a, spkr = b}
    >>> print(trace[0])
    take_turn: Who was spoken to speaks.
      addr: b → a
      spkr: a → b
    """

    if not isinstance(when, RecordType):
        raise UpdateError(f"the condition of a rule is a record type, found {when!r}")
    if on is not None and not isinstance(on, TypeNode):
        raise UpdateError(f"the event of a rule is of a type, found {on!r}")

    def made(effect: Effect) -> Rule:
        if not callable(effect):
            raise UpdateError(f"a rule is made of a function, found {effect!r}")
        name = getattr(effect, "__name__", "rule")
        asked = list(inspect.signature(effect).parameters)
        wanted = 1 + (on is not None)
        plain = [parameter for parameter in asked if parameter != "model"]
        if len(plain) != wanted:
            roles = "the state and the event" if on is not None else "the state"
            raise UpdateError(
                f"the rule {name} takes {roles}, and model by that name, "
                f"but its parameters are ({', '.join(asked)})"
            )
        return Rule(name, effect, when, on, "model" in asked)

    return made


def first(*parts: Algorithm) -> First:
    """The first of these rules or strategies that applies."""
    return First(_algorithms("first", parts))


def seq(*parts: Algorithm) -> Seq:
    """All of these in order; where one does not apply, none does."""
    return Seq(_algorithms("seq", parts))


def maybe(part: Algorithm) -> Maybe:
    """This if it applies, else nothing."""
    _algorithms("maybe", (part,))
    return Maybe(part)


def repeat(part: Algorithm, *, times: int = 1000) -> Repeat:
    """This again and again while it applies; more than `times` is an error."""
    _algorithms("repeat", (part,))
    if type(times) is not int or times < 1:
        raise UpdateError(f"repeat takes how often at most, found times={times!r}")
    return Repeat(part, times)


def _algorithms(name: str, parts: tuple[object, ...]) -> tuple[Algorithm, ...]:
    for part in parts:
        if not isinstance(part, Rule | First | Seq | Maybe | Repeat):
            raise UpdateError(f"{name} takes rules and strategies, found {part!r}")
    return parts  # type: ignore[return-value]


# --- running -------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Step:
    """One rule that was applied: what it changed, and the judgement that allowed it."""

    rule: Rule
    event: Object
    before: Record
    after: Record
    licence: Judgement

    @property
    def changes(self) -> tuple[str, ...]:
        """The differences between the states, path by path."""
        return tuple(differences(self.before, self.after))

    def __str__(self) -> str:
        doc = self.rule.doc.split("\n")[0]
        head = f"{self.rule.name}: {doc}" if doc else self.rule.name
        return "\n".join([head, *(f"  {change}" for change in self.changes)])


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
    events: Iterable[Object] = (),
) -> Run:
    """Plays the events through the algorithm, or runs it once where there are none.

    An event that nothing applies to leaves the state as it is. Raises `UpdateError`
    where the state is not of its type before the first or after any rule, a rule fails,
    or a repetition does not end; the caller's state and model stay what they were.
    """
    _algorithms("run", (algorithm,))
    if isinstance(events, str):
        raise UpdateError(f"events are a list of objects, found the one {events!r}")
    if not isinstance(events, Iterable):
        raise UpdateError(f"events are a list of objects, found {kind_of(events)}")
    if not isinstance(model, Model):
        raise UpdateError(f"a run is in a model, found {kind_of(model)}")
    state, events = freeze(state), tuple(map(freeze, events))
    _check(state, type, model, "before the first rule")
    trace: list[Step] = []
    for event in events or (None,):
        played = _Player(type, event).play(algorithm, Run(state, model, ()))
        if played is not None:
            state, model = played.state, played.model
            trace += played.trace
    return Run(state, model, tuple(trace))


def _check(state: Object, type: RecordType, model: Model, when: str) -> None:
    """Refuses what is not certainly a state of its type, and says where it fails."""
    if not isinstance(type, RecordType):
        raise UpdateError(f"the type of a state is a record type, found {type!r}")
    if not isinstance(state, Record):
        raise UpdateError(f"{when} the state is no record, but {notation(state)}")
    why = model.judge(state, type).why
    failed = why.failure()
    if failed is not None:
        claim = f"{notation(failed.sit)} : {failed.type}, {failed.rule}"
        raise UpdateError(
            f"{when} the state is not of its type, at {why.path()}: {claim}"
        )


@dataclass(frozen=True)
class _Player:
    """Plays one event; its methods give the run so far, or None if nothing applies."""

    type: RecordType
    event: Object

    def play(self, algorithm: Algorithm, so_far: Run) -> Run | None:
        match algorithm:
            case Rule():
                return self._apply(algorithm, so_far)
            case First(parts):
                tried = (self.play(part, so_far) for part in parts)
                return next((after for after in tried if after is not None), None)
            case Seq(parts):
                return self._in_turn(parts, so_far)
            case Maybe(part):
                return self.play(part, so_far) or so_far
            case Repeat(part, times):
                return self._again(part, times, so_far)

    def _in_turn(self, parts: tuple[Algorithm, ...], so_far: Run) -> Run | None:
        current: Run | None = so_far
        for part in parts:
            if current is None:
                return None
            current = self.play(part, current)
        return current

    def _again(self, part: Algorithm, times: int, so_far: Run) -> Run | None:
        current = so_far
        for _ in range(times):
            following = self.play(part, current)
            if following is None:
                return None if current is so_far else current
            if following is current:
                return current
            if following.state == current.state and following.model is current.model:
                raise UpdateError(
                    f"{following.trace[-1].rule} is repeated without changing anything",
                    hint="let its precondition fail once its work is done",
                )
            current = following
        following = self.play(part, current)
        if following is None or following is current:
            return current
        last = ", ".join(str(step.rule) for step in current.trace[-3:])
        raise UpdateError(
            f"a repetition did not end after {times} rounds; the last rules: {last}"
        )

    def _apply(self, rule: Rule, so_far: Run) -> Run | None:
        state, model, trace = so_far
        if rule.on is not None and not self._is_event(rule.on, model):
            return None
        licence = model.judge(state, rule.when)
        if licence.p != CERTAIN:
            return None
        effect = self._effect(rule, state, model)
        if effect is None:
            return None
        after, model = self._settled(rule, effect, state, model)
        _check(after, self.type, model, f"after {rule}")
        step = Step(rule, self.event, state, after, licence)
        return Run(after, model, (*trace, step))

    def _is_event(self, on: TypeNode, model: Model) -> bool:
        return self.event is not None and model.judge(self.event, on).p == CERTAIN

    def _effect(self, rule: Rule, state: Record, model: Model) -> object:
        args = (state,) if rule.on is None else (state, self.event)
        extra = {"model": model} if rule.takes_model else {}
        try:
            return rule.effect(*args, **extra)
        except TTRError as error:
            raise UpdateError(f"the rule {rule} failed: {error}") from error
        except Exception as error:
            fault = f"{error.__class__.__name__}: {error}"
            raise UpdateError(f"the rule {rule} failed: {fault}") from error

    def _settled(
        self, rule: Rule, effect: object, state: Record, model: Model
    ) -> tuple[Record, Model]:
        """The next state and model, whatever of the three kinds the effect is."""
        match effect:
            case Record():
                return effect, model
            case (Record() as after, Model() as extended):
                return after, extended
            case RecordType():
                return self._realised(rule, effect, state, model)
        raise UpdateError(
            f"the rule {rule} gives a state, a state and a model, a record type or "
            f"None, but it gave {effect!r}"
        )

    def _realised(
        self, rule: Rule, effect: RecordType, state: Record, model: Model
    ) -> tuple[Record, Model]:
        """A state of the asymmetric merge of the state's own type with the effect.

        What the state has beyond its declared type is kept.
        """
        try:
            own = singleton_type(state, self.type, model.theory)
            created, extended = model.create(amerge(own, effect, model.theory))
        except TTRError as error:
            raise UpdateError(
                f"no state can be made of what the rule {rule} gave: {error}"
            ) from error
        return Record({**state._fields, **created._fields}), extended
