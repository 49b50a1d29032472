"""Marks the fields in which a value differs from an earlier one."""

from __future__ import annotations

from dataclasses import replace

from ttr.display.layout import Layout, Matrix, layout_of
from ttr.types.interning import identity
from ttr.types.objects import Object, Record


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
