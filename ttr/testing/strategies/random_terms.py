"""Strategies for types and objects of a theory."""

from __future__ import annotations

from hypothesis import strategies as st

from ttr.errors import TTRError
from ttr.testing.strategies import random_types
from ttr.testing.strategies.random_types import Words
from ttr.theories.theory import Theory
from ttr.types.objects import Object
from ttr.types.syntax import RecordType, TypeNode

DEPTH = 3
"""How deep types and objects nest at most by default."""


def types(
    theory: Theory | None = None, *, depth: int = DEPTH
) -> st.SearchStrategy[TypeNode]:
    """Well-formed types of every constructor, with the names that a theory declares.

    Without a theory these are the basic types A, B and C, and predicates p, q and r of
    several arities. Constructors nest at most `depth` deep. Raises `TTRError` for what
    is no theory or no depth.

    >>> from hypothesis import find
    >>> print(find(types(), lambda T: isinstance(T, RecordType) and len(T.labels) == 2))
    [x : A, y : A]
    """
    return random_types.types(Words.of(theory), (), _check_depth(depth))


def record_types(
    theory: Theory | None = None, *, depth: int = DEPTH
) -> st.SearchStrategy[RecordType]:
    """Well-formed record types, drawn as `types` does.

    >>> from hypothesis import find
    >>> print(find(record_types(), lambda T: len(T.labels) == 2))
    [x : A, y : A]
    """
    return random_types.record_types(Words.of(theory), (), _check_depth(depth))


def objects(
    theory: Theory | None = None, *, depth: int = DEPTH
) -> st.SearchStrategy[Object]:
    """Objects of every kind that has a notation, with the names of a theory.

    They are names, numbers, records, lists, sets, strings of events, functions, types.

    >>> from hypothesis import find
    >>> find(objects(), lambda it: isinstance(it, tuple) and len(it) == 2)
    ('a', 'a')
    """
    return random_types.objects(Words.of(theory), (), _check_depth(depth))


def _check_depth(depth: object) -> int:
    if type(depth) is not int or depth < 0:
        raise TTRError(f"a depth is a whole number, 0 or more, found {depth!r}")
    return depth
