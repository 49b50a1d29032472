"""Type Theory with Records, for people who write meanings.

Types are immutable values: `rectype(x=Ind, c=dog(this.x))`, or the same read from the
notation of the papers, `theory.parse("[x : Ind, c : dog(x)]")`. A `Model` says which
objects are judged to be of which types; `judge`, `perceive` and `create` ask it.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from ttr import updates
from ttr.aliases import find_former_modules
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
from ttr.errors import (
    Endless,
    IllFormed,
    NoState,
    NotationError,
    NotHeard,
    Refused,
    RuleFailed,
    TooLargeError,
    TTRError,
    Undecided,
    Unexpected,
    Unsupported,
    UpdateError,
)
from ttr.judging import counterexamples as counterexamples  # provides a hook
from ttr.judging.judgements import Judgement, Why
from ttr.judging.models import Model
from ttr.judging.propositions import proposition
from ttr.probability import Degree
from ttr.safety.budgets import budget
from ttr.types import notebooks
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

if TYPE_CHECKING:
    from ttr.display.render import box, html, latex
    from ttr.notation.reader import parse
    from ttr.theories.checking import check
    from ttr.theories.theory import Theory, load

__all__ = [
    "Answer",
    "Application",
    "Basic",
    "Degree",
    "EventString",
    "FiniteSet",
    "Endless",
    "FunType",
    "Function",
    "IllFormed",
    "Ind",
    "Join",
    "Judgement",
    "ListOf",
    "Meet",
    "Model",
    "Negation",
    "NonEmpty",
    "NoState",
    "NotHeard",
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
    "Refused",
    "RuleFailed",
    "SetOf",
    "Singleton",
    "Str",
    "TTRError",
    "Theory",
    "TooLargeError",
    "Type",
    "TypeNode",
    "Undecided",
    "Unexpected",
    "Universe",
    "Unsupported",
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

_LATER = {
    "Theory": "ttr.theories.theory",
    "box": "ttr.display.render",
    "check": "ttr.theories.checking",
    "html": "ttr.display.render",
    "latex": "ttr.display.render",
    "load": "ttr.theories.theory",
    "parse": "ttr.notation.reader",
}


find_former_modules()


def _render(form: str, value: object) -> str:
    from ttr.display import render

    drawn: str = getattr(render, form)(value)
    return drawn


notebooks.as_html.provided_by(partial(_render, "html"))
notebooks.as_latex.provided_by(partial(_render, "latex"))


def __getattr__(name: str) -> Any:
    """Loads what needs the parser, or draws, only when it is asked for."""
    if name in _LATER:
        from importlib import import_module

        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module 'ttr' has no attribute {name!r}")
