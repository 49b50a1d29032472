"""Theories side by side: as the matrices of papers, with what differs standing out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import cycle
from typing import NamedTuple

from kille.lab.reports.figure_styles import HUES
from ttr import Record
from ttr.display.html import part_of_page
from ttr.display.layout import Layout, Matrix, Row, Word, layout_of
from ttr.escapes import html_text
from ttr.types import TypeNode

Described = Mapping[str, object]
"""A theory by the names of its parts: types and records, texts, and texts by name."""

_FEW = 3
"""So many fields that are the same are shown, not counted."""


def side_by_side(theories: Mapping[str, Described]) -> Iterator[str]:
    """The theories as a piece of a page, part by part; last what is the same in all.

    Theories that are alike in a part stand there together.
    """
    parts = dict.fromkeys(part for it in theories.values() for part in it)
    hues = dict(zip(theories, cycle(HUES), strict=False))
    same: dict[str, object] = {}
    for part in parts:
        groups = _groups({name: it.get(part) for name, it in theories.items()})
        if len(groups) == 1:
            same[part] = groups[0].value
            continue
        yield f"<h3>{html_text(part)}</h3>"
        yield from _apart(groups, hues)
    yield from _the_same({part: it for part, it in same.items() if it}, len(theories))


class _Group(NamedTuple):
    """What some theories have in common."""

    names: Sequence[str]
    value: object


def _groups(values: Mapping[str, object]) -> list[_Group]:
    """The values that differ, each with the names of those that have it."""
    groups: list[_Group] = []
    for name, value in values.items():
        place = next((i for i, it in enumerate(groups) if _same(value, it.value)), None)
        if place is None:
            groups.append(_Group([name], value))
        else:
            groups[place] = _Group([*groups[place].names, name], value)
    return groups


def _apart(groups: Sequence[_Group], hues: Mapping[str, str]) -> Iterator[str]:
    values = [it.value for it in groups]
    if all(map(_is_listed, values)):
        yield from _listed(groups, hues)
    elif all(isinstance(it, str) for it in values):
        lines = (
            f"<dt>{_called(it.names, hues)}</dt><dd>{_value(it.value)}</dd>"
            for it in groups
            if it.value
        )
        yield f"<dl>{''.join(lines)}</dl>"
    else:
        yield from _drawn(groups, hues)


def _the_same(parts: Mapping[str, object], count: int) -> Iterator[str]:
    """What all have in common, folded; what it is about is said."""
    about = parts.get("about")
    if about:
        yield f"<p>{html_text(str(about))}</p>"
    folded = {part: it for part, it in parts.items() if part != "about"}
    if folded:
        head = "the same in all: " if count > 1 else ""
        inside = "".join(
            line for part, it in folded.items() for line in _folded(part, _value(it))
        )
        yield from _folded(f"{head}{', '.join(folded)}", inside)


# --- matrices ------------------------------------------------------------------------


def apart(layout: Layout, others: Sequence[Layout]) -> Layout:
    """The layout with those fields marked that are not the same in all others.

    Of fields that are matrices everywhere, the innermost fields are marked.

    >>> from ttr import record
    >>> one, other = layout_of(record(x="a", y="b")), layout_of(record(x="a", y="c"))
    >>> [(row.label.text, row.changed) for row in apart(one, [other]).rows]
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
        _row_apart(it, [_row(of, it.label) for of in matrices]) for it in layout.rows
    )
    return replace(layout, rows=tuple(rows))


def _row_apart(row: Row, others: Sequence[Row | None]) -> Row:
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
        return replace(row, has=apart(row.has, inside))
    return replace(row, changed=True)


def _row(matrix: Matrix, label: Word) -> Row | None:
    return next((it for it in matrix.rows if it.label == label), None)


def shortened(layout: Layout) -> Layout:
    """The layout without the fields that are the same in all: it says how many."""
    if not isinstance(layout, Matrix):
        return layout
    same = sum(_fields(row) for row in layout.rows if not _differs(row))
    rows = [_shortened(row) for row in layout.rows if same <= _FEW or _differs(row)]
    if same > _FEW:
        told = Word(f"{same} fields as in all", "text")
        rows.append(Row(Word("…", "text"), None, told))
    return replace(layout, rows=tuple(rows))


def _fields(row: Row) -> int:
    return sum(map(_fields, row.has.rows)) if isinstance(row.has, Matrix) else 1


def _shortened(row: Row) -> Row:
    return replace(row, has=shortened(row.has)) if _differs_inside(row) else row


def _differs(row: Row) -> bool:
    """Whether it is marked, or has a field that is."""
    return row.changed or _differs_inside(row)


