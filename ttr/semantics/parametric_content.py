"""Parametric contents {bg, fg}: what is said, given what is presupposed.

The background bg is a record type: that of the contexts in which the content makes
sense. The foreground fg is a function from these contexts to types. Purification
eliminates the context: weak purification asks for some context, strong purification for
all. These are the two readings of "Every farmer who owns a donkey beats it". Sources:
Cooper 2023; Kanazawa 1994 for the readings.
"""

from __future__ import annotations

from ttr.building.constructors import Pi, fun, rectype
from ttr.computing.subtyping import subtype
from ttr.errors import IllFormedError
from ttr.judging.models import Model
from ttr.semantics.quantifiers.degrees_of_truth import Truth
from ttr.semantics.quantifiers.thresholds import Thresholds
from ttr.semantics.quantifiers.truth import truth
from ttr.signature.signature import Signature
from ttr.types.objects import BOUND, Object, Path, Record, record
from ttr.types.paths import replace_paths, shift_paths
from ttr.types.syntax import (
    Application,
    Function,
    FunType,
    RecordType,
    TypeNode,
    as_type,
    kind_of,
)

__all__ = ["apply", "content", "in_context", "strong", "weak"]


def content(
    bg: TypeNode, fg: Function | TypeNode, /, theory: Signature | None = None
) -> Record:
    """The parametric content {bg, fg}; a type as fg is the same in all contexts.

    Raises `IllFormedError` where bg is no record type, or not below the domain of fg.

    >>> from ttr import Ind, Pred, this
    >>> donkey, bray = Pred("donkey", Ind), Pred("bray", Ind)
    >>> Donkey = rectype(x=Ind, c=donkey(this.x))
    >>> print(content(Donkey, fun(r=Donkey)(bray(this.r.x))))
    {bg = [x : Ind, c : donkey(x)], fg = \\r:[x : Ind, c : donkey(x)]. bray(r.x)}
    """
    if not isinstance(bg, RecordType):
        raise IllFormedError(f"a background is a record type, found {kind_of(bg)}")
    if not isinstance(fg, Function):
        fg = fun(r=bg)(as_type(fg))
    covered = subtype(bg, as_type(fg.domain), theory)
    if not covered.yes:
        raise IllFormedError(
            f"the foreground {fg} does not take the contexts of the background {bg}: "
            f"{covered.why}"
        )
    return record(bg=bg, fg=fg)


def weak(of: Record, /) -> RecordType:
    """The weak purification: there is a context of which the foreground is true.

    >>> from ttr import Ind, Pred, this
    >>> Donkey = rectype(x=Ind, c=Pred("donkey", Ind)(this.x))
    >>> bray = fun(r=Donkey)(Pred("bray", Ind)(this.r.x))
    >>> print(weak(content(Donkey, bray)))
    [bg : [x : Ind, c : donkey(x)], fg : bray(bg.x)]
    """
    bg, fg = _parts(of)
    return rectype(bg=as_type(shift_paths(bg, 1)), fg=as_type(_body_at(fg, "bg")))


def strong(of: Record, /) -> FunType:
    """The strong purification: the foreground is true of every context.

    >>> from ttr import Ind, Pred, this
    >>> Donkey = rectype(x=Ind, c=Pred("donkey", Ind)(this.x))
    >>> bray = fun(r=Donkey)(Pred("bray", Ind)(this.r.x))
    >>> print(strong(content(Donkey, bray)))
    ((r : [x : Ind, c : donkey(x)]) -> bray(r.x))
    """
    bg, fg = _parts(of)
    return Pi(bg=bg)(as_type(_body_at(fg, "bg")))


def apply(function: Record, argument: Record, /) -> Record:
    """The content of a phrase made of a function and its argument.

    A context for it has a context for each part, under the labels f and a:
    {bg = [f : bg₁, a : bg₂], fg = λr. fg₁(r.f)(fg₂(r.a))}.

    >>> from ttr import Ind, Pred, rectype, this
    >>> Sam = rectype(x=Ind @ "sam")
    >>> sam = content(Sam, fun(r=Sam)(this.r.x))
    >>> run = fun(x=Ind)(Pred("run", Ind)(this.x))
    >>> print(apply(content(rectype(), fun(r=rectype())(run)), sam).bg)
    [a : [x = sam : Ind], f : Rec]
    """
    bg_f, fg_f = _parts(function)
    bg_a, fg_a = _parts(argument)
    bg = rectype(f=as_type(shift_paths(bg_f, 1)), a=as_type(shift_paths(bg_a, 1)))
    body = Application(_body_at(fg_f, "r", "f"), _body_at(fg_a, "r", "a"))
    return record(bg=bg, fg=fun(r=bg)(body))


def in_context(
    M: Model, of: Record, r: object, thresholds: Thresholds | None = None, /
) -> Truth:
    """How certain a content is in one context.

    Raises `RefusedError` where r is not certainly of the background.

    >>> from ttr import Ind, Model, Pred, record, rectype, this
    >>> Donkey = rectype(x=Ind, c=Pred("donkey", Ind)(this.x))
    >>> brays = content(Donkey, fun(r=Donkey)(Pred("bray", Ind)(this.r.x)))
    >>> M = Model().given("eeyore", Ind).given("s1", Pred("donkey", Ind)("eeyore"))
    >>> M = M.given("s2", Pred("bray", Ind)("eeyore"))
    >>> print(in_context(M, brays, record(x="eeyore", c="s1")).p)
    1
    """
    _, fg = _parts(of)
    return truth(M, as_type(M.apply(fg, r)), thresholds)


def _parts(of: object) -> tuple[RecordType, Function]:
    if isinstance(of, Record) and set(of) == {"bg", "fg"}:
        bg, fg = of._fields["bg"], of._fields["fg"]
        if isinstance(bg, RecordType) and isinstance(fg, Function):
            return bg, fg
    raise IllFormedError(
        f"a parametric content is a record {{bg, fg}}, found {kind_of(of)}",
        hint="build it with content(bg, fg)",
    )


def _body_at(f: Function, *labels: str) -> Object:
    """The body of a function with the path of these labels for its variable."""

    def at(path: Path) -> Object:
        if path.up > 0 or path.labels[0] != BOUND:
            return path
        return Path(0, (*labels, *path.labels[1:]))

    return replace_paths(f.body, at)
