"""Strategies for models of a theory."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from ttr.errors import RefusedError, TTRError
from ttr.judging.models import Model
from ttr.testing.strategies import random_types
from ttr.testing.strategies.random_types import Words
from ttr.theories.theory import Theory
from ttr.types.objects import Object
from ttr.types.syntax import Basic, PType, TypeNode


def models(
    theory: Theory | None = None, *, degrees: st.SearchStrategy[Any] | None = None
) -> st.SearchStrategy[Model]:
    r"""Models of a theory with random facts about a few objects.

    `degrees` draws their probabilities, as numbers or intervals; by default all facts
    are certain. Raises `TTRError` if `degrees` is no strategy.

    >>> from hypothesis import find
    >>> from ttr import Theory
    >>> pets = Theory.parse("basic Ind\npred dog(Ind)")
    >>> M = find(models(pets), lambda M: M.witnesses(pets.Ind))
    >>> print(M.judge(*M.witnesses(pets.Ind)[0:1], pets.Ind).p)
    1
    """
    if degrees is None:
        degrees = st.just(1.0)
    if not isinstance(degrees, st.SearchStrategy):
        raise TTRError(
            f"degrees are drawn by a strategy, as in st.floats(0, 1), found {degrees!r}"
        )
    return facts(Words.of(theory), theory, degrees)


@st.composite
def facts(
    draw: st.DrawFn,
    words: Words,
    theory: Theory | None,
    degrees: st.SearchStrategy[Any],
) -> Model:
    """Models of the theory with random facts about the words' names."""
    M = Model(theory)
    for T in words.basics:
        for name in draw(st.lists(st.sampled_from(words.names), unique=True)):
            M = _with_fact(M, name, T, draw(degrees))
    facts = st.tuples(st.sampled_from(words.names), random_types.ptypes(words, (), 0))
    for sit, ptype in draw(st.lists(facts, max_size=8)):
        M = _with_fact(M, sit, ptype, draw(degrees))
    return M


def _with_fact(M: Model, sit: Object, T: TypeNode, degree: object) -> Model:
    """The model with the fact, or without it if an axiom excludes it."""
    if not isinstance(T, Basic | PType):
        return M
    try:
        return M.given(sit, T, degree)
    except RefusedError:
        return M
