"""Measures of dialogues, and tests of whether two theories differ in them."""

from kille.lab.measures.agreement import kappas, vocabulary
from kille.lab.measures.comparison import (
    contrasts,
    differences,
    holm,
    in_pairs,
    least_p,
    mcnemar,
    mcnemar_of,
    pairs_needed,
)
from kille.lab.measures.measures import Measure, estimate, value
from kille.lab.measures.power import least_difference, power_of, runs_needed
from kille.lab.measures.scored_dialogues import ScoredDialogue, score_dialogue
from ttr.aliases import former_names

__all__ = [
    "Measure",
    "ScoredDialogue",
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
    "score_dialogue",
    "value",
    "vocabulary",
]

__getattr__ = former_names(
    __name__, {"Dialogue": "ScoredDialogue", "scored": "score_dialogue"}
)
