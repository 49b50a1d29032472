"""Topoi: warrants that say what to expect of a situation (Breitholtz 2020).

A topos is a function from situations of a background type to a type that may then be
expected: λr:[x : Ind, c : bird(x)]. [e : fly(r.x)]. An enthymeme, an argument that
leaves its warrant unsaid, is a function of the same kind, and a topos may underpin it.
"""

from __future__ import annotations

from dataclasses import dataclass

from ttr.building.functions import fix, restrict
from ttr.building.merging import merge
from ttr.computing.subtyping import Answer, consistent, subtype
from ttr.errors import IllFormed, Refused
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model, as_model
from ttr.probability import REFUTED, Degree
from ttr.safety.budgets import within_budget
from ttr.semantics.modality.necessity import ModalAnswer
from ttr.signature.signature import Signature
from ttr.types.objects import Unresolved
from ttr.types.paths import escaping
from ttr.types.printing import notation
from ttr.types.substitution import grounded
from ttr.types.syntax import (
    BOUND,
    Function,
    Record,
    TypeNode,
    as_type,
    freeze,
    kind_of,
    record,
)

__all__ = [
    "Topos",
    "combined",
    "compatible",
    "expected",
    "necessary",
    "possible",
    "topos",
    "underpins",
]


@dataclass(frozen=True)
class Topos:
    """A topos: `bg` is its background type, `fg` the function to what is expected."""

    fg: Function

    def __post_init__(self) -> None:
        fg = self.fg
        if not isinstance(fg, Function) or not isinstance(fg.body, TypeNode):
            raise IllFormed(
                "a topos is a function from situations to types, as in "
                rf"\r:[x : Ind]. [e : run(r.x)], found {kind_of(fg)}"
            )
        if escaping(fg):
            raise IllFormed(f"the topos {fg} has paths that lead nowhere")

    @property
    def bg(self) -> TypeNode:
        """The type of the situations that the topos is about."""
        return self.fg.domain

    @property
    def content(self) -> Record:
        """The topos as parametric content, {bg = type, fg = function}."""
        return record(bg=self.bg, fg=self.fg)

    def __str__(self) -> str:
        return str(self.fg)


def topos(fg: Function | Topos, /) -> Topos:
    r"""A function to types as a topos; a topos itself. Else it raises `IllFormed`.

    >>> from ttr.notation.reader import parse
    >>> from ttr.types.syntax import Ind, Pred
    >>> words = [Ind, Pred("bird", Ind), Pred("fly", Ind)]
    >>> birds_fly = topos(parse(r"\r:[x : Ind, c : bird(x)]. [e : fly(r.x)]", words))
    >>> print(birds_fly.bg)
    [x : Ind, c : bird(x)]
    """
    return fg if isinstance(fg, Topos) else Topos(fg)


# --- of a situation ------------------------------------------------------------------


@within_budget
def expected(model: Model, sit: object, warrant: Topos, /) -> TypeNode:
    """t(s), what the topos lets expect of a situation.

    Raises `Refused` where the situation is not certainly of the background type.
    """
    return as_type(as_model(model).apply(topos(warrant).fg, sit))


@within_budget
def necessary(model: Model, sit: object, T: TypeNode, warrant: Topos, /) -> ModalAnswer:
    """s : nec(T, B, t): is s of the background B, and t(s) ⊑ T?

    It is as certain as s : B where t(s) ⊑ T is derivable, refuted where that is, and
    else somewhere below. Source: Cooper 2023, on modality relative to a background.
    """
    told = _applied(model, sit, warrant)
    if isinstance(told, ModalAnswer):
        return told
    background, follows = told
    answer = subtype(follows, as_type(T), model.theory)
    return _as_far(background, answer, f"{follows} follows; is it below {T}?")


@within_budget
def possible(model: Model, sit: object, T: TypeNode, warrant: Topos, /) -> ModalAnswer:
    """s : poss(T, B, t): is s of the background B, and T compatible with t(s)?"""
    told = _applied(model, sit, warrant)
    if isinstance(told, ModalAnswer):
        return told
    background, follows = told
    answer = consistent(follows, as_type(T), theory=model.theory)
    return _as_far(background, answer, f"{follows} follows; can it be with {T}?")


