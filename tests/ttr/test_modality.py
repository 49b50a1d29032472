"""Modal systems: possibilities apart, necessity, existence, box and diamond types."""

import numpy as np
import pytest

from ttr import Basic, Ind, ListOf, Model, Pred, Theory, fun, record, rectype, this
from ttr.errors import IllFormedError, RefusedError, UndecidedError, UnsupportedError
from ttr.judging import proposition
from ttr.judging.propositions import probabilistic
from ttr.semantics.modality import (
    ModalSystem,
    modal_system,
    nec,
    necessarily,
    poss,
    possibly,
)
from ttr.signature.signature import Axiom, Signature

A, B, C = Basic("A"), Basic("B"), Basic("C")
dog, hug = Pred("dog", Ind), Pred("hug", Ind, Ind)
Dog = rectype(x=Ind, c=dog(this.x))


@pytest.fixture
def w() -> ModalSystem:
    """a is of A in both; of B in the first only; b is of A in the second only."""
    first = Model().given("a", A).given("a", B)
    second = Model().given("a", A).given("b", A)
    return modal_system(w1=first, w2=second)


# --- possibilities are apart ---


@pytest.mark.parametrize(
    ("sit", "T"),
    [
        ("c", A),
        ("c", A & B),
        (record(x="c", c="s1"), Dog),
        (record(x="c"), rectype(x=A & B)),
        (["c", "d"], ListOf(A)),
    ],
)
def test_what_is_told_in_one_possibility_is_so_in_no_other(w, sit, T):
    after = w.given("w1", sit, T)
    assert after.judge("w1", sit, T).holds is True
    assert after.judge("w2", sit, T).holds is False
    assert w.judge("w1", sit, T).holds is False


def test_one_record_type_is_judged_by_each_possibility_for_itself(w):
    w = w.given("w1", record(x="fido", c="s1"), Dog)
    w = w.given("w2", record(x="sam", c="s2"), Dog)
    found = {name: [str(r) for r in w[name].witnesses(Dog)] for name in w.names}
    assert found == {"w1": ["{c = s1, x = fido}"], "w2": ["{c = s2, x = sam}"]}


def test_how_it_is_shown(w):
    assert repr(w) == "<ModalSystem of w1, w2>"


def test_types_are_the_same_values_in_all_possibilities(w):
    assert w["w1"].judge("a", A).type is w["w2"].judge("a", A).type


# --- necessary and possible ---


def test_necessary_and_possible(w):
    notion = w.restrictive
    assert notion.necessary(A).yes
    assert notion.necessary(B).no
    assert notion.necessary(B).possibility == "w2"
    assert notion.possible(B).yes
    assert notion.possible(B).possibility == "w1"
    assert notion.possible(C).no


def test_an_answer_says_where(w):
    assert str(w.restrictive.necessary(A)) == "yes: something is of A in w1 and w2"
    assert str(w.restrictive.necessary(B)) == "no: nothing is of B in w2"
    assert str(w.restrictive.possible(C)) == "no: nothing is of C in w1 or w2"


def test_different_witnesses_in_each_possibility_will_do(w):
    w = w.given("w2", "b", B)
    assert w.restrictive.necessary(B).yes
    assert w.restrictive.necessary(proposition("a", B)).no
    assert w.restrictive.possible(proposition("a", B)).yes


def test_a_meet_of_record_types_has_the_records_of_both(w):
    assert w.restrictive.necessary(rectype(x=A) & rectype(y=A)).yes


def test_open_types_leave_it_unknown():
    theory = Signature(opened=frozenset([B]))
    w = modal_system(w1=Model(theory).given("a", B), w2=Model(theory))
    necessary = w.restrictive.necessary(B)
    assert necessary.unknown
    assert necessary.p == (0, 1)
    assert necessary.possibility == "w2"
    assert "w2" in necessary.why
    assert w.restrictive.possible(B).yes


def test_degrees_are_bounds_whatever_depends_on_what(w):
    w = w.given("w1", "c", B, 0.9).given("w2", "c", B, 0.7)
    said = proposition("c", B)
    assert w.restrictive.necessary(said).p == pytest.approx((0.6, 0.7))
    assert w.restrictive.possible(said).p == pytest.approx((0.9, 1.0))