def _differs_inside(row: Row) -> bool:
    return isinstance(row.has, Matrix) and any(map(_differs, row.has.rows))


def _drawn(groups: Sequence[_Group], hues: Mapping[str, str]) -> Iterator[str]:
    layouts = [_layout(it.value) for it in groups]
    short, whole = [], []
    for place, (group, layout) in enumerate(zip(groups, layouts, strict=True)):
        if layout is None:
            short.append(_value(group.value))
            whole.append(short[-1])
            continue
        others = [it for i, it in enumerate(layouts) if i != place and it]
        marked = apart(layout, others)
        short.append(part_of_page(shortened(marked)))
        whole.append(part_of_page(marked))
    names = [it.names for it in groups]
    yield _columns(names, short, hues)
    if short != whole:
        yield from _folded("with all fields", _columns(names, whole, hues))


def _same(one: object, other: object) -> bool:
    """Whether two parts are the same; of types and records, whether they read so."""
    return one == other or (_layout(one) is not None and _layout(one) == _layout(other))


def _layout(value: object) -> Layout | None:
    return layout_of(value) if isinstance(value, TypeNode | Record) else None


def _value(value: object) -> str:
    if isinstance(value, TypeNode | Record):
        return part_of_page(layout_of(value))
    if isinstance(value, Mapping):
        return _names(value)
    return f"<div>{_text(str(value))}</div>" if value else "<p>–</p>"


def _columns(
    names: Sequence[Sequence[str]], inside: Sequence[str], hues: Mapping[str, str]
) -> str:
    cards = (
        f'<div style="--hue: {hues[some[0]]}"><h4>{_called(some, hues)}</h4>{it}</div>'
        for some, it in zip(names, inside, strict=True)
    )
    return f'<div class="theories">{"".join(cards)}</div>'


def _called(names: Sequence[str], hues: Mapping[str, str]) -> str:
    """The names of theories, each with its hue where there are several."""
    if len(names) == 1:
        return html_text(names[0])
    return "".join(
        f'<span class="of" style="--hue: {hues[name]}">{html_text(name)}</span>'
        for name in names
    )


def _folded(summary: str, inside: str) -> Iterator[str]:
    yield f"<details><summary>{html_text(summary)}</summary>{inside}</details>"


# --- texts by name -------------------------------------------------------------------


def _is_listed(value: object) -> bool:
    return value is None or (
        isinstance(value, Mapping) and not isinstance(value, Record)
    )


def _listed(groups: Sequence[_Group], hues: Mapping[str, str]) -> Iterator[str]:
    """First the entries that differ, one a row; then the names of all others."""
    lists = [dict(it.value) if isinstance(it.value, Mapping) else {} for it in groups]
    entries = {name: [it.get(name) for it in lists] for it in lists for name in it}
    differing = {name: of for name, of in entries.items() if len(set(map(str, of))) > 1}
    if differing:
        heads = "".join(f"<th>{_called(it.names, hues)}</th>" for it in groups)
        yield '<div class="scroll"><table><thead><tr><th></th>'
        yield f"{heads}</tr></thead><tbody>"
        for name, of in differing.items():
            yield f"<tr><td><code>{html_text(name)}</code></td>{_row_of(of)}</tr>"
        yield "</tbody></table></div>"
    same = {name: of[0] for name, of in entries.items() if name not in differing}
    if same:
        yield from _folded(f"{len(same)} the same in all", _names(same))


def _row_of(entries: Sequence[object]) -> str:
    """An entry of each, types as matrices in which what differs is marked."""
    layouts = [_layout(it) for it in entries]
    cells = []
    for place, (entry, layout) in enumerate(zip(entries, layouts, strict=True)):
        if layout is None:
            cells.append(_entry(entry))
            continue
        others = [it for i, it in enumerate(layouts) if i != place and it]
        marked = part_of_page(apart(layout, others))
        cells.append(f'<td class="type">{marked}</td>')
    return "".join(cells)


def _names(texts: Mapping[str, object]) -> str:
    lines = (
        f"<dt><code>{html_text(name)}</code></dt><dd>{_text(str(text))}</dd>"
        for name, text in texts.items()
    )
    return f"<dl>{''.join(lines)}</dl>"


def _entry(text: object) -> str:
    if text is None:
        return '<td class="apart">–</td>'
    return f'<td class="apart">{_text(str(text))}</td>'


def _text(text: str) -> str:
    """A text; one of several lines is code."""
    return f"<pre>{html_text(text)}</pre>" if "\n" in text else html_text(text)
