"""Laws of function types: what is below what is so of all functions on two things.

The evaluator here is independent of the library: a basic type is a set of things, and a
partial function is of (S → T) if it takes each thing of S, and to a thing of T.
"""

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, consistent, join, meet, subtype
from ttr.types import FunType, Join, Meet, Negation

ATOMS = [Basic(name) for name in "ABC"]
THINGS = range(2)
SETS = [frozenset(x for x in THINGS if bits >> x & 1) for bits in range(4)]
ASSIGNMENTS = [dict(zip(ATOMS, sets, strict=True)) for sets in product(SETS, repeat=3)]
NO_FUNCTION = "no function"
FUNCTIONS = [NO_FUNCTION, *product((None, *THINGS), repeat=len(THINGS))]
AT_ONE = [(y,) for y in (None, *THINGS)]
"""What functions do with the first thing, the others apart."""

plain = st.recursive(
    st.sampled_from(ATOMS),
    lambda inner: st.one_of(
        inner.map(lambda T: ~T),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: meet(*parts)),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: join(*parts)),
    ),
    max_leaves=3,
)
arrows = st.builds(FunType, plain, plain)
compounds = st.recursive(
    arrows,
    lambda inner: st.one_of(
        inner.map(lambda T: ~T),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: meet(*parts)),
        st.lists(inner, min_size=2, max_size=2).map(lambda parts: join(*parts)),
    ),
    max_leaves=3,
)
several = st.lists(arrows, min_size=1, max_size=3).map(lambda parts: meet(*parts))


def is_of(x, T, sets):
    match T:
        case Basic():
            return x in sets[T]
        case Meet(parts):
            return all(is_of(x, part, sets) for part in parts)
        case Join(parts):
            return any(is_of(x, part, sets) for part in parts)
        case Negation(body):
            return not is_of(x, body, sets)
        case FunType(domain, result):
            if x is NO_FUNCTION:
                return False
            taken = [y for one, y in enumerate(x) if is_of(one, domain, sets)]
            return all(y is not None and is_of(y, result, sets) for y in taken)


def is_below(S, T, functions=FUNCTIONS):
    """Is each function of S one of T, whatever things are of the basic types?"""
    return all(
        is_of(f, T, sets)
        for sets in ASSIGNMENTS
        for f in functions
        if is_of(f, S, sets)
    )


@given(several, arrows)
def test_a_meet_of_function_types_below_another_is_decided(S, T):
    """It is by what a function does with one thing."""
    answer = subtype(S, T)
    assert answer.yes == is_below(S, T, AT_ONE), str(answer)


@given(compounds, compounds)
def test_what_is_below_is_so_of_all_functions(S, T):
    """Two things may be too few to refute it; then a counterexample does."""
    answer = subtype(S, T)
    assert not answer.yes or is_below(S, T), str(answer)
    if answer.no:
        against = answer.counter
        assert against.model.judge(against.sit, S).p == (1, 1)
        assert against.p == (0, 0)


@given(compounds)
def test_a_type_that_nothing_is_of_has_no_function(S):
    answer = consistent(S)
    if answer.no:
        assert not any(is_of(f, S, a) for a in ASSIGNMENTS for f in FUNCTIONS)


@given(plain, plain, plain)
def test_unions_and_meets_go_into_function_types(S, T, U):
    assert (S >> U) & (T >> U) <= (S | T) >> U
    assert (S | T) >> U <= (S >> U) & (T >> U)
    assert (S >> T) & (S >> U) <= S >> (T & U)
    assert S >> (T & U) <= (S >> T) & (S >> U)
    assert S >> T <= (S & U) >> (T | U)
