"""Draws values as in papers: in a terminal, in LaTeX, on a web page."""

from __future__ import annotations

from collections.abc import Callable
from types import BuiltinFunctionType, FunctionType, ModuleType, NoneType

from ttr.display.abbreviations import abbreviator
from ttr.display.html import derivation_as_html, layout_as_html
from ttr.display.latex import derivation_as_latex, layout_as_latex
from ttr.display.layout import Layout, Line, Sign, Step, Word, layout_of
from ttr.display.text import derivation_as_text, layout_as_text
from ttr.errors import IllFormedError
from ttr.judging.judgements import Judgement, Why, mark
from ttr.safety.budgets import within_budget
from ttr.signature.signature import Signature
from ttr.types.interning import Node
from ttr.types.notebook_display import NotebookValue, as_html, as_latex
from ttr.types.objects import Object, Record, freeze


@within_budget
def box(
    value: object,
    *,
    unfold: int | None = None,
    theory: Signature | None = None,
    width: int = 80,
) -> str:
    """The value as text on several lines, in `width` columns if that is possible.

    The value is a type, an object, a judgement or its `why`. With `unfold=0`, the names
    of the theory stand for their definitions; with `unfold=1`, one level of definitions
    is shown in full, and so on. Raises `IllFormedError` for a wrong number and for any
    other value, such as a theory, and `UnsupportedError` for a value that nests too
    deep.

    >>> from ttr import Ind, Pred, rectype, this
    >>> print(box(rectype(x=Ind, c=Pred("dog", Ind)(this.x))))
    ⎡x : Ind   ⎤
    ⎣c : dog(x)⎦
    """
    if type(width) is not int or width < 1:
        raise IllFormedError(
            f"a width is a number of columns, 1 or more, found {width!r}"
        )
    to_layout = _layout_function(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_text(_step(value, to_layout), width)
    return layout_as_text(_layout(value, to_layout), width)


@within_budget
def latex(
    value: object, *, unfold: int | None = None, theory: Signature | None = None
) -> str:
    r"""The value as LaTeX for mathematics, without the dollars around it.

    It needs amsmath, but no other packages and no macros; MathJax 2, MathJax 3 and
    KaTeX take it as well. For values, `unfold` and errors see `box`.

    >>> from ttr import Ind, Pred
    >>> print(latex(Pred("dog", Ind)("fido")))
    \mathrm{dog}(\mathrm{fido})
    """
    to_layout = _layout_function(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_latex(_step(value, to_layout))
    return layout_as_latex(_layout(value, to_layout))


@within_budget
def html(
    value: object, *, unfold: int | None = None, theory: Signature | None = None
) -> str:
    """The value as a part of a web page: tables with their style, and no script.

    Its colours are those of the page. When it is copied, the notation is copied. For
    values, `unfold` and errors see `box`.
    """
    to_layout = _layout_function(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_html(_step(value, to_layout))
    return layout_as_html(_layout(value, to_layout))


_ToLayout = Callable[[Object], Layout]


def _layout_function(theory: Signature | None, unfold: int | None) -> _ToLayout:
    fold = abbreviator(theory, unfold)
    text = theory.spelling if isinstance(theory, Signature) else ()
    return lambda value: layout_of(fold(value), fold.spelling(text))


def _layout(value: object, to_layout: _ToLayout) -> Layout:
    if not isinstance(value, Judgement):
        return to_layout(_drawable(value))
    degree = (Word("p", "variable"), Sign(" = "), Word(str(value.p), "text"))
    claim = _claim(value, to_layout)
    return Line((*claim.parts, Sign("   "), *degree))


_OF_PYTHON = (NoneType, type, FunctionType, BuiltinFunctionType, ModuleType)
"""Kinds of Python objects that nobody means to draw."""


def _drawable(value: object) -> Object:
    """The value as an object; raises `IllFormedError` for a theory, a model, an answer,
    …

    A value that has a `record`, such as a meaning, is drawn as this record.
    """
    kept = isinstance(value, Node | Record)
    behind = None if kept else getattr(value, "record", None)
    found = behind if isinstance(behind, Record) else freeze(value)
    kind: type = type(found)
    is_ours = kind.__module__.startswith("ttr.")
    if isinstance(found, _OF_PYTHON) or (
        is_ours and not isinstance(found, NotebookValue)
    ):
        raise IllFormedError(
            "types, objects, judgements and derivations are drawn, "
            f"found {kind.__name__}"
        )
    return found


def _claim(value: Judgement | Why, to_layout: _ToLayout) -> Line:
    return Line((to_layout(value.sit), Sign(" : "), to_layout(value.type)))


# --- derivations ---------------------------------------------------------------------


def _step(why: Why, to_layout: _ToLayout) -> Step:
    """A derivation; it points at what fails only if the claim certainly fails."""
    return _follow(why, to_layout, why.failure() if why.p.lo == 0.0 else None)


def _follow(why: Why, to_layout: _ToLayout, failing: Why | None) -> Step:
    """The step and those below it; `failing` is the one of them that fails, if any."""
    branch = _part_with(why, failing)
    parts = [_follow(p, to_layout, failing if p is branch else None) for p in why.parts]
    because = why.because
    return Step(
        mark(why.p),
        why.where,
        _claim(why, to_layout),
        because,
        tuple(parts),
        fails=failing is not None,
    )


def _part_with(why: Why, failing: Why | None) -> Why | None:
    """The part that contains the failing step, if there is one."""
    if failing is None or why is failing:
        return None
    return next(part for part in why.parts if part.failure() is failing)


as_html.provided_by(html)
as_latex.provided_by(latex)
