"""Worlds in which formulas are true: how many things each region of properties has.

A region says of each simple property whether its things have it. Left out are regions
that axioms rule out, and those that no relations among things can bring about: to hug a
boy and not to hug a person. The counts in the formulas are then linear demands on the
numbers of things.
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
    AllOrNone,
    Conjunction,
    Count,
    Disjunction,
    Formula,
    Is,
    Negated,
    OpaqueProperty,
    OpaqueSentence,
    apply_property,
    content_formula,
    leaves,
    property_formula,
)
from ttr.semantics.fragment.integer_feasibility import (
    Demand,
    UndecidedError,
    integer_solution,
)
from ttr.semantics.fragment.lexicon import Lexicon
from ttr.semantics.quantifiers import Thresholds, number
from ttr.types.syntax import Function, Pred, PType

_PROPERTIES = 14
"""The most simple properties that may divide the world."""

_INSIDE = 10
"""The most where relations are analysed, which is done anew for each thing."""

_RELATIONS = 6
"""The most relational properties that are checked for being possible together."""

_DEPTH = 3
"""How deep relations are analysed, as in "who hugs who chases who likes Kim"."""

_BRANCHES = 512
"""The most ways to make the formulas true that are tried."""

_Literal = tuple[Count | OpaqueSentence, bool]
_Simple = OpaqueProperty | Is
_Region = Mapping[_Simple, bool]


@dataclass(frozen=True)
class World:
    """How many things of each kind there are; unmentioned things are left out."""

    kinds: tuple[tuple[int, _Region], ...]

    def __str__(self) -> str:
        return ", ".join(
            f"{n} of ({_properties_in_words(kind)})" for n, kind in self.kinds if n
        )


def _properties_in_words(kind: _Region) -> str:
    has = [_name(one) for one, true in kind.items() if true]
    return ", ".join(has) or "none of these"


def _name(one: _Simple) -> str:
    return one.name if isinstance(one, Is) else str(apply_property(one.function, "it"))


class WorldFinder:
    """Finds worlds that obey the axioms of a lexicon, for an agent with thresholds.

    `held` has names of the things from which relations are being looked at.
    """

    def __init__(
        self, words: Lexicon, thresholds: Thresholds, held: tuple[str, ...] = ()
    ) -> None:
        self._words, self._thresholds, self._held = words, thresholds, held
        self._theory = words.theory
        self._implied: dict[tuple[_Simple, _Simple], bool] = {}
        self._possible: dict[tuple[Formula, ...], bool] = {}
        monotone = ("ADVERB", "MODAL", "PREP")
        found = (it for kind in monotone for it in words.words[kind].values())
        self._monotone = {it.meaning for it in found if isinstance(it.meaning, Pred)}

    def find_world(self, formulas: Sequence[Formula]) -> World | None:
        """A world in which all formulas are true, or None if there is none.

        Raises `UndecidedError` where the search was given up.
        """
        undecided = None
        for tried, branch in enumerate(_branches(formulas)):
            if tried >= _BRANCHES:
                raise UndecidedError
            try:
                found = self._world_of_branch(branch)
            except UndecidedError as error:
                undecided = error
                continue
            if found is not None:
                return found
        if undecided is not None:
            raise undecided
        return None

    def can_be(self, formulas: Sequence[Formula]) -> bool:
        """May all formulas be true together? Yes where the search was given up."""
        asked = tuple(formulas)
        if asked not in self._possible:
            try:
                self._possible[asked] = self.find_world(asked) is not None
            except UndecidedError:
                self._possible[asked] = True
        return self._possible[asked]

    def _world_of_branch(self, branch: tuple[_Literal, ...]) -> World | None:
        """A world in which these counts and sentences are so, or are not so."""
        stated = [
            (leaf.type, true)
            for leaf, true in branch
            if isinstance(leaf, OpaqueSentence)
        ]
        if any((T, not true) in stated for T, true in stated):
            return None
        counts = [(it, true) for it, true in branch if isinstance(it, Count)]
        simple = _simple_properties(counts)
        names = [one for one in simple if isinstance(one, Is)]
        counts += [(Count(it, it, one), True) for it in names for one in _ONE]
        kinds: dict[tuple[int, ...], _Region] = {}
        for region in self._possible_regions(simple, counts):
            column = tuple(_weight(it, true, region) for it, true in counts)
            if any(weight > 0 for weight in column):
                kinds.setdefault(column, region)
        kinds = {column: kinds[column] for column in _undominated_columns(kinds)}
        demands: list[Demand] = [
            (tuple(column[i] for column in kinds), _bound_of(it, true))
            for i, (it, true) in enumerate(counts)
        ]
        found = integer_solution(demands, len(kinds))
        if found is None:
            return None
        return World(tuple(zip(found, kinds.values(), strict=True)))

    # --- which regions there can be --------------------------------------------------

    def _possible_regions(
        self, simple: Sequence[_Simple], counts: Sequence[tuple[Count, bool]]
    ) -> Iterator[_Region]:
        if len(simple) > (_INSIDE if self._held else _PROPERTIES):
            raise UndecidedError
        plain = [one for one in simple if self._formula_inside(one) is None]
        related = [one for one in simple if one not in plain]
        facts = self._plain_counts(counts, set(plain))
        possible = list(self._ways_to_be_related(related, facts))
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

    def _formula_inside(self, one: _Simple) -> Formula | None:
        """A relational property, as a formula about the other things; else None."""
        if isinstance(one, Is) or len(self._held) >= _DEPTH:
            return None
        thing = self._next_name
        T = apply_property(one.function, thing)
        found = content_formula(T, self._thresholds, frozenset((*self._held, thing)))
        return None if isinstance(found, OpaqueSentence) else found

    @property
    def _next_name(self) -> str:
        return f"·{len(self._held)}"

    def _ways_to_be_related(
        self, related: Sequence[_Simple], facts: Sequence[Formula]
    ) -> Iterator[_Region]:
        """The regions of relational properties that one thing can be in."""
        if not related:
            yield {}
            return
        for values in product((False, True), repeat=len(related)):
            claims = [*facts]
            for one, true in zip(related, values, strict=True):
                found = self._formula_inside(one)
                if found is not None:
                    claims.append(found if true else Negated(found))
            if len(related) > _RELATIONS or self._finder_around.can_be(claims):
                yield dict(zip(related, values, strict=True))

    @cached_property
    def _finder_around(self) -> WorldFinder:
        """Finds worlds around one thing: what it is related to, and what not."""
        return WorldFinder(
            self._words, self._thresholds, (*self._held, self._next_name)
        )

    def _plain_counts(
        self, counts: Sequence[tuple[Count, bool]], plain: set[_Simple]
    ) -> list[Formula]:
        """The counts of properties without relations, which hold around each thing."""
        return [
            it if true else Negated(it)
            for it, true in counts
            if plain.issuperset(_simple_properties([(it, true)]))
        ]

    # --- what follows by the lexicon alone -------------------------------------------

    def _implies(self, a: _Simple, b: _Simple) -> bool:
        """Does a imply b, by the axioms and by what words mean?"""
        if (a, b) not in self._implied:
            self._implied[a, b] = self._axioms_imply(a, b)
        return self._implied[a, b]

    def _axioms_imply(self, a: _Simple, b: _Simple) -> bool:
        if isinstance(a, Is) or isinstance(b, Is):
            return False
        S, T = apply_property(a.function, "·"), apply_property(b.function, "·")
        if not isinstance(S, PType) or not isinstance(T, PType):
            return False
        if S.pred is not T.pred:
            return subtype(S, T, self._theory).yes
        if S.pred not in self._monotone or S.args[:-1] != T.args[:-1]:
            return False
        P, Q = S.args[-1], T.args[-1]
        return isinstance(P, Function) and isinstance(Q, Function) and self._below(P, Q)

    def _excludes(self, a: _Simple, b: _Simple) -> bool:
        """Do a and b exclude one another, by the lexicon?"""
        if isinstance(a, Is) or isinstance(b, Is) or not self._theory.exclusions:
            return False
        S, T = apply_property(a.function, "·"), apply_property(b.function, "·")
        return subtype(S, ~T, self._theory).yes

    def _below(self, P: Function, Q: Function) -> bool:
        """Can nothing be P and not Q?"""
        apart = Count(property_formula(P), Negated(property_formula(Q)), AT_ALL)
        return not self.can_be([apart])


_ONE = (number("at least", 1), number("at most", 1))


def _undominated_columns(columns: Iterable[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """The columns that no other column dominates: is at least as large throughout.

    As far as the demands go, a thing of a dominated kind could as well be of the other.
    """
    best: list[tuple[int, ...]] = []
    for one in sorted(columns, key=lambda column: (-sum(column), column)):
        if not any(all(map(ge, better, one)) for better in best):
            best.append(one)
    return best


# --- formulas as demands -------------------------------------------------------------


def _branches(formulas: Sequence[Formula]) -> Iterator[tuple[_Literal, ...]]:
    """The ways to make all formulas true, each as leaves that are so or are not so."""
    waiting: list[tuple[tuple[tuple[Formula, bool], ...], tuple[_Literal, ...]]] = [
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
            case Negated(part):
                waiting.append((((part, not true), *rest), literals))
            case Conjunction(parts) | Disjunction(parts) if (
                isinstance(first, Conjunction) == true
            ):
                waiting.append(((*((it, true) for it in parts), *rest), literals))
            case Conjunction(parts) | Disjunction(parts):
                waiting += [(((it, true), *rest), literals) for it in reversed(parts)]
            case AllOrNone(parts):
                waiting.append(((*((it, true) for it in parts), *rest), literals))
            case Count() | OpaqueSentence():
                waiting.append((rest, (*literals, (first, true))))
            case _:
                raise TypeError(f"{first} is said of a thing, not of the world")


def _simple_properties(counts: Iterable[tuple[Count, bool]]) -> list[_Simple]:
    """The simple properties in some counts, each once, in their order."""
    found = (one for it, _ in counts for side in (it.P, it.Q) for one in leaves(side))
    return list(
        dict.fromkeys(one for one in found if isinstance(one, OpaqueProperty | Is))
    )


def _weight(count: Count, true: bool, region: _Region) -> int:
    """The weight of one thing of a region in the demand that a count makes."""
    inside, outside = count.threshold.weights
    if not _holds(count.P, region):
        return 0
    score = inside if _holds(count.Q, region) else outside
    return score if count.threshold.is_lower_bound == true else -score


def _bound_of(count: Count, true: bool) -> int:
    """The bound of the demand that a count, or its negation, makes."""
    least_score = count.threshold.least_score
    return least_score if count.threshold.is_lower_bound == true else 1 - least_score


def _holds(formula: Formula, region: _Region) -> bool:
    match formula:
        case Conjunction(parts):
            return all(_holds(part, region) for part in parts)
        case Disjunction(parts):
            return any(_holds(part, region) for part in parts)
        case Negated(part):
            return not _holds(part, region)
        case OpaqueProperty() | Is():
            return region[formula]
        case _:
            raise TypeError(f"{formula} is said of the world, not of a thing")
