"""A rule set to be checked: its rules, and what is known of states and events."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TypeAlias
from weakref import WeakKeyDictionary

from ttr.computing.case_analysis import cases_or_whole
from ttr.computing.prover import Prover
from ttr.computing.subtyping import subtype
from ttr.errors import Span, TTRError
from ttr.judging.models import Model
from ttr.persistent_maps import Map
from ttr.probability import REFUTED
from ttr.signature.signature import Signature
from ttr.types.interning import identity
from ttr.types.objects import Object, Path, Record
from ttr.types.paths import free_paths, subterms
from ttr.types.syntax import (
    Basic,
    Pred,
    PType,
    Rec,
    RecordType,
    Singleton,
    TypeNode,
    meet,
)
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
    descend,
    leaf_fields,
    views_along,
)
from ttr.updates.rules import Body, Rule
from ttr.updates.update_strategies import Algorithm, event_types, rules_of

Demand: TypeAlias = tuple[Labels, TypeNode]
"""A path of the state, and the type of which a rule asks it to be."""


@lru_cache(maxsize=1024)
def _summarise(rule: Rule) -> EffectSummary:
    """Summarise what a rule's effect reads and writes, however it is written."""
    if isinstance(rule.effect, Body):
        return summarise_notation(rule, rule.effect)
    source = source_of(rule.effect)
    return UNKNOWN_EFFECT if source is None else summarise_python(source, rule)


