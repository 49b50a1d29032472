"""Propositions: what can be true or false.

A type is a proposition that is true if something is of it. An Austinian proposition,
{sit = s, sit_type = T}, is about a situation as well, and true if s is of T. A
probabilistic one, {sit = s, sit_type = T, prob = p}, says how probable that is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.errors import IllFormedError, TTRError
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, Degree, degree
from ttr.probability.degrees import ROUNDING, is_within
from ttr.types.objects import Object, Record, record
from ttr.types.syntax import TypeNode, as_type, kind_of

if TYPE_CHECKING:
    from ttr.judging.judgements import Judgement

__all__ = [
    "borne_out",
    "claim",
    "probabilistic",
    "probabilistic_claim",
    "proposition",
    "proposition_of",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)


def proposition(sit: object, T: TypeNode) -> Record:
    """The Austinian proposition that a situation is of a type.

    >>> from ttr import Ind, Pred
    >>> print(proposition("s1", Pred("dog", Ind)("fido")))
    {sit = s1, sit_type = dog(fido)}
    """
    return record(sit=sit, sit_type=as_type(T))


def probabilistic(sit: object, T: TypeNode, p: object) -> Record:
    """The probabilistic Austinian proposition that p(s : T) is p, or in an interval.

    An interval is kept as the list of its ends. Raises `TTRError` for what is no
    probability. Source: Cooper, Dobnik, Lappin and Larsson 2015.

    >>> from ttr import Ind, Pred
    >>> print(probabilistic("s1", Pred("dog", Ind)("fido"), 0.9))
    {prob = 0.9, sit = s1, sit_type = dog(fido)}
    >>> print(probabilistic("fido", Ind, (0.5, 1)).prob)
    (0.5, 1.0)
    """
    lo, hi = degree(p, "the prob of a proposition")
    return record(sit=sit, sit_type=as_type(T), prob=lo if lo == hi else [lo, hi])


def proposition_of(judgement: Judgement, /) -> Record:
    """The probabilistic Austinian proposition that a judgement states.

    Law: `probabilistic_claim(proposition_of(j))` is (j.sit, j.type, j.p).

    >>> from ttr import Ind, Model
    >>> print(proposition_of(Model().given("fido", Ind, 0.75).judge("fido", Ind)))
    {prob = 0.75, sit = fido, sit_type = Ind}
    """
    try:
        return probabilistic(judgement.sit, judgement.type, judgement.p)
    except AttributeError:
        raise IllFormedError(
            f"expected a judgement, found {kind_of(judgement)}"
        ) from None


def claim(p: object) -> tuple[Object, TypeNode]:
    """The situation and the type of an Austinian proposition; else `IllFormedError`.

    >>> from ttr import Ind, Pred
    >>> from ttr.judging import proposition
    >>> s, T = claim(proposition("s1", Pred("dog", Ind)("fido")))
    >>> print(s, ":", T)
    s1 : dog(fido)
    """
    if isinstance(p, Record) and set(p) >= {"sit", "sit_type"}:
        return p.sit, as_type(p.sit_type)
    raise IllFormedError(
        f"a proposition is a type or a record {{sit = s, sit_type = T}}, found {p}"
    )


def probabilistic_claim(p: object) -> tuple[Object, TypeNode, Degree]:
    """The situation, the type and the probability; one without prob claims certainty.

    Raises `IllFormedError` for what is no Austinian proposition.

    >>> from ttr import Ind, Pred
    >>> perhaps = probabilistic("s1", Pred("dog", Ind)("fido"), 0.9)
    >>> s, T, p = probabilistic_claim(perhaps)
    >>> print(f"{s} : {T} with {p}")
    s1 : dog(fido) with 0.9
    """
    sit, T = claim(p)
    if not isinstance(p, Record) or "prob" not in p:
        return sit, T, CERTAIN
    try:
        return sit, T, degree(p.prob, "the prob of a proposition")
    except TTRError as error:
        raise IllFormedError(f"{p}: {error.message}") from None


def borne_out(claimed: Degree, found: Degree) -> Degree:
    """How certain it is that a probability is as claimed, given the one found.

    True where what is found is within what is claimed, false where they are apart.

    >>> borne_out(Degree(0.5, 1), Degree(0.6, 0.7)) == CERTAIN
    True
    >>> print(borne_out(Degree(0.5, 0.5), Degree(0.6, 0.7)))
    0
    """
    if found.hi < claimed.lo - ROUNDING or found.lo > claimed.hi + ROUNDING:
        return REFUTED
    return CERTAIN if is_within(found, claimed) else UNKNOWN
