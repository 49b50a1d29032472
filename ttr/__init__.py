"""Type Theory with Records, for people who write meanings.

Types are immutable values: `rectype(x=Ind, c=dog(this.x))`, or the same read from the
notation of the papers, `theory.parse("[x : Ind, c : dog(x)]")`. A `Model` says which
objects are judged to be of which types; `judge`, `perceive` and `create` ask it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ttr.aliases import find_former_modules, former_names
from ttr.hooks import set_providers

if TYPE_CHECKING:
    from ttr import updates
    from ttr.building.constructors import Pi, fun, rectype
    from ttr.building.merging import amerge, merge
    from ttr.building.relabelling import relabel
    from ttr.building.well_formedness import wellformed
    from ttr.computing.subtyping import consistent, subtype
    from ttr.display.render import box, html, latex
    from ttr.display.shown import show
    from ttr.errors import TTRError
    from ttr.judging.models import Model
    from ttr.notation.reader import parse
    from ttr.safety.budgets import budget
    from ttr.theories.checking import check
    from ttr.theories.theory import Theory, load
    from ttr.types.objects import Record, record
    from ttr.types.path_notation import outer, this
    from ttr.types.records import replace
    from ttr.types.syntax import (
        Basic,
        Ind,
        ListOf,
        Plus,
        Pred,
        Rec,
        RecordType,
        RecType,
        SetOf,
        Str,
        Type,
        join,
        meet,
    )

PROVIDERS = {
    "ttr.types.interning.as_notation": "ttr.types.printing",
    "ttr.types.interning.as_python": "ttr.types.printing",
    "ttr.showing.as_html": "ttr.display.render",
    "ttr.showing.as_latex": "ttr.display.render",
    "ttr.types.paths.merge_by_form": "ttr.types.merges",
    "ttr.types.syntax.as_function_type": "ttr.types.derived_types",
    "ttr.types.syntax.is_subtype": "ttr.computing.subtyping",
    "ttr.computing.subtyping.counterexample": "ttr.judging.counterexamples",
    "ttr.judging.evaluator.make_witness": "ttr.judging.creation",
    "ttr.theories.theory.read_term": "ttr.theories.loading",
    "ttr.theories.theory.draft_of_text": "ttr.theories.loading",
    "ttr.theories.theory.draft_of_file": "ttr.theories.loading",
    "ttr.semantics.quantifiers.truth.truth_of_quantified": (
        "ttr.semantics.quantifiers.quantified_propositions"
    ),
}
"""Which module provides what is declared below it (`ttr.hooks`)."""

set_providers(PROVIDERS)
find_former_modules()
_former_name = former_names(__name__, stacklevel=3)

_ROOMS = (
    "building",
    "computing",
    "dialogues",
    "display",
    "errors",
    "judging",
    "notation",
    "probability",
    "safety",
    "semantics",
    "signature",
    "testing",
    "theories",
    "types",
    "updates",
)

_HOMES = {
    "ttr.building.constructors": "Pi fun rectype",
    "ttr.building.well_formedness": "wellformed",
    "ttr.building.merging": "amerge merge",
    "ttr.building.relabelling": "relabel",
    "ttr.computing.subtyping": "consistent subtype",
    "ttr.display.render": "box html latex",
    "ttr.display.shown": "show",
    "ttr.errors": "TTRError",
    "ttr.judging.models": "Model",
    "ttr.notation.reader": "parse",
    "ttr.safety.budgets": "budget",
    "ttr.theories.checking": "check",
    "ttr.theories.theory": "Theory load",
    "ttr.types.objects": ("EventString FiniteSet Record concat fst record rst"),
    "ttr.types.path_notation": "outer this",
    "ttr.types.records": "replace",
    "ttr.types.syntax": (
        "Application Basic Ind ListOf Negation NonEmpty Plus Pred Rec RecType "
        "RecordType SetOf Singleton Str Type TypeAt Universe join meet"
    ),
}
"""Where the names are that users need every day, and those that `repr` prints."""

_HOME_OF = {name: home for home, names in _HOMES.items() for name in names.split()}

__all__ = [
    "Basic",
    "Ind",
    "ListOf",
    "Model",
    "Pi",
    "Plus",
    "Pred",
    "Rec",
    "RecType",
    "Record",
    "RecordType",
    "SetOf",
    "Str",
    "TTRError",
    "Theory",
    "Type",
    "amerge",
    "box",
    "budget",
    "check",
    "consistent",
    "fun",
    "html",
    "join",
    "latex",
    "load",
    "meet",
    "merge",
    "outer",
    "parse",
    "record",
    "rectype",
    "relabel",
    "replace",
    "show",
    "subtype",
    "this",
    "updates",
    "wellformed",
]


def __getattr__(name: str) -> Any:
    """Loads what a name needs when it is first asked for."""
    if name in _ROOMS:
        return import_module(f"ttr.{name}")
    if name not in _HOME_OF:
        return _former_name(name)
    value = getattr(import_module(_HOME_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
