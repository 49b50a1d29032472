"""Questions about types that need no model: S ⊑ T, consistency, normal forms.

Read `normal_forms` and `case_analysis`, then `generic_witness` (an arbitrary witness of
a type), `prover` (what it is surely of) and `subtyping`; `strings` has the automata of
types of strings. May import: signature, types, safety.
"""
