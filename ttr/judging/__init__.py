"""Judgements: is a : T in a model, how certain is it, and why?

Read `judgements` (a judgement with its reason), `models` (what users ask), then
`assignments` (the facts) and `evaluator` (how a judgement is derived); `creation` makes
up witnesses, `counterexamples` refutes with one. May import: building, computing,
signature, types, probability, safety.
"""
