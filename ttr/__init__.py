"""Type Theory with Records, for people who write meanings.

Types are immutable values: `rectype(x=Ind, c=dog(this.x))`, or the same read from the
notation of the papers, `theory.parse("[x : Ind, c : dog(x)]")`. A `Model` says which
objects are judged to be of which types; `judge`, `perceive` and `create` ask it.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from ttr import counters as counters  # provides counterexamples
from ttr import notebooks, updates
from ttr.budgets import budget
from ttr.constructors import Pi, fun, rectype
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
from ttr.formation import wellformed
from ttr.judgements import Judgement, Why
from ttr.merging import amerge, merge
from ttr.models import Model
from ttr.normal_forms import join_normal_form, meet_normal_form
from ttr.objects import concat, fst, rst
from ttr.probability import Degree
from ttr.propositions import proposition
from ttr.records import replace
from ttr.reshaping.flattening import flatten, unflatten
from ttr.reshaping.functions import fix, restrict
from ttr.reshaping.relabelling import relabel
from ttr.reshaping.subtraction import subtract
from ttr.reshaping.supertypes import common_supertype
from ttr.subtyping import Answer, consistent, subtype
from ttr.syntax import (
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
    from ttr.checking import check
    from ttr.notation.reader import parse
    from ttr.render import box, html, latex
    from ttr.theories import Theory, load

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
    "Theory": "ttr.theories",
    "box": "ttr.render",
    "check": "ttr.checking",
    "html": "ttr.render",
    "latex": "ttr.render",
    "load": "ttr.theories",
    "parse": "ttr.notation.reader",
}


def _render(form: str, value: object) -> str:
    from ttr import render

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
