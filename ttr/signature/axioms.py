"""The types that declared axioms put above and below a type, by matching schemas."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import cast

from ttr.signature.signature import Axiom, Exclusion, Signature, head
from ttr.types.interning import identity
from ttr.types.objects import Object, Path
from ttr.types.paths import replace_paths
from ttr.types.syntax import Basic, Pred, PType

Binding = Mapping[Path, Object]

Atom = Basic | PType


def supertypes(
    T: Basic | PType, axioms: tuple[Axiom, ...]
) -> Iterator[tuple[Axiom, Basic | PType]]:
    """Each type that the axioms put above T, once, with the last axiom used.

    Axioms with conditions are left out (`ttr.signature.conditional_axioms`).

    >>> from ttr import Ind, Pred, this
    >>> dog, puppy = Pred("dog", Ind), Pred("puppy", Ind)
    >>> axioms = (Axiom(puppy(this.x), dog(this.x)),)
    >>> for axiom, upper in supertypes(puppy("rex"), axioms):
    ...     print(upper, "by", axiom)
    dog(rex) by puppy(x) <: dog(x)
    """
    steps = [(one, one.lower, one.upper) for one in axioms if not one.when]
    yield from _closure(T, steps)


def subtypes(
    T: Basic | PType, axioms: tuple[Axiom, ...]
) -> Iterator[tuple[Axiom, Basic | PType]]:
    """Each type that the axioms put below T, once, with the last axiom used.

    A schematic variable that occurs only on the lower side stays a path.
    """
    steps = [(one, one.upper, one.lower) for one in axioms if not one.when]
    yield from _closure(T, steps)


def supertype_set(T: Atom, theory: Signature) -> frozenset[Atom]:
    """The types that the axioms put above T."""
    if not theory.axioms:
        return frozenset()
    found = theory._memo.get(T)
    if found is None:
        found = frozenset(upper for _, upper in supertypes(T, theory.axioms))
        theory._memo[T] = found
    return cast(frozenset[Atom], found)


def find_exclusion(S: Atom, T: Atom, theory: Signature) -> Exclusion | None:
    """The exclusion of the two types, or of types above them; None if there is none.

    >>> from ttr import Ind, Pred, this
    >>> dog, cat = Pred("dog", Ind), Pred("cat", Ind)
    >>> theory = Signature(exclusions=(Exclusion(dog(this.x), cat(this.x)),))
    >>> print(find_exclusion(cat("felix"), dog("felix"), theory))
    dog(x) <: ~cat(x)
    >>> find_exclusion(cat("felix"), dog("fido"), theory)
    """
    if not theory.exclusions:
        return None
    if (S, T) not in theory._memo:
        theory._memo[S, T] = _find_exclusion(S, T, theory)
    return cast(Exclusion | None, theory._memo[S, T])


def _find_exclusion(S: Atom, T: Atom, theory: Signature) -> Exclusion | None:
    mine, theirs = (S, *supertype_set(S, theory)), (T, *supertype_set(T, theory))
    for exclusion in theory.exclusions:
        sides = exclusion.left, exclusion.right
        for one, other in product(mine, theirs):
            if _match_both(sides, (one, other)) or _match_both(sides, (other, one)):
                return exclusion
    return None


def _match_both(schemas: tuple[Atom, Atom], types: tuple[Atom, Atom]) -> bool:
    """Do both types match their schemas with the same values of the variables?"""
    left, right = (match_schema(*pair) for pair in zip(schemas, types, strict=True))
    if left is None or right is None:
        return False
    return all(
        identity(left[path]) == identity(right[path]) for path in left if path in right
    )


def _closure(
    T: Atom, steps: Sequence[tuple[Axiom, Atom, Atom]]
) -> Iterator[tuple[Axiom, Atom]]:
    if not steps:
        return
    by_head: dict[Basic | Pred, list[tuple[Axiom, Atom, Atom]]] = {}
    for step in steps:
        by_head.setdefault(head(step[1]), []).append(step)
    found, waiting = {T}, [T]
    for current in waiting:
        for axiom, start, end in by_head.get(head(current), ()):
            bound = match_schema(start, current)
            if bound is None:
                continue
            reached = instantiate(end, bound)
            if reached not in found:
                found.add(reached)
                waiting.append(reached)
                yield axiom, reached


def match_schema(schema: Basic | PType, T: Basic | PType) -> Binding | None:
    """The values of the variables for which the schema is T, or None."""
    if isinstance(schema, Basic) or isinstance(T, Basic):
        return {} if schema is T else None
    if schema.pred is not T.pred or len(schema.args) != len(T.args):
        return None
    bound: dict[Path, Object] = {}
    for wanted, arg in zip(schema.args, T.args, strict=True):
        known = bound.setdefault(wanted, arg) if isinstance(wanted, Path) else wanted
        if identity(known) != identity(arg):
            return None
    return bound


def instantiate(schema: Basic | PType, bound: Binding) -> Basic | PType:
    """The schema with its variables replaced."""
    found: Basic | PType = replace_paths(schema, lambda path: bound.get(path, path))
    return found
