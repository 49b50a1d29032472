"""Values that a notebook shows as they are drawn in papers."""

from __future__ import annotations

from ttr.hooks import hook


@hook
def as_html(value: object) -> str:
    """The value as HTML: `ttr.display.render.html`."""
    raise NotImplementedError


@hook
def as_latex(value: object) -> str:
    """The value as LaTeX: `ttr.display.render.latex`."""
    raise NotImplementedError


class NotebookValue:
    """A value that a notebook shows as it is drawn in papers.

    >>> from ttr import Ind
    >>> Ind._repr_latex_()
    '$\\\\displaystyle \\\\mathit{Ind}$'
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        return as_html(self)

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {as_latex(self)}$"
