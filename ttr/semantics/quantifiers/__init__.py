"""Quantifiers by witness sets: every, most, few and the rest, in a model, with reasons.

`every(P, Q)` is a type: of it is a situation {X, f} with a witness set X. `settle` asks
whether a model has one, `judge_situation` whether a given situation is one, and
`quantify` counts extensions that are known already. `truth` works out types with
quantifiers inside.
"""

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.semantics.quantifiers.anaphora import Antecedents, antecedents
from ttr.semantics.quantifiers.degrees_of_truth import Truth
from ttr.semantics.quantifiers.determiners import (
    DETERMINERS,
    Determiner,
    at_least,
    at_most,
    determiner_of,
    every,
    exactly,
    exist,
    exist_pl,
    few,
    many,
    most,
    no,
    not_every,
    several,
)
from ttr.semantics.quantifiers.extension_pairs import Case
from ttr.semantics.quantifiers.extensions import Extension, extension
from ttr.semantics.quantifiers.quantified_propositions import (
    Quantification,
    UndefinedError,
    quantify,
    settle,
)
from ttr.semantics.quantifiers.quantified_situations import judge_situation
from ttr.semantics.quantifiers.thresholds import Threshold, Thresholds, number, share
from ttr.semantics.quantifiers.truth import absent, truth

__all__ = [
    "DETERMINERS",
    "Antecedents",
    "Case",
    "Determiner",
    "Extension",
    "Quantification",
    "Threshold",
    "Thresholds",
    "Truth",
    "UndefinedError",
    "absent",
    "antecedents",
    "at_least",
    "at_most",
    "determiner_of",
    "every",
    "exactly",
    "exist",
    "exist_pl",
    "extension",
    "few",
    "judge_situation",
    "many",
    "most",
    "no",
    "not_every",
    "number",
    "quantify",
    "settle",
    "several",
    "share",
    "truth",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
