"""S ⊑ T: is every witness of S one of T, whatever is judged to be of what?

A sound system of rules over structure and declared axioms, with three answers. `yes` is
derivable; `no` means that some assignment of witnesses speaks against it; `unknown`
means neither is known. What happens to be judged is never looked at.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import assert_never

from ttr.axioms import above
from ttr.errors import following_nesting
from ttr.hypothetical import ITSELF, Hypothetical, element, step, unpacked
from ttr.levels import why_outside
from ttr.printing import notation
from ttr.substitution import replace_paths
from ttr.syntax import (
    Basic,
    ListOf,
    Meet,
    Object,
    Path,
    PType,
    Record,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
    as_type,
    identity,
)
from ttr.theories import Signature

__all__ = ["Answer", "subtype"]


@dataclass(frozen=True)
class Answer:
    """An answer to a question of subtyping: `verdict` is yes, no or unknown."""

    verdict: str
    why: str

    @property
    def yes(self) -> bool:
        """Derivable: it holds under every assignment."""
        return self.verdict == "yes"

    @property
    def no(self) -> bool:
        """Refuted: some assignment speaks against it."""
        return self.verdict == "no"

    @property
    def unknown(self) -> bool:
        """Neither derivable nor refuted."""
        return self.verdict == "unknown"

    def __bool__(self) -> bool:
        raise TypeError("an answer is yes, no or unknown: ask for .yes or .no")

    def __str__(self) -> str:
        return f"{self.verdict}: {self.why}"


@following_nesting
def subtype(S: TypeNode, T: TypeNode, theory: Signature | None = None, /) -> Answer:
    """Is S a subtype of T, by structure and, with a theory, by its axioms?

    Record types: each field of T is in S, and there below; paths mean the same record,
    and a manifest field equals what it is set to. T@a ⊑ T. A meet is below each of its
    parts. list(S) ⊑ list(T) if S ⊑ T. Raises `IllFormed` for what is no type. Source:
    Cooper 2023, with Betarte and Tasistro 1998 for record types.

    The rules are asked of one arbitrary witness of S. Where nothing can be of S, it is
    below every type; where there may be nothing, a refutation is not certain.

    >>> from ttr.syntax import Ind, Pred, rectype, this
    >>> dog = Pred("dog", Ind)
    >>> print(subtype(rectype(x=Ind, c=dog(this.x)), rectype(x=Ind)))
    yes: each field of [x : Ind] is there, and below
    >>> print(subtype(rectype(x=Ind), rectype(x=Ind, c=dog(this.x))))
    no: [x : Ind] has no field c
    """
    S, T = as_type(S), as_type(T)
    if S is T:
        return Answer("yes", f"{S} is below itself")
    witness = Hypothetical(S)
    if witness.impossible:
        return Answer("yes", f"nothing can be of {S}")
    answer = _Question(S, witness, theory or Signature()).ask(ITSELF, T, ())
    if answer.no and not witness.certain:
        return Answer("unknown", f"{answer.why}, but nothing may be of {S}")
    if answer.yes and not answer.why:
        return Answer("yes", _by_form(S, T))
    return answer


def _by_form(S: TypeNode, T: TypeNode) -> str:
    if isinstance(T, RecordType):
        return f"each field of {T} is there, and below"
    return f"{S} is below {T} by its form"


_YES = Answer("yes", "")

Where = tuple[str, ...]
"""The labels from the witness to the field that a question is about."""


@dataclass(frozen=True)
class _Question:
    """Is the witness of S of a type, under the axioms?

    `given` are the elements of lists that the question is about.
    """

    S: TypeNode
    witness: Hypothetical
    theory: Signature
    given: frozenset[Path] = frozenset()

    def ask(self, term: Object, T: TypeNode, where: Where) -> Answer:
        """Is a term, a place in the witness or an object, of T for sure?

        T's paths start where the whole witness stands.
        """
        term = self.witness.normal(term)
        if any(known is T for known in self._known(term)):
            return _YES
        match T:
            case Basic() | PType():
                return self._atom(term, T, where)
            case Singleton(base, value):
                return self._singleton(term, base, value, where)
            case Meet(parts):
                return _every([self.ask(term, part, where) for part in parts])
            case ListOf(item):
                return self._list(term, T, item, where)
            case RecordType():
                return self._record(term, T, where)
            case Universe():
                return self._universe(term, T, where)
        raise assert_never(T)  # type: ignore[arg-type]

    def _atom(self, term: Object, T: Basic | PType, where: Where) -> Answer:
        wanted = self.witness.normal(T)
        for known in self._known(term):
            if known is wanted:
                return _YES
            if not isinstance(known, Basic | PType):
                continue
            for axiom, upper in above(known, self.theory.axioms):
                if upper is wanted:
                    return Answer("yes", f"by the axiom {axiom}")
        return self._not_below(term, wanted, where)

    def _singleton(
        self, term: Object, base: TypeNode, value: Object, where: Where
    ) -> Answer:
        wanted = self.witness.normal(value)
        if identity(term) == identity(wanted):
            return self.ask(term, base, where)
        one = ".".join(where) or f"a witness of {self.S}"
        return _no(where, f"{one} need not be {self._shown(wanted)}")

    def _list(self, term: Object, T: ListOf, item: TypeNode, where: Where) -> Answer:
        if isinstance(term, tuple):
            return _every([self.ask(element, item, where) for element in term])
        if not any(isinstance(known, ListOf) for known in self._known(term)):
            return self._not_below(term, T, where)
        place = element(term)
        if self.witness.is_absent(place):
            return _YES
        return replace(self, given=self.given | {place}).ask(place, item, where)

    def _record(self, term: Object, T: RecordType, where: Where) -> Answer:
        known = [R for R in self._known(term) if isinstance(R, RecordType)]
        if not known and not isinstance(term, Record):
            return self._not_below(term, T, where)
        for label, field in T.fields:
            if isinstance(term, Record) and label in term:
                inner = term[label]
            elif isinstance(term, Path) and any(label in R for R in known):
                inner = step(term, label)
            else:
                return _no(where, f"{self._types(term)} has no field {label}")
            answer = self.ask(inner, unpacked(field, term), (*where, label))
            if answer.no:
                return answer
        return _YES

    def _universe(self, term: Object, T: Universe, where: Where) -> Answer:
        if isinstance(term, TypeNode):
            outside = why_outside(term, T)
            return _no(where, f"{self._shown(term)}: {outside}") if outside else _YES
        for known in self._known(term):
            if isinstance(known, Universe) and _is_among(known, T):
                return _YES
        return self._not_below(term, T, where)

    def _known(self, term: Object) -> list[TypeNode]:
        return self.witness.types_of(term, self.given)

    def _not_below(self, term: Object, T: TypeNode, where: Where) -> Answer:
        return _no(where, f"{self._types(term)} is not below {self._shown(T)}")

    def _types(self, term: Object) -> str:
        """What is known of a term, as one type, for a reason."""
        known = self._known(term)
        return " /\\ ".join(map(self._shown, known)) or self._shown(term)

    def _shown(self, value: Object) -> str:
        """The notation of a value, its places written as paths from the witness."""
        labels = frozenset(self.S.labels if isinstance(self.S, RecordType) else ())
        return notation(replace_paths(value, _from_witness), (labels,))


def _from_witness(place: Path) -> Path:
    inside = place.labels[: len(ITSELF.labels)] == ITSELF.labels
    return Path(place.up, place.labels[inside:] or place.labels)


def _no(where: Where, why: str) -> Answer:
    return Answer("no", f"in the field {'.'.join(where)}, {why}" if where else why)


def _every(answers: list[Answer]) -> Answer:
    """The answer where all must be yes."""
    return next((answer for answer in answers if not answer.yes), _YES)


def _is_among(U: Universe, T: Universe) -> bool:
    """Whether the types of the one are among those of the other."""
    return U.level <= T.level and T.name in ("Type", U.name)
