"""Judgements: is a : T in a model, how certain is it, and why?

Read `judgements` (a judgement with its reason), `models` (what users ask), then
`assignments` (the facts) and `evaluator` (the clauses of a : T, and the derivation by
them; `certainty` asks the same clauses for yes or no). `creation` makes witnesses,
`counterexamples` refutes with one. May import: building, computing,
signature, types, probability, safety.
"""

from ttr.judging.judgements import Judgement, Why
from ttr.judging.models import Model
from ttr.judging.propositions import proposition

__all__ = [
    "Judgement",
    "Model",
    "Why",
    "proposition",
]
