r"""Tables as LaTeX, to be put into a paper by \input; they need only amsmath."""

from __future__ import annotations

from collections.abc import Iterator

from kille.lab.results import Cell, Table, format_cell
from ttr.display.latex import latex_text


def latex_table(table: Table) -> str:
    r"""Format a table as a tabular, with its title and note as comments above it.

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
    columns = range(len(table.columns))
    sides = "".join("r" if table.has_numbers(it) else "l" for it in columns)
    yield f"\\begin{{tabular}}{{{sides}}}"
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
    text = format_cell(cell)
    return "--" if text == format_cell(None) else f"${text}$"
