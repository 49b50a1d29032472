"""S ⊑ T: is every witness of S one of T, whatever is judged to be of what?

The rules are sound; they look at structure and declared axioms, never at judgements.
There are three answers. `yes`: it is derivable. `no`: there is an assignment in which
some witness of S is not of T. `unknown`: neither was found.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING

from ttr.computing.case_analysis import cases, clauses, has_cases
from ttr.computing.case_search import open_cases
from ttr.computing.comparison_by_form import is_below_by_form
from ttr.computing.findings import YES, Finding
from ttr.computing.generic_witness import ITSELF, Assumption
from ttr.computing.kept_redexes import open_presupposition
from ttr.computing.normalisation import normal_type
from ttr.computing.path_cycles import has_fields_in_order
from ttr.computing.prover import Prover
from ttr.errors import TooLargeError
from ttr.hooks import hook
from ttr.safety.budgets import within_budget
from ttr.showing import Fold, NotebookValue, Part, Text, Tone, Value, below, beside
from ttr.signature.signature import Signature, signature_of
from ttr.types.interning import Node
from ttr.types.objects import EventString, FiniteSet, Object, Path
from ttr.types.paths import subterms
from ttr.types.syntax import (
    Basic,
    ListOf,
    Meet,
    Negation,
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


MANY = 16
"""After how many proofs of cases one of the whole is tried, field by field."""

TRIED = 256
"""How many cases are looked at in which an answer is left open."""


@dataclass(frozen=True)
class Refutation:
    """A possible counterexample to S ⊑ T: a witness of S under these assumptions.

    S and T are what is computed; `asked` is T as it was written, if that differs.
    """

    S: TypeNode
    T: TypeNode
    theory: Signature
    assumed: tuple[Assumption, ...] = ()
    asked: TypeNode | None = None


@hook
def counterexample(refutation: Refutation) -> Judgement | None:
    """A judgement that speaks against S ⊑ T (`ttr.judging.counterexamples`)."""
    raise NotImplementedError


VERDICTS = ("no", "unknown", "yes")
"""The verdicts; that on several claims together is the first one of theirs."""


@dataclass(frozen=True, eq=False, repr=False)
class Answer(NotebookValue):
    """An answer to a question about types: `verdict` is yes, no or unknown.

    A reason may be given as what makes it: then it is made when it is asked for.
    """

    verdict: str
    _reason: str | Callable[[], str]
    _refutation: Refutation | None = None

    @property
    def why(self) -> str:
        """The reason in words."""
        if not isinstance(self._reason, str):
            object.__setattr__(self, "_reason", _in_words(self._reason))
        return self._reason  # type: ignore[return-value]

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
        """A counterexample to S ⊑ T: the judgement of a witness of S that is not of T.

        Its `model` is the assignment in which this is so. None unless it is refuted.

        >>> from ttr import Ind, rectype
        >>> print(subtype(rectype(x=Ind), rectype(x=Ind, y=Ind)).counter)
        {x = a1} : [x : Ind, y : Ind]   p = 0
        """
        if self._refutation is None or not self.no:
            return None
        return counterexample(self._refutation)

    def _shown_as_(self) -> Part:
        tone: Tone = "yes" if self.yes else "no" if self.no else "strong"
        counter = self.counter
        against = None
        if counter is not None:
            against = below(
                beside(Text("counterexample:", "quiet"), Value(counter)),
                Fold("why it is none", Value(counter.why)),
            )
        return below(beside(Text(self.verdict, tone), Text(self.why)), against)

    def __bool__(self) -> bool:
        raise TypeError("an answer is yes, no or unknown: ask for .yes or .no")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Answer):
            return NotImplemented
        return (self.verdict, self.why) == (other.verdict, other.why)

    def __hash__(self) -> int:
        return hash((self.verdict, self.why))

    def __reduce__(self) -> tuple[object, ...]:
        return Answer, (self.verdict, self.why, self._refutation)

    def __repr__(self) -> str:
        return f"Answer(verdict={self.verdict!r}, why={self.why!r})"

    def __str__(self) -> str:
        return f"{self.verdict}: {self.why}"


def _message(error: TooLargeError, *_: object) -> str:
    return error.message


@within_budget(otherwise=_message)
def _in_words(reason: Callable[[], str]) -> str:
    """The reason; where it is too large to be printed, that it is."""
    return reason()


def _left_open(error: TooLargeError, *_: object, **__: object) -> Answer:
    """The answer where the budget ended."""
    return Answer("unknown", error.message)


@within_budget(otherwise=_left_open)
def subtype(S: TypeNode, T: TypeNode, /, theory: Signature | None = None) -> Answer:
    """Is S a subtype of T, by structure and, with a theory, by its axioms?

    Record types: each field of T is in S, and there below; paths mean the same record,
    and a manifest field equals what it is set to. T@a ⊑ T. A meet is below each of its
    parts, a join above each of its parts; S ⊑ ¬T if nothing can be of both. Lists,
    sets, strings and plus(T) go along with their elements; (S → T) ⊑ (S′ → T′) if
    S′ ⊑ S and T ⊑ T′. Raises `IllFormedError` for what is no type. Source: Cooper 2023,
    with Betarte and Tasistro 1998 for record types.

    The proof is about one arbitrary witness of S, or of each case where S is a join.
    A type without witnesses is below every type. Where S may have none, nothing is
    refuted.

    >>> from ttr import Ind, rectype, this
    >>> dog = Pred("dog", Ind)
    >>> print(subtype(rectype(x=Ind, c=dog(this.x)), rectype(x=Ind)))
    yes: each field of [x : Ind] is there, and below
    >>> print(subtype(rectype(x=Ind), rectype(x=Ind, c=dog(this.x))))
    no: [x : Ind] has no field c
    """
    S, T, theory = as_type(S), as_type(T), signature_of(theory)
    computed = (S, T) if S is T else (normal_type(S, theory), normal_type(T, theory))
    if computed != (S, T):
        return _as_asked(subtype(*computed, theory), T)
    if S is T:
        return Answer("yes", lambda: f"{S} is below itself")
    if is_below_by_form(S, T):
        return Answer("yes", partial(_why_in_each_case, S, T, theory))
    if clauses(T) is None:
        answer = _by_contradiction(S, T, theory)
    else:
        answer = (_in_each_case if has_cases(S) else _in_case)(S, T, theory)
    return answer


def _in_each_case(S: TypeNode, T: TypeNode, theory: Signature) -> Answer:
    """The answer for a type with joins: no if it is for some case, yes if for all."""
    proofs: dict[TypeNode, tuple[Prover, Finding]] = {}
    is_whole_below = False

    def is_below(case: TypeNode) -> bool:
        nonlocal is_whole_below
        if len(proofs) == MANY:
            is_whole_below = Prover.for_type(S, theory).prove(ITSELF, T).yes
        if is_whole_below:
            return True
        prover = Prover.for_type(case, theory)
        found = YES if prover.is_impossible else prover.prove(ITSELF, T)
        proofs[case] = prover, found
        return found.yes

    left_open: Answer | None = None
    for case in islice(open_cases(S, T, theory, is_below), TRIED):
        prover, found = proofs[case]
        answer = _refute(prover, T, found)
        if answer.no:
            return answer
        left_open = answer if left_open is None else left_open
    if left_open is not None:
        return left_open
    return Answer("yes", partial(_why_in_each_case, S, T, theory))


def _why_in_each_case(S: TypeNode, T: TypeNode, theory: Signature) -> str:
    if not has_cases(S):
        return _why_by_form(S, T)
    found = cases(S)
    if found and len(found) == 1:
        return _in_case(found[0], T, theory).why
    return f"each case of {S} is below {T}"


def _by_contradiction(S: TypeNode, T: TypeNode, theory: Signature) -> Answer:
    """The answer for a T of very many clauses: can something be of S and not of T?"""
    left_open = False
    for case in islice(_possible_cases(meet(S, Negation(T)), theory), TRIED):
        against = Refutation(case, T, theory)
        answer = Answer("no", partial("{} is not below {}".format, S, T), against)
        if answer.counter is not None:
            return answer
        left_open = True
    if left_open:
        return Answer("unknown", partial("{} may not be below {}".format, S, T))
    return Answer("yes", partial("each case of {} is below {}".format, S, T))


def _possible_cases(T: TypeNode, theory: Signature) -> Iterator[TypeNode]:
    """The cases of a type of which it is not derivable that nothing is of them."""
    return open_cases(
        T, None, theory, lambda case: Prover.for_type(case, theory).is_impossible
    )


def _as_asked(answer: Answer, asked: TypeNode) -> Answer:
    """The answer for types as they were written, from that for what they compute to.

    A counterexample is to the type that was asked for.
    """
    refutation = answer._refutation
    if refutation is not None:
        refutation = replace(refutation, asked=asked)
    return Answer(answer.verdict, answer._reason, refutation)


def _in_case(S: TypeNode, T: TypeNode, theory: Signature) -> Answer:
    """The answer for one case of a type."""
    prover = Prover.for_type(S, theory)
    if prover.is_impossible:
        return Answer("yes", lambda: f"nothing can be of {S}")
    found = prover.prove(ITSELF, T)
    if found.yes:
        return Answer("yes", lambda: found.why or _why_by_form(S, T))
    return _refute(prover, T, found)


def _refute(prover: Prover, T: TypeNode, found: Finding) -> Answer:
    """The answer no if there certainly is a counterexample, else unknown."""
    S = prover.S
    refutation = Refutation(S, T, prover.theory, found.assumed)
    open_ = partial(_why_open, found, prover.theory, S, T)
    answer = Answer("no", open_, refutation)
    if is_decided(prover, T) or answer.counter is not None:
        return answer
    if open_presupposition(S, T):
        return Answer("unknown", open_)
    if prover.witness.is_certain:
        no_refutation = "but no counterexample was found: there may be no witness"
        return Answer("unknown", lambda: f"{open_()}, {no_refutation}")
    return Answer("unknown", lambda: f"{open_()}, but nothing may be of {S}")


def _why_open(found: Finding, theory: Signature, *types: TypeNode) -> str:
    """What is not derived, and what is presupposed; and how to name the theory."""
    kept = open_presupposition(*types)
    if not kept:
        return found.why
    is_missing = theory is signature_of(None)
    way_out = "; a theory may say so: subtype(S, T, theory)" if is_missing else ""
    return f"{found.why}; {kept}{way_out}"


def is_decided(prover: Prover, T: TypeNode) -> bool:
    """Is what the prover does not derive of a witness and T surely refuted?"""
    S = prover.S
    heads = prover.theory.conditional_heads
    if heads and any(part in heads for part in _heads_in(S, T)):
        return False
    plain = prover.witness.is_certain and _is_plain(S) and _is_plain(T)
    return plain and has_fields_in_order(S)


def _heads_in(*types: TypeNode) -> Iterator[Basic | Pred]:
    """The basic types and predicates in the types."""
    return (part for part in subterms(types) if isinstance(part, Basic | Pred))


_TYPES = (Basic, PType, Singleton, Meet, ListOf, RecordType, Universe)
_PLAIN = (*_TYPES, Pred, Path, FiniteSet, EventString)


def _is_plain(T: TypeNode) -> bool:
    """Is T made only of constructors for which the rules are complete?"""
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
        for part in subterms(found)
    )


def _why_by_form(S: TypeNode, T: TypeNode) -> str:
    if isinstance(T, RecordType):
        return f"each field of {T} is there, and below"
    return f"{S} is below {T} by its form"


@within_budget(otherwise=_left_open)
def consistent(*types: TypeNode, theory: Signature | None = None) -> Answer:
    """Can something be of all the types, under some assignment?

    >>> from ttr import Ind
    >>> print(consistent(Ind @ "a", Ind @ "b"))
    no: nothing can be of (Ind@a) /\\ (Ind@b)
    >>> consistent(Ind, Basic("Event")).yes
    True
    """
    signature = signature_of(theory)
    T = meet(*[normal_type(as_type(one), signature) for one in types])
    left_open = False
    for case in islice(_possible_cases(T, signature), TRIED):
        found = counterexample(Refutation(case, Negation(case), signature))
        if found is not None:
            return Answer("yes", f"some assignment has {found.sit} of {T}")
        left_open = True
    if left_open:
        return Answer("unknown", lambda: f"no witness of {T} could be made up")
    return Answer("no", lambda: f"nothing can be of {T}")


is_subtype.provided_by(lambda S, T: subtype(S, T).yes)
