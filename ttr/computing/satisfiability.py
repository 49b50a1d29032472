"""Satisfiability of clauses: a search that learns from dead ends.

Literals are whole numbers but 0: −n denies what n says. The search decides one literal
after another and draws what follows. Where that contradicts a clause, it learns a new
one that says why, goes back to the decision that it is about, and never makes the same
mistake again. Source: Marques-Silva and Sakallah 1999; Moskewicz et al. 2001 for
watching two literals of each clause.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ttr.safety.budgets import spend

Clause = list[int]
"""Literals of which one must hold."""


class Search:
    """Looks for what makes all clauses true; they can be added as it goes on.

    It decides for the first literal of the first clause that is still open, so that
    what is written first is tried first.

    >>> search = Search([[1, 2], [-1]])
    >>> sorted(search.solve())
    [-1, 2]
    >>> search.add([-2])
    >>> search.solve() is None
    True
    """

    def __init__(self, clauses: Iterable[Sequence[int]] = ()) -> None:
        self._clauses: list[Clause] = []
        self._watching: dict[int, list[Clause]] = {}
        self._holds: dict[int, bool] = {}
        self._because: dict[int, Clause | None] = {}
        self._level: dict[int, int] = {}
        self._trail: list[int] = []
        self._decided: list[int] = []
        """The number of literals on the trail before each decision."""
        self._followed = 0
        self._units: list[int] = []
        self._is_contradictory = False
        for clause in clauses:
            self.add(clause)

    def add(self, literals: Sequence[int]) -> None:
        """Add a clause."""
        clause = list(dict.fromkeys(literals))
        spend(1 + len(clause))
        self._take_back(0)
        if any(-literal in clause for literal in clause):
            self._clauses.append(clause)  # which way it holds is decided, too
        elif not clause:
            self._is_contradictory = True
        elif len(clause) == 1:
            self._units += clause
        else:
            self._clauses.append(clause)
            self._watch(clause)

    def solve(self) -> set[int] | None:
        """Literals that make every clause true, or None where there are none.

        What is in no way needed for that is left open.
        """
        self._take_back(0)
        self._followed = 0
        if self._is_contradictory or not all(map(self._take_unit, self._units)):
            self._is_contradictory = True
            return None
        while True:
            against = self._follow()
            if against is not None:
                if not self._decided:
                    self._is_contradictory = True
                    return None
                self._learn(against)
                continue
            literal = self._next_decision()
            if literal is None:
                return set(self._trail)
            self._decided.append(len(self._trail))
            self._take(literal, None)

    def _watch(self, clause: Clause) -> None:
        for literal in clause[:2]:
            self._watching.setdefault(literal, []).append(clause)

    def _take(self, literal: int, because: Clause | None) -> None:
        self._holds[literal], self._holds[-literal] = True, False
        self._because[literal] = because
        self._level[literal] = self._level[-literal] = len(self._decided)
        self._trail.append(literal)

    def _take_unit(self, literal: int) -> bool:
        """Take what holds whatever else does; False if that is contradictory."""
        known = self._holds.get(literal)
        if known is None:
            self._take(literal, None)
        return known is not False

    def _take_back(self, level: int) -> None:
        """Take back all decisions but so many, and what followed from them."""
        if len(self._decided) <= level:
            return
        kept = self._decided[level]
        for literal in self._trail[kept:]:
            del self._holds[literal], self._holds[-literal]
        del self._trail[kept:], self._decided[level:]
        self._followed = kept

    def _next_decision(self) -> int | None:
        """The first open literal of the first clause that is open, if one is."""
        holds = self._holds
        for clause in self._clauses:
            if not any(map(holds.get, clause)):
                spend(1 + len(clause))
                return next(literal for literal in clause if literal not in holds)
        return None

    def _follow(self) -> Clause | None:
        """Draw what follows from what holds; give a clause that is contradicted."""
        holds = self._holds
        while self._followed < len(self._trail):
            denied = -self._trail[self._followed]
            self._followed += 1
            watching = self._watching.get(denied)
            if not watching:
                continue
            spend(1 + len(watching) // 2)
            kept: list[Clause] = []
            self._watching[denied] = kept
            for number, clause in enumerate(watching):
                if clause[0] == denied:
                    clause[0], clause[1] = clause[1], denied
                first = clause[0]
                if holds.get(first):
                    kept.append(clause)
                    continue
                for place in range(2, len(clause)):
                    other = clause[place]
                    if holds.get(other) is not False:
                        clause[1], clause[place] = other, denied
                        self._watching.setdefault(other, []).append(clause)
                        break
                else:
                    kept.append(clause)
                    if first in holds:
                        kept += watching[number + 1 :]
                        return clause
                    self._take(first, clause)
        return None

    def _learn(self, against: Clause) -> None:
        """Learn the clause that says which decisions were the mistake; go back."""
        now = len(self._decided)
        level = self._level
        seen: set[int] = set()
        learned: Clause = []
        open_here = 0
        place = len(self._trail)
        reason: Iterable[int] = against
        while True:
            for literal in reason:
                if literal in seen or not level[literal]:
                    continue
                seen.add(literal)
                if level[literal] == now:
                    open_here += 1
                else:
                    learned.append(literal)
            place -= 1
            while -self._trail[place] not in seen:
                place -= 1
            literal = self._trail[place]
            open_here -= 1
            if not open_here:
                break
            because = self._because[literal]
            assert because is not None
            reason = [other for other in because if other != literal]
        spend(1 + len(seen))
        back = max((level[other] for other in learned), default=0)
        self._take_back(back)
        if not learned:
            self._units.append(-literal)
            self._take(-literal, None)
            return
        latest = max(range(len(learned)), key=lambda n: level[learned[n]])
        learned[0], learned[latest] = learned[latest], learned[0]
        clause = [-literal, *learned]
        self._clauses.append(clause)
        self._watch(clause)
        self._take(-literal, clause)
