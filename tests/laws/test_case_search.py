"""Laws of the search for cases: what it finds is what going through all cases finds."""

from __future__ import annotations

from itertools import product

import pytest
from generators import types
from hypothesis import given
from hypothesis import strategies as st

from ttr import Basic, Model, Str, consistent, join, meet, rectype, subtype
from ttr.computing.case_analysis import cases
from ttr.computing.case_search import open_cases
from ttr.computing.prover import Prover
from ttr.computing.satisfiability import Search
from ttr.errors import RefusedError
from ttr.signature.axioms import find_exclusion, supertype_set
from ttr.signature.signature import Axiom, Exclusion, Signature
from ttr.types import Join, Meet, Negation, TypeNode

# --- clauses -------------------------------------------------------------------------

variables = st.integers(1, 6)
literals = st.builds(lambda n, so: n if so else -n, variables, st.booleans())
clauses = st.lists(st.lists(literals, max_size=4), max_size=24)


def satisfying_worlds(wanted: list[list[int]]) -> list[frozenset[int]]:
    """By truth table: all the ways to make the clauses true."""
    worlds = product(*[(n, -n) for n in range(1, 7)])
    return [
        frozenset(world)
        for world in worlds
        if all(any(one in world for one in clause) for clause in wanted)
    ]


@given(clauses)
def test_it_finds_what_makes_clauses_true_iff_something_does(wanted):
    found = Search(wanted).solve()
    every = satisfying_worlds(wanted)
    assert (found is not None) == bool(every)
    assert found is None or any(found <= world for world in every)


@given(clauses, clauses)
def test_clauses_may_be_added_between_searches(some, more):
    search = Search(some)
    search.solve()
    for clause in more:
        search.add(clause)
        search.solve()
    assert (search.solve() is not None) == bool(satisfying_worlds(some + more))


@given(clauses)
def test_it_finds_every_way_once_each_is_forbidden(wanted):
    search = Search(wanted)
    left = set(satisfying_worlds(wanted))
    while (found := search.solve()) is not None:
        covered = {world for world in left if found <= world}
        assert covered
        left -= covered
        search.add([-literal for literal in found])
    assert not left


# --- types ---------------------------------------------------------------------------

ATOMS = [Basic(name) for name in "ABCDE"]
BOOLEAN = st.recursive(
    st.sampled_from(ATOMS),
    lambda inner: st.one_of(
        st.builds(Negation, inner),
        st.builds(meet, inner, inner),
        st.builds(join, inner, inner),
        st.builds(join, inner, inner, inner),
    ),
    max_leaves=16,
)
A, B, C, D, E = ATOMS
THEORIES = [
    Signature(),
    Signature(axioms=(Axiom(A, B), Axiom(B, C))),
    Signature(axioms=(Axiom(A, B),), exclusions=(Exclusion(B, D),)),
    Signature(exclusions=(Exclusion(A, A), Exclusion(C, E))),
]
theories = st.sampled_from(THEORIES)


def is_of(world: frozenset[TypeNode], T: TypeNode) -> bool:
    match T:
        case Negation(body):
            return not is_of(world, body)
        case Meet(parts):
            return all(is_of(world, part) for part in parts)
        case Join(parts):
            return any(is_of(world, part) for part in parts)
    return T in world


def worlds(theory: Signature) -> list[frozenset[TypeNode]]:
    """The basic types that one object may be of, by the axioms."""
    found = []
    for case in product((True, False), repeat=len(ATOMS)):
        world = frozenset(T for T, so in zip(ATOMS, case, strict=True) if so)
        if all(supertype_set(T, theory) <= world for T in world) and not any(
            find_exclusion(S, T, theory) for S in world for T in world
        ):
            found.append(world)
    return found


@given(BOOLEAN, BOOLEAN, theories)
def test_joins_meets_and_negations_of_basic_types_are_decided(S, T, theory):
    mine = [world for world in worlds(theory) if is_of(world, S)]
    below = all(is_of(world, T) for world in mine)
    assert subtype(S, T, theory).verdict == ("yes" if below else "no")


@given(st.lists(BOOLEAN, min_size=1, max_size=4), theories)
def test_consistent_is_decided_for_them_too(types, theory):
    T = meet(*types)
    possible = any(is_of(world, T) for world in worlds(theory))
    assert consistent(*types, theory=theory).verdict == ("yes" if possible else "no")
    try:
        sit, M = Model(theory).create(T)
    except RefusedError:
        assert not possible
    else:
        assert possible
        assert M.judge(sit, T).holds


@given(BOOLEAN, BOOLEAN, BOOLEAN, BOOLEAN, theories)
def test_so_are_fields_of_them(S, T, S2, T2, theory):
    """Where the fields do not depend on each other."""
    left, right = rectype(x=S, y=S2), rectype(x=T, y=T2)

    def mine(U: TypeNode) -> list[frozenset[TypeNode]]:
        return [world for world in worlds(theory) if is_of(world, U)]

    below = (
        not mine(S)
        or not mine(S2)
        or (
            all(is_of(world, T) for world in mine(S))
            and all(is_of(world, T2) for world in mine(S2))
        )
    )
    assert subtype(left, right, theory).yes == below
    assert not (below and subtype(left, right, theory).no)


@given(BOOLEAN, theories)
def test_the_open_cases_are_the_type(S, theory):
    """Whatever is of S is of one of them, and whatever is of one of them is of S."""
    found = list(open_cases(S, None, theory, lambda case: False))
    for world in worlds(theory):
        assert is_of(world, S) == any(is_of(world, case) for case in found)


@given(BOOLEAN, BOOLEAN, theories)
def test_the_cases_that_are_left_out_are_below(S, T, theory):
    found = list(open_cases(S, T, theory, lambda case: False))
    for world in worlds(theory):
        if is_of(world, S) and not is_of(world, T):
            assert any(is_of(world, case) for case in found)


@given(types(), types(), types())
def test_for_all_types_it_finds_a_possible_case_iff_there_is_one(S, T, U):
    for whole in (meet(S, join(T, U)), meet(join(S, T), join(T, U), join(~S, U))):
        every = cases(whole)
        if every is None:
            continue
        possible = [one for one in every if not is_impossible(one)]
        found = list(open_cases(whole, None, THEORIES[0], is_impossible))
        assert bool(found) == bool(possible)
        assert not any(map(is_impossible, found))


def is_impossible(case: TypeNode) -> bool:
    return Prover.for_type(case, THEORIES[0]).is_impossible


def test_what_matters_of_a_record_is_also_that_it_is_one():
    record = rectype(x=A @ "a" | B, y=A | B @ "b")
    other = ((C >> D) & ~C) | Str(A @ "a" | B @ "b")
    assert consistent(record | Str(D), other).yes
    assert consistent(record | Str(D), C >> D).no


@pytest.mark.slow
@given(st.lists(BOOLEAN, min_size=6, max_size=9), st.lists(BOOLEAN, min_size=1))
def test_many_at_once_are_decided(meets, joins):
    S, T = meet(*meets), join(*joins)
    mine = [world for world in worlds(THEORIES[0]) if is_of(world, S)]
    below = all(is_of(world, T) for world in mine)
    assert subtype(S, T).verdict == ("yes" if below else "no")
