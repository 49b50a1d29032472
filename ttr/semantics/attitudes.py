"""Attitudes: to believe is to have a view that matches a content, whatever its labels.

What an agent has in mind is a type, its view: `m : ltm(a, V)` says that m is a
situation in which a's long-term memory is of V. Then m : believe(a, C) iff V ⊑ C up to
relabelling, and m : know(a, C) iff moreover something is of C; who is given to know
what is not so is refused. So contents are types, not sets of worlds: two that are true
in the same worlds may match different views.
Source: Cooper 2023, on attitudes.

>>> from ttr import Theory
>>> theory = Theory.parse('''
...     basic Ind
...     pred  spy(Ind), ltm(Ind, RecType)
...     object ralph, ortcutt : Ind
...     given m : ltm(ralph, [id0 : Ind, e0 : spy(id0)])
... ''')
>>> M = with_attitudes(Model(theory))
>>> M.judge("m", believe("ralph", theory.parse("[x : Ind, c : spy(x)]"))).holds
True
>>> M.judge("m", believe("ralph", theory.parse("[c : spy(ortcutt)]"))).holds
False
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from ttr.building.conditions import IsBelow
from ttr.building.relabelled_subtyping import subtype_up_to_relabelling
from ttr.judging.models import Model, as_model
from ttr.judging.truth_of_types import IsTrue
from ttr.probability import CERTAIN
from ttr.safety.budgets import spend, within_budget
from ttr.signature.signature import Axiom
from ttr.types.objects import Object, freeze
from ttr.types.path_notation import this
from ttr.types.syntax import Ind, Pred, PType, RecType, TypeNode, as_type

__all__ = [
    "AXIOMS",
    "Match",
    "believe",
    "know",
    "ltm",
    "matches",
    "with_attitudes",
]

ltm = Pred("ltm", Ind, RecType)
"""ltm(a, V): the situations in which a's long-term memory is of V.

>>> from ttr import Ind, rectype
>>> from ttr.semantics.attitudes import ltm
>>> print(ltm("sam", rectype(x=Ind)))
ltm(sam, [x : Ind])
"""

believe = Pred("believe", Ind, RecType)
"""believe(a, C): the situations in which a believes that something is of C.

>>> from ttr import Ind, Model, Pred, rectype, this
>>> from ttr.semantics.attitudes import believe, ltm, with_attitudes
>>> view = rectype(y=Ind, c=Pred("dog", Ind)(this.y))
>>> M = with_attitudes(Model().given("m", ltm("sam", view)))
>>> print(M.true(believe("sam", rectype(x=Ind))))
1
"""

know = Pred("know", Ind, RecType)
"""know(a, C): those in which a believes it, and something is of C.

>>> from ttr import Ind, Model, rectype
>>> from ttr.semantics.attitudes import know, ltm, with_attitudes
>>> M = with_attitudes(Model().given("m", ltm("sam", rectype(x=Ind))))
>>> content = know("sam", rectype(x=Ind))
>>> print(M.true(content), M.given("fido", Ind).true(content))
0 1
"""


def _closed_under_matching(lower: Pred, upper: Pred) -> Axiom:
    """lower(a, V) <: upper(a, C) if V <= C up to relabelling."""
    a, V, C = freeze(this.a), freeze(this.V), freeze(this.C)
    return Axiom(lower(a, V), upper(a, C), (IsBelow(V, C, relabelled=True),))


AXIOMS: tuple[Axiom, ...] = (
    _closed_under_matching(ltm, believe),
    _closed_under_matching(believe, believe),
    _closed_under_matching(know, know),
    Axiom(
        know(this.a, this.C),
        believe(this.a, this.C),
        only=(IsTrue(freeze(this.C)),),
    ),
    Axiom(believe(this.a, this.C), know(this.a, this.C), (IsTrue(freeze(this.C)),)),
)
"""The witness conditions of `believe` and `know`, as a theory may state them.

>>> from ttr.semantics.attitudes import AXIOMS
>>> print(*AXIOMS, sep="; ")
ltm(a, V) <: believe(a, C) if V <= C up to relabelling; believe(a, V) <: believe(a, C)
if V <= C up to relabelling; know(a, V) <: know(a, C) if V <= C up to relabelling;
know(a, C) <: believe(a, C) only if true(C); believe(a, C) <: know(a, C) if true(C)
"""


def with_attitudes(M: Model, /) -> Model:
    """The model in whose theory `believe` and `know` have their witness conditions.

    >>> [str(axiom) for axiom in with_attitudes(Model()).theory.axioms][0]
    'ltm(a, V) <: believe(a, C) if V <= C up to relabelling'
    """
    theory = as_model(M).theory
    axioms = tuple(dict.fromkeys((*theory.axioms, *AXIOMS)))
    return Model.of(replace(M.facts, theory=replace(theory, axioms=axioms)))


@dataclass(frozen=True)
class Match:
    """A view that is below a content: where it is had, the view, and the relabelling.

    `relabelling` are the new names of labels of the content, as `relabel` takes them.

    >>> from ttr import rectype
    >>> M = Model().given("m", ltm("sam", rectype(id0=Ind)))
    >>> [match] = matches(M, "sam", rectype(x=Ind))
    >>> print(match.situation, match.view, match.relabelling)
    m [id0 : Ind] {'x': 'id0'}
    """

    situation: Object
    view: TypeNode
    relabelling: Mapping[str, str]


@within_budget
def matches(
    M: Model, agent: object, content: TypeNode, /, by: Pred = ltm
) -> tuple[Match, ...]:
    """The views that an agent certainly has and that match a content, as they were
    told.

    `by` is the predicate that relates agents to views. Raises `IllFormedError` for a
    content that is no type.

    >>> from ttr import rectype
    >>> M = Model().given("m", ltm("sam", rectype(id0=Ind)))
    >>> matches(M, "sam", rectype(x=Ind))
    (Match(situation='m', view=rectype(id0=Basic('Ind')), relabelling={'x': 'id0'}),)
    """
    agent, content = freeze(agent), as_type(content)
    found: list[tuple[int, Match]] = []
    for T, told in as_model(M).facts.told.items():
        spend()
        if not isinstance(T, PType) or T.pred is not by or T.args[0] != agent:
            continue
        view = as_type(T.args[-1])
        answer = subtype_up_to_relabelling(view, content, M.theory)
        if answer.relabelling is None:
            continue
        for number, sit in told.values():
            if M.judge(sit, T).p == CERTAIN:
                found.append((number, Match(sit, view, answer.relabelling)))
    return tuple([match for _, match in sorted(found, key=lambda pair: pair[0])])
