"""How atoms depend on one another.

Atoms are independent unless they are linked: by a conditional, because one entails the
other or they exclude each other, or because it was said that nothing is known of how
they depend. Linked atoms form a *component*; components are independent.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeVar

from ttr.probability.degrees import UNKNOWN, Degree
from ttr.probability.events import Event, Truth, substitute
from ttr.safety.budgets import spend

Atom = Hashable

T = TypeVar("T")


@dataclass(frozen=True)
class Conditional:
    """p(target | condition), where the condition is that other atoms hold or fail.

    >>> known = Dependence(
    ...     {"rain": Degree(0.2, 0.2), "wet": Degree(0, 1)},
    ...     conditionals=(
    ...         Conditional("wet", (("rain", True),), Degree(0.9, 0.9)),
    ...         Conditional("wet", (("rain", False),), Degree(0.1, 0.1)),
    ...     ),
    ... )
    >>> from ttr.probability import Atomic, chance
    >>> print(chance(Atomic("wet", Degree(0, 1)), known).p)
    0.26
    """

    target: Atom
    condition: tuple[tuple[Atom, bool], ...]
    p: Degree

    @property
    def atoms(self) -> tuple[Atom, ...]:
        """The target and what it depends on."""
        return self.target, *[atom for atom, _ in self.condition]

    def applies(self, truth: Truth) -> bool:
        """Is the condition met?"""
        return all(truth[atom] == wanted for atom, wanted in self.condition)


@dataclass(frozen=True, eq=False)
class Component:
    """Linked atoms, in order, and all that is known of them together.

    It is not whole if further atoms are linked to them.
    """

    atoms: tuple[Atom, ...]
    degrees: Mapping[Atom, Degree]
    entailed: tuple[tuple[Atom, Atom], ...] = ()
    exclusive: tuple[tuple[Atom, Atom], ...] = ()
    conditionals: tuple[Conditional, ...] = ()
    unknown: bool = False
    whole: bool = True
    names: Mapping[Atom, object] = field(default_factory=dict)

    def format_atom(self, atom: Atom) -> str:
        """The atom as it is to be read."""
        return str(self.names.get(atom, atom))

    def links(self) -> list[str]:
        """What links the atoms, in words.

        >>> pair = Component(("a", "b"), {}, exclusive=(("a", "b"),))
        >>> pair.links()
        ['a excludes b']
        """
        write = self.format_atom
        found = [f"{write(one)} entails {write(other)}" for one, other in self.entailed]
        found += [
            f"{write(one)} excludes {write(other)}" for one, other in self.exclusive
        ]
        for one in self.conditionals:
            on = [("" if so else "not ") + write(atom) for atom, so in one.condition]
            found.append(f"P({write(one.target)} | {', '.join(on)}) is {one.p}")
        if self.unknown:
            found.append("nothing is known of how they depend")
        return found

    def closest(self, first: Iterable[Atom]) -> list[Atom]:
        """All atoms, these first, then what is linked to them, step by step."""
        links: list[tuple[Atom, ...]] = [*self.entailed, *self.exclusive]
        links += [one.atoms for one in self.conditionals]
        around: dict[Atom, dict[Atom, None]] = {atom: {} for atom in self.atoms}
        for link in links:
            for atom in link:
                around[atom].update(dict.fromkeys(link))
        found = dict.fromkeys(first)
        waiting = list(found)
        for atom in waiting:
            new = [other for other in around[atom] if other not in found]
            found.update(dict.fromkeys(new))
            waiting += new
        return list(found | dict.fromkeys(self.atoms))

    def restrict(self, kept: Iterable[Atom]) -> Component:
        """What is known of some of the atoms."""
        inside = set(kept)
        return Component(
            tuple([atom for atom in self.atoms if atom in inside]),
            {atom: p for atom, p in self.degrees.items() if atom in inside},
            tuple([link for link in self.entailed if inside.issuperset(link)]),
            tuple([link for link in self.exclusive if inside.issuperset(link)]),
            tuple([one for one in self.conditionals if inside.issuperset(one.atoms)]),
            self.unknown,
            False,
            self.names,
        )

    @property
    def is_order(self) -> bool:
        """Whether what entails what is all that links the atoms.

        Then the degrees of each go together if those of any two do: let each be so
        where one and the same random number is at most its degree.
        """
        return not (self.exclusive or self.conditionals or self.unknown)

    @cached_property
    def parents(self) -> dict[Atom, tuple[Atom, ...]] | None:
        """What each atom directly depends on, where conditionals are all there is.

        None where something else is known, where one atom's conditionals have different
        conditions, or where atoms depend on one another in a circle. The parents of an
        atom come before it.
        """
        if self.entailed or self.exclusive or self.unknown:
            return None
        found: dict[Atom, tuple[Atom, ...]] = {}
        for one in self.conditionals:
            on = tuple([atom for atom, _ in one.condition])
            if set(found.setdefault(one.target, on)) != set(on):
                return None
            if self.degrees[one.target] != UNKNOWN:
                return None
        return _sort_by_parents(self.atoms, found)


def _sort_by_parents(
    names: tuple[Atom, ...], parents: Mapping[Atom, tuple[Atom, ...]]
) -> dict[Atom, tuple[Atom, ...]] | None:
    """The atoms with their parents before them; None where they go in a circle."""
    spend()
    placed: dict[Atom, tuple[Atom, ...]] = {}
    waiting = list(names)
    while waiting:
        ready = [a for a in waiting if all(on in placed for on in parents.get(a, ()))]
        if not ready:
            return None
        placed.update((atom, parents.get(atom, ())) for atom in ready)
        waiting = [atom for atom in waiting if atom not in placed]
    return placed


@dataclass(frozen=True, eq=False)
class Dependence:
    """The degrees of linked atoms, and their links; whatever is not here is apart.

    What is `defined` is an event of other atoms: so are those that nothing is known of
    but what entails them, what they entail and what excludes them.

    >>> half = Degree(0.5, 0.5)
    >>> known = Dependence({"a": half, "b": half, "c": half}, entailed=(("a", "b"),))
    >>> [one.atoms for one in known.components]
    [('a', 'b')]
    """

    degrees: Mapping[Atom, Degree] = field(default_factory=dict)
    entailed: tuple[tuple[Atom, Atom], ...] = ()
    exclusive: tuple[tuple[Atom, Atom], ...] = ()
    conditionals: tuple[Conditional, ...] = ()
    unknown: tuple[tuple[Atom, ...], ...] = ()
    whole: bool = True
    names: Mapping[Atom, object] = field(default_factory=dict)
    defined: Mapping[Atom, Event] = field(default_factory=dict)

    def spelt_out(self, event: Event) -> Event:
        """The event with what is defined by others in their terms."""
        return substitute(event, self.defined) if self.defined else event

    @cached_property
    def components(self) -> tuple[Component, ...]:
        """The atoms that are linked, put together."""
        links = [*self.entailed, *self.exclusive, *self.unknown]
        links += [one.atoms for one in self.conditionals]
        groups = list(_group(links))
        place = {atom: number for number, group in enumerate(groups) for atom in group}
        entailed = _distribute(self.entailed, [place[a] for a, _ in self.entailed])
        exclusive = _distribute(self.exclusive, [place[a] for a, _ in self.exclusive])
        targets = [place[one.target] for one in self.conditionals]
        conditionals = _distribute(self.conditionals, targets)
        unknown = {place[atom] for link in self.unknown for atom in link}
        return tuple(
            Component(
                groups[number],
                {atom: self.degrees.get(atom, UNKNOWN) for atom in groups[number]},
                tuple(entailed[number]),
                tuple(exclusive[number]),
                tuple(conditionals[number]),
                number in unknown,
                self.whole,
                self.names,
            )
            for number in range(len(groups))
        )

    @cached_property
    def place(self) -> dict[Atom, int]:
        """The number of the component of each linked atom."""
        return {a: i for i, one in enumerate(self.components) for a in one.atoms}


INDEPENDENT = Dependence()
"""All atoms are independent.

>>> from ttr.probability import INDEPENDENT, All, Atomic, chance, degree
>>> heads, six = Atomic("heads", degree(0.5)), Atomic("six", degree(0.2))
>>> print(chance(All((heads, six)), INDEPENDENT).p)
0.1
"""


def _group(links: Iterable[tuple[Atom, ...]]) -> Iterator[tuple[Atom, ...]]:
    """The atoms of links that share one, directly or by others, put together."""
    group: dict[Atom, dict[Atom, None]] = {}
    for link in links:
        whole: dict[Atom, None] = {}
        for atom in link:
            whole.update(group.get(atom, {atom: None}))
        group.update(dict.fromkeys(whole, whole))
    seen: set[int] = set()
    for whole in group.values():
        if id(whole) not in seen:
            seen.add(id(whole))
            yield tuple(whole)


def _distribute(
    values: Iterable[T], numbers: Iterable[int]
) -> defaultdict[int, list[T]]:
    """The values grouped by their numbers."""
    found: defaultdict[int, list[T]] = defaultdict(list)
    for value, number in zip(values, numbers, strict=True):
        found[number].append(value)
    return found