def test_a_proposition_with_a_probability_is_true_where_that_is_the_probability(w):
    w = w.given("w1", "c", B, 0.9).given("w2", "c", B, 0.7)
    assert w.restrictive.necessary(probabilistic("c", B, (0.7, 0.9))).yes
    assert w.restrictive.possible(probabilistic("c", B, 0.9)).yes
    assert w.restrictive.necessary(probabilistic("c", B, 0.9)).no


def test_an_answer_is_no_truth_value(w):
    with pytest.raises(TypeError, match=r"ask for \.yes or \.no"):
        bool(w.restrictive.necessary(A))


# --- subtyping and equivalence ---


def test_subtyping_in_all_possibilities(w):
    assert w.restrictive.subtype(B, A).yes
    answer = w.restrictive.subtype(A, B)
    assert answer.no
    assert answer.possibility == "w2"
    assert (answer.counter.sit, answer.counter.holds) == ("a", False)
    assert not B <= A


def test_equivalence(w):
    same = w.given("w2", "a", B).given("w2", "b", B)
    assert w.restrictive.equivalent(A, B).no
    assert same.restrictive.equivalent(A, B).yes
    assert w.restrictive.equivalent(A & B, B).yes


def test_equivalence_by_an_axiom():
    theory = Signature(axioms=(Axiom(A, B), Axiom(B, A)), opened=frozenset([A, B]))
    w = modal_system(w1=Model(theory), w2=Model(theory))
    assert w.restrictive.equivalent(A, B).yes


def test_more_may_be_of_an_open_type():
    theory = Signature(opened=frozenset([A]))
    w = modal_system(only=Model(theory).given("a", A).given("a", B))
    assert w.restrictive.subtype(A, B).unknown
    assert w.restrictive.subtype(B, A).yes


def test_more_may_be_of_a_type_by_an_axiom():
    theory = Signature(axioms=(Axiom(C, A),), opened=frozenset([C]))
    w = modal_system(only=Model(theory).given("a", A).given("a", B))
    assert w.restrictive.subtype(A, B).unknown


def test_a_perhaps_in_one_possibility(w):
    w = w.given("w2", "a", B, 0.5).given("w2", "b", B)
    answer = w.restrictive.subtype(A, B)
    assert answer.unknown
    assert answer.counter.p == (0.5, 0.5)


def test_record_types_with_the_same_records():
    M = Model().given("a", A).given("b", A).given("a", B).given("b", B)
    w = modal_system(w1=M, w2=M.given("c", B))
    assert w.restrictive.subtype(rectype(x=A), rectype(x=B)).yes
    answer = w.restrictive.subtype(rectype(x=B), rectype(x=A))
    assert str(answer.counter.sit) == "{x = c}"


def test_records_with_further_fields_are_not_listed():
    """{x = a} is not of [y : A], but {x = a, y = a} is: of [x : A] are both."""
    w = modal_system(w1=Model().given("a", A))
    assert w.restrictive.subtype(rectype(x=A), ~rectype(y=A)).unknown
    assert w.restrictive.subtype(rectype(x=A), rectype(y=A)).no


def test_what_cannot_be_listed(w):
    answer = w.restrictive.subtype(ListOf(A), ListOf(B))
    assert answer.unknown
    assert "cannot be listed" in answer.why


# --- types that do not exist everywhere ---


def test_the_two_notions(w):
    w = w.without("w2", B)
    assert w.has("w1", B)
    assert not w.has("w2", rectype(x=B))
    assert str(w.restrictive.necessary(B)) == "no: B does not exist in w2"
    assert w.inclusive.necessary(B).yes
    assert w.restrictive.subtype(A, B).no
    assert w.inclusive.subtype(A, B).yes
    assert w.restrictive.possible(B).no
    assert w.inclusive.possible(B).yes


def test_without_a_predicate_its_ptypes_do_not_exist(w):
    w = w.without("w1", dog)
    assert not w.has("w1", Dog)
    assert not w.has("w1", proposition("s", dog("a")))
    assert w.has("w1", hug("a", "b"))
    with pytest.raises(IllFormedError, match=r"dog\(a\) does not exist in w1"):
        w.judge("w1", "s", dog("a"))
    with pytest.raises(IllFormedError, match="does not exist in w1"):
        w.given("w1", "s", dog("a"))


