"""How an atom follows from others by axioms that hold under conditions.

`ltm(a, V) <: believe(a, C) if V <= C up to relabelling` puts infinitely many contents
above each view. So what follows is not listed: of a given atom it is asked on which
known ones it may rest, and what has to hold then.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from ttr.safety.budgets import spend
from ttr.signature.axioms import (
    Atom,
    Binding,
    instantiate,
    match_schema,
    subtypes,
    supertypes,
)
from ttr.signature.signature import (
    Axiom,
    Condition,
    Head,
    Signature,
    head,
    reachable_heads,
)
from ttr.types.interning import identity


@dataclass(frozen=True)
class Way:
    """A way for an atom to follow: from a known one, by axioms, if conditions hold."""

    source: Atom
    axioms: tuple[Axiom, ...] = ()
    conditions: tuple[Condition, ...] = ()

    def extend(self, *axioms: Axiom, when: tuple[Condition, ...] = ()) -> Way:
        """The way that goes on by these axioms, under these conditions too."""
        conditions = (*self.conditions, *when)
        return replace(self, axioms=(*self.axioms, *axioms), conditions=conditions)


def ways_to_follow(
    goal: Atom, known: Iterable[Atom], theory: Signature
) -> Iterator[Way]:
    """The ways in which an atom follows from known ones by axioms with conditions.

    What follows by other axioms alone is found by `supertypes`.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     pred  dog(Ind), ltm(Ind, RecType), believe(Ind, RecType)
    ...     ltm(a, V) <: believe(a, C) if V <= C up to relabelling
    ...     object sam : Ind
    ... ''')
    >>> goal = theory.parse("believe(sam, [y : Ind])")
    >>> for way in ways_to_follow(goal, [theory.parse("ltm(sam, [x : Ind])")], theory):
    ...     print(way.source, "if", *way.conditions)
    ltm(sam, [x : Ind]) if [x : Ind] <= [y : Ind] up to relabelling
    """
    if head(goal) not in theory.conditional_heads:
        return
    reached = list(_follow_forwards(known, theory))
    for way in _follow_backwards(goal, reached, theory, frozenset()):
        if any(axiom.when for axiom in way.axioms):
            yield way


def _follow_forwards(
    known: Iterable[Atom], theory: Signature
) -> Iterator[tuple[Atom, Way]]:
    """What follows from known atoms, where a content is as narrow as its bound.

    Of all the contents above a view that is the view: what follows from any of them
    with a condition follows from this one, too.
    """
    waiting = [(T, Way(T)) for T in known]
    seen = {T for T, _ in waiting}
    for T, way in waiting:
        spend()
        yield T, way
        further = [
            (upper, way.extend(axiom)) for axiom, upper in supertypes(T, theory.axioms)
        ]
        for axiom in theory.conditional_axioms:
            bound = match_schema(axiom.lower, T)
            narrowest = None if bound is None else _bind_to_bounds(axiom, bound)
            if narrowest is not None:
                upper = instantiate(axiom.upper, narrowest)
                when = _instantiate_conditions(axiom, narrowest)
                further.append((upper, way.extend(axiom, when=when)))
        for upper, there in further:
            if upper not in seen:
                seen.add(upper)
                waiting.append((upper, there))


def _bind_to_bounds(axiom: Axiom, bound: Binding) -> Binding | None:
    """The binding that also has S for T wherever S <= T; None if that is not all."""
    found = dict(bound)
    for condition in axiom.when:
        found.update(condition.narrowest(found))
    return found if axiom.variables <= found.keys() else None


def _follow_backwards(
    goal: Atom,
    reached: list[tuple[Atom, Way]],
    theory: Signature,
    asked: frozenset[Atom],
) -> Iterator[Way]:
    """The ways to the goal; none goes through what is asked already."""
    spend()
    if goal in asked:
        return
    asked |= {goal}
    targets = [(goal, ()), *((T, (by,)) for by, T in subtypes(goal, theory.axioms))]
    for target, by in targets:
        yield from (way.extend(*by) for T, way in reached if T is target)
        for axiom in theory.conditional_axioms:
            bound = match_schema(axiom.upper, target)
            if bound is None:
                continue
            if axiom.variables <= bound.keys():
                when = _instantiate_conditions(axiom, bound)
                lower = instantiate(axiom.lower, bound)
                for way in _follow_backwards(lower, reached, theory, asked):
                    yield way.extend(axiom, *by, when=when)
                continue
            for T, way in reached:
                both = _combine(bound, match_schema(axiom.lower, T))
                if both is not None and axiom.variables <= both.keys():
                    when = _instantiate_conditions(axiom, both)
                    yield way.extend(axiom, *by, when=when)


def _combine(bound: Binding, more: Binding | None) -> Binding | None:
    """Both bindings, if they agree."""
    if more is None:
        return None
    shared = bound.keys() & more.keys()
    if any(identity(bound[one]) != identity(more[one]) for one in shared):
        return None
    return {**bound, **more}


def _instantiate_conditions(axiom: Axiom, bound: Binding) -> tuple[Condition, ...]:
    """The conditions of an axiom on these values, without those that hold by form."""
    conditions = [condition.with_values(bound) for condition in axiom.when]
    return tuple([one for one in conditions if not one.holds_by_form])


def heads_below(heads: Iterable[Head], theory: Signature) -> tuple[Head, ...]:
    """The basic types and predicates from which axioms may lead to one of these."""
    steps = [(head(one.upper), head(one.lower)) for one in theory.axioms]
    return reachable_heads(heads, steps)
