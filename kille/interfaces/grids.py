"""Results in a terminal: tables as they are, transposed, or in parts, as they fit."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from textwrap import wrap

from rich.cells import cell_len
from rich.console import Console
from rich.table import Table as Grid
from rich.text import Text

from kille.interfaces.terminal import COLUMNS_OF_A_PIPE, console
from kille.lab.results import Cell, Result, Table, format_cell
from ttr.escapes import terminal_line

_GAP = 2  # columns between those of a table


def results_console() -> Console:
    """The console for results; a pipe is as wide as `COLUMNS` says, or 100 columns."""
    out = console()
    if not out.is_terminal and "COLUMNS" not in os.environ:
        out.width = COLUMNS_OF_A_PIPE
    return out


def print_result(out: Console, result: Result) -> None:
    """Print a result: its title, what there is to see, and its tables."""
    out.print(Text(f"\n{result.title}", style="bold"), soft_wrap=False)
    print_findings(out, result)
    for table in result.tables:
        print_table(out, table)


def print_findings(out: Console, result: Result) -> None:
    """Print what there is to see in a result, if it says so."""
    if result.text:
        out.print(Text(f"\n{result.text}"), soft_wrap=False)


def print_table(out: Console, table: Table) -> None:
    """Print the table as it is, transposed, in parts, or row by row, as it fits."""
    table = replace(table, columns=tuple(map(terminal_line, table.columns)))
    out.print(Text(f"\n{table.title}", style="italic"), soft_wrap=False)
    for number, part in enumerate(_fit_table(table, out.width)):
        out.print("\n" * bool(number), end="")
        out.print(_grid(part, out.width), soft_wrap=False)
    if table.note:
        out.print(Text(table.note, style="dim"), soft_wrap=False)


def _format_cell(cell: Cell) -> str:
    return terminal_line(format_cell(cell))


def _fit_table(table: Table, width: int) -> Sequence[Table]:
    if _width(table) <= width:
        return [table]
    turned = _transpose(table)
    if _width(turned) <= width:
        return [turned]
    parts = _parts(table, width)
    if all(_width(part) <= width for part in parts):
        return parts
    return [_transpose(replace(table, rows=(row,))) for row in table.rows] or [turned]


def _parts(table: Table, width: int) -> list[Table]:
    """Split the columns so that each part fits, with those that name the rows."""
    count, names = len(table.columns), [*range(_count_naming_columns(table))]
    parts = [[*range(min(len(names) + 1, count))]]
    for column in range(len(names) + 1, count):
        if _width(_some(table, [*parts[-1], column])) <= width:
            parts[-1].append(column)
        else:
            parts.append([*names, column])
    return [_some(table, part) for part in parts]


def _count_naming_columns(table: Table) -> int:
    """How many columns name the row: those before the first of numbers."""
    columns = range(len(table.columns))
    return max(next(filter(table.has_numbers, columns), 1), 1)


def _some(table: Table, places: Sequence[int]) -> Table:
    columns = tuple(table.columns[place] for place in places)
    rows = tuple(tuple(row[place] for place in places) for row in table.rows)
    return replace(table, columns=columns, rows=rows)


def _transpose(table: Table) -> Table:
    """The table with rows and columns exchanged."""
    columns = zip(
        table.columns, *(map(_format_cell, row) for row in table.rows), strict=True
    )
    heads, *rows = columns
    return replace(table, columns=heads, rows=tuple(rows))


def _widths(table: Table, lines: int) -> list[int]:
    """The width of each column if its head may take this many lines."""
    return [
        max(
            [
                _narrowest(head, lines),
                *(cell_len(_format_cell(row[i])) for row in table.rows),
            ]
        )
        for i, head in enumerate(table.columns)
    ]


def _narrowest(head: str, lines: int) -> int:
    """The least width at which the head takes at most this many lines, unbroken."""
    least = max(map(cell_len, head.split()), default=1)
    whole = max(cell_len(head), 1)
    return next(
        it for it in range(least, whole + 1) if len(_break_head(head, it)) <= lines
    )


def _break_head(head: str, width: int) -> list[str]:
    return wrap(head, width, break_long_words=False, break_on_hyphens=False)


def _height(table: Table) -> int:
    """The number of lines of the highest head at its least width."""
    return max(len(head.split()) for head in table.columns) or 1


def _width(table: Table, lines: int | None = None) -> int:
    """The columns of a terminal that it takes; the least, if lines do not matter."""
    widths = _widths(table, lines or _height(table))
    return sum(widths) + _GAP * (len(widths) - 1)


def _flattest(table: Table, width: int) -> int:
    """The fewest lines of a head with which the table fits."""
    most = _height(table)
    fitting = (it for it in range(1, most) if _width(table, it) <= width)
    return next(fitting, most)


def _grid(table: Table, width: int) -> Grid:
    grid = Grid(
        box=None,
        collapse_padding=True,
        pad_edge=False,
        padding=(0, _GAP, 0, 0),
        header_style="bold",
    )
    widths = _widths(table, _flattest(table, width))
    for place, (head, room) in enumerate(zip(table.columns, widths, strict=True)):
        grid.add_column(
            Text("\n".join(_break_head(head, room))),
            justify="right" if table.has_numbers(place) else "left",
            vertical="top",
            overflow="fold",
        )
    for row in table.rows:
        grid.add_row(*(Text(_format_cell(cell)) for cell in row))
    return grid
