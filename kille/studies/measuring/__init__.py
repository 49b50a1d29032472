"""What is measured of dialogues, and whether two theories differ in it."""

from kille.studies.measuring.agreement import kappas, vocabulary
from kille.studies.measuring.comparing import (
    contrasts,
    differences,
    holm,
    in_pairs,
    least_p,
    mcnemar,
    mcnemar_of,
    pairs_needed,
)
from kille.studies.measuring.measures import Measure, estimate, value
from kille.studies.measuring.power import least_difference, power_of, runs_needed
from kille.studies.measuring.scored import Dialogue, scored

__all__ = [
    "Dialogue",
    "Measure",
    "contrasts",
    "differences",
    "estimate",
    "holm",
    "in_pairs",
    "kappas",
    "least_difference",
    "least_p",
    "mcnemar",
    "mcnemar_of",
    "pairs_needed",
    "power_of",
    "runs_needed",
    "scored",
    "value",
    "vocabulary",
]
