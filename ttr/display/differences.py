"""Marks the fields in which a value differs from an earlier one, or from others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ttr.display.layout import Layout, Matrix, Row, Word, layout_of
from ttr.types.interning import identity
from ttr.types.objects import Object, Record

_FEW = 3
"""Up to this many fields that are the same are shown; more are counted."""


def layout_of_changes(before: Object, after: Object) -> Layout:
    """The layout of a value, with the fields marked that have changed.

    In nested records, the innermost fields that have changed are marked.

    >>> from ttr import record
    >>> layout = layout_of_changes(record(x="a", y="b"), record(x="a", y="c"))
    >>> [(row.label.text, row.changed) for row in layout.rows]
    [('x', False), ('y', True)]
    """
    return mark_changes(layout_of(after), before, after)


def mark_changes(layout: Layout, before: Object, after: Object) -> Layout:
    """The layout of `after` with the fields marked that have changed since `before`."""
    match layout, before, after:
        case Matrix(rows=rows), Record(), Record() if len(after):
            marked = []
            for row in rows:
                label = row.label.text
                if label not in after:  # it stands for those left out
                    marked.append(row)
                    continue
                if label not in before:
                    marked.append(replace(row, changed=True))
                    continue
                was, now = before[label], after[label]
                if isinstance(was, Record) and isinstance(now, Record) and len(now):
                    marked.append(replace(row, has=mark_changes(row.has, was, now)))
                    continue
                marked.append(replace(row, changed=identity(was) != identity(now)))
            return replace(layout, rows=tuple(marked))
    return layout


def mark_differences(layout: Layout, others: Sequence[Layout]) -> Layout:
    """Mark the fields of a layout that are not the same in all others.

    Of fields that are matrices everywhere, the innermost fields are marked.

    >>> from ttr import record
    >>> one, other = layout_of(record(x="a", y="b")), layout_of(record(x="a", y="c"))
    >>> [(row.label.text, row.changed) for row in mark_differences(one, [other]).rows]
    [('x', False), ('y', True)]
    """
    if not isinstance(layout, Matrix):
        return layout
    if not all(isinstance(it, Matrix) for it in others):
        return replace(
            layout, rows=tuple(replace(it, changed=True) for it in layout.rows)
        )
    matrices = [it for it in others if isinstance(it, Matrix)]
    rows = (
        _mark_row(it, [_row(of, it.label) for of in matrices]) for it in layout.rows
    )
    return replace(layout, rows=tuple(rows))


def _mark_row(row: Row, others: Sequence[Row | None]) -> Row:
    if all(it == row for it in others):
        return row
    known = [it for it in others if it is not None]
    inside = [it.has for it in known]
    deeper = (
        len(known) == len(others)
        and all(it.manifest == row.manifest for it in known)
        and all(isinstance(it, Matrix) for it in (row.has, *inside))
    )
    if deeper:
        return replace(row, has=mark_differences(row.has, inside))
    return replace(row, changed=True)


def _row(matrix: Matrix, label: Word) -> Row | None:
    return next((it for it in matrix.rows if it.label == label), None)


def omit_common_fields(layout: Layout) -> Layout:
    """Replace the fields that are the same in all by how many they are."""
    if not isinstance(layout, Matrix):
        return layout
    same = sum(_count_fields(row) for row in layout.rows if not _differs(row))
    rows = [_omit_inside(row) for row in layout.rows if same <= _FEW or _differs(row)]
    if same > _FEW:
        count = Word(f"{same} fields as in all", "text")
        rows.append(Row(Word("…", "text"), None, count))
    return replace(layout, rows=tuple(rows))


def _count_fields(row: Row) -> int:
    return sum(map(_count_fields, row.has.rows)) if isinstance(row.has, Matrix) else 1


def _omit_inside(row: Row) -> Row:
    return (
        replace(row, has=omit_common_fields(row.has)) if _differs_inside(row) else row
    )


def _differs(row: Row) -> bool:
    """Is a row marked, or a field in it?"""
    return row.changed or _differs_inside(row)


def _differs_inside(row: Row) -> bool:
    return isinstance(row.has, Matrix) and any(map(_differs, row.has.rows))
