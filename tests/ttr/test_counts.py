"""Frequencies over judgements: counts, conditionals, intervals, wrong evidence."""

import pickle
from fractions import Fraction

import pytest

from ttr import Basic, Ind, Model, Pred, TTRError, rectype, this
from ttr.errors import IllFormedError, RefusedError
from ttr.judging import proposition
from ttr.judging.propositions import probabilistic
from ttr.semantics.learning import (
    JEFFREYS,
    LAPLACE,
    NO_SMOOTHING,
    Counts,
    Smoothing,
    lidstone,
)
from ttr.semantics.learning.counts import Weight
from ttr.signature.signature import Axiom, Signature

A, B, C = Basic("A"), Basic("B"), Basic("C")
Dog, Bark = Basic("Dog"), Basic("Bark")
dog, red = Pred("dog", Ind), Pred("red", Ind)


@pytest.fixture
def kennel() -> Counts:
    """Three dogs, two of which bark."""
    barking = [proposition(name, Dog & Bark) for name in ("f", "s")]
    return Counts().learned(*barking, proposition("r", Dog))


def test_how_much_there_is(kennel):
    assert kennel.weight(Dog) == (3, 3)
    assert kennel.weight(Bark) == (2, 2)
    assert kennel.weight(C) == (0, 0)
    assert kennel.total == (3, 3)
    assert len(kennel) == 3


def test_how_it_is_shown(kennel):
    assert repr(kennel) == "<Counts: 3 judgements of 2 types>"


def test_how_probable(kennel):
    assert kennel.p(Dog) == (1, 1)
    assert kennel.p(Bark) == pytest.approx((2 / 3, 2 / 3))
    assert kennel.p(Bark, given=Dog) == pytest.approx((2 / 3, 2 / 3))
    assert kennel.p(Dog, given=Bark) == (1, 1)


def test_what_is_below_counts():
    small = rectype(x=Ind, c=dog(this.x), s=red(this.x))
    J = Counts().learned(proposition("s1", small), proposition("s2", rectype(x=Ind)))
    assert J.p(rectype(x=Ind)) == (1, 1)
    assert J.p(rectype(x=Ind, c=dog(this.x))) == (0.5, 0.5)


def test_axioms_count():
    Puppy = Basic("Puppy")
    theory = Signature(axioms=(Axiom(Puppy, Dog),))
    assert Counts(theory).learned(proposition("p", Puppy)).p(Dog) == (1, 1)
    assert Counts().learned(proposition("p", Puppy)).p(Dog) == (0, 0)


def test_degrees_are_summed_exactly():
    J = Counts()
    for n in range(10):
        J = J.learned(probabilistic(f"s{n}", A, 0.1))
    assert J.weight(A).lo == 10 * Fraction(0.1)
    assert J.p(A) == (1, 1)


def test_judgements_are_evidence():
    M = Model().given("a", A, 0.5).given("b", B)
    J = Counts().learned(M.judge("a", A), M.judge("b", B))
    assert J.p(A) == pytest.approx((1 / 3, 1 / 3))
    assert Counts().learned(probabilistic("b", B, 1), probabilistic("a", A, 0.5)) == J


def test_intervals_give_the_least_and_the_most():
    J = Counts().learned(probabilistic("s", A, (0.5, 1)), probabilistic("t", B, 1))
    assert J.weight(A) == (0.5, 1)
    assert J.p(A) == pytest.approx((1 / 3, 1 / 2))
    assert J.p(B) == pytest.approx((1 / 2, 2 / 3))
    assert J.p(A, given=A) == (1, 1)


def test_a_subtyping_that_is_not_derivable_counts_as_perhaps():
    f, T = Ind >> (A | B), (Ind >> A) | (Ind >> B)
    J = Counts().learned(proposition("s", f), proposition("t", C))
    assert J._verdict(f, T) == "unknown"
    assert J.weight(T) == (0, 1)
    assert J.p(T) == (0, 0.5)
    assert J.p(C, given=T) == (0, 0)


def test_nothing_to_divide_by_is_not_known(kennel):
    assert Counts().p(A) == (0, 1)
    assert kennel.p(Bark, given=C) == (0, 1)
    assert Counts().learned(probabilistic("s", A, 0)).p(A) == (0, 1)
    assert Counts().learned(probabilistic("s", A, (0, 1))).p(A) == (1, 1)


