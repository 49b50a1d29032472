"""Worlds for formulas: how many things are in each region that properties divide.

A region says of each simple property whether its things have it. Regions that axioms
rule out are left out; so are those that no relations among things can bring about: to
hug a boy and not to hug a person. The counts that formulas ask for are then demands on
whole numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, permutations, product
from operator import ge

from ttr.computing.subtyping import subtype
from ttr.semantics.fragment.formulas import (
    AT_ALL,
    Alike,
    Counted,
    Formula,
    Is,
    Neither,
    Parts,
    Says,
    Some,
    Stated,
    applied,
    claim,
    leaves,
    said,
)
from ttr.semantics.fragment.integer_feasibility import (
    Demand,
    UndecidedError,
    integer_solution,
)
from ttr.semantics.fragment.lexicon import Lexicon
from ttr.semantics.quantifiers import Thresholds, number
from ttr.types.syntax import Function, Pred, PType

__all__ = ["Regions", "World"]

PROPERTIES = 14
"""How many simple properties may divide the world."""

INSIDE = 10
"""How many may divide it where relations are looked into, each time anew."""

RELATIONS = 6
"""Of how many of them is asked whether relations can bring them about together."""

DEPTH = 3
"""How deep relations are looked into, as in "who hugs who chases who likes Kim"."""

BRANCHES = 512
"""How many ways are followed to make formulas true."""

Literal = tuple[Counted | Stated, bool]
Simple = Says | Is
Region = Mapping[Simple, bool]


@dataclass(frozen=True)
class World:
    """How many things there are of each kind; things nobody speaks of are left out."""

    kinds: tuple[tuple[int, Region], ...]

    def __str__(self) -> str:
        return ", ".join(f"{n} of ({_named(kind)})" for n, kind in self.kinds if n)


def _named(kind: Region) -> str:
    has = [_name(one) for one, true in kind.items() if true]
    return ", ".join(has) or "none of these"


def _name(one: Simple) -> str:
    return one.name if isinstance(one, Is) else str(applied(one.function, "it"))


class Regions:
    """Finds worlds by a lexicon's axioms, for an agent with some thresholds."""

    def __init__(
        self, words: Lexicon, thresholds: Thresholds, held: tuple[str, ...] = ()
    ) -> None:
        self._words, self._thresholds, self._held = words, thresholds, held
        self._theory = words.theory
        self._implied: dict[tuple[Simple, Simple], bool] = {}
        self._possible: dict[tuple[Formula, ...], bool] = {}
        monotone = ("ADVERB", "MODAL", "PREP")
        found = (it for kind in monotone for it in words.words[kind].values())
        self._monotone = {it.meaning for it in found if isinstance(it.meaning, Pred)}

    def world(self, formulas: Sequence[Formula]) -> World | None:
        """A world in which all formulas are true, or None if there is none.

        Raises `UndecidedError` where it was not found out in so many steps.
        """
        undecided = None
        for tried, branch in enumerate(_branches(formulas)):
            if tried >= BRANCHES:
                raise UndecidedError
            try:
                found = self._of_branch(branch)
            except UndecidedError as error:
                undecided = error
                continue
            if found is not None:
                return found
        if undecided is not None:
            raise undecided
        return None

    def can_be(self, formulas: Sequence[Formula]) -> bool:
        """Whether there may be a world; yes, where it was not found out."""
        asked = tuple(formulas)
        if asked not in self._possible:
            try:
                self._possible[asked] = self.world(asked) is not None
            except UndecidedError:
                self._possible[asked] = True
        return self._possible[asked]

    def _of_branch(self, branch: tuple[Literal, ...]) -> World | None:
        stated = [
            (leaf.type, true) for leaf, true in branch if isinstance(leaf, Stated)
        ]
        if any((T, not true) in stated for T, true in stated):
            return None
        counts = [(it, true) for it, true in branch if isinstance(it, Counted)]
        simple = _simple(counts)
        names = [one for one in simple if isinstance(one, Is)]
        counts += [(Counted(it, it, one), True) for it in names for one in _ONE]
        kinds: dict[tuple[int, ...], Region] = {}
        for region in self._regions(simple, counts):
            column = tuple(_weight(it, true, region) for it, true in counts)
            if any(weight > 0 for weight in column):
                kinds.setdefault(column, region)
        kinds = {column: kinds[column] for column in _best(kinds)}
        demands: list[Demand] = [
            (tuple(column[i] for column in kinds), _bound(it, true))
            for i, (it, true) in enumerate(counts)
        ]
        found = integer_solution(demands, len(kinds))
        if found is None:
            return None
        return World(tuple(zip(found, kinds.values(), strict=True)))

    # --- which regions there can be --------------------------------------------------

    def _regions(
        self, simple: Sequence[Simple], counts: Sequence[tuple[Counted, bool]]
    ) -> Iterator[Region]:
        if len(simple) > (INSIDE if self._held else PROPERTIES):
            raise UndecidedError
        plain = [one for one in simple if self._inside(one) is None]
        related = [one for one in simple if one not in plain]
        possible = list(self._together(related, self._facts(counts, set(plain))))
        implied = [(a, b) for a, b in permutations(simple, 2) if self._implies(a, b)]
        apart = [(a, b) for a, b in combinations(simple, 2) if self._excludes(a, b)]
        for values in product((False, True), repeat=len(plain)):
            first = dict(zip(plain, values, strict=True))
            for second in possible:
                region = {**first, **second}
                if any(region[a] and not region[b] for a, b in implied):
                    continue
                if not any(region[a] and region[b] for a, b in apart):
                    yield region

    def _inside(self, one: Simple) -> Formula | None:
        """What a property says of a thing, if it is a relation to others; else None."""
        if isinstance(one, Is) or len(self._held) >= DEPTH:
            return None
        thing = self._thing
        T = applied(one.function, thing)
        found = claim(T, self._thresholds, frozenset((*self._held, thing)))
        return None if isinstance(found, Stated) else found

    @property
    def _thing(self) -> str:
        return f"·{len(self._held)}"

    def _together(
        self, related: Sequence[Simple], facts: Sequence[Formula]
    ) -> Iterator[Region]:
        """The ways in which a thing can be related to others, and not."""
        if not related:
            yield {}
            return
        for values in product((False, True), repeat=len(related)):
            claims = [*facts]
            for one, true in zip(related, values, strict=True):
                found = self._inside(one)
                if found is not None:
                    claims.append(found if true else Neither(found))
            if len(related) > RELATIONS or self._around.can_be(claims):
                yield dict(zip(related, values, strict=True))

    @cached_property
    def _around(self) -> Regions:
        """The worlds around one thing, as the things related to it see them."""
        return Regions(self._words, self._thresholds, (*self._held, self._thing))

    def _facts(
        self, counts: Sequence[tuple[Counted, bool]], plain: set[Simple]
    ) -> list[Formula]:
        """The counts of plain properties, which are the same in every look around."""
        return [
            it if true else Neither(it)
            for it, true in counts
            if plain.issuperset(_simple([(it, true)]))
        ]

    # --- what follows by the lexicon alone -------------------------------------------

    def _implies(self, a: Simple, b: Simple) -> bool:
        """Whether what has one property has another, by axioms and what words mean."""
        if (a, b) not in self._implied:
            self._implied[a, b] = self._worked_out(a, b)
        return self._implied[a, b]

    def _worked_out(self, a: Simple, b: Simple) -> bool:
        if isinstance(a, Is) or isinstance(b, Is):
            return False
        S, T = applied(a.function, "·"), applied(b.function, "·")
        if not isinstance(S, PType) or not isinstance(T, PType):
            return False
        if S.pred is not T.pred:
            return subtype(S, T, self._theory).yes
        if S.pred not in self._monotone or S.args[:-1] != T.args[:-1]:
            return False
        P, Q = S.args[-1], T.args[-1]
        return isinstance(P, Function) and isinstance(Q, Function) and self._below(P, Q)

    def _excludes(self, a: Simple, b: Simple) -> bool:
        """Whether nothing has both properties, by what the lexicon says."""
        if isinstance(a, Is) or isinstance(b, Is) or not self._theory.exclusions:
            return False
        S, T = applied(a.function, "·"), applied(b.function, "·")
        return subtype(S, ~T, self._theory).yes

    def _below(self, P: Function, Q: Function) -> bool:
        """Whether nothing can be P and not Q."""
        apart = Counted(said(P), Neither(said(Q)), AT_ALL)
        return not self.can_be([apart])


