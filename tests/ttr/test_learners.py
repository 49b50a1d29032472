"""The classifiers as learners: what holds of every learner, and what features are."""

import copy
import pickle

import pytest

from kille.perception.learners import check_learner
from ttr import Basic, Ind, Pred, TTRError, outer, rectype, this
from ttr.semantics.learning import LAPLACE, Learner, LogOdds, NaiveBayes, feature_types

A, B, C = Basic("A"), Basic("B"), Basic("C")
red, big = Pred("red", Ind), Pred("big", Ind)
EXAMPLES = [(A & B, "a"), (A, "a"), (B, "b"), (B & C, "b"), (C, "c"), (A & C, "a")]


@pytest.mark.parametrize(
    "make",
    [
        lambda: Learner(NaiveBayes((A, B, C))),
        lambda: Learner(NaiveBayes((A, B, C), LAPLACE)),
        lambda: Learner(LogOdds((A, B, C))),
    ],
    ids=["naive Bayes", "smoothed", "log-odds"],
)
def test_it_keeps_the_laws_of_learners(make):
    check_learner(make, EXAMPLES)


@pytest.mark.parametrize("classifier", [NaiveBayes((A, B)), LogOdds((A, B))])
def test_what_was_learned_is_a_value(classifier):
    learner = Learner(classifier)
    learner.learn_one(A, "a", key=1)
    before = learner.classifier
    learner.learn_one(B, "b", key="two")
    assert before.probabilities(A).keys() == {"a"}
    assert learner.classifier == classifier.learned(B, "b", key="two").learned(
        A, "a", key=1
    )
    learner.forget("two")
    assert learner.classifier == before


def test_what_is_refused_leaves_the_learner_as_it_was():
    learner = Learner(LogOdds((A, B)))
    learner.learn_one(A, "a", key=1)
    before = learner.classifier
    for x, label, key in [(A & ~A, "a", 2), (A, "", 2), (A, "a", 1)]:
        with pytest.raises(TTRError):
            learner.learn_one(x, label, key=key)
    assert learner.classifier is before


def test_errors_are_also_those_that_a_learner_raises():
    learner = Learner(NaiveBayes((A,)))
    learner.learn_one(A, "a", key=1)
    with pytest.raises(ValueError, match="the key 1 is taken"):
        learner.learn_one(A, "a", key=1)
    with pytest.raises(KeyError, match="nothing was learned under the key 2"):
        learner.forget(2)


def test_how_they_are_shown():
    taught = LogOdds((A, B)).learned(A, "a", key=1).learned(B, "b", key=2)
    assert repr(taught) == "<LogOdds over 2 features, 2 lessons: 1 a, 1 b>"
    assert repr(NaiveBayes((A,))) == "<NaiveBayes over 1 features, 0 lessons>"


def test_what_is_no_classifier():
    with pytest.raises(TTRError, match="a learner needs a classifier, found"):
        Learner("a")


def test_a_field_is_a_feature_with_what_it_depends_on():
    T = rectype(x=Ind, y=Ind @ this.x, c=red(this.y), s=big(this.x))
    assert feature_types(T) == (
        rectype(x=Ind),
        rectype(x=Ind, s=big(this.x)),
        rectype(x=Ind, y=Ind @ this.x),
        rectype(x=Ind, y=Ind @ this.x, c=red(this.y)),
    )
    assert all(feature >= T for feature in feature_types(T))


def test_a_field_of_two_types_is_two_features():
    T = rectype(x=Ind, c=red(this.x) & big(this.x))
    assert feature_types(T) == (
        rectype(x=Ind),
        rectype(x=Ind, c=big(this.x)),
        rectype(x=Ind, c=red(this.x)),
    )


def test_features_of_nested_and_other_types():
    inner = rectype(e=red(outer.x))
    T = rectype(x=Ind, r=inner)
    assert feature_types(T) == (rectype(x=Ind), T)
    assert feature_types(A) == (A,)
    assert feature_types(rectype(x=A) & rectype(y=B)) == (rectype(x=A), rectype(y=B))


def test_lessons_without_keys():
    learner = Learner(NaiveBayes((A, B)))
    learner.learn_one(A, "a", key="lesson 1")
    learner.learn_one(B, "b")
    learner.learn_one(B, "b")
    assert learner.labels == ("a", "b")
    learner.forget("lesson 3")
    learner.forget("lesson 2")
    assert learner.labels == ("a",)


@pytest.mark.parametrize("kind", [NaiveBayes, LogOdds])
def test_a_copy_is_taught_apart(kind):
    learner = Learner(kind((A, B)))
    for again in (learner.copy(), copy.deepcopy(learner)):
        again.learn_one(A, "a")
        assert (learner.labels, again.labels) == ((), ("a",))


@pytest.mark.parametrize("kind", [NaiveBayes, LogOdds])
def test_what_was_learned_can_be_kept_in_a_file(kind):
    learned = kind((A, B)).learned(A, "a", key=1).learned(B, "b", key=2)
    again = pickle.loads(pickle.dumps(learned))
    assert again.evidence == learned.evidence
    assert again.probabilities(A) == learned.probabilities(A)