def test_named_smoothing(kennel):
    assert kennel.p(Bark, given=Dog, smoothing=LAPLACE) == (0.6, 0.6)
    assert kennel.p(Bark, given=Dog, smoothing=JEFFREYS) == (0.625, 0.625)
    assert kennel.p(Bark, given=Dog, smoothing=lidstone(2)) == pytest.approx(
        (4 / 7,) * 2
    )
    assert kennel.p(Bark, given=C, smoothing=LAPLACE) == (0.5, 0.5)
    assert lidstone(0).pseudocount == NO_SMOOTHING.pseudocount
    assert [str(s) for s in (LAPLACE, NO_SMOOTHING, lidstone(2))] == [
        "Laplace",
        "no smoothing",
        "Lidstone(2)",
    ]


@pytest.mark.parametrize("wrong", [-1, float("nan"), float("inf"), "1", None])
def test_what_is_no_pseudocount(wrong):
    with pytest.raises(TTRError, match="a pseudocount is a finite number, 0 or more"):
        lidstone(wrong)


# --- taking back ---


def test_taking_back(kennel):
    more = kennel.learned(probabilistic("x", A & B, 0.3))
    assert more != kennel
    assert more.retracted(probabilistic("x", A & B, 0.3)) == kennel
    nothing = kennel.retracted(*[record for record, _ in kennel.held.values()])
    assert nothing == Counts()
    assert nothing.total == Weight(Fraction(0), Fraction(0))


def test_the_same_evidence_twice_is_two(kennel):
    said = proposition("r", Dog)
    twice = kennel.learned(said)
    assert twice.times(said) == 2
    assert twice.weight(Dog) == (4, 4)
    assert twice.retracted(said) == kennel


def test_what_was_not_learned_cannot_be_taken_back(kennel):
    for other in (proposition("x", Dog), probabilistic("r", Dog, 0.5)):
        with pytest.raises(TTRError, match="was not learned, so it cannot be taken"):
            kennel.retracted(other)


def test_learning_changes_no_older_value(kennel):
    before = kennel.p(Bark)
    kennel.learned(proposition("x", Bark))
    assert kennel.p(Bark) == before


# --- wrong evidence ---


@pytest.mark.parametrize("T", [A & ~A, rectype(x=Ind @ "a") & rectype(x=Ind @ "b")])
def test_evidence_of_what_nothing_can_be_of(T):
    with pytest.raises(RefusedError, match="cannot be: nothing can be of"):
        Counts().learned(proposition("s", T))
    assert len(Counts().learned(probabilistic("s", T, 0))) == 1


@pytest.mark.parametrize("said", [proposition("s", ~A), probabilistic("s", A, 0)])
def test_evidence_that_contradicts_what_is_certain(said):
    J = Counts().learned(proposition("s", A))
    with pytest.raises(RefusedError, match="contradicts what is certain of s"):
        J.learned(proposition("t", B), said)
    assert len(J.learned(probabilistic("t", ~A, 1))) == 2
    assert len(J.retracted(proposition("s", A)).learned(said)) == 1


def test_nothing_is_learned_where_something_is_refused():
    J = Counts()
    with pytest.raises(RefusedError):
        J.learned(proposition("s", A), proposition("s", ~A))
    assert Counts() == J


@pytest.mark.parametrize("wrong", ["a", 3, None, A])
def test_what_is_no_evidence(wrong):
    with pytest.raises(IllFormedError, match="a proposition is a type or a record"):
        Counts().learned(wrong)


def test_evidence_with_paths_that_lead_nowhere():
    with pytest.raises(IllFormedError, match="paths that lead nowhere"):
        Counts().learned(proposition("s", dog(this.x)))


def test_what_is_no_theory_or_type(kennel):
    with pytest.raises(IllFormedError, match="expected a theory"):
        Counts("a")
    with pytest.raises(IllFormedError, match="expected a type"):
        kennel.p("Dog")
    with pytest.raises(IllFormedError, match="expected a type"):
        kennel.p(Dog, given="Bark")


def test_counts_can_be_kept_in_a_file():
    J = Counts().learned(probabilistic("s", A, 0.5))
    again = pickle.loads(pickle.dumps(J))
    assert len(again) == 1
    assert again.p(A) == J.p(A)


@pytest.mark.parametrize("pseudocount", [-1, float("nan"), float("inf"), "1", None])
def test_a_smoothing_that_adds_no_number(pseudocount):
    with pytest.raises(TTRError, match="a finite number, 0 or more"):
        Smoothing("mine", pseudocount)
