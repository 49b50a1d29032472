"""Values as they are drawn in papers: in a terminal, with LaTeX, on a web page."""

from __future__ import annotations

from collections.abc import Callable
from types import BuiltinFunctionType, FunctionType, ModuleType, NoneType
from typing import TYPE_CHECKING

from ttr.display.abbreviations import folding
from ttr.display.html import derivation_as_html, layout_as_html
from ttr.display.latex import derivation_as_latex, layout_as_latex
from ttr.display.layout import Layout, Line, Sign, Step, Word, laid_out
from ttr.display.text import derivation_as_text, layout_as_text
from ttr.errors import IllFormed
from ttr.judging.judgements import Judgement, Why, mark
from ttr.safety.budgets import within_budget
from ttr.types.interning import Node
from ttr.types.notebooks import Drawn, as_html, as_latex
from ttr.types.syntax import Object, Record, freeze

if TYPE_CHECKING:
    from ttr.signature.signature import Signature

__all__ = ["box", "html", "latex"]


@within_budget
def box(
    value: object,
    *,
    unfold: int | None = None,
    theory: Signature | None = None,
    width: int = 80,
) -> str:
    """The value as text on several lines, in `width` columns where it can be done.

    Takes a type, an object, a judgement or its `why`. With `unfold=0` the names of the
    theory stand for what they are defined as, with `unfold=1` one level of definitions
    is opened, and so on. Raises `IllFormed` for a wrong number and for what is none of
    these, as a theory; `Unsupported` for what nests too deep.

    >>> from ttr import Ind, Pred, rectype, this
    >>> print(box(rectype(x=Ind, c=Pred("dog", Ind)(this.x))))
    ⎡x : Ind   ⎤
    ⎣c : dog(x)⎦
    """
    if type(width) is not int or width < 1:
        raise IllFormed(f"a width is a number of columns, 1 or more, found {width!r}")
    shown = _showing(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_text(_step(value, shown), width)
    return layout_as_text(_shown(value, shown), width)


@within_budget
def latex(
    value: object, *, unfold: int | None = None, theory: Signature | None = None
) -> str:
    r"""The value as LaTeX for mathematics, without the dollars around it.

    It needs amsmath, and neither other packages nor macros of its own; MathJax 2 and 3
    and KaTeX read it too. For values, `unfold` and errors see `box`.

    >>> from ttr import Ind, Pred
    >>> print(latex(Pred("dog", Ind)("fido")))
    \mathrm{dog}(\mathrm{fido})
    """
    shown = _showing(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_latex(_step(value, shown))
    return layout_as_latex(_shown(value, shown))


@within_budget
def html(
    value: object, *, unfold: int | None = None, theory: Signature | None = None
) -> str:
    """The value as a piece of a web page: tables, with their style and no script.

    It takes the colours of the page. Copied as text, it is notation. For values,
    `unfold` and errors see `box`.
    """
    shown = _showing(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_html(_step(value, shown))
    return layout_as_html(_shown(value, shown))


_Shown = Callable[[Object], Layout]


def _showing(theory: Signature | None, unfold: int | None) -> _Shown:
    fold = folding(theory, unfold)
    return lambda value: laid_out(fold(value))


def _shown(value: object, shown: _Shown) -> Layout:
    if not isinstance(value, Judgement):
        return shown(_drawable(value))
    degree = (Word("p", "variable"), Sign(" = "), Word(str(value.p), "text"))
    claim = _claim(value, shown)
    return Line((*claim.parts, Sign("   "), *degree))


_OF_PYTHON = (NoneType, type, FunctionType, BuiltinFunctionType, ModuleType)
"""What is a slip where an object is to be drawn."""


def _drawable(value: object) -> Object:
    """The value as an object; raises `IllFormed` for theories, models, answers, …

    What stands for a record, as a meaning does, is drawn as that record.
    """
    kept = isinstance(value, Node | Record)
    behind = None if kept else getattr(value, "record", None)
    found = behind if isinstance(behind, Record) else freeze(value)
    kind: type = type(found)
    is_ours = kind.__module__.startswith("ttr.")
    if isinstance(found, _OF_PYTHON) or (is_ours and not isinstance(found, Drawn)):
        raise IllFormed(
            "types, objects, judgements and derivations are drawn, "
            f"found {kind.__name__}"
        )
    return found


def _claim(value: Judgement | Why, shown: _Shown) -> Line:
    return Line((shown(value.sit), Sign(" : "), shown(value.type)))


# --- derivations ---------------------------------------------------------------------


def _step(why: Why, shown: _Shown) -> Step:
    """A derivation; what is likely does not fail, so nothing is pointed at then."""
    return _follow(why, shown, why.failure() if why.p.lo == 0.0 else None)


def _follow(why: Why, shown: _Shown, failing: Why | None) -> Step:
    """The step with those below it; `failing` is the one that fails, if it is here."""
    guilty = _guilty(why, failing)
    parts = [_follow(p, shown, failing if p is guilty else None) for p in why.parts]
    because = why.because
    return Step(
        mark(why.p),
        why.where,
        _claim(why, shown),
        because,
        tuple(parts),
        fails=failing is not None,
    )


def _guilty(why: Why, failing: Why | None) -> Why | None:
    """The part with the step that fails, if there is one."""
    if failing is None or why is failing:
        return None
    return next(part for part in why.parts if part.failure() is failing)


as_html.provided_by(html)
as_latex.provided_by(latex)
