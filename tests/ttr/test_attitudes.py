"""Attitudes: believing and knowing in Python, and what the account predicts."""

import pytest

from ttr import (
    Ind,
    Model,
    Pred,
    RecType,
    Theory,
    outer,
    rectype,
    relabel,
    subtype,
    this,
)
from ttr.errors import IllFormedError, RefusedError
from ttr.semantics.attitudes import (
    AXIOMS,
    believe,
    know,
    ltm,
    matches,
    with_attitudes,
)

spy, man, named = Pred("spy", Ind), Pred("man", Ind), Pred("named", Ind, Ind)
VIEW = rectype(s=Ind, e=spy(this.s), o=Ind @ "ortcutt", m=man(this.o))
SPY = rectype(x=Ind, c=spy(this.x))


def model(*views):
    M = Model()
    for number, (agent, view) in enumerate(views, 1):
        M = M.given(f"m{number}", ltm(agent, view))
    return with_attitudes(M)


def test_believing_is_having_a_view_below_the_content():
    M = model(("ralph", VIEW))
    assert M.judge("m1", believe("ralph", SPY)).holds
    assert not M.judge("m1", believe("ralph", rectype(c=spy("ortcutt")))).holds
    assert not M.judge("m1", believe("sam", SPY)).holds
    assert not M.judge("m2", believe("ralph", SPY)).holds
    assert M.true(believe("ralph", SPY)) == (1, 1)


def test_believing_does_not_ask_how_labels_are_called():
    M = model(("ralph", VIEW))
    for names in ({"x": "c", "c": "x"}, {"x": "y"}, {"c": "o"}):
        content = relabel(SPY, names)
        assert M.judge("m1", believe("ralph", content)).holds
        assert subtype(believe("ralph", SPY), believe("ralph", content), M.theory).yes


def test_knowing_is_believing_what_is_so():
    M = model(("ralph", VIEW))
    assert not M.judge("m1", know("ralph", SPY)).holds
    M = M.given("kim", Ind).given("s", spy("kim"))
    assert M.judge("m1", know("ralph", SPY)).holds
    assert M.true(SPY) == (1, 1)
    assert not M.judge("m1", know("ralph", rectype(x=Ind, c=man(this.x)))).holds


def test_nobody_is_given_to_know_what_is_not_so():
    M = model()
    with pytest.raises(RefusedError, match=r"only if true\(C\): P\(.*\) = 0"):
        M.given("k", know("ralph", SPY))
    M = M.given("kim", Ind).given("s", spy("kim")).given("k", know("ralph", SPY))
    assert M.judge("k", believe("ralph", SPY)).holds
    assert M.true(SPY) == (1, 1)


def test_who_is_made_up_to_know_knows_what_is_so():
    sit, M = model().create(know("ralph", SPY))
    assert M.judge(sit, know("ralph", rectype(y=Ind))).holds
    assert M.true(SPY) == (1, 1)


def test_what_is_known_is_believed_and_not_the_other_way_round():
    theory = with_attitudes(Model()).theory
    assert subtype(know("ralph", SPY), believe("ralph", SPY), theory).yes
    assert subtype(know("ralph", SPY), believe("ralph", rectype(x=Ind)), theory).yes
    assert not subtype(believe("ralph", SPY), know("ralph", SPY), theory).yes
    assert subtype(believe("ralph", rectype(x=Ind)), believe("ralph", SPY), theory).no


def test_a_theory_can_declare_the_same():
    theory = Theory.parse("""
        basic Ind
        pred  ltm(Ind, RecType), believe(Ind, RecType), know(Ind, RecType)
        ltm(a, V) <: believe(a, C) if V <= C up to relabelling
        believe(a, V) <: believe(a, C) if V <= C up to relabelling
        know(a, V) <: know(a, C) if V <= C up to relabelling
        know(a, C) <: believe(a, C) only if true(C)
        believe(a, C) <: know(a, C) if true(C)
    """)
    assert theory.axioms == AXIOMS
    assert theory.believe is believe
    assert with_attitudes(Model(theory)).theory.axioms == AXIOMS


def test_a_match_has_the_view_and_the_relabelling():
    narrow = rectype(i=Ind, e=spy(this.i))
    M = model(("ralph", VIEW), ("sam", narrow), ("ralph", narrow))
    first, second = matches(M, "ralph", SPY)
    assert (first.situation, first.view) == ("m1", VIEW)
    assert first.relabelling == {"x": "s", "c": "e"}
    assert (second.situation, second.view) == ("m3", narrow)
    assert subtype(narrow, relabel(SPY, second.relabelling)).yes
    assert matches(M, "ralph", rectype(c=spy("ortcutt"))) == ()
    assert matches(M, "kim", SPY) == ()


def test_an_uncertain_view_is_no_match_yet():
    M = with_attitudes(Model().given("m", ltm("sam", VIEW), 0.6))
    assert matches(M, "sam", SPY) == ()
    assert M.judge("m", believe("sam", SPY)).p == (0.6, 1)


def test_other_attitudes_have_views_of_their_own():
    want = Pred("desires", Ind, RecType)
    M = Model().given("m", want("sam", VIEW))
    (match,) = matches(M, "sam", SPY, by=want)
    assert match.relabelling == {"x": "s", "c": "e"}
    assert matches(M, "sam", SPY) == ()


def test_de_re_is_a_content_about_the_thing():
    M = model(("ralph", VIEW)).given("ortcutt", Ind).given("kim", Ind)
    de_re = rectype(x=Ind, b=believe("ralph", rectype(c=man(outer.x))))
    assert [r.x for r in M.witnesses(de_re)] == ["ortcutt"]
    assert (
        M.witnesses(rectype(x=Ind, b=believe("ralph", rectype(c=spy(outer.x))))) == ()
    )
    manifest = rectype(x=Ind @ "ortcutt", c=man(this.x))
    assert M.judge("m1", believe("ralph", manifest)).holds
    assert subtype(
        believe("ralph", manifest), believe("ralph", rectype(x=Ind)), M.theory
    ).yes


def test_an_impossible_view_believes_everything():
    M = model(("sam", rectype(x=Ind @ "a", y=Ind @ "b" & Ind @ "c")))
    assert M.judge("m1", believe("sam", SPY)).holds


def test_a_view_of_nothing_believes_nothing_but_that_there_is_something():
    M = model(("sam", rectype()))
    assert M.judge("m1", believe("sam", rectype())).holds
    assert not M.judge("m1", believe("sam", rectype(x=Ind))).holds


def test_what_is_no_type_is_refused():
    with pytest.raises(IllFormedError):
        matches(Model(), "sam", "content")
