"""Mistakes of whoever uses meanings from Python: one clear line, nothing changed."""

import copy
import pickle

import numpy as np
import pytest
from sklearn.linear_model import LogisticRegression, SGDClassifier

from ttr import Ind, Model, Pred, TTRError, outer, record, rectype
from ttr.building.constructors import fun
from ttr.semantics.learning import Learner, LogOdds
from ttr.semantics.perceptual import (
    ByLearner,
    Perceptron,
    PointMap,
    Projective,
    RealVector,
    Speaker,
    agreement,
    as_learner,
    blank,
    clusters,
    combined_type,
    convergence,
    coordinates,
    detections,
    exchange,
    history,
    in_model,
    individuate,
    interpretation,
    learner_params,
    meaning,
    perceive,
)
from ttr.types.syntax import Basic

BG = rectype(x=Ind, pos=RealVector)
RIGHT = fun(r=BG)(rectype(c=Pred("right", Ind)(outer.r.x)))
right = meaning(RIGHT, Perceptron(), record(w=[1.0, 0.0], t=0.5), of="pos")
here = record(x="o1", pos=[0.9, 0.1])
ann = Speaker("ann", {"right": right})
TABLE = np.array([[0.2, 0.4], [1.0, 2.0]])


class Saying:
    """A learner that always says the same."""

    def __init__(self, answer):
        self.answer = answer

    def learn_one(self, x, y):
        pass

    def predict_proba_one(self, x):
        return self.answer


def by_learner(answer):
    params = learner_params(Saying(answer), labels=["right"])
    return meaning(RIGHT, ByLearner("right"), params, of="pos")


def sgd():
    return as_learner(SGDClassifier(loss="log_loss"), ["a", "b"])


MISTAKES = {
    "no model to judge in": (lambda: right.judge("M", here), "expected a model"),
    "no model to be in": (lambda: right.in_model(None, here), "expected a model"),
    "no model for several": (lambda: in_model(3, (right,), here), "expected a model"),
    "no model to perceive in": (lambda: perceive({}, here, right), "expected a model"),
    "no model for regions": (lambda: individuate(Model, record()), "expected a model"),
    "one meaning for several": (
        lambda: in_model(Model(), right, here),
        "a list of",
    ),
    "no labels": (lambda: learner_params(Saying({}), labels=3), "a list of"),
    "no classes": (
        lambda: as_learner(SGDClassifier(loss="log_loss"), 3),
        "a list of",
    ),
    "an empty percept": (lambda: sgd().learn_one([], "a"), "SGDClassifier failed"),
    "a class that is an array": (lambda: sgd().learn_one([1], TABLE), "none of"),
    "no parameters of a learner": (
        lambda: ByLearner("a").degree(None, (1, 2)),
        "made by learner_params",
    ),
    "no parameters of a template": (
        lambda: Projective().degree(None, (1, 2)),
        "a spatial template has",
    ),
    "a word that is none": (lambda: Speaker("ann", {3: right}), "a word is a text"),
    "a word of another kind": (lambda: ann[[]], "no meaning of"),
    "a new word that is none": (lambda: ann.with_meaning([], right), "a word is"),
    "what is right is no word": (
        lambda: ann.corrected(here, said="right", right=TABLE),
        "no meaning of",
    ),
    "no teacher": (lambda: exchange(right, ann, "right", here), "expected a speaker"),
    "no pupil": (lambda: exchange(ann, None, "right", here), "expected a speaker"),
    "no pupils": (lambda: convergence(ann, 3, "right", [here]), "a list of"),
    "a pupil that is none": (
        lambda: convergence(ann, [right], "right", [here]),
        "expected a speaker",
    ),
    "no teacher to converge to": (
        lambda: convergence(right, [ann], "right", [here]),
        "expected a speaker",
    ),
    "no situations to compare in": (
        lambda: agreement(right, right, 3),
        "a list of",
    ),
    "no situations to learn from": (
        lambda: history(ann, ann, "right", 3),
        "a list of",
    ),
    "no regions": (lambda: detections(3, right), "a list of"),
    "no words": (
        lambda: detections([PointMap([[1]])], "right"),
        "a perceptual meaning",
    ),
    "no label": (lambda: interpretation(BG, []), "a ptype at"),
    "a point map of one number": (lambda: PointMap(np.array(0.5)), "a point is"),
    "more dimensions than there can be": (lambda: blank(10**400), "1 number or more"),
    "too small a reach": (lambda: clusters([[1e300]], 1e-300), "the reach"),
    "dimensions that are a table": (lambda: blank(TABLE), "1 number or more"),
    "a frame that is a table": (lambda: coordinates([1, 1], TABLE), "a frame is"),
    "weights that are a table": (
        lambda: Perceptron().degree(TABLE, (1, 2)),
        "the parameters of a perceptron",
    ),
    "a degree that is a table": (
        lambda: by_learner({"right": TABLE}).degree(here),
        "a degree in",
    ),
    "a meaning that is none": (lambda: combined_type(right, 3), "perceptual meaning"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_told_in_one_line(mistake):
    make, said = MISTAKES[mistake]
    with pytest.raises(TTRError, match=said) as told:
        make()
    assert "\n" not in told.value.message


class Tensor:
    """An array of a library that answers with an error of its own."""

    def __float__(self):
        raise RuntimeError("a tensor with 2 elements cannot be converted")


def test_what_cannot_be_a_number():
    with pytest.raises(TTRError, match="finite"):
        right.degree(record(x="o1", pos=[Tensor()]))


def test_a_lesson_that_fails_leaves_an_estimator_as_it_was():
    learner = as_learner(LogisticRegression())
    learner.learn_one([0.0, 1.0], "a")
    learner.learn_one([1.0, 0.0], "b")
    before = learner.predict_proba_one([0.0, 1.0])
    with pytest.raises(TTRError, match="LogisticRegression failed"):
        learner.learn_one([1.0, 0.0, 3.0], "b")
    learner.learn_one([0.0, 1.0], "a")
    assert learner.predict_proba_one([0.0, 1.0])["a"] > before["a"]


def test_points_of_many_dimensions():
    points = [[float(i == j) for i in range(40)] for j in range(3)]
    assert [len(it) for it in clusters(points, 2)] == [3]


@pytest.mark.parametrize(
    "again", [copy.deepcopy, lambda v: pickle.loads(pickle.dumps(v))]
)
def test_a_speaker_can_be_copied(again):
    assert again(ann) == ann
    assert hash(again(ann)) == hash(ann)


def test_a_classifier_over_types_is_a_learner_of_meanings():
    red = Basic("Red")
    learner = Learner(LogOdds((red,)))
    interp = fun(r=rectype(x=Ind, seen=Ind))(rectype(c=Pred("red", Ind)(outer.r.x)))
    red_things = meaning(
        interp,
        ByLearner("red"),
        learner_params(learner),
        of="seen",
        through=lambda _: red,
    )
    taught = red_things.confirmed(record(x="o1", seen="o1"))
    assert taught.degree(record(x="o1", seen="o1")).lo > 0.5
    assert learner.labels == ()
    assert taught.params.labels == ("red",)
