"""Probabilities as intervals, and the probability of events made of others.

The atoms are judgements of an object and a basic type or ptype; an event is made of
them. Equal atoms are one event; distinct atoms are independent, unless a `Dependence`
links them: by what entails or excludes what, by conditionals, or as unknown.
"""

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.probability.degrees import (
    CERTAIN,
    REFUTED,
    UNKNOWN,
    Degree,
    complement,
    degree,
    format_probability,
)
from ttr.probability.dependence import (
    INDEPENDENT,
    Component,
    Conditional,
    Dependence,
)
from ttr.probability.event_probability import (
    Chance,
    ContradictionError,
    are_apart,
    chance,
)
from ttr.probability.events import All, AnyOf, Atomic, Event, Not
from ttr.probability.networks import ImpossibleError
from ttr.probability.polytopes import feasible

__all__ = [
    "CERTAIN",
    "INDEPENDENT",
    "REFUTED",
    "UNKNOWN",
    "All",
    "AnyOf",
    "Atomic",
    "Chance",
    "Component",
    "Conditional",
    "ContradictionError",
    "Degree",
    "Dependence",
    "Event",
    "ImpossibleError",
    "Not",
    "are_apart",
    "chance",
    "complement",
    "degree",
    "feasible",
    "format_probability",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
