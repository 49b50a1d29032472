"""Questions about types that need no model: S ⊑ T, consistency, normal forms.

Read `normalisation` (what a type computes to) and `case_analysis`, then
`generic_witness` (an arbitrary witness of a type), `prover` (what it is surely of) and
`subtyping`; `strings` has the automata of types of strings. May import: signature,
types, safety.
"""

from ttr.computing.definitional_equality import equal
from ttr.computing.normal_forms import join_normal_form, meet_normal_form
from ttr.computing.normalisation import normal_form
from ttr.computing.subtyping import Answer, consistent, subtype

__all__ = [
    "Answer",
    "consistent",
    "equal",
    "join_normal_form",
    "meet_normal_form",
    "normal_form",
    "subtype",
]
