"""Probabilities as intervals, and how probable events are together.

The atoms are judgements of an object and a basic type or ptype. Equal atoms are one
event, an atom that another one entails adds nothing, and distinct atoms are taken as
independent. An event is made of atoms by `All`, `AnyOf` and `Not`.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple, TypeAlias

from ttr.errors import TTRError

__all__ = [
    "CERTAIN",
    "REFUTED",
    "UNKNOWN",
    "All",
    "AnyOf",
    "Atomic",
    "Degree",
    "Event",
    "Not",
    "chance",
    "degree",
]

SHARED = 10
"""How many atoms may occur more than once for a probability to be exact."""


class Degree(NamedTuple):
    """An interval of probability: [1, 1] certain, [0, 0] refuted, [0, 1] unknown."""

    lo: float
    hi: float

    def __str__(self) -> str:
        """The interval as a semanticist writes it.

        >>> print(Degree(0.25, 0.25), Degree(0, 1))
        0.25 [0, 1]
        >>> print(Degree(0.99999, 0.99999))
        0.99999
        """
        if self.lo == self.hi:
            return _number(self.lo)
        return f"[{_number(self.lo)}, {_number(self.hi)}]"


def _number(x: float) -> str:
    """Four digits, unless they would make it certain or refuted."""
    short = f"{x:.4g}"
    return short if x in (0.0, 1.0) or 0.0 < float(short) < 1.0 else repr(x)


CERTAIN = Degree(1.0, 1.0)
REFUTED = Degree(0.0, 0.0)
UNKNOWN = Degree(0.0, 1.0)


def degree(value: object, what: str = "a probability") -> Degree:
    """A number, a truth value or a pair [lo, hi] as a degree; else `TTRError`.

    >>> degree(True), degree((0.2, 0.4))
    (Degree(lo=1.0, hi=1.0), Degree(lo=0.2, hi=0.4))
    >>> degree(1.5)
    Traceback (most recent call last):
    ttr.errors.TTRError: a probability is a number in [0, 1] or an interval ...
    """
    pair = tuple(value) if isinstance(value, tuple | list) else (value, value)
    lo, hi = map(_float, pair) if len(pair) == 2 else (math.nan, math.nan)
    if not 0.0 <= lo <= hi <= 1.0:
        raise TTRError(
            f"{what} is a number in [0, 1] or an interval of two, lower first, "
            f"but found {value!r}"
        )
    return Degree(lo, hi)


def _float(value: object) -> float:
    """The value as a number; not a number for what is none."""
    if isinstance(value, str | bytes | bytearray):
        return math.nan
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return math.nan


# --- events --------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Atomic:
    """An atom, and how probable it is."""

    atom: Hashable
    p: Degree


@dataclass(frozen=True, slots=True)
class All:
    """All of the events."""

    parts: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class AnyOf:
    """At least one of the events."""

    parts: tuple[Event, ...]


@dataclass(frozen=True, slots=True)
class Not:
    """The event does not happen."""

    part: Event


Event: TypeAlias = Atomic | All | AnyOf | Not

Entailed = Mapping[Hashable, frozenset[Hashable]]
"""The other atoms that an atom entails; none where it has no entry."""


def chance(event: Event, entailed: Entailed) -> Degree:
    """How probable an event is, exactly where that is feasible, else its bounds.

    Where no atom occurs twice, products of independent events; where at most `SHARED`
    do, the same in each case of those atoms. Conjunctions and disjunctions of atoms are
    exact whatever entails what.

    >>> a = Atomic("a", Degree(0.4, 0.4))
    >>> print(chance(Not(a), {}), chance(All((a, Not(a))), {}))
    0.6 0
    >>> print(chance(AnyOf((a, Atomic("b", Degree(0.5, 1)))), {}))
    [0.7, 1]
    """
    occurring = Counter(one.atom for one, _ in _atoms(event, True))
    related = any(occurring.keys() & others for others in entailed.values())
    if related:
        return _related(event, entailed)
    shared = {atom for atom, times in occurring.items() if times > 1}
    if len(shared) > SHARED:
        return _bounds(event)
    return _in_cases(event, shared)


def _atoms(event: Event, positive: bool) -> Iterator[tuple[Atomic, bool]]:
    """The atoms as often as they occur, and whether the event rises with them."""
    waiting = [(event, positive)]
    while waiting:
        one, sign = waiting.pop()
        match one:
            case Atomic():
                yield one, sign
            case Not(part):
                waiting.append((part, not sign))
            case All(parts) | AnyOf(parts):
                waiting += [(part, sign) for part in parts]


# --- independent atoms ---


def _in_cases(event: Event, shared: set[Hashable]) -> Degree:
    """The sum over the cases of the shared atoms, at the corners of their intervals.

    An event rises with an atom that it is only for, so a corner is enough there; with
    one it is for and against, it may be lowest or highest at either end.
    """
    degrees = {one.atom: one.p for one, _ in _atoms(event, True)}
    signs: dict[Hashable, set[bool]] = {}
    for one, sign in _atoms(event, True):
        signs.setdefault(one.atom, set()).add(sign)
    names = [atom for atom in degrees if atom in shared]
    mixed = [a for a in names if len(signs[a]) > 1 and degrees[a].lo < degrees[a].hi]
    if len(names) + len(mixed) > SHARED:
        return _bounds(event)
    lows, highs = [], []
    for corner in product(*[degrees[atom] for atom in mixed]):
        fixed = dict(zip(mixed, corner, strict=True))
        low = {a: fixed.get(a, degrees[a][False in signs[a]]) for a in names}
        high = {a: fixed.get(a, degrees[a][True in signs[a]]) for a in names}
        lows.append(_weighted(event, low)[0])
        highs.append(_weighted(event, high)[1])
    return _ordered(min(lows), max(highs))


def _weighted(event: Event, shared: Mapping[Hashable, float]) -> tuple[float, float]:
    """Lower and upper probability where the shared atoms have these probabilities."""
    lo = hi = 0.0
    for truth in product((True, False), repeat=len(shared)):
        case = dict(zip(shared, truth, strict=True))
        weight = math.prod(p if case[a] else 1.0 - p for a, p in shared.items())
        if weight > 0.0:
            one = _apart(event, case)
            lo, hi = lo + weight * one[0], hi + weight * one[1]
    return lo, hi


def _apart(event: Event, case: Mapping[Hashable, bool]) -> tuple[float, float]:
    """The probability where all atoms are apart but those that the case decides."""
    match event:
        case Atomic(atom, p):
            return (float(case[atom]),) * 2 if atom in case else (p.lo, p.hi)
        case Not(part):
            lo, hi = _apart(part, case)
            return 1.0 - hi, 1.0 - lo
        case All(parts):
            found = [_apart(part, case) for part in parts]
            return math.prod(p[0] for p in found), math.prod(p[1] for p in found)
        case AnyOf(parts):
            found = [_apart(part, case) for part in parts]
            low = math.prod(1.0 - p[0] for p in found)
            return 1.0 - low, 1.0 - math.prod(1.0 - p[1] for p in found)


# --- atoms that entail others ---


def _related(event: Event, entailed: Entailed) -> Degree:
    """Where atoms entail others: exact for all of some atoms or any of them."""
    atoms = _members(event, All)
    if atoms is not None:
        kept = _minimal(atoms, lambda a, b: b in entailed.get(a, ()))
        return _in_cases(All(tuple(kept)), set())
    atoms = _members(event, AnyOf)
    if atoms is not None:
        kept = _minimal(atoms, lambda a, b: a in entailed.get(b, ()))
        return _in_cases(AnyOf(tuple(kept)), set())
    return _bounds(event)


def _members(event: Event, kind: type[All] | type[AnyOf]) -> list[Atomic] | None:
    """The distinct atoms of an event of one kind all through; else None."""
    match event:
        case Atomic():
            return [event]
        case All(parts) | AnyOf(parts) if isinstance(event, kind):
            found = [_members(part, kind) for part in parts]
            if None in found:
                return None
            every = [atom for part in found for atom in part or ()]
            return list({one.atom: one for one in every}.values())
    return None


def _minimal(
    atoms: list[Atomic], decides: Callable[[Hashable, Hashable], bool]
) -> list[Atomic]:
    """The atoms that no other one decides, and one of those that decide each other."""
    kept: list[Atomic] = []
    for one in atoms:
        deciding = [two.atom for two in atoms if decides(two.atom, one.atom)]
        mutual = [atom for atom in deciding if decides(one.atom, atom)]
        told = any(other.atom in mutual for other in kept)
        if len(mutual) == len(deciding) and not told:
            kept.append(one)
    return kept


# --- bounds ---


def _bounds(event: Event) -> Degree:
    """What holds whatever depends on what (Fréchet's bounds, part by part)."""
    match event:
        case Atomic(_, p):
            return p
        case Not(part):
            lo, hi = _bounds(part)
            return Degree(1.0 - hi, 1.0 - lo)
        case All(parts):
            found = [_bounds(part) for part in parts]
            low = sum(p.lo for p in found) - (len(found) - 1)
            return _ordered(max(0.0, low), min((p.hi for p in found), default=1.0))
        case AnyOf(parts):
            found = [_bounds(part) for part in parts]
            high = min(1.0, sum(p.hi for p in found))
            return _ordered(max((p.lo for p in found), default=0.0), high)


def _ordered(lo: float, hi: float) -> Degree:
    """The interval, where rounding may have taken an end too far."""
    lo, hi = min(max(lo, 0.0), 1.0), min(max(hi, 0.0), 1.0)
    return Degree(min(lo, hi), max(lo, hi))
