"""Theories side by side: as the matrices of papers, with what differs standing out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from html import escape
from itertools import cycle

from kille.experiments.strokes import HUES
from ttr import Record, TypeNode
from ttr.display.layout import Layout, Matrix, Row, Word, laid_out
from ttr.display.markup import part_of_page

__all__ = ["STYLE", "apart", "shortened", "side_by_side"]

Described = Mapping[str, object]
"""A theory by the names of its parts: types and records, texts, and texts by name."""

_FEW = 3
"""So many fields that are the same are shown, not counted."""

STYLE = """
.theories { display: grid; gap: 1.2rem 1.4rem; align-items: start; margin: .8rem 0;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 17rem), 1fr)); }
.theories > div { min-width: 0; overflow-x: auto; border-top: 3px solid var(--hue);
  padding-top: .4rem; font-size: .75rem; }
.theories h4 { margin: 0 0 .3rem; font-size: .95rem; }
details { margin: .4rem 0; } summary { cursor: pointer; color: var(--quiet); }
.apart { background: rgba(229, 160, 13, .2); }
pre { font: .85em/1.45 ui-monospace, "DejaVu Sans Mono", monospace; overflow-x: auto;
  background: var(--soft); padding: .6rem .8rem; border-radius: .3rem; margin: .4rem 0;
  white-space: pre-wrap; overflow-wrap: anywhere; }
"""


def side_by_side(theories: Mapping[str, Described]) -> Iterator[str]:
    """The theories as a piece of a page, part by part; last what is the same in all."""
    parts = dict.fromkeys(part for it in theories.values() for part in it)
    same: list[str] = []
    for part in parts:
        values = {name: it.get(part) for name, it in theories.items()}
        (first, *others) = values.values()
        if all(_same(it, first) for it in others):
            same += _folded(part, _value(first)) if first else []
            continue
        yield f"<h3>{escape(part)}</h3>"
        if all(map(_is_listed, values.values())):
            yield from _listed(values)
        else:
            yield from _drawn(values)
    if same:
        yield "<h3>The same in all</h3>" if len(theories) > 1 else ""
        yield from same


# --- matrices ------------------------------------------------------------------------


def apart(layout: Layout, others: Sequence[Layout]) -> Layout:
    """The layout with those fields marked that are not the same in all others.

    Of fields that are matrices everywhere, the innermost fields are marked.

    >>> from ttr import record
    >>> one, other = laid_out(record(x="a", y="b")), laid_out(record(x="a", y="c"))
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


def _drawn(values: Mapping[str, object]) -> Iterator[str]:
    short, whole = {}, {}
    layouts = {name: _layout(it) for name, it in values.items()}
    for name, layout in layouts.items():
        short[name] = whole[name] = _value(values[name])
        if layout is None:
            continue
        others = [it for other, it in layouts.items() if other != name and it]
        marked = apart(layout, others)
        short[name] = part_of_page(shortened(marked))
        whole[name] = part_of_page(marked)
    yield _columns(short)
    if short != whole:
        yield from _folded("with all fields", _columns(whole))


def _same(one: object, other: object) -> bool:
    """Whether two parts are the same; of types and records, whether they read so."""
    return one == other or (_layout(one) is not None and _layout(one) == _layout(other))


def _layout(value: object) -> Layout | None:
    return laid_out(value) if isinstance(value, TypeNode | Record) else None


def _value(value: object) -> str:
    if isinstance(value, TypeNode | Record):
        return part_of_page(laid_out(value))
    if isinstance(value, Mapping):
        return _names(value)
    return f"<div>{_text(str(value))}</div>" if value else "<p>–</p>"


def _columns(inside: Mapping[str, str]) -> str:
    cards = (
        f'<div style="--hue: {hue}"><h4>{escape(name)}</h4>{it}</div>'
        for (name, it), hue in zip(inside.items(), cycle(HUES), strict=False)
    )
    return f'<div class="theories">{"".join(cards)}</div>'


def _folded(summary: str, inside: str) -> Iterator[str]:
    yield f"<details><summary>{escape(summary)}</summary>{inside}</details>"


# --- texts by name -------------------------------------------------------------------


def _is_listed(value: object) -> bool:
    return value is None or (
        isinstance(value, Mapping) and not isinstance(value, Record)
    )


def _listed(values: Mapping[str, object]) -> Iterator[str]:
    """First the entries that differ, one a row; then the names of all others."""
    lists = {
        name: dict(it) if isinstance(it, Mapping) else {} for name, it in values.items()
    }
    names = list(dict.fromkeys(entry for it in lists.values() for entry in it))
    texts = {entry: [it.get(entry) for it in lists.values()] for entry in names}
    differing = [entry for entry in names if len(set(map(str, texts[entry]))) > 1]
    if differing:
        heads = "".join(f"<th>{escape(name)}</th>" for name in lists)
        yield '<div class="scroll"><table><thead><tr><th></th>'
        yield f"{heads}</tr></thead><tbody>"
        for entry in differing:
            cells = "".join(_entry(text) for text in texts[entry])
            yield f"<tr><td><code>{escape(entry)}</code></td>{cells}</tr>"
        yield "</tbody></table></div>"
    same = {it: of[0] for it, of in texts.items() if it not in differing}
    if same:
        yield from _folded(f"{len(same)} the same in all", _names(same))


def _names(texts: Mapping[str, object]) -> str:
    lines = (
        f"<dt><code>{escape(name)}</code></dt><dd>{_text(str(text))}</dd>"
        for name, text in texts.items()
    )
    return f"<dl>{''.join(lines)}</dl>"


def _entry(text: object) -> str:
    if text is None:
        return '<td class="apart">–</td>'
    return f'<td class="apart">{_text(str(text))}</td>'


def _text(text: str) -> str:
    """A text; one of several lines is code."""
    return f"<pre>{escape(text)}</pre>" if "\n" in text else escape(text)
