"""Values that draw themselves in a notebook."""

from __future__ import annotations

__all__ = ["Drawn"]


class Drawn:
    """Something that a notebook shows as it is drawn in papers.

    >>> from ttr.syntax import Ind
    >>> Ind._repr_latex_()
    '$\\\\displaystyle \\\\mathit{Ind}$'
    """

    __slots__ = ()

    def _repr_html_(self) -> str:
        from ttr.render import html

        return html(self)

    def _repr_latex_(self) -> str:
        from ttr.render import latex

        return f"$\\displaystyle {latex(self)}$"
