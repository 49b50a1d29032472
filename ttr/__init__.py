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
    from ttr.building.flattening import flatten, unflatten
    from ttr.building.formation import wellformed
    from ttr.building.functions import fix, restrict
    from ttr.building.generalisation import common_supertype
    from ttr.building.merging import amerge, merge
    from ttr.building.relabelling import relabel
    from ttr.building.subtraction import subtract
    from ttr.computing.normal_forms import join_normal_form, meet_normal_form
    from ttr.computing.subtyping import Answer, consistent, subtype
    from ttr.display.render import box, html, latex
    from ttr.errors import (
        EndlessError,
        IllFormedError,
        NoStateError,
        NotationError,
        NotHeardError,
        RefusedError,
        RuleFailedError,
        TooLargeError,
        TTRError,
        UndecidedError,
        UnexpectedError,
        UnsupportedError,
        UpdateError,
    )
    from ttr.judging.judgements import Judgement, Why
    from ttr.judging.models import Model
    from ttr.judging.propositions import proposition
    from ttr.notation.reader import parse
    from ttr.probability import Degree
    from ttr.safety.budgets import budget
    from ttr.theories.checking import check
    from ttr.theories.theory import Theory, load
    from ttr.types.objects import concat, fst, rst
    from ttr.types.records import replace
    from ttr.types.syntax import (
        Application,
        Basic,
        EventString,
        FiniteSet,
        Function,
        FunType,
        Ind,
        Join,
        ListOf,
        Meet,
        Negation,
        NonEmpty,
        Operation,
        Path,
        Plus,
        Pred,
        PType,
        Rec,
        Record,
        RecordType,
        RecType,
        SetOf,
        Singleton,
        Str,
        Type,
        TypeNode,
        Universe,
        join,
        meet,
        outer,
        record,
        this,
    )

PROVIDERS = {
    "ttr.types.interning.as_notation": "ttr.types.printing",
    "ttr.types.interning.as_python": "ttr.types.printing",
    "ttr.types.notebooks.as_html": "ttr.display.render",
    "ttr.types.notebooks.as_latex": "ttr.display.render",
    "ttr.types.objects.as_application": "ttr.types.syntax",
    "ttr.types.syntax.as_function_type": "ttr.types.forms",
    "ttr.types.syntax.is_subtype": "ttr.computing.subtyping",
    "ttr.computing.subtyping.counterexample": "ttr.judging.counterexamples",
    "ttr.judging.evaluator.make_witness": "ttr.judging.creation",
    "ttr.semantics.quantifiers.truth.truth_of_quantified": (
        "ttr.semantics.quantifiers.quantified_propositions"
    ),
}
"""Which module provides what is declared below it (`ttr.hooks`)."""

set_providers(PROVIDERS)
find_former_modules()
_former_name = former_names(__name__, stacklevel=3)

_HOMES = {
    "ttr.building.constructors": "Pi fun rectype",
    "ttr.building.flattening": "flatten unflatten",
    "ttr.building.formation": "wellformed",
    "ttr.building.functions": "fix restrict",
    "ttr.building.generalisation": "common_supertype",
    "ttr.building.merging": "amerge merge",
    "ttr.building.relabelling": "relabel",
    "ttr.building.subtraction": "subtract",
    "ttr.computing.normal_forms": "join_normal_form meet_normal_form",
    "ttr.computing.subtyping": "Answer consistent subtype",
    "ttr.display.render": "box html latex",
    "ttr.errors": (
        "EndlessError IllFormedError NoStateError NotHeardError NotationError "
        "RefusedError RuleFailedError TTRError TooLargeError UndecidedError "
        "UnexpectedError UnsupportedError UpdateError"
    ),
    "ttr.judging.judgements": "Judgement Why",
    "ttr.judging.models": "Model",
    "ttr.judging.propositions": "proposition",
    "ttr.notation.reader": "parse",
    "ttr.probability": "Degree",
    "ttr.safety.budgets": "budget",
    "ttr.theories.checking": "check",
    "ttr.theories.theory": "Theory load",
    "ttr.types.objects": "concat fst rst",
    "ttr.types.records": "replace",
    "ttr.types.syntax": (
        "Application Basic EventString FiniteSet FunType Function Ind Join ListOf "
        "Meet Negation NonEmpty Operation PType Path Plus Pred Rec RecType Record "
        "RecordType SetOf Singleton Str Type TypeNode Universe join meet outer "
        "record this"
    ),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names.split()}

__all__ = [
    "Answer",
    "Application",
    "Basic",
    "Degree",
    "EndlessError",
    "EventString",
    "FiniteSet",
    "FunType",
    "Function",
    "IllFormedError",
    "Ind",
    "Join",
    "Judgement",
    "ListOf",
    "Meet",
    "Model",
    "Negation",
    "NoStateError",
    "NonEmpty",
    "NotHeardError",
    "NotationError",
    "Operation",
    "PType",
    "Path",
    "Pi",
    "Plus",
    "Pred",
    "Rec",
    "RecType",
    "Record",
    "RecordType",
    "RefusedError",
    "RuleFailedError",
    "SetOf",
    "Singleton",
    "Str",
    "TTRError",
    "Theory",
    "TooLargeError",
    "Type",
    "TypeNode",
    "UndecidedError",
    "UnexpectedError",
    "Universe",
    "UnsupportedError",
    "UpdateError",
    "Why",
    "amerge",
    "box",
    "budget",
    "check",
    "common_supertype",
    "concat",
    "consistent",
    "fix",
    "flatten",
    "fst",
    "fun",
    "html",
    "join",
    "join_normal_form",
    "latex",
    "load",
    "meet",
    "meet_normal_form",
    "merge",
    "outer",
    "parse",
    "proposition",
    "record",
    "rectype",
    "relabel",
    "replace",
    "restrict",
    "rst",
    "subtract",
    "subtype",
    "this",
    "unflatten",
    "updates",
    "wellformed",
]


def __getattr__(name: str) -> Any:
    """Loads what a name needs when it is first asked for."""
    if name == "updates":
        return import_module("ttr.updates")
    if name not in _HOME_OF:
        return _former_name(name)
    value = getattr(import_module(_HOME_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
