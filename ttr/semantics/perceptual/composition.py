"""Several meanings at once: a red cup is what is a cup and red by both classifiers."""

from __future__ import annotations

from functools import reduce

from ttr.building.merging import merge
from ttr.errors import TTRError
from ttr.judging.judgements import Judgement
from ttr.judging.models import Model
from ttr.semantics.argument_checks import as_tuple
from ttr.semantics.perceptual.meanings import Meaning, as_meaning
from ttr.types.objects import Record
from ttr.types.syntax import TypeNode


def combined_type(*meanings: Meaning) -> TypeNode:
    """The merge of the types of some meanings: in its situations all the words hold.

    >>> from ttr import Ind, Pred, fun, outer, record, rectype
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, meaning
    >>> def word(name, percept):
    ...     bg = rectype({"x": Ind, percept: RealVector})
    ...     interp = fun(r=bg)(rectype(c=Pred(name, Ind)(outer.r.x)))
    ...     return meaning(interp, Perceptron(), record(w=[1], t=0.5), of=percept)
    >>> red, cup = word("red", "colour"), word("cup", "shape")
    >>> print(combined_type(red, cup))  # doctest: +NORMALIZE_WHITESPACE
    [colour : RealVector, shape : RealVector, x : Ind, c : cup(x) /\\ red(x)]
    """
    if not meanings:
        raise TTRError("a combined type is that of one meaning or more, found none")
    types: list[TypeNode] = [as_meaning(it).type for it in meanings]
    return reduce(merge, types)


def in_model(M: Model, meanings: tuple[Meaning, ...], *situations: Record) -> Model:
    """The model with all of these meanings in it; see `Meaning.in_model`.

    >>> from ttr import Ind, Model, Pred, fun, outer, record, rectype
    >>> from ttr.semantics.perceptual import Perceptron, RealVector, meaning
    >>> interp = fun(r=rectype(x=Ind, pos=RealVector))(
    ...     rectype(c=Pred("right", Ind)(outer.r.x))
    ... )
    >>> right = meaning(interp, Perceptron(), record(w=[1, 0], t=0.5), of="pos")
    >>> s = record(x="o1", pos=[0.9, 0.1])
    >>> M = in_model(Model().given("o1", Ind), (right,), s)
    >>> print(M.perceive(s, right.type))
    {c = e1, pos = [0.9, 0.1], x = o1} : [pos : RealVector, x : Ind, c : right(x)]   p =
    1
    """
    for it in as_tuple(meanings, "meanings"):
        M = as_meaning(it).in_model(M, *situations)
    return M


def perceive(M: Model, r: Record, *meanings: Meaning) -> Judgement:
    """Judge whether all of the words hold in a situation.

    Each classifier judges its percept; distinct judgements are independent.

    >>> from ttr import Ind, Model, Pred, fun, outer, record, rectype
    >>> from ttr.semantics.perceptual import GradedPerceptron, RealVector, meaning
    >>> interp = fun(r=rectype(x=Ind, pos=RealVector))(
    ...     rectype(c=Pred("right", Ind)(outer.r.x))
    ... )
    >>> right = meaning(interp, GradedPerceptron(), record(w=[1, 0], t=0.5), of="pos")
    >>> s = record(x="o1", pos=[0.7, 0.1])
    >>> print(perceive(Model().given("o1", Ind), s, right).p)
    0.8808
    """
    return in_model(M, meanings, r).perceive(r, combined_type(*meanings))
