"""Type acts: what an agent does with a type, and what comes of it."""

import pytest

from ttr import Ind, Model, Pred, TTRError, record, rectype
from ttr.errors import RefusedError
from ttr.judging.type_acts import Create, Judge, JudgeSome, Query, QuerySome, perform
from ttr.probability import UNKNOWN

dog, cat = Pred("dog", Ind), Pred("cat", Ind)
M = Model().given("fido", Ind).given("s1", dog("fido")).given("s2", dog("fido"), 0.5)


def test_judging_is_remembered():
    after = perform(Judge("s3", dog("fido")), M)
    assert after.answer.holds is True
    assert after.model.judge("s3", dog("fido")).holds is True
    assert M.judge("s3", dog("fido")).p == UNKNOWN


def test_what_contradicts_is_refused():
    sees = M.witnessed(cat, by=lambda x: False)
    with pytest.raises(RefusedError, match="is refused by the witness function of cat"):
        perform(Judge("s4", cat("fido")), sees)


def test_judging_that_something_is_takes_what_is_known():
    known = perform(JudgeSome(dog("fido")), M)
    assert (known.answer.sit, known.model) == ("s1", M)
    made = perform(JudgeSome(cat("fido")), M)
    assert made.model.judge(made.answer.sit, cat("fido")).holds is True


def test_queries_change_nothing():
    asked = perform(Query("s2", dog("fido")), M)
    assert (asked.answer.p, asked.model) == ((0.5, 0.5), M)
    found = perform(QuerySome(dog("fido")), M)
    assert [answer.sit for answer in found.answers] == ["s1"]
    assert found.model is M
    nothing = perform(QuerySome(cat("fido")), M)
    with pytest.raises(
        RefusedError, match=r"nothing known answers some : cat\(fido\)\?"
    ):
        _ = nothing.answer


def test_creating_makes_something_new():
    made = perform(Create(dog("fido")), M)
    assert made.answer.sit not in ("s1", "s2")
    whole = perform(Create(rectype(e=dog("fido"))), made.model)
    assert whole.answer.sit != record(e=made.answer.sit)


def test_acts_print_as_in_the_literature():
    acts = [Judge("s", Ind), JudgeSome(Ind), Query("s", Ind), QuerySome(Ind)]
    assert [*map(str, acts), str(Create(Ind))] == [
        "s : Ind",
        "some : Ind",
        "s : Ind?",
        "some : Ind?",
        ": Ind!",
    ]


def test_what_is_no_act():
    with pytest.raises(
        TTRError, match=r"an act is one of ttr\.judging\.type_acts, found"
    ):
        perform("bark", M)


def test_outcomes_print_what_was_answered():
    found = perform(QuerySome(dog("fido")), M)
    assert str(found) == "some : dog(fido)?   s1 : dog(fido)   p = 1"
    nothing = perform(QuerySome(cat("fido")), M)
    assert str(nothing) == "some : cat(fido)?   nothing known"
