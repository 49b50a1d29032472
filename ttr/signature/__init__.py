"""What a theory assumes: declarations, axioms, exclusions, and what these entail.

Read `signature` first, then `axioms`. May import: types.
"""
