r"""Tables as LaTeX, to be put into a paper by \input; they need only amsmath."""

from __future__ import annotations

from collections.abc import Iterator

from kille.lab.reports.result_pages import shown
from kille.lab.results import Cell, Estimate, Table
from ttr.display.latex import latex_text


def latex_table(table: Table) -> str:
    r"""The table as a tabular, its title and its note above it as comments.

    >>> print(latex_table(Table("A & B", ("theory", "p"), (("x_1", 0.25),))), end="")
    % A & B
    \begin{tabular}{lr}
    \hline
    $\text{theory}$ & $\text{p}$ \\
    \hline
    $\text{x}\_\text{1}$ & $0.250$ \\
    \hline
    \end{tabular}
    """
    return "\n".join(_lines(table)) + "\n"


def _lines(table: Table) -> Iterator[str]:
    for comment in filter(None, (table.title, table.note)):
        yield f"% {' '.join(comment.split())}"
    sides = [_side([row[i] for row in table.rows]) for i in range(len(table.columns))]
    yield f"\\begin{{tabular}}{{{''.join(sides)}}}"
    yield r"\hline"
    yield _row(table.columns)
    yield r"\hline"
    yield from map(_row, table.rows)
    yield r"\hline"
    yield r"\end{tabular}"


def _row(cells: tuple[Cell, ...]) -> str:
    return " & ".join(map(_cell, cells)) + r" \\"


def _cell(cell: Cell) -> str:
    if isinstance(cell, str):
        return f"${latex_text(cell)}$" if cell else ""
    told = shown(cell)
    return "--" if told == shown(None) else f"${told}$"


def _side(cells: list[Cell]) -> str:
    """Numbers stand to the right, words to the left."""
    is_number = all(
        it is None or isinstance(it, int | float | Estimate) for it in cells
    )
    return "r" if is_number else "l"
