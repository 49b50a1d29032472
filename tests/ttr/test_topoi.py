"""Topoi: what is expected of a situation, and the arguments that rest on them."""

import pytest

from ttr import (
    Basic,
    Ind,
    Model,
    Pred,
    TTRError,
    fun,
    merge,
    outer,
    record,
    rectype,
    subtype,
    this,
)
from ttr.errors import IllFormedError, RefusedError
from ttr.semantics.topoi import (
    Topos,
    combine_topoi,
    compatible,
    expectation,
    necessary,
    possible,
    topos,
    underpins,
)
from ttr.signature.signature import Axiom, Signature

bird, penguin, fly, swim = (Pred(n, Ind) for n in ("bird", "penguin", "fly", "swim"))
Bird = rectype(x=Ind, c=bird(this.x))
Penguin = rectype(x=Ind, p=penguin(this.x))
birds_fly = topos(fun(r=Bird)(rectype(e=fly(outer.r.x))))
penguins_do_not = topos(fun(r=Penguin)(rectype(e=~fly(outer.r.x))))
penguins_swim = topos(fun(r=Penguin)(rectype(f=swim(outer.r.x))))

tweety = record(x="tweety", c="s1")
M = Model().given("tweety", Ind).given("s1", bird("tweety"))


def test_what_a_topos_lets_expect():
    assert expectation(M, tweety, birds_fly) is rectype(e=fly("tweety"))


def test_of_what_is_no_bird_nothing_is_expected():
    with pytest.raises(RefusedError, match="takes objects of"):
        expectation(M, record(x="fido", c="s1"), birds_fly)


def test_a_topos_is_parametric_content():
    assert birds_fly.content == record(bg=Bird, fg=birds_fly.fg)


def test_necessary_given_a_background():
    assert necessary(M, tweety, rectype(e=fly("tweety")), birds_fly).yes
    assert necessary(M, tweety, rectype(e=swim("tweety")), birds_fly).no
    stone = necessary(M, record(x="stone"), rectype(e=fly("stone")), birds_fly)
    assert stone.no
    assert "not of the background" in stone.why


def test_possible_given_a_background():
    assert possible(M, tweety, rectype(e=swim("tweety")), birds_fly).yes
    assert possible(M, tweety, rectype(e=~fly("tweety")), birds_fly).no


def test_a_background_of_its_own_is_below_that_of_the_topos():
    """s : nec(T, B, t) iff s : B, B is below the background of t, and t(s) below T."""
    singer = rectype(x=Ind, s=Pred("sing", Ind)(this.x))
    singing_bird = merge(Bird, singer)
    here = M.given("s2", Pred("sing", Ind)("tweety"))
    s, flies = record(x="tweety", c="s1", s="s2"), rectype(e=fly("tweety"))
    assert necessary(here, s, flies, birds_fly, background=singing_bird).yes
    assert possible(here, s, flies, birds_fly, background=singing_bird).yes
    for ask in (necessary, possible):
        answer = ask(here, s, flies, birds_fly, background=singer)
        assert answer.no
        assert "is not below the background of the topos" in answer.why
    silent = necessary(M, tweety, flies, birds_fly, background=singing_bird)
    assert silent.no
    assert "not of the background" in silent.why


def test_as_far_as_the_situation_is_of_the_background():
    unsure = Model().given("tweety", Ind).given("s1", bird("tweety"), 0.8)
    answer = necessary(unsure, tweety, rectype(e=fly("tweety")), birds_fly)
    assert answer.p == pytest.approx((0.8, 0.8))
    assert possible(unsure, tweety, rectype(e=~fly("tweety")), birds_fly).no


def test_axioms_help():
    fast = Pred("fast", Ind)
    theory = Signature(axioms=(Axiom(fly(this.a), fast(this.a)),))
    sure = Model(theory).given("tweety", Ind).given("s1", bird("tweety"))
    assert necessary(sure, tweety, rectype(e=fast("tweety")), birds_fly).yes
    assert necessary(M, tweety, rectype(e=fast("tweety")), birds_fly).no


def test_topoi_combine():
    both = combine_topoi(birds_fly, penguins_swim)
    assert both.bg is merge(Bird, Penguin)
    here = M.given("s2", penguin("tweety"))
    follows = expectation(here, record(x="tweety", c="s1", p="s2"), both)
    assert follows is rectype(e=fly("tweety"), f=swim("tweety"))


def test_topoi_that_contradict_each_other_are_both_held():
    assert compatible(birds_fly, penguins_do_not).no
    assert compatible(birds_fly, penguins_swim).yes


def test_what_follows_by_a_combination_follows_by_each():
    both = combine_topoi(birds_fly, penguins_swim)
    here = M.given("s2", penguin("tweety"))
    s = record(x="tweety", c="s1", p="s2")
    for one in (birds_fly, penguins_swim):
        assert subtype(expectation(here, s, both), expectation(here, s, one)).yes


def test_an_enthymeme_and_its_topos():
    """'It is a bird that sings, so it flies': the topos warrants it."""
    sing = Pred("sing", Ind)
    premise = merge(Bird, rectype(x=Ind, s=sing(this.x)))
    said = topos(fun(r=premise)(rectype(e=fly(outer.r.x))))
    assert underpins(birds_fly, said).yes
    assert underpins(penguins_swim, said).no
    other = topos(fun(r=premise)(rectype(e=swim(outer.r.x))))
    assert underpins(birds_fly, other).no


def test_what_is_no_topos():
    for wrong in (Bird, "a", None, fun(x=Ind)(this.x), fun(x=Ind)("a")):
        with pytest.raises(
            IllFormedError, match="a topos is a function from situations"
        ):
            topos(wrong)
    with pytest.raises(IllFormedError, match="paths that lead nowhere"):
        topos(fun(x=Ind)(fly(outer.y)))
    with pytest.raises(IllFormedError, match="a topos is a function from situations"):
        expectation(M, tweety, "fly")
    assert topos(fun(x=Ind)(Basic("A"))).bg is Ind


def test_a_function_will_do_for_a_topos():
    assert topos(birds_fly) is birds_fly
    assert expectation(M, tweety, birds_fly.fg) is rectype(e=fly("tweety"))
    assert necessary(M, tweety, rectype(e=fly("tweety")), birds_fly.fg).yes
    assert underpins(birds_fly.fg, birds_fly.fg).yes
    assert combine_topoi(birds_fly.fg, birds_fly.fg) == birds_fly


@pytest.mark.parametrize("model", [None, Model, "M"])
@pytest.mark.parametrize("ask", [necessary, possible])
def test_a_topos_is_applied_in_a_model(ask, model):
    with pytest.raises(TTRError, match="a model to judge in"):
        ask(model, tweety, Bird, birds_fly)
    with pytest.raises(TTRError, match="a model to judge in"):
        expectation(model, tweety, birds_fly)


@pytest.mark.parametrize("fg", [None, Bird, fun(r=Bird)(outer.r.x)])
def test_a_topos_made_by_hand_is_checked_too(fg):
    with pytest.raises(IllFormedError, match="a topos is a function"):
        Topos(fg)
