"""What a pronoun can pick up after a quantified sentence, by its sets of witnesses."""

from __future__ import annotations

from dataclasses import dataclass

from ttr.semantics.quantifiers.extension_pairs import Case
from ttr.semantics.quantifiers.quantified_propositions import Quantification
from ttr.types.objects import FiniteSet


@dataclass(frozen=True)
class Antecedents:
    """The sets that a later pronoun may stand for.

    `refset` are those of P that are Q, `maxset` all of P, and `compset` those of P that
    are not Q. The last is there only after a quantifier that falls, as in "Few dogs
    bark. They sleep instead.", where P is not empty. All of P are offered only if the
    quantifier is about them, as "most dogs" is; "a dog" and "two dogs" are not.

    >>> from ttr.semantics.quantifiers import Extension, antecedents, every, quantify
    >>> dogs, barkers = Extension.of(["fido", "rex"]), Extension.of(["fido", "rex"])
    >>> found = antecedents(quantify(every, dogs, barkers))
    >>> print(found.refset, found.compset)
    {fido, rex} None
    """

    refset: FiniteSet
    maxset: FiniteSet
    compset: FiniteSet | None
    offers_maxset: bool = True

    @property
    def accessible(self) -> tuple[FiniteSet, ...]:
        """The sets that a pronoun can reach, what is most accessible first."""
        maxset = (self.maxset,) if self.offers_maxset else ()
        compset = () if self.compset is None else (self.compset,)
        return tuple(dict.fromkeys((self.refset, *maxset, *compset)))

    @property
    def plural(self) -> tuple[FiniteSet, ...]:
        """What "they" can stand for, what is most accessible first."""
        return tuple([X for X in self.accessible if len(X) > 1])

    @property
    def singular(self) -> tuple[object, ...]:
        """What "it", "he" or "she" can stand for: who alone is P and Q."""
        return self.refset.items if len(self.refset) == 1 else ()


def antecedents(found: Quantification) -> Antecedents:
    """The anaphora sets of a quantification.

    Sources: Moxey and Sanford 1987; Cooper 2023, §7.4.

    >>> from ttr.semantics.quantifiers import Extension, few, quantify
    >>> dogs = Extension.of(["fido", "rex", "sam", "kim"], "dog")
    >>> found = quantify(few, dogs, Extension.of(["fido"], "bark"))
    >>> print(*antecedents(found).plural)
    {fido, kim, rex, sam} {kim, rex, sam}
    """
    falls = not any(one.is_lower_bound for one in found.asked)
    compset = _set_of(found.compset) if falls and found.compset else None
    about_all = falls or all(one.unit == "share" for one in found.asked)
    return Antecedents(_set_of(found.refset), _set_of(found.maxset), compset, about_all)


def _set_of(cases: tuple[Case, ...]) -> FiniteSet:
    return FiniteSet(*[it.sit for it in cases])