_ONE = (number("at least", 1), number("at most", 1))


def _best(columns: Iterable[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """The columns that none is better than in all respects.

    A thing of a worse kind could as well be one of the better kind, as far as what is
    demanded goes.
    """
    best: list[tuple[int, ...]] = []
    for one in sorted(columns, key=lambda column: (-sum(column), column)):
        if not any(all(map(ge, better, one)) for better in best):
            best.append(one)
    return best


# --- formulas as demands -------------------------------------------------------------


def _branches(formulas: Sequence[Formula]) -> Iterator[tuple[Literal, ...]]:
    """The ways to make all formulas true, each as leaves that are, or are not, so."""
    waiting: list[tuple[tuple[tuple[Formula, bool], ...], tuple[Literal, ...]]] = [
        (tuple((formula, True) for formula in formulas), ())
    ]
    while waiting:
        left, literals = waiting.pop()
        if not left:
            yield literals
            continue
        (first, true), *others = left
        rest = tuple(others)
        match first:
            case Neither(part):
                waiting.append((((part, not true), *rest), literals))
            case Parts(parts) | Some(parts) if isinstance(first, Parts) == true:
                waiting.append(((*((it, true) for it in parts), *rest), literals))
            case Parts(parts) | Some(parts):
                waiting += [(((it, true), *rest), literals) for it in reversed(parts)]
            case Alike(parts):
                waiting.append(((*((it, true) for it in parts), *rest), literals))
            case Counted() | Stated():
                waiting.append((rest, (*literals, (first, true))))
            case _:
                raise TypeError(f"{first} is said of a thing, not of the world")


def _simple(counts: Iterable[tuple[Counted, bool]]) -> list[Simple]:
    """The simple properties in some counts, each once, in their order."""
    found = (one for it, _ in counts for side in (it.P, it.Q) for one in leaves(side))
    return list(dict.fromkeys(one for one in found if isinstance(one, Says | Is)))


def _weight(count: Counted, true: bool, region: Region) -> int:
    """What one thing of a region adds to a count's score, or takes from it."""
    inside, outside = count.threshold.weights
    if not _holds(count.P, region):
        return 0
    score = inside if _holds(count.Q, region) else outside
    return score if count.threshold.rising == true else -score


def _bound(count: Counted, true: bool) -> int:
    """What the score, or its opposite, is at least."""
    bound = count.threshold.bound
    return bound if count.threshold.rising == true else 1 - bound


def _holds(formula: Formula, region: Region) -> bool:
    match formula:
        case Parts(parts):
            return all(_holds(part, region) for part in parts)
        case Some(parts):
            return any(_holds(part, region) for part in parts)
        case Neither(part):
            return not _holds(part, region)
        case Says() | Is():
            return region[formula]
        case _:
            raise TypeError(f"{formula} is said of the world, not of a thing")
