"""Learning from judgements: frequencies, naive Bayes and a linear classifier.

What was learned is an immutable value. Learning gives another value, and so does taking
evidence back, which undoes it exactly. A `Learner` is an object around such a value.
Sources: Cooper, Dobnik, Lappin and Larsson 2015; Larsson and Bernardy 2021.

Read `counts` first, with `smoothing`; then classifiers over types: `features`,
`evidence`, `evidence_classifier`, and on these `naive_bayes` and `linear_classifier`
(with `logistic_regression`); then `learner`. May import: argument_checks, judging and
all below.
"""

from ttr.semantics.learning.counts import Counts
from ttr.semantics.learning.features import feature_types
from ttr.semantics.learning.learner import Learner
from ttr.semantics.learning.linear_classifier import LogOdds
from ttr.semantics.learning.naive_bayes import NaiveBayes, posterior
from ttr.semantics.learning.smoothing import (
    JEFFREYS,
    LAPLACE,
    NO_SMOOTHING,
    Smoothing,
    lidstone,
)

__all__ = [
    "JEFFREYS",
    "LAPLACE",
    "NO_SMOOTHING",
    "Counts",
    "Learner",
    "LogOdds",
    "NaiveBayes",
    "Smoothing",
    "feature_types",
    "lidstone",
    "posterior",
]
