"""Meanings with classifiers inside, which change when somebody corrects them.

A perceptual meaning is a record {params, bg, clf, interp}. It judges situations that
have percepts in them, also in models. Feedback gives another meaning, so it learns; and
the meanings that two speakers have of a word can be compared. Regions of points give
rise to individuals, whose places are judged in frames of reference. Sources: Larsson
2013; Dobnik, Cooper and Larsson 2013.

Read `meanings` first, with `classifiers` and `interpretations`; then methods:
`perceptron`, `learners`, `estimators`; then `composition`, `speakers`, `similarity`;
then space: `individuation`, `frames_of_reference`. May import: argument_checks,
learning's logistic_regression, judging and all below.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.semantics.perceptual.classifiers import Classifier, Method
from ttr.semantics.perceptual.composition import combined_type, in_model, perceive
from ttr.semantics.perceptual.estimators import as_learner
from ttr.semantics.perceptual.frames_of_reference import (
    Frame,
    Projective,
    absolute,
    coordinates,
    intrinsic,
    relative,
)
from ttr.semantics.perceptual.individuation import (
    INDIVIDUATE,
    Individual,
    PointMap,
    Points,
    Region,
    clusters,
    detections,
    individuate,
)
from ttr.semantics.perceptual.interpretations import interpretation
from ttr.semantics.perceptual.learners import ByLearner, Learner, learner_params
from ttr.semantics.perceptual.meanings import Meaning, meaning
from ttr.semantics.perceptual.perceptron import GradedPerceptron, Perceptron, blank
from ttr.semantics.perceptual.similarity import (
    Agreement,
    Convergence,
    agreement,
    convergence,
    difference,
)
from ttr.semantics.perceptual.speakers import Speaker, exchange, history, says
from ttr.semantics.perceptual.vectors import RealVector

__all__ = [
    "INDIVIDUATE",
    "Agreement",
    "ByLearner",
    "Classifier",
    "Convergence",
    "Frame",
    "GradedPerceptron",
    "Individual",
    "Learner",
    "Meaning",
    "Method",
    "Perceptron",
    "PointMap",
    "Points",
    "Projective",
    "RealVector",
    "Region",
    "Speaker",
    "absolute",
    "agreement",
    "as_learner",
    "blank",
    "clusters",
    "combined_type",
    "convergence",
    "coordinates",
    "detections",
    "difference",
    "exchange",
    "history",
    "in_model",
    "individuate",
    "interpretation",
    "intrinsic",
    "learner_params",
    "meaning",
    "perceive",
    "relative",
    "says",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
