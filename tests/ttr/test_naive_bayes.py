"""Naive Bayes over types: posteriors from judgements, and the classifier."""

import pytest

from ttr import Basic, Ind, Pred, TTRError, rectype, this
from ttr.errors import IllFormedError, RefusedError
from ttr.judging import proposition
from ttr.judging.propositions import probabilistic
from ttr.semantics.learning import LAPLACE, Counts, NaiveBayes, posterior

red, round_ = Pred("red", Ind), Pred("round", Ind)
Apple, Pear = Basic("Apple"), Basic("Pear")
Red, Round = Basic("Red"), Basic("Round")
A, B = Basic("A"), Basic("B")


@pytest.fixture
def fruit() -> Counts:
    """6 apples, 5 red and 5 round; 4 pears, 1 red and 1 round."""
    apples = [Apple & Red & Round] * 4 + [Apple & Red, Apple & Round]
    pears = [Pear & Red, Pear & Round, Pear, Pear]
    return Counts().learned(
        *(proposition(f"o{n}", T) for n, T in enumerate([*apples, *pears]))
    )


def test_the_posterior_of_the_classes(fruit):
    found = posterior(fruit, [Apple, Pear], [Red, Round])
    assert found[Apple] == pytest.approx((0.9434, 0.9434), abs=5e-5)
    assert found[Apple].lo + found[Pear].lo == pytest.approx(1)


def test_without_evidence_the_posterior_is_the_prior(fruit):
    assert posterior(fruit, [Apple, Pear])[Apple] == pytest.approx((0.6, 0.6))


def test_the_same_evidence_twice_is_once(fruit):
    once = posterior(fruit, [Apple, Pear], [Red])
    assert posterior(fruit, [Apple, Pear], [Red, Red]) == once


def test_smoothing(fruit):
    found = posterior(fruit, [Apple, Pear], [Red, Round], smoothing=LAPLACE)
    apple, pear = 0.6 * (6 / 8) ** 2, 0.4 * (2 / 6) ** 2
    assert found[Apple] == pytest.approx((apple / (apple + pear),) * 2)


def test_evidence_that_no_class_allows_tells_nothing(fruit):
    assert set(posterior(fruit, [Apple, Pear], [A]).values()) == {(0, 1)}
    smoothed = posterior(fruit, [Apple, Pear], [A], smoothing=LAPLACE)
    assert smoothed[Apple].lo == pytest.approx(0.6 / 8 / (0.6 / 8 + 0.4 / 6))


def test_intervals(fruit):
    unsure = fruit.learned(probabilistic("o", Apple & Red, (0, 1)))
    found = posterior(unsure, [Apple, Pear], [Red])
    sure = [fruit.learned(probabilistic("o", Apple & Red, p)) for p in (0, 0.5, 1)]
    exact = [posterior(J, [Apple, Pear], [Red]) for J in sure]
    for one in exact:
        for kind in (Apple, Pear):
            assert found[kind].lo <= one[kind].lo + 1e-12
            assert one[kind].hi <= found[kind].hi + 1e-12


def test_many_kinds_of_evidence_do_not_underflow():
    features = [Basic(f"F{n}") for n in range(400)]
    J = Counts().learned(proposition("a", Apple), proposition("b", Pear))
    found = posterior(J, [Apple, Pear], features, smoothing=LAPLACE)
    assert found[Apple] == pytest.approx((0.5, 0.5))


def test_what_cannot_be_asked(fruit):
    with pytest.raises(IllFormedError, match="at least one class"):
        posterior(fruit, [])
    with pytest.raises(
        IllFormedError, match="expected a list of types as classes, found"
    ):
        posterior(fruit, Apple)
    with pytest.raises(IllFormedError, match="expected a list of types as evidence"):
        posterior(fruit, [Apple], Red)
    with pytest.raises(IllFormedError, match="the judgements are Counts"):
        posterior([], [Apple])
    with pytest.raises(TTRError, match="expected a smoothing, found 'Laplace'"):
        posterior(fruit, [Apple], [Red], smoothing="Laplace")
    with pytest.raises(TTRError, match="expected a smoothing, found 1"):
        NaiveBayes((Red,), 1)
    with pytest.raises(IllFormedError, match="expected a list of types as features"):
        NaiveBayes(Red)


# --- the classifier ---

RedThing = rectype(x=Ind, c=red(this.x))
RoundThing = rectype(x=Ind, d=round_(this.x))
RedRound = rectype(x=Ind, c=red(this.x), d=round_(this.x))
SEEN = [
    *((RedRound, "apple"),) * 4,
    (RedThing, "apple"),
    (RoundThing, "apple"),
    (RedThing, "pear"),
    (RoundThing, "pear"),
    *((rectype(x=Ind), "pear"),) * 2,
]


def taught(classifier, examples=SEEN):
    for key, (x, label) in enumerate(examples):
        classifier = classifier.learned(x, label, key=key)
    return classifier


def test_the_classifier_gives_the_same():
    found = taught(NaiveBayes((RedThing, RoundThing))).probabilities(RedRound)
    assert found["apple"] == pytest.approx(0.9434, abs=5e-5)
    smoothed = taught(NaiveBayes((RedThing, RoundThing), LAPLACE))
    assert smoothed.probabilities(RedRound)["apple"] == pytest.approx(
        0.6 * (6 / 8) ** 2 / (0.6 * (6 / 8) ** 2 + 0.4 * (2 / 6) ** 2)
    )


def test_features_that_are_not_seen_say_nothing():
    found = taught(NaiveBayes((RedThing, RoundThing))).probabilities(rectype(x=Ind))
    assert found == pytest.approx({"apple": 0.6, "pear": 0.4})


def test_what_no_label_was_seen_with_has_no_probability():
    one = NaiveBayes((A, B)).learned(A, "a", key=1)
    assert one.probabilities(B) == {"a": 0.0}
    assert NaiveBayes((A,)).probabilities(A) == {}


def test_evidence_that_is_wrong():
    one = NaiveBayes((A, B)).learned(A, "a", key=1)
    with pytest.raises(RefusedError, match="so it is no evidence"):
        one.learned(A & ~A, "a", key=2)
    with pytest.raises(RefusedError, match="so it is no evidence"):
        one.probabilities(A & ~A)
    with pytest.raises(IllFormedError, match="paths that lead nowhere"):
        one.learned(red(this.x), "a", key=2)
    with pytest.raises(IllFormedError, match="expected a type"):
        one.learned("a", "a", key=2)
    with pytest.raises(TTRError, match="a label is a word"):
        one.learned(A, "", key=2)
    with pytest.raises(TTRError, match="a key is a number or a text"):
        one.learned(A, "a", key=[2])
    with pytest.raises(TTRError, match="the key 1 is taken, by a lesson of 'a'"):
        one.learned(A, "a", key=1)
    with pytest.raises(TTRError, match="nothing was learned under the key"):
        one.retracted([2])
    with pytest.raises(IllFormedError, match="the feature A is given twice"):
        NaiveBayes((A, A))
    with pytest.raises(IllFormedError, match="expected a type"):
        NaiveBayes(("A",))