def test_a_type_that_exists_nowhere(w):
    w = w.without("w1", B).without("w2", B)
    with pytest.raises(IllFormedError, match="no possibility has B"):
        w.inclusive.necessary(B)
    assert w.restrictive.possible(B).no


# --- box and diamond types ---


def test_box_and_diamond_types_are_judged_of_a_situation(w):
    assert w.judge("w1", "s", necessarily(A)).holds is True
    assert w.judge("w1", "s", necessarily(B)).holds is False
    assert w.judge("w2", "s", possibly(B)).holds is True
    assert w.judge("w2", "s", ~necessarily(B) & possibly(B)).holds is True


def test_box_and_diamond_types_in_a_record_type(w):
    asleep = Pred("asleep", A)
    T = rectype(x=A, c=possibly(asleep(this.x)))
    w = w.given("w1", "s1", asleep("b"))
    assert w.judge("w2", record(x="b", c="s"), T).holds is True
    assert w.judge("w2", record(x="a", c="s"), T).holds is False


def test_necessity_of_what_is_possible(w):
    assert w.restrictive.necessary(possibly(B)).yes
    assert w.restrictive.possible(necessarily(B)).no
    assert w.restrictive.necessary(~necessarily(B) & possibly(B)).yes
    assert w.restrictive.necessary(necessarily(necessarily(A))).yes


def test_what_a_box_is_about_is_worked_out_first(w):
    f = fun(x=A)(B @ this.x)
    assert w.judge("w1", "s", possibly(f("a"))).holds is True
    assert w.judge("w1", "s", possibly(f("zz"))).holds is False


def test_a_box_inside_another_type_is_asked_of_a_situation(w):
    with pytest.raises(UnsupportedError, match="are asked of the system"):
        w.restrictive.necessary(rectype(c=necessarily(A)))
    assert w.restrictive.subtype(A & necessarily(A), B).unknown


def test_they_are_written_as_predicates_of_types():
    theory = Theory.parse("basic A\npred nec(Type), poss(Type)")
    assert theory.parse("nec(poss(A))") is necessarily(possibly(A))
    assert (theory.nec, theory.poss) == (nec, poss)


def test_of_what_is_unknown_the_box_is_unknown():
    theory = Signature(opened=frozenset([B]))
    w = modal_system(w1=Model(theory))
    with pytest.raises(UndecidedError):
        _ = w.judge("w1", "s", necessarily(B)).holds


# --- wrong input ---


def test_what_is_no_system():
    with pytest.raises(IllFormedError, match="at least one possibility"):
        modal_system()
    with pytest.raises(
        IllFormedError, match="the possibility w must be a model, found 3"
    ):
        modal_system(w=3)
    with pytest.raises(IllFormedError, match="w1 and w2 are of different theories"):
        modal_system(w1=Model(), w2=Model(Signature(opened=frozenset([A]))))


def test_what_is_no_possibility(w):
    for ask in (
        lambda: w["w3"],
        lambda: w.given("w3", "a", A),
        lambda: w.judge("w3", "a", A),
        lambda: w.without("w3", A),
        lambda: w.has("w3", A),
    ):
        with pytest.raises(IllFormedError, match="no possibility w3, only w1, w2"):
            ask()


def test_what_is_no_head_or_type(w):
    with pytest.raises(IllFormedError, match="lacks is a basic type or a predicate"):
        w.without("w1", A & B)
    with pytest.raises(IllFormedError, match="a proposition is a type or a record"):
        w.restrictive.necessary("a")
    with pytest.raises(IllFormedError, match="expected a type"):
        w.restrictive.subtype(A, "a")


def test_what_cannot_be_told_changes_nothing(w):
    before = w.judge("w1", "a", A).p
    with pytest.raises(RefusedError):
        w.given("w1", "a", A & ~A)
    assert w.judge("w1", "a", A).p == before


@pytest.mark.parametrize("name", [None, 3, [], np.array([1, 2])])
def test_a_possibility_has_a_name(name):
    w = modal_system(w1=Model())
    with pytest.raises(IllFormedError, match="there is no possibility"):
        w[name]
    with pytest.raises(IllFormedError, match="there is no possibility"):
        w.judge(name, "s", Basic("A"))