def _applied(
    model: Model, sit: object, warrant: Topos
) -> tuple[Judgement, TypeNode] | ModalAnswer:
    """The situation judged to be of the background, and what then follows of it.

    The answer no, where it is not of the background or lacks what is spoken of.
    """
    warrant = topos(warrant)
    background = as_model(model).judge(sit, warrant.bg)
    outside = f"{notation(background.sit)} is not of the background {warrant.bg}"
    if background.p == REFUTED:
        return ModalAnswer(REFUTED, outside)
    try:
        body = grounded(warrant.fg.body, ({BOUND: freeze(sit)},))
        return background, as_type(model.reduced(body))
    except (Unresolved, Refused) as wrong:
        raise Refused(f"the topos {warrant} fails there: {wrong.message}") from None


def _as_far(background: Judgement, answer: Answer, question: str) -> ModalAnswer:
    """The answer, as far as the situation is of the background at all."""
    low = background.p.lo if answer.yes else 0.0
    high = 0.0 if answer.no else background.p.hi
    return ModalAnswer(Degree(low, high), f"{question} {answer}")


# --- of one another ------------------------------------------------------------------


@within_budget
def combined(first: Topos, second: Topos, theory: Signature | None = None, /) -> Topos:
    r"""The topos about situations of both backgrounds, which lets expect both.

    Law: what follows by it of a situation is of what follows by each of the two.

    >>> from ttr.building.constructors import fun, rectype
    >>> from ttr.types.syntax import Ind, Pred, outer, this
    >>> rain, wet, cold = (Pred(name, Ind) for name in ("rain", "wet", "cold"))
    >>> Rain = rectype(x=Ind, c=rain(this.x))
    >>> one = topos(fun(r=Rain)(rectype(e=wet(outer.r.x))))
    >>> two = topos(fun(s=rectype(x=Ind))(rectype(f=cold(outer.s.x))))
    >>> print(combined(one, two))
    \r:[x : Ind, c : rain(x)]. [e : wet(r.x), f : cold(r.x)]
    """
    first, second = topos(first), topos(second)
    bg = merge(first.bg, second.bg, theory)
    body = merge(as_type(first.fg.body), as_type(second.fg.body), theory)
    return Topos(Function(bg, body, first.fg.hint))


def compatible(
    first: Topos, second: Topos, theory: Signature | None = None, /
) -> Answer:
    """Can what the two topoi let expect of one situation be the case together?

    Topoi need not agree: a rhetorical resource may hold "birds fly" and "penguins do
    not", and no situation is of what both let expect. Raises `IllFormed` where they are
    no functions from record types to record types.
    """
    return consistent(fix(combined(first, second, theory).fg, theory), theory=theory)


def underpins(
    warrant: Topos, enthymeme: Topos, theory: Signature | None = None, /
) -> Answer:
    r"""Does the topos underpin the enthymeme: is its conclusion drawn by the topos?

    The premise must be below the background, and what the topos lets expect of any
    situation of the premise below the conclusion. Source: Breitholtz 2020.

    >>> from ttr.building.constructors import fun, rectype
    >>> from ttr.types.syntax import Ind, Pred, outer, this
    >>> bird, fly, sing = (Pred(name, Ind) for name in ("bird", "fly", "sing"))
    >>> Bird, Singer = rectype(x=Ind, c=bird(this.x)), rectype(x=Ind, s=sing(this.x))
    >>> warrant = topos(fun(r=Bird)(rectype(e=fly(outer.r.x))))
    >>> said = topos(fun(r=merge(Bird, Singer))(rectype(e=fly(outer.r.x))))
    >>> print(underpins(warrant, said).verdict, underpins(said, warrant).verdict)
    yes no
    """
    warrant, enthymeme = topos(warrant), topos(enthymeme)
    premise = subtype(enthymeme.bg, warrant.bg, theory)
    if not premise.yes:
        return premise
    drawn = fix(restrict(warrant.fg, enthymeme.bg, theory), theory)
    return subtype(drawn, fix(enthymeme.fg, theory), theory)
