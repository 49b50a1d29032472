"""Type acts: what an agent does with a type – judge, query, create.

An agent judges an object to be of a type (a :ₐ T), or that something is (some :ₐ T);
asks whether it is (a :ₐ T?), or of what something is (some :ₐ T?); or creates a
situation of a type (:ₐ T!). To be licensed to an act is not to do it: what licenses is
a rule's agenda, what is done is a value here, and `perform` works out what comes of
it in the agent's model. Source: Cooper 2023, chapter 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from ttr.aliases import former_names
from ttr.errors import RefusedError, TTRError
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model, as_model
from ttr.types.objects import Object, freeze
from ttr.types.printing import notation
from ttr.types.syntax import TypeNode, as_type, kind_of

__all__ = [
    "Create",
    "Judge",
    "JudgeSome",
    "Outcome",
    "Query",
    "QuerySome",
    "TypeAct",
    "perform",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)


@dataclass(frozen=True)
class Judge:
    """a : T – the agent takes this object to be of the type from now on.

    >>> from ttr import Ind
    >>> print(perform(Judge("fido", Ind), Model()))
    fido : Ind   fido : Ind   p = 1
    """

    sit: Object
    type: TypeNode

    def __str__(self) -> str:
        return f"{notation(self.sit)} : {self.type}"


@dataclass(frozen=True)
class JudgeSome:
    """some : T – the agent takes something to be of the type, known or not.

    >>> from ttr import Ind, Pred
    >>> M = Model().given("fido", Ind)
    >>> print(perform(JudgeSome(Pred("dog", Ind)("fido")), M))
    some : dog(fido)   s1 : dog(fido)   p = 1
    """

    type: TypeNode

    def __str__(self) -> str:
        return f"some : {self.type}"


@dataclass(frozen=True)
class Query:
    """a : T? – the agent asks itself whether this object is of the type.

    >>> from ttr import Ind
    >>> print(perform(Query("fido", Ind), Model().given("fido", Ind, 0.8)))
    fido : Ind?   fido : Ind   p = 0.8
    """

    sit: Object
    type: TypeNode

    def __str__(self) -> str:
        return f"{notation(self.sit)} : {self.type}?"


@dataclass(frozen=True)
class QuerySome:
    """some : T? – the agent asks itself what it knows that is of the type.

    >>> from ttr import Ind
    >>> M = Model().given("fido", Ind).given("rex", Ind)
    >>> [it.sit for it in perform(QuerySome(Ind), M).answers]
    ['fido', 'rex']
    """

    type: TypeNode

    def __str__(self) -> str:
        return f"some : {self.type}?"


@dataclass(frozen=True)
class Create:
    """: T! – the agent brings about a new situation of the type.

    >>> from ttr import Ind, Pred
    >>> M = Model().given("fido", Ind)
    >>> print(perform(Create(Pred("bark", Ind)("fido")), M))
    : bark(fido)!   s1 : bark(fido)   p = 1
    """

    type: TypeNode

    def __str__(self) -> str:
        return f": {self.type}!"


TypeAct: TypeAlias = Judge | JudgeSome | Query | QuerySome | Create
"""Any of the type acts.

>>> from ttr import Ind
>>> from ttr.judging.type_acts import Query, TypeAct
>>> isinstance(Query("fido", Ind), TypeAct)
True
"""


@dataclass(frozen=True, eq=False)
class Outcome:
    """The outcome of an act: the judgements that answer it, and the model after it.

    An act of judging or creating is answered by the one judgement made; a query by what
    is judged so far, each object that may be of the type with its degree.

    >>> from ttr import Ind
    >>> made = perform(Judge("fido", Ind), Model())
    >>> print(made.answer, made.model.judge("fido", Ind).holds, sep="; ")
    fido : Ind   p = 1; True
    """

    act: TypeAct
    answers: tuple[Judgement, ...]
    model: Model

    @property
    def answer(self) -> Judgement:
        """The first answer; raises `RefusedError` where there is none."""
        if not self.answers:
            raise RefusedError(f"nothing known answers {self.act}")
        return self.answers[0]

    def __str__(self) -> str:
        told = "; ".join(map(str, self.answers)) or "nothing known"
        return f"{self.act}   {told}"


def perform(act: TypeAct, model: Model) -> Outcome:
    """Perform an act in an agent's model.

    A query changes nothing, and creating never takes what there is already. Raises
    `RefusedError` where what is judged contradicts what the agent knows, or nothing of
    the type can be.

    >>> from ttr import Ind, Pred
    >>> dog, M = Pred("dog", Ind), Model().given("fido", Ind)
    >>> made = perform(Create(dog("fido")), M)
    >>> print(made)
    : dog(fido)!   s1 : dog(fido)   p = 1
    >>> print(perform(QuerySome(dog("fido")), made.model).answer.sit)
    s1
    >>> print(perform(Query("s1", dog("fido")), M).answer.p)
    0
    """
    as_model(model)
    match act:
        case Judge(sit, T):
            sit = freeze(sit)
            extended = model.given(sit, T)
            return Outcome(act, (extended.judge(sit, T),), extended)
        case JudgeSome(T) if known := _known_judgements(T, model):
            return Outcome(act, known[:1], model)
        case JudgeSome(T) | Create(T):
            sit, extended = model.create(T)
            return Outcome(act, (extended.judge(sit, T),), extended)
        case Query(sit, T):
            return Outcome(act, (model.judge(sit, T),), model)
        case QuerySome(T):
            return Outcome(act, _known_judgements(T, model), model)
    raise TTRError(f"an act is one of ttr.judging.type_acts, found {kind_of(act)}")


def _known_judgements(T: TypeNode, model: Model) -> tuple[Judgement, ...]:
    """The judgements of the known objects of a type, in the order of the facts."""
    return tuple(model.judge(sit, T) for sit in model.witnesses(as_type(T)))
