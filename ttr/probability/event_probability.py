"""The probability of an event from its atoms and their dependence."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence
from contextlib import suppress
from typing import NamedTuple, TypeAlias

from ttr.probability.degrees import (
    CERTAIN,
    REFUTED,
    UNKNOWN,
    Degree,
    degree_of_negation,
    share,
)
from ttr.probability.dependence import INDEPENDENT, Component, Dependence
from ttr.probability.events import (
    NEVER,
    SURE,
    All,
    AnyOf,
    Atomic,
    Event,
    Not,
    Truth,
    atoms,
    literals,
    signs,
    simplify,
)
from ttr.probability.independent_events import bounds, sum_over_cases
from ttr.probability.linear_programs import InfeasibleError
from ttr.probability.networks import ImpossibleError, Network, conjunction, network
from ttr.probability.polytopes import Polytope, polytope
from ttr.safety.budgets import spend

BRANCHES = 1024
"""The number of cases of linked atoms that are distinguished, in all."""


class Chance(NamedTuple):
    """A probability, whether its interval is exact, and the components it rests on.

    >>> from ttr.probability import Atomic, chance
    >>> found = chance(Atomic("rain", Degree(0.2, 0.3)))
    >>> print(found.p, found.exact)
    [0.2, 0.3] True
    """

    p: Degree
    exact: bool
    rests_on: tuple[Component, ...] = ()


class ContradictionError(Exception):
    """The degrees of a component contradict one another.

    >>> from ttr.probability import Atomic, Dependence, chance
    >>> apart = Dependence(
    ...     {"rain": Degree(0.8, 0.8), "dry": Degree(0.7, 0.7)},
    ...     exclusive=(("rain", "dry"),),
    ... )
    >>> chance(Atomic("rain", Degree(0.8, 0.8)), apart)
    Traceback (most recent call last):
        ...
    ttr.probability.event_probability.ContradictionError
    """

    def __init__(self, component: Component) -> None:
        super().__init__()
        self.component = component


def chance(
    event: Event, known: Dependence = INDEPENDENT, given: Event = SURE
) -> Chance:
    """The probability of an event, given another one.

    Exact where at most ten atoms are shared between parts of the event, and components
    are small; else bounds that hold whatever depends on what. Raises `ImpossibleError`
    where what is given cannot be, and `ContradictionError` where degrees do not go
    together.

    >>> a, b = Atomic("a", Degree(0.4, 0.4)), Atomic("b", Degree(0.5, 0.5))
    >>> print(chance(All((a, b))).p, chance(AnyOf((a, Not(a)))).p)
    0.2 1
    >>> below = Dependence({"a": a.p, "b": b.p}, entailed=(("a", "b"),))
    >>> print(chance(All((a, b)), below).p, chance(a, below, given=b).p)
    0.4 0.8
    """
    event, given = known.spelt_out(event), known.spelt_out(given)
    if given == SURE and not known.components:
        found = sum_over_cases(event)
        if found is not None:
            return Chance(found, True)
    sure, others = _divide(given)
    others = _relevant(event, sure, others, known)
    truth = literals(sure) or {}
    if all(len(_keys(one, known)) == 1 and _is_linked(one, known) for one in others):
        with suppress(_TooManyCasesError):
            return _Solving(known, truth, others).of(event)
    return _quotient(event, known, sure, All(tuple(others)))


class _TooManyCasesError(Exception):
    """A condition with more cases than can be distinguished."""


def _divide(given: Event) -> tuple[Event, list[Event]]:
    """The conjunction of literals that a condition needs, and what else it needs.

    What follows from the rest is left out, so that A and (A or B) is A alone. Raises
    `ImpossibleError` where the literals contradict one another.
    """
    truth: dict[Hashable, bool] = {}
    sure: list[Event] = []
    waiting, others = [given], list[Event]()
    while waiting:
        spend()
        one = simplify(waiting.pop(), truth)
        found = literals(one)
        if one == NEVER:
            raise ImpossibleError
        if found:
            truth.update(found)
            sure.append(one)
            waiting, others = waiting + others, []
        elif found is None and isinstance(one, All):
            waiting += one.parts
        elif found is None:
            others.append(one)
    return All(tuple(sure)), _without_consequences(others)


def _without_consequences(events: Iterable[Event]) -> list[Event]:
    """The events without those that follow from others of them by their form."""
    kept = list(dict.fromkeys(events))
    for one in tuple(kept):
        others = [other for other in kept if other != one]
        if _follows(one, others):
            kept = others
    return kept


def _follows(event: Event, given: Sequence[Event]) -> bool:
    """Does an event happen, by its form, where these do?"""
    spend(1 + len(given))
    if event in given:
        return True
    match event:
        case All(parts):
            return all(_follows(part, given) for part in parts)
        case AnyOf(parts):
            choices = (set(one.parts) for one in given if isinstance(one, AnyOf))
            return any(map(set(parts).issuperset, choices)) or any(
                _follows(part, given) for part in parts
            )
    return False


def _relevant(
    event: Event, sure: Event, others: list[Event], known: Dependence
) -> list[Event]:
    """Those of some conditions that bear on an event, directly or by one another.

    Raises `ImpossibleError` where the rest cannot be.
    """
    keys, kept, left = _keys(event, known), list[Event](), others
    while met := [one for one in left if not keys.isdisjoint(_keys(one, known))]:
        keys = keys.union(*[_keys(one, known) for one in met])
        kept += met
        left = [one for one in left if one not in met]
    if left and chance(All(tuple(left)), known, sure).p.hi == 0.0:
        raise ImpossibleError
    return kept


def _is_linked(event: Event, known: Dependence) -> bool:
    return all(one.atom in known.place for one in atoms(event))


def are_apart(events: Sequence[Event], known: Dependence = INDEPENDENT) -> bool:
    """Are the events independent, as no two of them share or link an atom?

    >>> a, b = Atomic("a", Degree(0.5, 0.5)), Atomic("b", Degree(0.4, 0.4))
    >>> are_apart([a, b])
    True
    >>> are_apart([a, b], Dependence(entailed=(("a", "b"),)))
    False
    """
    seen: set[Hashable] = set()
    for event in events:
        mine = _keys(known.spelt_out(event), known)
        if not seen.isdisjoint(mine):
            return False
        seen |= mine
    return True


def _keys(event: Event, known: Dependence) -> set[Hashable]:
    """The atoms of an event; for linked ones, the component they are in."""
    return {known.place.get(one.atom, one.atom) for one in atoms(event)}


def _quotient(event: Event, known: Dependence, sure: Event, rest: Event) -> Chance:
    """p(E ∧ C) / (p(E ∧ C) + p(¬E ∧ C)), each given what is sure.

    It is for a condition C that is about several components.
    """
    both = chance(All((event, rest)), known, sure)
    only = chance(All((Not(event), rest)), known, sure)
    p = share(both.p, only.p)
    if p is None:
        raise ImpossibleError
    points = both.p.lo == both.p.hi and only.p.lo == only.p.hi
    rests_on = tuple(dict.fromkeys((*both.rests_on, *only.rests_on)))
    return Chance(p, points and both.exact and only.exact, rests_on)


Joint: TypeAlias = Network | Polytope
"""The cases of some atoms of a component, and what shares they can have."""


def _joint(component: Component, needed: tuple[Hashable, ...]) -> Joint | None:
    """The joint distribution of some atoms of a component; None if it is too large."""
    return network(component, needed) or polytope(component, needed)


def _conjoin(component: Component, event: Event, given: Truth) -> Degree | None:
    """The probability of a conjunction or disjunction of literals of a network.

    None for any other event, and where it mentions atoms outside the component.
    """
    truth, denied = literals(event), literals(Not(event))
    wanted = denied if truth is None else truth
    if not wanted or not component.degrees.keys() >= wanted.keys():
        return None
    found = conjunction(component, wanted, given)
    if found is None or truth is not None:
        return found
    return degree_of_negation(found)


class _Solving:
    """Divides an event into independent parts, and linked parts into worlds."""

    def __init__(
        self, known: Dependence, condition: Truth, others: Sequence[Event] = ()
    ) -> None:
        self._known, self._condition = known, condition
        self._others: dict[int, list[Event]] = {}
        for one in others:
            number = next(known.place[it.atom] for it in atoms(one))
            self._others.setdefault(number, []).append(one)
        self._exact = True
        self._rests_on: dict[int, None] = {}
        self._branches = 1

    def of(self, event: Event) -> Chance:
        """The probability of an event under the condition."""
        place = self._known.place
        free = {a: so for a, so in self._condition.items() if a not in place}
        mine = [place[a] for a in self._condition if a in place]
        for number in dict.fromkeys((*mine, *self._others)):
            whole = self._in_cases(number, SURE)
            if whole is None and number in self._others:
                raise _TooManyCasesError
        self._rests_on.clear()
        p = self._solve(simplify(event, free))
        found = tuple([self._known.components[number] for number in self._rests_on])
        return Chance(p, self._exact, found)

    def _solve(self, event: Event) -> Degree:
        spend()
        match event:
            case Atomic(atom, p):
                return self._solve_component(event) if atom in self._known.place else p
            case Not(part):
                lo, hi = self._solve(part)
                return Degree(1.0 - hi, 1.0 - lo)
            case All(()):
                return CERTAIN
            case AnyOf(()):
                return REFUTED
        groups = list(_groups(event.parts, self._known))
        if len(groups) == 1:
            return self._solve_component(event)
        kind = type(event)
        found = [
            self._solve(kind(group) if len(group) > 1 else group[0]) for group in groups
        ]
        apart = [Atomic(number, p) for number, p in enumerate(found)]
        return sum_over_cases(kind(tuple(apart))) or UNKNOWN

    def _solve_component(self, event: Event) -> Degree:
        """The probability of an event whose parts are linked, world by world."""
        place = self._known.place
        number = next(
            (place[one.atom] for one in atoms(event) if one.atom in place), None
        )
        if number is None:
            found = sum_over_cases(event)
            return self._bounds_of(event) if found is None else found
        event = _minimal(event, self._known.components[number])
        found = self._in_cases(number, event)
        self._exact = self._exact and not self._is_mixed(event)
        return self._bounds_of(event) if found is None else found

    def _in_cases(self, number: int, event: Event) -> Degree | None:
        """The probability from what is left in each case; None for too many cases."""
        spend()
        component = self._known.components[number]
        mine = {a: so for a, so in self._condition.items() if a in component.degrees}
        others = self._others.get(number, [])
        conjoined = None if others else _conjoin(component, event, mine)
        if conjoined is not None:
            self._rests_on[number] = None
            return conjoined
        every = (one for part in (event, *others) for one in atoms(part))
        asked = (one.atom for one in every if one.atom in component.degrees)
        joint = _joint(component, tuple(dict.fromkeys((*mine, *asked))))
        branches = self._branches
        if joint is None or branches * len(joint.cases) > BRANCHES:
            return None
        self._branches *= len(joint.cases)
        self._rests_on[number] = None
        worth = [self._solve(simplify(event, case)) for case in joint.cases]
        self._branches = branches
        wide = any(p.lo < p.hi for p in worth)
        self._exact = self._exact and joint.exact and not (wide and branches > 1)
        try:
            return joint.share(worth, mine, others)
        except InfeasibleError:
            raise ContradictionError(component) from None

    def _is_mixed(self, event: Event) -> bool:
        """May the event both rise and fall with an unlinked atom with an interval?

        Each world then uses the end of the interval that suits it.
        """
        rising: dict[Hashable, bool] = {}
        return any(
            one.p.lo < one.p.hi and rising.setdefault(one.atom, sign) != sign
            for one, sign in signs(event)
            if one.atom not in self._known.place
        )

    def _bounds_of(self, event: Event) -> Degree:
        """Bounds that hold for any dependence; unknown under a condition on it."""
        self._exact = False
        given = {self._known.place.get(a, a) for a in self._condition}
        given.update(self._others)
        return bounds(event) if given.isdisjoint(_keys(event, self._known)) else UNKNOWN


def _minimal(event: Event, component: Component) -> Event:
    """An event without the atoms that others of its parts decide."""
    if not isinstance(event, All | AnyOf):
        return event
    mine = {part.atom for part in event.parts if isinstance(part, Atomic)}
    if isinstance(event, All) and any(mine.issuperset(e) for e in component.exclusive):
        return AnyOf(())
    links = [link for link in component.entailed if mine.issuperset(link)]
    told: dict[Hashable, None] = {}
    for lower, upper in links:
        kept, gone = (lower, upper) if isinstance(event, All) else (upper, lower)
        if kept not in told:
            told[gone] = None
    parts = [
        part
        for part in event.parts
        if not (isinstance(part, Atomic) and part.atom in told)
    ]
    return type(event)(tuple(parts)) if len(parts) > 1 else parts[0]


def _groups(parts: Iterable[Event], known: Dependence) -> Iterator[tuple[Event, ...]]:
    """The parts, those together that share an atom or a component."""
    groups: dict[int, list[Event]] = {}
    leader: dict[Hashable, int] = {}
    for number, part in enumerate(parts):
        keys = _keys(part, known)
        met = sorted({leader[key] for key in keys if key in leader})
        groups[number] = [one for other in met for one in groups.pop(other)] + [part]
        moved = [key for key, other in leader.items() if other in met] if met else ()
        leader.update(dict.fromkeys((*keys, *moved), number))
    yield from map(tuple, groups.values())
