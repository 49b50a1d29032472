"""Draws values as in papers: in a terminal, in LaTeX, on a web page."""

from __future__ import annotations

from ttr.display.html import derivation_as_html, layout_as_html
from ttr.display.latex import derivation_as_latex, layout_as_latex
from ttr.display.parts_in_html import parts_as_html
from ttr.display.parts_in_latex import parts_as_latex
from ttr.display.pieces import (
    drawable,
    has_parts,
    layout_function,
    layout_of_value,
    step_of,
)
from ttr.display.room import WORDS, room_for
from ttr.display.text import derivation_as_text, layout_as_text
from ttr.errors import IllFormedError, TTRError
from ttr.judging.judgements import Why
from ttr.safety.budgets import within_budget
from ttr.showing import In, Part, Text, Value, as_html, as_latex
from ttr.signature.signature import Signature


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
    to_layout = layout_function(theory, unfold)
    if isinstance(value, Why):
        return derivation_as_text(step_of(value, to_layout), width)
    return layout_as_text(layout_of_value(drawable(value), to_layout), width)


@within_budget
def latex(
    value: object, *, unfold: int | None = None, theory: Signature | None = None
) -> str:
    r"""The value as LaTeX for mathematics, without the dollars around it.

    It needs amsmath, but no other packages and no macros; MathJax 2, MathJax 3 and
    KaTeX take it as well. A type, an object, a judgement or its `why` is drawn in full,
    with `unfold` as in `box`; of a theory, a model, a rule, a game, a turn and whatever
    else a notebook draws there is as much as it shows. Raises as `box`, and
    `IllFormedError` for what is a picture, such as a look.

    >>> from ttr import Ind, Pred
    >>> print(latex(Pred("dog", Ind)("fido")))
    \mathrm{dog}(\mathrm{fido})
    """
    to_layout = layout_function(theory, unfold)
    if has_parts(value):
        with room_for(WORDS):
            drawn = parts_as_latex(_parts(value, theory))
        if drawn is None:
            raise IllFormedError(f"a picture has no LaTeX, found {_kind(value)}")
        return drawn
    if isinstance(value, Why):
        return derivation_as_latex(step_of(value, to_layout))
    return layout_as_latex(layout_of_value(drawable(value), to_layout))


@within_budget
def html(
    value: object, *, unfold: int | None = None, theory: Signature | None = None
) -> str:
    """The value as a part of a web page: tables with their style, and no script.

    Its colours are those of the page. When it is copied, the notation is copied. For
    values, `unfold` and errors see `latex`; pictures are in it.

    >>> from ttr import Ind, rectype
    >>> "<script" in html(rectype(x=Ind)), "Ind" in html(rectype(x=Ind))
    (False, True)
    """
    to_layout = layout_function(theory, unfold)
    if has_parts(value):
        with room_for(WORDS):
            return parts_as_html(_parts(value, theory))
    if isinstance(value, Why):
        return derivation_as_html(step_of(value, to_layout))
    return layout_as_html(layout_of_value(drawable(value), to_layout))


def _parts(value: object, theory: Signature | None) -> Part:
    """What a value is shown as: itself, if it says nothing else."""
    shown: Part = value._shown_as_() if has_parts(value) else Value(value)  # type: ignore[attr-defined]
    return shown if theory is None else In(theory, shown)


def _kind(value: object) -> str:
    return type(value).__name__


# --- in a notebook -------------------------------------------------------------------


@as_html.provided_by
def notebook_html(value: object) -> str:
    """The value as a notebook shows it: as much as there is room for; never an error.

    What is large is folded; what cannot be drawn is replaced by the reason.
    """
    try:
        return _bounded_html(value)
    except TTRError as error:
        return parts_as_html(Text(error.message, "quiet"))


@as_latex.provided_by
def notebook_latex(value: object) -> str | None:
    """The same as LaTeX; None for what has none, such as a picture."""
    try:
        return _bounded_latex(value)
    except TTRError:
        return None


@within_budget
def _bounded_html(value: object) -> str:
    with room_for(WORDS):
        return parts_as_html(_parts(value, None))


@within_budget
def _bounded_latex(value: object) -> str | None:
    with room_for(WORDS):
        return parts_as_latex(_parts(value, None))
