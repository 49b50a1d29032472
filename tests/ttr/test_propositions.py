"""Propositions: Austinian and probabilistic, their truth and what follows from them."""

import pytest

from ttr import Basic, Ind, Model, Pred, Record, TTRError, record, rectype
from ttr.errors import IllFormedError
from ttr.judging import proposition
from ttr.judging.propositions import probabilistic, probabilistic_claim, proposition_of
from ttr.semantics.propositional_entailment import entails, equivalent
from ttr.signature.signature import Axiom, Exclusion, Signature

A, B = Basic("A"), Basic("B")
M = Model().given("a", A, 0.75).given("b", A).given("b", B)


@pytest.mark.parametrize("p", [0, 1, 0.25, (0.2, 0.4), [0.5, 1], True])
def test_a_probabilistic_proposition_is_a_record(p):
    said = probabilistic("a", A, p)
    sit, T, degree = probabilistic_claim(said)
    assert isinstance(said, Record)
    assert (sit, T) == ("a", A)
    assert probabilistic(sit, T, degree) == said


def test_one_written_as_a_record():
    said = record(sit="a", sit_type=A, prob=[0.2, 0.4])
    assert said == probabilistic("a", A, (0.2, 0.4))
    assert probabilistic_claim(proposition("a", A)) == ("a", A, (1, 1))


@pytest.mark.parametrize("p", [-0.1, 1.1, "0.5", (0.4, 0.2), None, float("nan")])
def test_what_is_no_probability(p):
    with pytest.raises(TTRError, match="the prob of a proposition is a number in"):
        probabilistic("a", A, p)


def test_a_record_with_a_wrong_prob():
    with pytest.raises(IllFormedError, match=r"prob = 2, .*is a number in \[0, 1\]"):
        probabilistic_claim(record(sit="a", sit_type=A, prob=2))


@pytest.mark.parametrize("sit", ["a", "b", "zz"])
def test_there_and_back_from_a_judgement(sit):
    j = M.judge(sit, A)
    assert probabilistic_claim(proposition_of(j)) == (j.sit, j.type, j.p)
    assert M.true(proposition_of(j)) == (1, 1)


def test_what_is_no_judgement():
    with pytest.raises(
        IllFormedError, match="expected a judgement, found the object 'a'"
    ):
        proposition_of("a")


def test_truth():
    assert M.true(A) == (1, 1)
    assert M.true(proposition("a", A)) == (0.75, 0.75)
    assert M.true(probabilistic("a", A, 0.75)) == (1, 1)
    assert M.true(probabilistic("a", A, (0.5, 1))) == (1, 1)
    assert M.true(probabilistic("a", A, 0.7)) == (0, 0)
    assert M.true(probabilistic("b", B, 1)) == (1, 1)


def test_truth_of_what_is_known_loosely():
    loose = Model().given("a", A, (0.5, 0.8))
    assert loose.true(probabilistic("a", A, (0.4, 0.8))) == (1, 1)
    assert loose.true(probabilistic("a", A, 0.6)) == (0, 1)
    assert loose.true(probabilistic("a", A, (0.9, 1))) == (0, 0)


def test_a_probability_worked_out_in_another_way():
    T = rectype(x=A, y=A)
    here = Model().given("a", A, 0.1).given("c", A, 0.7)
    said = probabilistic(record(x="a", y="c"), T, 0.07)
    assert here.true(said) == (1, 1)


def test_entailment():
    assert entails(A & B, A).yes
    assert entails(proposition("s", A & B), proposition("s", A)).yes
    assert entails(proposition("s", A), proposition("s", B)).no
    assert entails(proposition("s", A), proposition("t", A)).unknown
    assert entails(proposition("s", A), A).yes
    assert entails(A, proposition("s", A)).unknown
    assert entails(probabilistic("s", A, 0.5), A).unknown


def test_entailment_by_an_axiom():
    dog, animal = Pred("dog", Ind), Pred("animal", Ind)
    theory = Signature(axioms=(Axiom(dog("a"), animal("a")),))
    first, second = proposition("s", dog("a")), proposition("s", animal("a"))
    assert entails(first, second, theory).yes
    assert entails(first, second).no


def test_entailment_of_degrees():
    first = probabilistic("s", A, (0.6, 0.7))
    assert entails(first, probabilistic("s", A | B, (0.5, 1))).yes
    assert entails(first, probabilistic("s", A | B, (0.5, 0.8))).unknown
    assert entails(first, probabilistic("s", A, (0.5, 0.8))).yes
    assert entails(first, probabilistic("s", A, 0.65)).no
    assert entails(first, probabilistic("s", A & B, (0, 0.7))).yes
    assert entails(first, probabilistic("s", B, (0, 1))).yes


def test_equivalence():
    assert equivalent(proposition("s", A & (A | B)), proposition("s", A)).yes
    assert equivalent(proposition("s", A & B), proposition("s", A)).no
    assert equivalent(proposition("s", A), probabilistic("s", A, 1)).yes


@pytest.mark.parametrize("wrong", ["a", 3, record(x="a"), None])
def test_what_is_no_proposition(wrong):
    for ask in (
        lambda: M.true(wrong),
        lambda: entails(wrong, A),
        lambda: entails(A, wrong),
        lambda: entails(proposition("s", A), wrong),
    ):
        with pytest.raises(IllFormedError, match="a proposition is a type or a record"):
            ask()


def test_what_follows_of_the_negation():
    Apart = Signature(exclusions=(Exclusion(A, B),))
    assert entails(probabilistic("s", A, 0.7), probabilistic("s", ~A, 0.3)).yes
    assert entails(probabilistic("s", A, 0), proposition("s", ~A)).yes
    assert entails(
        probabilistic("s", ~A, (0.1, 0.4)), probabilistic("s", A, (0.6, 0.9))
    ).yes
    assert entails(probabilistic("s", A, 0.7), probabilistic("s", ~A, 0.5)).no
    assert entails(
        probabilistic("s", A, 0.7), probabilistic("s", B, (0, 0.3)), Apart
    ).yes
    assert entails(probabilistic("s", A, 0.7), probabilistic("s", B, (0, 0.3))).unknown
