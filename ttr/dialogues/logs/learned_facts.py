"""The facts that a turn adds to the model, so that a log can be continued."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from ttr.judging.models import Model
from ttr.judging.stated_dependence import Atom
from ttr.persistent_maps import Map
from ttr.probability import Degree
from ttr.types.objects import Object

_NONE: Map[Atom, Degree] = Map()


@dataclass(frozen=True)
class Fact:
    """A judgement of a basic type or ptype, as it was given to a model."""

    sit: Object
    type: Atom
    p: Degree


def new_facts(before: Model, after: Model) -> tuple[Fact, ...]:
    """The facts of a model that an earlier one lacks, in the order of their coming."""
    new: list[tuple[int, Fact]] = []
    for key, facts in after.facts.known.items():
        known = before.facts.known.get(key, _NONE)
        if facts is known:
            continue
        for T, p in facts.items():
            if known.get(T) != p:
                number, sit = after.facts.told[T][key]
                new.append((number, Fact(sit, T, p)))
    return tuple(fact for _, fact in sorted(new, key=lambda one: one[0]))


def differs_by_facts_only(before: Model, after: Model) -> bool:
    """Does a model differ from an earlier one by facts alone?

    Witness functions and conditional probabilities cannot be written down as facts.
    """
    was, has = before.facts, after.facts
    return has.functions is was.functions and has.links is was.links


def restore_facts(model: Model, facts: Iterable[Fact], names: int) -> Model:
    """The model with these facts, after it has made up this many names."""
    for fact in facts:
        model = model.given(fact.sit, fact.type, fact.p)
    return Model.of(replace(model.facts, created=names))
