"""Declarations of the names in a log, so that it can be read without its game."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from ttr.errors import TTRError
from ttr.notation.names import format_predicate
from ttr.notation.reader import read_term
from ttr.safety.consent import Consent
from ttr.theories.theory import Theory, theory_of_text
from ttr.types.objects import Object
from ttr.types.paths import subterms
from ttr.types.printing import notation
from ttr.types.syntax import Pred


@dataclass(frozen=True)
class Declarations:
    """What a log has declared: statements of the notation, and names of objects."""

    statements: tuple[str, ...] = ()
    objects: frozenset[str] = frozenset()
    theory: Theory = field(default_factory=Theory, repr=False)

    def together_with(
        self, statements: Iterable[str], objects: Iterable[str]
    ) -> Declarations:
        """These declarations and more; raises `TTRError`."""
        more = tuple(statements)
        everything = (*self.statements, *more)
        theory = _theory("\n".join(everything)) if more else self.theory
        names = self.objects.union(objects)
        return Declarations(everything, names, replace(theory, objects=names))

    def missing_declarations(
        self, values: Iterable[object]
    ) -> tuple[list[str], list[str]]:
        """The further statements and names of objects that these values need."""
        needed = Theory.of(*values)
        known = self.theory
        basics = [name for name in needed.basics if name not in known.basics]
        predicates = [
            one
            for name, one in needed.predicates.items()
            if known.predicates.get(name) is not one
        ]
        statements = [f"basic {name}" for name in basics]
        statements += map(format_predicate, _in_order(predicates))
        return statements, sorted(needed.objects - self.objects)

    def read_value(self, text: str, source: str) -> Object:
        """The value that a text stands for."""
        return read_term(text, self.theory, source)

    def reads_back(self, value: Object) -> bool:
        """Has the value a notation that reads back to the same value?"""
        try:
            again = self.read_value(notation(value), "<log>")
        except TTRError:
            return False
        return again == value and type(again) is type(value)


def _theory(text: str) -> Theory:
    """The theory that a log declares, which imports nothing."""
    return theory_of_text(text, "<log>", Consent())


def _in_order(predicates: list[Pred]) -> Iterator[Pred]:
    """The predicates, each after those that the types of its arguments mention."""
    waiting = dict.fromkeys(predicates)
    while waiting:
        for one in [*waiting]:
            mentioned = [part for part in subterms(one.arities) if part is not one]
            if not any(part in waiting for part in mentioned if isinstance(part, Pred)):
                yield one
                del waiting[one]
