"""Learners of other makes as classifiers: taught copies, checked answers."""

import copy
import math
import threading
import warnings

import pytest

from ttr import Ind, Pred, TTRError, record, rectype, this
from ttr.errors import UnsupportedError
from ttr.probability import UNKNOWN
from ttr.semantics.perceptual import (
    ByLearner,
    RealVector,
    as_learner,
    interpretation,
    learner_params,
    meaning,
)

CUP = rectype(x=Ind, pos=RealVector, c=Pred("cup", Ind)(this.x))


class Nearest:
    """A learner in the manner of river: the label of the nearest example it has."""

    def __init__(self):
        self.examples = []

    def learn_one(self, x, y):
        self.examples.append((x, y))

    def predict_proba_one(self, x):
        near = [(math.dist(x, e), y) for e, y in self.examples]
        if not near:
            return {}
        best = min(near)[1]
        return {y: float(y == best) for _, y in self.examples}


class Answering:
    """A learner whose answers are given in turn; an exception is raised."""

    labels = ("cup", "mug")

    def __init__(self, *answers):
        self.answers = list(answers)

    def learn_one(self, x, y):
        if isinstance(self.answers[0], Exception):
            raise self.answers[0]

    def predict_proba_one(self, x):
        answer = self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]
        if isinstance(answer, Exception):
            raise answer
        return answer


def word(learner, label="cup", other="mug", **options):
    params = learner_params(learner, **options)
    return meaning(interpretation(CUP, "c"), ByLearner(label, other), params, of="pos")


def at(*pos):
    return record(x="o1", pos=pos)


def test_lessons_go_to_a_copy():
    start = Nearest()
    cup = word(start)
    assert str(cup.params) == "{labels = [], learner = <Handle Nearest>}"
    assert cup.degree(at(0, 0)) == UNKNOWN
    one = cup.confirmed(at(0, 0))
    two = one.rejected(at(1, 1))
    assert start.examples == []
    assert str(two.params) == (
        "{labels = [cup, mug], learner = <Handle Nearest + 2 lessons>}"
    )
    degrees = [it.degree(at(0.9, 0.9)) for it in (cup, one, two)]
    assert degrees == [UNKNOWN, (1.0, 1.0), (0.0, 0.0)]
    start.learn_one((0, 0), "spoon")
    assert two.degree(at(0.1, 0)) == (1.0, 1.0)


def test_lessons_on_one_meaning_do_not_reach_its_other_successor():
    cup = word(Nearest()).confirmed(at(0, 0))
    mugs, cups = cup.rejected(at(1, 1)), cup.confirmed(at(1, 1))
    assert mugs.degree(at(1, 1)) == (0.0, 0.0)
    assert cups.degree(at(1, 1)) == (1.0, 1.0)
    assert mugs != cups


def test_a_word_that_was_never_taught_may_have_what_the_others_leave():
    spoon = word(Answering({"cup": 0.5, "mug": 0.25}), label="spoon")
    assert spoon.degree(at(0)) == (0.0, 0.25)


def test_a_rejection_alone_teaches_nothing_where_there_is_no_other_label():
    cup = word(Nearest(), other=None)
    with pytest.raises(
        UnsupportedError, match="cup: that it is not cup teaches"
    ) as wrong:
        cup.rejected(at(0))
    assert "say what it is instead" in str(wrong.value)


@pytest.mark.parametrize(
    ("answer", "wrong"),
    [
        ({"cup": math.nan, "mug": 0.5}, "must give cup a degree in [0, 1], found nan"),
        ({"cup": -0.1, "mug": 0.5}, "must give cup a degree in [0, 1], found -0.1"),
        ({"cup": 1.1, "mug": 0.0}, "must give cup a degree in [0, 1], found 1.1"),
        ({"cup": "1", "mug": 0.0}, "must give cup a degree in [0, 1], found '1'"),
        ({"cup": None, "mug": 0.0}, "must give cup a degree in [0, 1], found None"),
        ({"cup": 0.75, "mug": 0.75}, "sum to 1 at most, found 1.5"),
        ({"cup": 1.0}, "has the labels cup, mug, but answered for cup"),
        ({"mug": 1.0}, "has the labels cup, mug, but answered for mug"),
        (
            {"cup": 0.5, "mug": 0.25, "spoon": 0.25},
            "has the labels cup, mug, but answered for cup, mug, spoon",
        ),
        ([("cup", 1.0)], "a mapping from labels to degrees, found [[cup, 1.0]]"),
        (RuntimeError("tired"), "a learner, as cup failed on [0]: RuntimeError: tired"),
    ],
)
def test_answers_that_are_no_degrees(answer, wrong):
    cup = word(Answering(answer))
    with pytest.raises(TTRError) as refused:
        cup.degree(at(0))
    assert refused.value.message.startswith("cup: ")
    assert wrong in refused.value.message


def test_a_learner_that_changes_its_labels_between_calls():
    cup = word(Answering({"cup": 0.5, "mug": 0.5}, {"cup": 0.5, "dog": 0.5}))
    assert cup.degree(at(0)) == (0.5, 0.5)
    with pytest.raises(
        TTRError, match="the labels cup, mug, but answered for cup, dog"
    ):
        cup.degree(at(0))