@dataclass(frozen=True)
class RuleSet:
    """The rules of a strategy, the type of its states, and the state it starts from.

    `hears` are the types of the events from outside; if it is empty, any may come, and
    `heard_at` the places where they are written. `agenda` is the path of the planned
    moves, if there is one. `game` is the name of the game that the rules are those of,
    and `known` are the rules of its theory, whether they are in the game or not.
    """

    algorithm: Algorithm
    type: RecordType
    start: Record | None
    model: Model
    hears: tuple[TypeNode, ...]
    agenda: Labels | None = None
    game: str = ""
    known: tuple[Rule, ...] = ()
    heard_at: tuple[Span, ...] = ()

    @cached_property
    def rules(self) -> tuple[Rule, ...]:
        """The rules, each once, in the order in which they stand."""
        return rules_of(self.algorithm)

    @cached_property
    def summaries(self) -> Mapping[Rule, EffectSummary]:
        """What each rule's effect reads and writes."""
        return {rule: _summarise(rule) for rule in self.rules}

    def summary_of(self, rule: Rule) -> EffectSummary:
        """What the effect of any rule reads and writes, also of one left out."""
        return self.summaries[rule] if rule in self.summaries else _summarise(rule)

    @cached_property
    def left_out(self) -> tuple[Rule, ...]:
        """The rules of the theory that the strategy of the game leaves out."""
        played = set(map(id, self.rules))
        return tuple(rule for rule in self.known if id(rule) not in played)

    def name_of(self, T: TypeNode) -> str:
        """The name by which the theory defines a type, or else the type as text."""
        return self._names.get(identity(T), str(T))

    @cached_property
    def _names(self) -> Mapping[object, str]:
        names: dict[object, str] = {}
        for name, value in self.model.theory.definitions.items():
            names.setdefault(identity(value), name)
        return names

    @cached_property
    def demands(self) -> Mapping[Rule, tuple[Demand, ...]]:
        """What each rule asks of the state that the start does not have."""
        return {rule: tuple(self._demands_of(rule)) for rule in self.rules}

    def _demands_of(self, rule: Rule) -> Iterator[Demand]:
        if self.start is None or rule.when is self.type:
            return
        for path, T in leaf_fields(rule.when):
            if not path or free_paths(T) or T in views_along(self.type, path):
                continue
            found = views_along(Term(self.start), path)
            if all(self.excludes(view, T) for view in found):
                yield path, T

    @cached_property
    def may_learn(self) -> bool:
        """May a rule add facts to the model?"""
        asking = (rule for rule in self.rules if "model" in rule.takes)
        return any(not isinstance(rule.effect, Body) for rule in asking)

    # --- where paths lead -------------------------------------------------------------

    @cached_property
    def _views_written(self) -> Mapping[Labels, Views]:
        """The views of what rules set, by its path."""
        placed: dict[Labels, Views] = {}
        for rule, summary in self.summaries.items():
            for write in summary.writes:
                brought = self.views_brought_by(rule, write) or (Rec,)
                known = (*placed.get(write.path, ()), *brought)
                placed[write.path] = tuple(dict.fromkeys(known))
        return placed

    def views_brought_by(self, rule: Rule, write: Write) -> Views:
        """The views of what a write sets; none if it may be anything."""
        if write.term is None or not isinstance(write.term.value, Path):
            if write.term is not None and not free_paths(write.term.value):
                return (write.term,)
            return () if write.type is None else (write.type,)
        variable, *labels = write.term.value.labels
        found = self._types_at(rule, variable, tuple(labels))
        return () if isinstance(found, Missing) else found

    def _types_at(self, rule: Rule, variable: str, path: Labels) -> Views | Missing:
        """The views at a path by the types alone."""
        return descend(self._views_of_variables(rule).get(variable, ()), path)

    def _views_of_variables(self, rule: Rule) -> Mapping[str, Views]:
        """The views of each variable of a rule."""
        state, *event = rule.names
        roots: dict[str, Views] = {state: (self.type, rule.when)}
        if rule.on is not None:
            roots[event[0]] = (rule.on,)
        for label, field in rule.where.fields if rule.where else ():
            roots[label] = (field,)
        return roots

    def views_at(self, rule: Rule, variable: str, path: Labels) -> Views | Missing:
        """The views at a path that starts at a variable of a rule, or what is missing.

        An event may also be of the types that other rules take, as they see it, too.
        """
        roots = self._views_of_variables(rule).get(variable, ())
        if variable == rule.names[0]:
            return descend((*roots, *self._views_of_start), path, self._views_written)
        if variable in rule.names:
            return descend((*roots, *self._views_of_events), path)
        return descend(roots, path)

    @cached_property
    def _views_of_events(self) -> Views:
        """The types of the events that rules take, or that are heard."""
        return tuple(dict.fromkeys((*event_types(self.rules), *self.hears)))

    def views_in_state(self, path: Labels) -> Views | Missing:
        """The views at a path of a state, or what is missing."""
        return descend((self.type, *self._views_of_start), path, self._views_written)

    @property
    def _views_of_start(self) -> Views:
        return () if self.start is None else (Term(self.start),)

    # --- what excludes what -----------------------------------------------------------

    @cached_property
    def open_model(self) -> Model:
        """The model in which whatever is not known may still be the case."""
        facts = self.model.facts
        heads = dict.fromkeys(
            part.pred if isinstance(part, PType) else part
            for part in subterms(self._types_asked_for())
            if isinstance(part, Basic | PType | Pred)
        )
        opened = facts.opened.update(Map(dict.fromkeys(heads, True)))
        return Model.of(replace(facts, opened=opened))

    def _types_asked_for(self) -> Iterator[Object]:
        """The types in which those are of which the checks judge objects to be."""
        yield self.type
        for rule in self.rules:
            yield from (rule.when, rule.where)

    def excludes(self, found: View, T: TypeNode) -> bool:
        """Is something with this view surely not of a type?"""
        if free_paths(T) or found is T:
            return False
        if isinstance(found, Term):
            return self._is_refuted(found.value, T)
        return not free_paths(found) and not self.are_compatible(found, T)

    def _is_refuted(self, value: Object, T: TypeNode) -> bool:
        """Is an object not of a type, whatever else may become known?"""
        try:
            return self.open_model.judge(value, T).p == REFUTED
        except TTRError:
            return False

    def are_compatible(self, *types: TypeNode) -> bool:
        """May something be of all of these types, as far as is known?"""
        return not self.remember(
            frozenset(types), lambda: _is_impossible(meet(*types), self.model.theory)
        )

    def may_coincide(self, S: TypeNode, T: TypeNode) -> bool:
        """May something that is meant to be of S well be of T?

        This is stricter than `are_compatible`: something is of two basic types, or two
        ptypes, only if one is a subtype of the other.
        """
        match S, T:
            case Singleton(base, _), _:
                return self.may_coincide(base, T) and self.are_compatible(S, T)
            case _, Singleton(base, _):
                return self.may_coincide(S, base) and self.are_compatible(S, T)
            case RecordType(), RecordType():
                shared = [label for label in S if label in T]
                return all(self.may_coincide(S[label], T[label]) for label in shared)
            case PType(one, _), PType(other, _) if one is other:
                return True
            case Basic() | PType(), Basic() | PType():
                return self.covers(S, T) or self.covers(T, S)
        return True

    def covers(self, wide: TypeNode, narrow: TypeNode) -> bool:
        """Is everything of the narrow type surely of the wide one?"""
        return self.remember(
            (wide, narrow), lambda: subtype(narrow, wide, self.model.theory).yes
        )

    def remember(self, question: object, answer: Callable[[], bool]) -> bool:
        """The answer to a question, computed when it is first asked in a theory."""
        memory = _ANSWERS.setdefault(self.model.theory, {})
        if question not in memory:
            memory[question] = answer()
        return memory[question]


_ANSWERS: WeakKeyDictionary[Signature, dict[object, bool]] = WeakKeyDictionary()
"""What was found out about types in a theory, for all rule sets that are in it."""


def _is_impossible(T: TypeNode, theory: Signature) -> bool:
    """Is surely nothing of a type, under any assignment?"""
    try:
        provers = (Prover.for_type(case, theory) for case in cases_or_whole(T))
        return all(prover.is_impossible for prover in provers)
    except TTRError:
        return False
