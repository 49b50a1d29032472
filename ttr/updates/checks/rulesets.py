"""A rule set as it is checked: its rules, and what is known of states and events."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TypeAlias

from immutables import Map

from ttr.computing.case_analysis import cases
from ttr.computing.prover import Prover
from ttr.computing.subtyping import subtype
from ttr.errors import TTRError
from ttr.judging.models import Model
from ttr.probability import REFUTED
from ttr.signature.signature import Signature
from ttr.types.paths import escaping, occurring
from ttr.types.syntax import (
    Basic,
    Object,
    Path,
    Pred,
    PType,
    Rec,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    meet,
)
from ttr.updates.algorithms import Algorithm, rules_of
from ttr.updates.checks.effect_summaries import UNKNOWN_EFFECT, EffectSummary, Write
from ttr.updates.checks.notation_effects import summarise_notation
from ttr.updates.checks.python_effects import summarise_python
from ttr.updates.checks.python_sources import source_of
from ttr.updates.checks.state_layout import (
    Labels,
    Missing,
    Term,
    View,
    Views,
    along,
    descend,
    leaves,
)
from ttr.updates.rules import Body, Rule

__all__ = ["Demand", "RuleSet"]

Demand: TypeAlias = tuple[Labels, TypeNode]
"""What a rule asks of a place of the state."""


@lru_cache(maxsize=1024)
def _summarise(rule: Rule) -> EffectSummary:
    """Summarise what a rule's effect reads and writes, however it is written."""
    if isinstance(rule.effect, Body):
        return summarise_notation(rule, rule.effect)
    source = source_of(rule.effect)
    return UNKNOWN_EFFECT if source is None else summarise_python(source, rule)


