"""Judgements: is a : T in a model, how certain is it, and why?

Read `judgements` (a judgement with its reason), `models` (what users ask), then
`assignments` (the facts) and `evaluator` (the clauses of a : T, and the derivation by
them; `certainty` asks the same clauses for yes or no). `creation` makes witnesses,
`counterexamples` refutes with one. May import: building, computing,
signature, types, probability, safety.
"""
