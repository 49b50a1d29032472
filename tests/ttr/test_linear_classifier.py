"""The linear classifier: log-odds, dependent evidence, its fit."""

import math

import pytest

from ttr import Basic, TTRError
from ttr.errors import RefusedError
from ttr.semantics.learning import LAPLACE, LogOdds, NaiveBayes
from ttr.semantics.learning.logistic_regression import Example, fit_weights, logistic

A, B, C = Basic("A"), Basic("B"), Basic("C")
COPIES = tuple(Basic(f"Copy{n}") for n in range(5))


def taught(classifier, examples):
    for key, (x, label) in enumerate(examples):
        classifier = classifier.learned(x, label, key=key)
    return classifier


def every(*kinds):
    found = kinds[0]
    for kind in kinds[1:]:
        found &= kind
    return found


# What is of A is good in 8 of 10 cases, anything else in 2; there are copies of A.
COPIED = every(A, *COPIES)
EXAMPLES = [
    *((COPIED, "good"),) * 80,
    *((COPIED, "bad"),) * 20,
    *((B, "good"),) * 20,
    *((B, "bad"),) * 80,
]


def test_dependent_evidence_is_not_counted_twice():
    """Naive Bayes multiplies copies of a feature; the linear model shares it out."""
    features = (A, *COPIES)
    bayes = taught(NaiveBayes(features, LAPLACE), EXAMPLES)
    linear = taught(LogOdds(features), EXAMPLES)
    alone = taught(LogOdds((A,)), EXAMPLES)
    assert bayes.probabilities(COPIED)["good"] > 0.999
    assert linear.probabilities(COPIED)["good"] == pytest.approx(0.8, abs=0.03)
    assert alone.probabilities(COPIED)["good"] == pytest.approx(0.8, abs=0.03)


def test_copies_share_their_weight():
    _, first, *others = taught(LogOdds((A, *COPIES)), EXAMPLES).weights["good"]
    assert others == pytest.approx([first] * 5)


def test_log_odds_are_the_sum_of_the_weights():
    linear = taught(LogOdds((A, B)), EXAMPLES)
    always, of_a, of_b = linear.weights["good"]
    assert linear.log_odds(A, "good") == pytest.approx(always + of_a)
    assert linear.log_odds(C, "good") == pytest.approx(always)
    p = linear.probabilities(A)["good"]
    assert linear.log_odds(A, "good") == pytest.approx(math.log(p / (1 - p)))
    assert of_a > 0 > of_b


def test_two_labels_are_each_other_s_complement():
    found = taught(LogOdds((A, B)), EXAMPLES).probabilities(A)
    assert found["good"] + found["bad"] == pytest.approx(1)


def test_a_wide_prior_gives_the_frequencies():
    wide = taught(LogOdds((A,), variance=1e6), EXAMPLES)
    assert wide.probabilities(A)["good"] == pytest.approx(0.8, abs=1e-4)
    assert wide.probabilities(B)["good"] == pytest.approx(0.2, abs=1e-4)


def test_the_weights_are_at_the_top():
    """At the top the slope is 0: Σ (right − p) x = w / variance."""
    linear = taught(LogOdds((A, B), variance=0.5), EXAMPLES[:90])
    for label, weights in linear.weights.items():
        for i, feature in enumerate((None, A, B)):
            rows = [(x, one) for x, one in EXAMPLES[:90] if feature in (None, *x_of(x))]
            slope = sum((one == label) - single(linear, x, label) for x, one in rows)
            assert slope == pytest.approx(weights[i] / 0.5, abs=1e-6)


def x_of(x):
    return getattr(x, "parts", (x,))


def single(linear, x, label):
    return logistic(linear.log_odds(x, label))


def test_separable_evidence_has_finite_weights():
    sure = taught(LogOdds((A,), variance=100.0), [(A, "a"), (B, "b")] * 500)
    assert all(abs(w) < 100 for w in sure.weights["a"])
    assert 0.99 < sure.probabilities(A)["a"] < 1


def test_one_label_is_not_certain():
    found = LogOdds((A,)).learned(A, "a", key=1).probabilities(A)
    assert 0.5 < found["a"] < 1


def test_of_nothing_learned_nothing_is_known():
    assert LogOdds((A,)).probabilities(A) == {}
    with pytest.raises(TTRError, match="the label 'a' was never learned"):
        LogOdds((A,)).log_odds(A, "a")


@pytest.mark.parametrize("wrong", [0, -1.0, float("nan"), float("inf"), 2e6, "1", None])
def test_what_is_no_variance(wrong):
    with pytest.raises(TTRError, match="the variance of weights is a number above 0"):
        LogOdds((A,), variance=wrong)


def test_evidence_of_what_nothing_can_be_of():
    with pytest.raises(RefusedError, match="so it is no evidence"):
        LogOdds((A,)).learned(A & ~A, "a", key=1)


@pytest.mark.parametrize("variance", [1e-300, 1e-6, 1.0, 1e6])
def test_copies_and_certainty_at_every_variance(variance):
    sure = taught(LogOdds((A, *COPIES), variance), [(COPIED, "a"), (B, "b")] * 300)
    weights = sure.weights["a"]
    assert all(map(math.isfinite, weights))
    assert weights[2:] == pytest.approx([weights[1]] * 5)
    assert (
        0 <= sure.probabilities(B)["a"] <= 0.5 <= sure.probabilities(COPIED)["a"] <= 1
    )


def test_the_fit_of_one_weight_is_the_frequency():
    rows = [Example((0,), True, 30), Example((0,), False, 10)]
    assert logistic(fit_weights(rows, 1, 1e9)[0]) == pytest.approx(0.75)
    assert fit_weights([], 2, 1.0) == (0.0, 0.0)


def test_weights_that_were_handed_out_are_not_its_own():
    fruit = LogOdds((A, B)).learned(A, "apple", key=1).learned(B, "pear", key=2)
    before = fruit.probabilities(A)
    fruit.weights["apple"] = (9.0, 9.0, 9.0)
    assert fruit.probabilities(A) == before
