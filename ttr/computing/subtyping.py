"""S ⊑ T: is every witness of S one of T, whatever is judged to be of what?

A sound system of rules over structure and declared axioms, with three answers. `yes` is
derivable; `no` means that some assignment of witnesses speaks against it; `unknown`
means neither is known. What happens to be judged is never looked at.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ttr.computing.case_analysis import cases
from ttr.computing.cycles import in_order
from ttr.computing.generic_witness import Assumption
from ttr.computing.prover import Finding, Question
from ttr.computing.witness_places import ITSELF
from ttr.errors import TooLargeError
from ttr.hooks import hook
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Signature, signature_of
from ttr.types.interning import Node
from ttr.types.paths import occurring
from ttr.types.syntax import (
    Basic,
    EventString,
    FiniteSet,
    ListOf,
    Meet,
    Negation,
    Object,
    Path,
    Pred,
    PType,
    RecordType,
    Singleton,
    TypeNode,
    Universe,
    as_type,
    is_subtype,
    meet,
)

if TYPE_CHECKING:
    from ttr.judging.judgements import Judgement

__all__ = ["Answer", "Refutation", "consistent", "subtype"]


@dataclass(frozen=True)
class Refutation:
    """What may speak against S ⊑ T: a witness of S of which this is assumed."""

    S: TypeNode
    T: TypeNode
    theory: Signature
    assumed: tuple[Assumption, ...] = ()


@hook
def counterexample(refutation: Refutation) -> Judgement | None:
    """A judgement that speaks against S ⊑ T: `ttr.judging.counterexamples.counter`."""
    raise NotImplementedError


@dataclass(frozen=True)
class Answer:
    """An answer to a question about types: `verdict` is yes, no or unknown."""

    verdict: str
    why: str
    _refutation: Refutation | None = field(default=None, repr=False, compare=False)

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

    @property
    def counter(self) -> Judgement | None:
        """A judgement that speaks against S ⊑ T: of a witness of S, which is not of T.

        Its `model` is the assignment in which it is so. None where nothing is refuted.

        >>> from ttr.building.constructors import rectype
        >>> from ttr.types.syntax import Ind
        >>> print(subtype(rectype(x=Ind), rectype(x=Ind, y=Ind)).counter)
        {x = a1} : [x : Ind, y : Ind]   p = 0
        """
        if self._refutation is None or not self.no:
            return None
        return counterexample(self._refutation)

    def __bool__(self) -> bool:
        raise TypeError("an answer is yes, no or unknown: ask for .yes or .no")

    def __str__(self) -> str:
        return f"{self.verdict}: {self.why}"


def _left_open(error: TooLargeError, *_: object, **__: object) -> Answer:
    """The answer where the budget ended."""
    return Answer("unknown", error.message)


@within_budget(otherwise=_left_open)
def subtype(S: TypeNode, T: TypeNode, theory: Signature | None = None, /) -> Answer:
    """Is S a subtype of T, by structure and, with a theory, by its axioms?

    Record types: each field of T is in S, and there below; paths mean the same record,
    and a manifest field equals what it is set to. T@a ⊑ T. A meet is below each of its
    parts, a join above each of its parts; S ⊑ ¬T if nothing can be of both. Lists,
    sets, strings and plus(T) go along with their elements; (S → T) ⊑ (S′ → T′) if
    S′ ⊑ S and T ⊑ T′. Raises `IllFormed` for what is no type. Source: Cooper 2023, with
    Betarte and Tasistro 1998 for record types.

    The rules are asked of one arbitrary witness of S, in each case where S is a join.
    Where nothing can be of S, it is below every type; where there may be nothing, a
    refutation is not certain.

    >>> from ttr.building.constructors import rectype
    >>> from ttr.types.syntax import Ind, this
    >>> dog = Pred("dog", Ind)
    >>> print(subtype(rectype(x=Ind, c=dog(this.x)), rectype(x=Ind)))
    yes: each field of [x : Ind] is there, and below
    >>> print(subtype(rectype(x=Ind), rectype(x=Ind, c=dog(this.x))))
    no: [x : Ind] has no field c
    """
    S, T, theory = as_type(S), as_type(T), signature_of(theory)
    if S is T:
        return Answer("yes", f"{S} is below itself")
    found = cases(S)
    answers = [_in_case(case, T, theory) for case in found or (S,)]
    refuted = next((answer for answer in answers if answer.no), None)
    if refuted is not None:
        return refuted
    if len(answers) > 1 and all(answer.yes for answer in answers):
        return Answer("yes", f"each case of {S} is below {T}")
    return next((answer for answer in answers if answer.unknown), answers[0])


def _in_case(S: TypeNode, T: TypeNode, theory: Signature) -> Answer:
    """The answer for one case of a type."""
    question = Question.about(S, theory)
    if question.impossible:
        return Answer("yes", f"nothing can be of {S}")
    found = question.ask(ITSELF, T)
    if found.yes:
        return Answer("yes", found.why or _by_form(S, T))
    return _refuted(question, T, found)


def _refuted(question: Question, T: TypeNode, found: Finding) -> Answer:
    """The answer no, if an assignment is known to speak against it."""
    S = question.S
    refutation = Refutation(S, T, question.theory, found.assumed)
    answer = Answer("no", found.why, refutation)
    certain = question.witness.certain
    if certain and _is_plain(S) and _is_plain(T) and in_order(S):
        return answer
    if answer.counter is not None:
        return answer
    but = "" if certain else f", but nothing may be of {S}"
    return Answer("unknown", f"{found.why}{but}")


_TYPES = (Basic, PType, Singleton, Meet, ListOf, RecordType, Universe)
_PLAIN = (*_TYPES, Pred, Path, FiniteSet, EventString)


def _is_plain(T: TypeNode) -> bool:
    """Whether it is of constructors whose rules leave nothing underivable."""
    waiting: dict[Object, None] = {T: None}
    found: dict[Object, None] = {}
    while waiting:
        value, _ = waiting.popitem()
        # A record type may be wide: its ptypes are looked at without going into paths.
        match value:
            case RecordType(fields):
                waiting.update((field, None) for _, field in fields)
            case PType(pred, args) if all(type(arg) in (Path, str) for arg in args):
                found[pred] = None
            case _:
                found[value] = None
    return all(
        isinstance(part, _PLAIN) or not isinstance(part, Node)
        for part in occurring(found)
    )


def _by_form(S: TypeNode, T: TypeNode) -> str:
    if isinstance(T, RecordType):
        return f"each field of {T} is there, and below"
    return f"{S} is below {T} by its form"


@within_budget(otherwise=_left_open)
def consistent(*types: TypeNode, theory: Signature | None = None) -> Answer:
    """Can something be of all the types, under some assignment?

    >>> from ttr.types.syntax import Ind
    >>> print(consistent(Ind @ "a", Ind @ "b"))
    no: nothing can be of (Ind@a) /\\ (Ind@b)
    >>> consistent(Ind, Basic("Event")).yes
    True
    """
    T = meet(*types)
    signature = signature_of(theory)
    open_cases = [
        case
        for case in cases(T) or (T,)
        if not Question.about(case, signature).impossible
    ]
    if not open_cases:
        return Answer("no", f"nothing can be of {T}")
    for case in open_cases:
        found = counterexample(Refutation(case, Negation(case), signature))
        if found is not None:
            return Answer("yes", f"some assignment has {found.sit} of {T}")
    return Answer("unknown", f"no witness of {T} could be made up")


is_subtype.provided_by(lambda S, T: subtype(S, T).yes)
