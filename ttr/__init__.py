"""Type Theory with Records, for people who write meanings.

Types are immutable values: `rectype(x=Ind, c=dog(this.x))`, or the same read from the
notation of the papers, `theory.parse("[x : Ind, c : dog(x)]")`. A `Model` says which
objects are judged to be of which types; `judge`, `perceive` and `create` ask it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ttr import updates
from ttr.errors import (
    IllFormed,
    NotationError,
    Refused,
    TTRError,
    Undecided,
    Unsupported,
    UpdateError,
)
from ttr.formation import wellformed
from ttr.judgements import Judgement, Why
from ttr.merging import amerge, merge
from ttr.models import Model
from ttr.probability import Degree
from ttr.records import replace
from ttr.subtyping import Answer, subtype
from ttr.syntax import (
    Basic,
    Ind,
    ListOf,
    Meet,
    Path,
    Pred,
    PType,
    Rec,
    Record,
    RecordType,
    RecType,
    Singleton,
    Type,
    TypeNode,
    Universe,
    meet,
    outer,
    record,
    rectype,
    this,
)

if TYPE_CHECKING:
    from ttr.checking import check
    from ttr.notation import parse
    from ttr.theories import Theory, load

__all__ = [
    "Answer",
    "Basic",
    "Degree",
    "IllFormed",
    "Ind",
    "Judgement",
    "ListOf",
    "Meet",
    "Model",
    "NotationError",
    "PType",
    "Path",
    "Pred",
    "Rec",
    "RecType",
    "Record",
    "RecordType",
    "Refused",
    "Singleton",
    "TTRError",
    "Theory",
    "Type",
    "TypeNode",
    "Undecided",
    "Universe",
    "Unsupported",
    "UpdateError",
    "Why",
    "amerge",
    "check",
    "load",
    "meet",
    "merge",
    "outer",
    "parse",
    "record",
    "rectype",
    "replace",
    "subtype",
    "this",
    "updates",
    "wellformed",
]

_LATER = {
    "Theory": "ttr.theories",
    "check": "ttr.checking",
    "load": "ttr.theories",
    "parse": "ttr.notation",
}


def __getattr__(name: str) -> Any:
    """Loads what needs the parser only when it is asked for."""
    if name in _LATER:
        from importlib import import_module

        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module 'ttr' has no attribute {name!r}")
