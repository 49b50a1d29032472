"""Types made of types: well-formed record and function types, merge, relabelling.

Read `constructors` and `well_formedness` (when is a type well-formed?), then `merging`;
each of the others does one thing to given types, and `relabelled_subtyping` asks
whether one is below another with other labels; so do axioms with `conditions`. May
import: computing and all below it.
"""

from ttr.building.constructors import Pi, fun, rectype
from ttr.building.flattening import flatten, unflatten
from ttr.building.function_domains import fix, restrict
from ttr.building.generalisation import common_supertype
from ttr.building.merging import amerge, merge
from ttr.building.relabelled_subtyping import (
    RelabelledAnswer,
    subtype_up_to_relabelling,
)
from ttr.building.relabelling import relabel
from ttr.building.subtraction import subtract
from ttr.building.well_formedness import wellformed

__all__ = [
    "Pi",
    "RelabelledAnswer",
    "amerge",
    "common_supertype",
    "fix",
    "flatten",
    "fun",
    "merge",
    "rectype",
    "relabel",
    "restrict",
    "subtract",
    "subtype_up_to_relabelling",
    "unflatten",
    "wellformed",
]
