"""Judgements and the derivations behind them."""

import numpy as np
import pytest

from ttr import Basic, Ind, ListOf, Model, Pred, record, rectype, this
from ttr.errors import UndecidedError
from ttr.judging.judgements import degree_if_decided
from ttr.probability import CERTAIN, REFUTED, UNKNOWN, All, AnyOf

A = Basic("A")
dog = Pred("dog", Ind)
Dog = rectype(x=Ind, c=dog(this.x))
Kennel = rectype(owner=Ind, first=Dog, all=ListOf(Dog))

M = Model().given("a", Ind).given("s", dog("a")).given("b", A, 0.5)


def test_the_derivation_as_a_tree():
    fido = record(x="a", c="s")
    r = record(owner="a", first=fido, all=[fido, record(x="a")])
    assert (
        str(M.judge(r, Kennel).why)
        == """\
✗ {all = [{c = s, x = a}, {x = a}], first = {c = s, x = a}, owner = a} : \
[all : list([x : Ind, c : dog(x)]), first : [x : Ind, c : dog(x)], owner : Ind]   \
(field by field)
  ✗ all: [{c = s, x = a}, {x = a}] : list([x : Ind, c : dog(x)])   (each element)
    ✓ {c = s, x = a} : [x : Ind, c : dog(x)]   (field by field)
      ✓ x: a : Ind   (given)
      ✓ c: s : dog(a)   (given)
    ✗ {x = a} : [x : Ind, c : dog(x)]   (field by field)
      ✓ x: a : Ind   (given)
      ✗ c: nothing : dog(a)   (there is no c; s would do)
  ✓ first: {c = s, x = a} : [x : Ind, c : dog(x)]   (field by field)
    ✓ x: a : Ind   (given)
    ✓ c: s : dog(a)   (given)
  ✓ owner: a : Ind   (given)"""
    )


@pytest.mark.parametrize(
    ("r", "path", "rule"),
    [
        (record(x="a"), "c", "there is no c"),
        (record(x="b", c="s"), "x", "nothing says so"),
        (record(c="s"), "x", "there is no x"),
        ("a", "", "it is no record"),
        (record(x="a", c="s"), "", None),
    ],
)
def test_where_and_why_it_fails(r, path, rule):
    why = M.judge(r, Dog).why
    failed = why.failure()
    assert why.path() == path
    assert (failed.rule if failed else None) == rule


def test_a_nested_path():
    r = record(owner="a", first={"x": "a", "c": "t"}, all=[])
    why = M.judge(r, Kennel).why
    assert why.path() == "first.c"
    assert str(why.failure()) == "✗ c: t : dog(a)   (nothing says so; s would do)"


def test_what_is_denied_fails_itself():
    why = M.judge(record(x="a"), rectype(x=~Ind)).why
    assert why.path() == "x"
    assert why.failure().rule == "what is denied"


def test_a_remedy_is_named_for_atoms_only():
    missing = M.judge(record(), rectype(x=ListOf(Ind), y=Ind)).why
    assert [part.because for part in missing.parts] == [
        "there is no x",
        "there is no y; a would do",
    ]


def test_what_is_refuted_fails_before_what_is_uncertain():
    T = rectype(b=A, c=dog("a"))
    assert M.judge(record(b="b", c="t"), T).why.path() == "c"
    assert M.judge(record(b="b", c="s"), T).why.path() == "b"


def test_an_unresolved_path_refutes():
    j = M.judge(record(c="s"), rectype(x=Ind, c=dog(this.x)))
    assert j.holds is False
    assert "the path x leads nowhere: there is no x" in str(j.why)


def test_degrees():
    j = M.judge("b", A)
    assert j.p == (0.5, 0.5)
    assert j.at_least(0.5)
    assert not j.at_least(0.51)
    assert str(j) == "b : A   p = 0.5"
    assert str(j.why) == "p = 0.5 b : A   (given)"
    with pytest.raises(UndecidedError, match=r"b : A   p = 0\.5 is neither"):
        _ = j.holds
    with pytest.raises(TypeError, match=r"ask j\.holds or j\.at_least"):
        bool(j)


def test_equality_is_of_situation_type_and_degree():
    assert M.judge("a", Ind) == Model().given("a", Ind).judge("a", Ind)
    assert M.judge("a", Ind) != M.judge("b", Ind)
    assert M.judge(1, A) != M.judge(True, A)
    assert M.judge(np.zeros(2), A) != M.judge(np.zeros(2), A)
    assert len({M.judge("a", Ind), M.judge("a", Ind)}) == 1
    assert M.judge("a", Ind) != "a : Ind"
    assert "model" not in repr(M.judge("a", Ind))


def test_a_judgement_is_shown_without_its_model():
    shown = repr(Model().given("a", Ind).judge("a", Ind))
    assert shown == "Judgement(sit='a', type=Basic('Ind'), p=Degree(lo=1.0, hi=1.0))"


def test_uncertain_judgements_in_order():
    M = Model().given("a", Ind, 0.5).given("s", dog("a"), 0.9)
    why = M.judge(record(x="a", c="s"), Dog).why
    assert [step.type for step in why.uncertain()] == [Ind, dog("a")]
    assert list(Model().given("a", Ind).judge("a", Ind).why.uncertain()) == []


C, R = CERTAIN, REFUTED


@pytest.mark.parametrize(
    ("how", "degrees", "decided"),
    [
        ("all", [C, C], C),
        ("all", [], C),
        ("all", [C, None], None),
        ("all", [None, R], R),
        ("any", [None, C], C),
        ("any", [], R),
        ("any", [R, R], R),
        ("any", [R, None], None),
        ("none", [None, C], R),
        ("none", [], C),
        ("none", [R, R], C),
        ("none", [R, UNKNOWN], None),
    ],
)
def test_certain_or_refuted_grounds_may_decide_a_claim(how, degrees, decided):
    assert degree_if_decided(how, degrees) == decided


def test_what_is_decided_rests_on_nothing_uncertain():
    T = rectype(x=A, y=ListOf(Ind))
    refuted = M.judge(record(x="b", y="a"), T).why
    certain = M.judge(record(x="b", y=["a"]), rectype(y=ListOf(Ind))).why
    assert [part.p for part in refuted.parts] == [(0.5, 0.5), (0, 0)]
    assert (refuted.event(), certain.event()) == (AnyOf(()), All(()))
