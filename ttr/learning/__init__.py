"""Learning from judgements: frequencies, naive Bayes and a linear classifier.

What was learned is an immutable value: learning gives another one, and so does taking
evidence back, exactly. A `Learner` holds such a value for whoever wants to be taught.
"""

from ttr.learning.bayes import NaiveBayes, posterior
from ttr.learning.counts import Counts
from ttr.learning.features import feature_types
from ttr.learning.learner import Learner
from ttr.learning.linear import LogOdds
from ttr.learning.smoothing import (
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