@dataclass(frozen=True, eq=False)
class RuleSet:
    """The rules of a strategy, the type of its states, and what they start from.

    `hears` are the types of the events that come from outside, none where any may;
    `agenda` is the path of the moves that are planned, where there is one.
    """

    algorithm: Algorithm
    type: RecordType
    start: Record | None
    model: Model
    hears: tuple[TypeNode, ...]
    agenda: Labels | None = None

    @cached_property
    def rules(self) -> tuple[Rule, ...]:
        """The rules, each once, in the order in which they stand."""
        return rules_of(self.algorithm)

    @cached_property
    def summaries(self) -> Mapping[Rule, EffectSummary]:
        """What each rule's effect reads and writes."""
        return {rule: _summarise(rule) for rule in self.rules}

    @cached_property
    def demands(self) -> Mapping[Rule, tuple[Demand, ...]]:
        """What each rule asks of places of the state that not every start has there."""
        return {rule: tuple(self._demanded(rule)) for rule in self.rules}

    def _demanded(self, rule: Rule) -> Iterator[Demand]:
        if self.start is None or rule.when is self.type:
            return
        for path, T in leaves(rule.when):
            if not path or escaping(T) or T in along(self.type, path):
                continue
            found = along(Term(self.start), path)
            if all(self.excludes(view, T) for view in found):
                yield path, T

    @cached_property
    def learns(self) -> bool:
        """Whether a rule may add facts to the model."""
        asking = (rule for rule in self.rules if "model" in rule.takes)
        return any(not isinstance(rule.effect, Body) for rule in asking)

    # --- where paths lead -------------------------------------------------------------

    @cached_property
    def _placed(self) -> Mapping[Labels, Views]:
        """What is set whole, at each path: of which types that is."""
        placed: dict[Labels, Views] = {}
        for rule, told in self.summaries.items():
            for write in told.writes:
                brought = self.brought(rule, write) or (Rec,)
                known = (*placed.get(write.path, ()), *brought)
                placed[write.path] = tuple(dict.fromkeys(known))
        return placed

    def brought(self, rule: Rule, write: Write) -> Views:
        """What a write brings to where it sets; nothing where that may be anything."""
        if write.term is None or not isinstance(write.term.value, Path):
            if write.term is not None and not escaping(write.term.value):
                return (write.term,)
            return () if write.type is None else (write.type,)
        variable, *labels = write.term.value.labels
        found = self._led(rule, variable, tuple(labels))
        return () if isinstance(found, Missing) else found

    def _led(self, rule: Rule, variable: str, path: Labels) -> Views | Missing:
        """Where a path leads, by the types alone."""
        return descend(self._roots(rule).get(variable, ()), path)

    def _roots(self, rule: Rule) -> Mapping[str, Views]:
        """What each variable of a rule is of."""
        state, *event = rule.names
        roots: dict[str, Views] = {state: (self.type, rule.when)}
        if rule.on is not None:
            roots[event[0]] = (rule.on,)
        for label, field in rule.where.fields if rule.where else ():
            roots[label] = (field,)
        return roots

    def led(self, rule: Rule, variable: str, path: Labels) -> Views | Missing:
        """What is known of where a path leads that begins with a variable of a rule.

        An event may be of what other rules take, too, as where one follows another.
        """
        roots = self._roots(rule).get(variable, ())
        if variable == rule.names[0]:
            return descend((*roots, *self._started), path, self._placed)
        if variable in rule.names:
            return descend((*roots, *self._events), path)
        return descend(roots, path)

    @cached_property
    def _events(self) -> Views:
        """The types of the events that any rule takes, or that are heard."""
        taken = (rule.on for rule in self.rules if rule.on is not None)
        return tuple(dict.fromkeys((*taken, *self.hears)))

    def leads(self, path: Labels) -> Views | Missing:
        """What is known of where a path leads in a state of no rule in particular."""
        return descend((self.type, *self._started), path, self._placed)

    @property
    def _started(self) -> Views:
        return () if self.start is None else (Term(self.start),)

    # --- what excludes what -----------------------------------------------------------

    @cached_property
    def opened(self) -> Model:
        """The model in which anything that was not said may still be so."""
        facts = self.model.facts
        heads = dict.fromkeys(
            part.pred if isinstance(part, PType) else part
            for part in occurring(self._types())
            if isinstance(part, Basic | PType | Pred)
        )
        opened = facts.opened.update(Map(dict.fromkeys(heads, True)))
        return Model.of(replace(facts, opened=opened))

    def _types(self) -> Iterator[Object]:
        yield self.type
        yield from self.hears
        for rule in self.rules:
            yield from (T for T in (rule.when, rule.on, rule.where, rule.gives) if T)
            for write in self.summaries[rule].writes:
                yield from (write.type,) if write.type else ()
                yield from (write.term.value,) if write.term else ()

    @cached_property
    def _answers(self) -> dict[object, bool]:
        return {}

    def excludes(self, found: View, T: TypeNode) -> bool:
        """Whether a type or an object surely has nothing to do with a type."""
        if escaping(T) or found is T:
            return False
        if isinstance(found, Term):
            return self._refuted(found.value, T)
        return not escaping(found) and not self.together(found, T)

    def _refuted(self, value: Object, T: TypeNode) -> bool:
        """Whether an object is not of a type, whatever else may become known."""
        try:
            return self.opened.judge(value, T).p == REFUTED
        except TTRError:
            return False

    def together(self, *types: TypeNode) -> bool:
        """Whether something may be of all of the types, as far as is known."""
        return not self.remembered(
            frozenset(types), lambda: _impossible(meet(*types), self.model.theory)
        )

    def alike(self, S: TypeNode, T: TypeNode) -> bool:
        """Whether what is made to be of one type may well be of the other.

        That something is of two basic types, or of two predications, is thought of only
        where the theory says so.
        """
        match S, T:
            case Singleton(base, _), _:
                return self.alike(base, T) and self.together(S, T)
            case _, Singleton(base, _):
                return self.alike(S, base) and self.together(S, T)
            case RecordType(), RecordType():
                shared = [label for label in S if label in T]
                return all(self.alike(S[label], T[label]) for label in shared)
            case PType(one, _), PType(other, _) if one is other:
                return True
            case Basic() | PType(), Basic() | PType():
                return self.covers(S, T) or self.covers(T, S)
        return True

    def covers(self, wide: TypeNode, narrow: TypeNode) -> bool:
        """Whether what is of one type is surely of another."""
        return self.remembered(
            (wide, narrow), lambda: subtype(narrow, wide, self.model.theory).yes
        )

    def remembered(self, question: object, answer: Callable[[], bool]) -> bool:
        """The answer to a question, worked out when it is asked for the first time."""
        if question not in self._answers:
            self._answers[question] = answer()
        return self._answers[question]


def _impossible(T: TypeNode, theory: Signature) -> bool:
    """Whether surely nothing is of a type, under any assignment."""
    try:
        every = cases(T) or (T,)
        return all(Prover.for_type(case, theory).is_impossible for case in every)
    except TTRError:
        return False
