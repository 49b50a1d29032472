"""What a theory assumes: declarations, axioms, exclusions, and what these entail.

Read `signature` first, then `axioms` and `conditional_axioms`. May import: types.
"""
