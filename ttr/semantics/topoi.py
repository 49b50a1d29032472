"""Topoi: warrants that say what to expect of a situation (Breitholtz 2020).

A topos is a function from situations of a background type to the type to be expected:
λr:[x : Ind, c : bird(x)]. [e : fly(r.x)]. An enthymeme, an argument whose warrant is
left unsaid, is such a function, too; a topos may underpin it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from ttr.aliases import former_names
from ttr.building.function_domains import fix, restrict
from ttr.building.merging import merge
from ttr.computing.subtyping import Answer, consistent, subtype
from ttr.errors import IllFormedError, RefusedError
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model, as_model
from ttr.probability import REFUTED, Degree
from ttr.safety.budgets import within_budget
from ttr.semantics.modality.necessity import ModalAnswer
from ttr.signature.signature import Signature
from ttr.types.objects import Record, UnresolvedError, freeze, record
from ttr.types.paths import free_paths
from ttr.types.printing import notation
from ttr.types.substitution import instantiate_body
from ttr.types.syntax import Function, TypeNode, as_type, kind_of

__all__ = [
    "Topos",
    "combine_topoi",
    "compatible",
    "expectation",
    "necessary",
    "possible",
    "topos",
    "underpins",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)


@dataclass(frozen=True)
class Topos:
    """A topos: `bg` is its background type, `fg` the function to what to expect.

    >>> from ttr import Ind, Pred, fun, outer, rectype, this
    >>> bird, fly = Pred("bird", Ind), Pred("fly", Ind)
    >>> Bird = rectype(x=Ind, c=bird(this.x))
    >>> birds_fly = Topos(fun(r=Bird)(rectype(e=fly(outer.r.x))))
    >>> print(birds_fly.bg)
    [x : Ind, c : bird(x)]
    """

    fg: Function

    def __post_init__(self) -> None:
        fg = self.fg
        if not isinstance(fg, Function) or not isinstance(fg.body, TypeNode):
            raise IllFormedError(
                "a topos is a function from situations to types, as in "
                rf"\r:[x : Ind]. [e : run(r.x)], found {kind_of(fg)}"
            )
        if free_paths(fg):
            raise IllFormedError(f"the topos {fg} has paths that lead nowhere")

    @property
    def bg(self) -> TypeNode:
        """The type of the situations that the topos is about."""
        return self.fg.domain

    @property
    def content(self) -> Record:
        """The topos as a parametric content {bg, fg}."""
        return record(bg=self.bg, fg=self.fg)

    def __str__(self) -> str:
        return str(self.fg)


def topos(fg: Function | Topos, /) -> Topos:
    r"""A function as a topos, a topos as itself; `IllFormedError` for anything else.

    >>> from ttr import Ind, Pred, parse
    >>> words = [Ind, Pred("bird", Ind), Pred("fly", Ind)]
    >>> birds_fly = topos(parse(r"\r:[x : Ind, c : bird(x)]. [e : fly(r.x)]", words))
    >>> print(birds_fly.bg)
    [x : Ind, c : bird(x)]
    """
    return fg if isinstance(fg, Topos) else Topos(fg)


# --- of a situation ------------------------------------------------------------------


@within_budget
def expectation(model: Model, sit: object, warrant: Topos, /) -> TypeNode:
    """t(s): what to expect of a situation s by a topos t.

    Raises `RefusedError` where s is not certainly of the background type.

    >>> from ttr import Ind, Model, Pred, fun, outer, record, rectype, this
    >>> bird, fly = Pred("bird", Ind), Pred("fly", Ind)
    >>> Bird = rectype(x=Ind, c=bird(this.x))
    >>> birds_fly = topos(fun(r=Bird)(rectype(e=fly(outer.r.x))))
    >>> M = Model().given("tweety", Ind).given("s1", bird("tweety"))
    >>> print(expectation(M, record(x="tweety", c="s1"), birds_fly))
    [e : fly(tweety)]
    """
    return as_type(as_model(model).apply(topos(warrant).fg, sit))


@within_budget
def necessary(
    model: Model,
    sit: object,
    T: TypeNode,
    warrant: Topos,
    /,
    *,
    background: TypeNode | None = None,
) -> ModalAnswer:
    """s : nec(T, B, t): is s of B, B ⊑ the background of t, and t(s) ⊑ T?

    B is `background`, or the background of the topos itself. As certain as s : B where
    the two subtypings are derivable; not so where one is refuted; else between the two.
    Source: Cooper 2023, §6.4, on modality relative to a background.

    >>> from ttr import Ind, Model, Pred, fun, outer, record, rectype, this
    >>> bird, fly = Pred("bird", Ind), Pred("fly", Ind)
    >>> Bird = rectype(x=Ind, c=bird(this.x))
    >>> birds_fly = topos(fun(r=Bird)(rectype(e=fly(outer.r.x))))
    >>> M = Model().given("tweety", Ind).given("s1", bird("tweety"))
    >>> s = record(x="tweety", c="s1")
    >>> necessary(M, s, rectype(e=fly("tweety")), birds_fly).yes
    True
    """
    found = _apply_to_situation(model, sit, warrant, background)
    if isinstance(found, ModalAnswer):
        return found
    answer = subtype(found.follows, as_type(T), model.theory)
    question = f"{found.follows} follows; is it below {T}?"
    return _limit_answer(found, answer, question)


@within_budget
def possible(
    model: Model,
    sit: object,
    T: TypeNode,
    warrant: Topos,
    /,
    *,
    background: TypeNode | None = None,
) -> ModalAnswer:
    """s : poss(T, B, t): is s of B, B ⊑ the background of t, t(s) compatible with T?

    B is as with `necessary`. Types are compatible if something can be of both.

    >>> from ttr import Ind, Model, Pred, fun, outer, record, rectype, this
    >>> bird, fly = Pred("bird", Ind), Pred("fly", Ind)
    >>> Bird = rectype(x=Ind, c=bird(this.x))
    >>> birds_fly = topos(fun(r=Bird)(rectype(e=fly(outer.r.x))))
    >>> M = Model().given("tweety", Ind).given("s1", bird("tweety"))
    >>> s = record(x="tweety", c="s1")
    >>> possible(M, s, ~rectype(e=fly("tweety")), birds_fly).no
    True
    """
    found = _apply_to_situation(model, sit, warrant, background)
    if isinstance(found, ModalAnswer):
        return found
    answer = consistent(found.follows, as_type(T), theory=model.theory)
    question = f"{found.follows} follows; can it be with {T}?"
    return _limit_answer(found, answer, question)


class _Applied(NamedTuple):
    """A topos applied to a situation.

    `inside` judges the situation to be of the background B, `covered` is whether B is
    below that of the topos, and `follows` what the topos lets expect.
    """

    inside: Judgement
    covered: Answer
    follows: TypeNode


def _apply_to_situation(
    model: Model, sit: object, warrant: Topos, background: TypeNode | None
) -> _Applied | ModalAnswer:
    """The topos applied; the answer no where the situation or B is outside of it.

    Raises `RefusedError` where the topos cannot be applied.
    """
    warrant = topos(warrant)
    B = warrant.bg if background is None else as_type(background)
    inside = as_model(model).judge(sit, B)
    covered = subtype(B, warrant.bg, model.theory)
    if covered.no:
        outside = f"{B} is not below the background of the topos: {covered.why}"
        return ModalAnswer(REFUTED, outside)
    if inside.p == REFUTED:
        outside = f"{notation(inside.sit)} is not of the background {B}"
        return ModalAnswer(REFUTED, outside)
    try:
        body = instantiate_body(warrant.fg, freeze(sit))
        return _Applied(inside, covered, as_type(model.reduce(body)))
    except (UnresolvedError, RefusedError) as wrong:
        raise RefusedError(
            f"the topos {warrant} fails there: {wrong.message}"
        ) from None


def _limit_answer(found: _Applied, answer: Answer, question: str) -> ModalAnswer:
    """The answer, limited by how certainly the situation is of the background."""
    low = found.inside.p.lo if answer.yes and found.covered.yes else 0.0
    high = 0.0 if answer.no else found.inside.p.hi
    return ModalAnswer(Degree(low, high), f"{question} {answer}")


# --- of one another ------------------------------------------------------------------


@within_budget
def combine_topoi(
    first: Topos, second: Topos, /, theory: Signature | None = None
) -> Topos:
    r"""The merge of two topoi: of situations of both backgrounds, both can be expected.

    Law: what follows by it is below what follows by each of the two.

    >>> from ttr import Ind, Pred, fun, outer, rectype, this
    >>> rain, wet, cold = (Pred(name, Ind) for name in ("rain", "wet", "cold"))
    >>> Rain = rectype(x=Ind, c=rain(this.x))
    >>> one = topos(fun(r=Rain)(rectype(e=wet(outer.r.x))))
    >>> two = topos(fun(s=rectype(x=Ind))(rectype(f=cold(outer.s.x))))
    >>> print(combine_topoi(one, two))
    \r:[x : Ind, c : rain(x)]. [e : wet(r.x), f : cold(r.x)]
    """
    first, second = topos(first), topos(second)
    bg = merge(first.bg, second.bg, theory)
    body = merge(as_type(first.fg.body), as_type(second.fg.body), theory)
    return Topos(Function(bg, body))


def compatible(
    first: Topos, second: Topos, /, theory: Signature | None = None
) -> Answer:
    """Can what two topoi let expect of one situation be the case together?

    Topoi need not be consistent: somebody may hold "birds fly" and "penguins do not".
    Raises `IllFormedError` where they are not functions from record types to record
    types.

    >>> from ttr import Ind, Pred, fun, outer, rectype, this
    >>> fly = Pred("fly", Ind)
    >>> flies = topos(fun(r=rectype(x=Ind))(rectype(e=fly(outer.r.x))))
    >>> stays = topos(fun(r=rectype(x=Ind))(rectype(e=~fly(outer.r.x))))
    >>> compatible(flies, flies).verdict, compatible(flies, stays).verdict
    ('yes', 'no')
    """
    both = combine_topoi(first, second, theory)
    return consistent(fix(both.fg, theory), theory=theory)


def underpins(
    warrant: Topos, enthymeme: Topos, /, theory: Signature | None = None
) -> Answer:
    r"""Does the topos underpin the enthymeme, that is, draw its conclusion?

    The premise must be below the background; and what the topos lets expect of any
    situation of the premise must be below the conclusion. Source: Breitholtz 2020.

    >>> from ttr import Ind, Pred, fun, outer, rectype, this
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