def test_a_learner_that_always_answers_for_two():
    class Logistic:
        """In the manner of binary classifiers of river: False and True, from first."""

        bias = 0.0

        def learn_one(self, x, y):
            self.bias += 1.0 if y else -1.0

        def predict_proba_one(self, x):
            p = 1 / (1 + math.exp(-self.bias))
            return {False: 1 - p, True: p}

    cup = word(Logistic(), label=True, other=False, labels=[False, True])
    assert cup.degree(at(0)) == (0.5, 0.5)
    assert cup.confirmed(at(0)).degree(at(0)).lo > 0.7
    assert cup.rejected(at(0)).degree(at(0)).hi < 0.3
    with pytest.raises(TTRError, match=r"labels \(none\), but answered") as wrong:
        word(Logistic(), label=True, other=False).degree(at(0))
    assert "give learner_params the labels" in wrong.value.hint


def test_rounding_is_forgiven():
    cup = word(Answering({"cup": 1.0 + 1e-9, "mug": -1e-9}))
    assert cup.degree(at(0)) == (1.0, 1.0)


def test_a_lesson_that_fails_leaves_the_meaning_as_it_was():
    cup = word(Answering(RuntimeError("tired")))
    before = str(cup)
    with pytest.raises(TTRError, match=r"cup: a learner, as cup failed on .* tired"):
        cup.confirmed(at(0))
    assert str(cup) == before


def test_a_copy_has_to_be_another_object():
    with pytest.raises(TTRError, match="the copy of Nearest is the learner itself"):
        word(Nearest(), copied=lambda learner: learner)


def test_what_cannot_be_copied():
    learner = Nearest()
    learner.lock = threading.Lock()
    with pytest.raises(TTRError, match="Nearest cannot be copied: TypeError") as wrong:
        word(learner)
    assert wrong.value.hint.startswith("say how it can: learner_params(learner, cop")


def test_what_is_no_learner():
    from sklearn.linear_model import LogisticRegression

    with pytest.raises(TTRError, match="expected a list of labels, found cup"):
        learner_params(Nearest(), "cup")
    with pytest.raises(TTRError, match="lacks learn_one and predict_proba_one"):
        learner_params(object())
    with pytest.raises(TTRError, match="lacks learn_one") as raw:
        learner_params(LogisticRegression())
    assert raw.value.hint == "make a learner of it: as_learner(LogisticRegression(…))"
    with pytest.raises(TTRError, match="found the class LogisticRegression") as made:
        as_learner(LogisticRegression)
    assert made.value.hint == "make one: as_learner(LogisticRegression())"
    with pytest.raises(TTRError, match=r"made by learner_params, found \{t = 1\}"):
        word(Nearest()).with_params(record(t=1)).degree(at(0))


# --- in the manner of scikit-learn ---------------------------------------------------


def taught(cup):
    for pos in ((0.0, 0.1), (0.1, 0.0), (0.2, 0.1)):
        cup = cup.confirmed(at(*pos))
    for pos in ((1.0, 0.9), (0.9, 1.0), (0.8, 1.1)):
        cup = cup.rejected(at(*pos))
    return cup


def test_an_estimator_that_is_taught_example_by_example():
    from sklearn.naive_bayes import GaussianNB

    start = as_learner(GaussianNB(), ["cup", "mug"])
    cup = taught(word(start))
    assert str(cup.params) == (
        "{labels = [cup, mug], learner = <Handle GaussianNB + 6 lessons>}"
    )
    assert cup.degree(at(0.1, 0.1)).lo > 0.9
    assert cup.degree(at(0.9, 0.9)).hi < 0.1
    assert not hasattr(start.estimator, "classes_")
    with pytest.raises(TTRError, match="spoon is none of the classes cup, mug"):
        word(start, label="spoon").confirmed(at(0, 0))


def test_an_estimator_that_knows_its_classes_needs_none():
    from sklearn.naive_bayes import GaussianNB

    fitted = GaussianNB().fit(
        [[0, 0], [0, 1], [5, 5], [5, 6]], ["mug"] * 2 + ["cup"] * 2
    )
    cup = word(as_learner(fitted))
    assert cup.params.labels == ("cup", "mug")
    assert cup.degree(at(5, 5.5)).lo > 0.9


def test_an_estimator_that_answers_with_nan():
    from sklearn.naive_bayes import GaussianNB

    cup = word(as_learner(GaussianNB(), ["cup", "mug"])).confirmed(at(0, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        with pytest.raises(TTRError, match=r"GaussianNB must give .* found nan"):
            cup.degree(at(0, 0))


def test_an_estimator_that_is_fitted_anew():
    from sklearn.linear_model import LogisticRegression

    cup = word(as_learner(LogisticRegression(C=100.0)))
    assert cup.confirmed(at(0, 0)).degree(at(0, 0)) == UNKNOWN
    learned = taught(cup)
    assert learned.degree(at(0.1, 0.1)).lo > 0.9
    assert learned.degree(at(0.9, 0.9)).hi < 0.1
    assert cup.degree(at(0, 0)) == UNKNOWN
    again = copy.deepcopy(learned.params.learner.learner)
    assert again.predict_proba_one([0.1, 0.1]) == pytest.approx(
        learned.params.learner.learner.predict_proba_one([0.1, 0.1])
    )


def test_estimators_that_do_not_do():
    from sklearn.cluster import KMeans
    from sklearn.naive_bayes import GaussianNB

    with pytest.raises(TTRError, match="expected a list of classes, found cup"):
        as_learner(GaussianNB(), "cup")
    with pytest.raises(TTRError, match="KMeans has no predict_proba"):
        as_learner(KMeans())
    with pytest.raises(
        TTRError, match="GaussianNB learns by partial_fit, so it has to"
    ):
        as_learner(GaussianNB())

    class Fixed:
        def predict_proba(self, rows):
            return rows

    with pytest.raises(TTRError, match="Fixed has neither partial_fit nor fit"):
        as_learner(Fixed())
