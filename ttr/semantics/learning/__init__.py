"""Learning from judgements: frequencies, naive Bayes and a linear classifier.

What was learned is an immutable value: learning gives another one, and so does taking
evidence back, exactly. A `Learner` holds such a value for whoever wants to be taught.
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
