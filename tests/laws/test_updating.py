"""Laws of updating: what is certain, what a rule makes of a state."""

import numpy as np
from generators import A, B, models, objects, record_types, records, types
from hypothesis import assume, given
from hypothesis import strategies as st

from ttr import (
    Basic,
    Ind,
    ListOf,
    Model,
    Pred,
    TTRError,
    amerge,
    fun,
    meet,
    merge,
    record,
    rectype,
    this,
)
from ttr.judging.certainty import is_certain, is_certain_given
from ttr.probability import CERTAIN
from ttr.signature.signature import Axiom, Signature
from ttr.types import Application, NonEmpty


@given(types(), objects(), models())
def test_certainty_is_that_of_the_derivation(T, a, M):
    assert is_certain(M.facts, a, T) == (M.judge(a, T).p == CERTAIN)


@given(record_types(), records(), models())
def test_certainty_of_records_is_that_of_the_derivation(T, r, M):
    assert is_certain(M.facts, r, T) == (M.judge(r, T).p == CERTAIN)


@given(types(), types(), models())
def test_what_is_known_need_not_be_judged_again(T, known, M):
    try:
        a, M = M.create(known)
    except TTRError:
        assume(False)
    for asked in (T, known, meet(T, known), ListOf(T), NonEmpty(known)):
        for sit, given_ in ((a, known), ((a, a), ListOf(known)), ((), ListOf(known))):
            found = is_certain_given(M.facts, sit, asked, given_)
            assert found == is_certain(M.facts, sit, asked)


@given(record_types(), record_types(), models())
def test_what_is_known_of_records_need_not_be_judged_again(T, known, M):
    try:
        r, M = M.create(known)
    except TTRError:
        assume(False)
    for asked in (T, known, merge(T, known), amerge(known, T)):
        found = is_certain_given(M.facts, r, asked, known)
        assert found == is_certain(M.facts, r, asked)


@given(record_types(), models(), st.sampled_from([0.0, 0.5, 1.0]), st.data())
def test_what_was_told_anew_is_judged_anew(T, M, p, data):
    try:
        r, M = M.create(T)
    except TTRError:
        assume(False)
    assert is_certain(M.facts, r, T)
    told = [(r[label], F) for label, F in T.fields if isinstance(F, Basic)]
    assume(told)
    try:
        M = M.given(*data.draw(st.sampled_from(told)), p)
    except TTRError:
        assume(False)
    assert is_certain(M.facts, r, T) == (M.judge(r, T).p == CERTAIN)


def test_other_witness_functions_judge_anew():
    A = Basic("A")
    r, T = record(x="a"), rectype(x=A)
    short = Model().witnessed(A, by=lambda a: len(a) == 1)
    assert is_certain(short.facts, r, T)
    long = short.witnessed(A, by=lambda a: len(a) > 1)
    assert not is_certain(long.facts, r, T)
    assert not is_certain(short.given("a", A, 0.5).facts, r, T)
    assert is_certain(short.facts, r, T)


def test_an_axiom_makes_a_part_of_a_join_certain():
    dog, puppy, cat = (Pred(name, Ind) for name in ("dog", "puppy", "cat"))
    T = dog("rex") | cat("rex")
    told = Model().given("s", puppy("rex"))
    assert not is_certain(told.facts, "s", T)
    theory = Signature(axioms=(Axiom(puppy(this.x), dog(this.x)),))
    known = Model(theory).given("s", puppy("rex"))
    assert is_certain(known.facts, "s", T)
    assert is_certain(known.given("s", A).facts, "s", T)
    assert not is_certain(told.facts, "s", T)


def test_what_is_set_to_what_has_no_value_is_not_certain():
    of_B = Application(fun(y=B)(this.y), "a")
    M = Model().given("a", A)
    assert not is_certain_given(M.facts, "a", A @ of_B, A)
    assert is_certain_given(M.given("a", B).facts, "a", A @ of_B, A)
    assert not is_certain_given(M.given("b", B).facts, "b", A @ of_B, A)


def test_what_a_field_is_set_to_is_compared_by_value():
    pair = ("a", "b")
    r, T = record(x=["a", "b"]), rectype(x=ListOf(A) @ pair)
    M = Model().given("a", A).given("b", A)
    assert is_certain_given(M.facts, r, T, rectype(x=ListOf(A)))
    for sit, other in (("a", "b"), ("b", "a")):
        assert not is_certain_given(M.facts, sit, A @ other, A)


def test_a_part_of_a_join_is_found_at_a_path():
    ask, tell = Pred("ask", Ind), Pred("tell", Ind)
    T = rectype(m=rectype(e=ask("a"))) | rectype(m=rectype(e=tell("a")))
    facts = Model().given("s", tell("a")).facts
    assert is_certain(facts, record(m={"e": "s"}), T)
    for other in (record(m={"e": "t"}), record(m={}), record(m="s"), record(), "s"):
        assert not is_certain(facts, other, T)


def test_what_was_changed_in_place_is_judged_anew():
    r, T = record(x=np.zeros(1)), rectype(x=A)
    facts = Model().witnessed(A, by=lambda x: bool(x[0] == 0)).facts
    assert is_certain(facts, r, T)
    r.x[0] = 1
    assert not is_certain(facts, r, T)
