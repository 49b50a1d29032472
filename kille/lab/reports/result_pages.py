"""A page of HTML that holds all of a comparison: tables, figures, how to repeat it.

It needs nothing but itself, by day and by night, on a wide and on a narrow window.
Whatever comes from names and files is escaped.
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence

from kille.lab.reports.drawing import MISSING, can_draw, jpeg, svg
from kille.lab.results import Cell, Estimate, Figure, Result, Table, format_cell
from ttr.aliases import former_names
from ttr.escapes import html_text

__all__ = ["beginning", "ending", "file_of", "page", "section"]

__getattr__ = former_names(__name__, {"shown": "kille.lab.results:format_cell"})

_SHORT = 14  # characters: such cells are not broken
_LONGEST = 60  # characters in the name of a file
_STYLE = """
:root { color-scheme: light dark; --ink: #1d2129; --paper: #fbfbf9; --line: #d9dade;
  --soft: #f0f1f0; --quiet: #5b6270; --accent: #0072B2; --wrong: #D55E00; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e6ea; --paper: #16181d;
  --line: #363a44; --soft: #20232a; --quiet: #a2a9b6; --accent: #56B4E9; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 64rem; padding: 1.5rem clamp(.8rem, 4vw, 2.5rem) 4rem;
  background: var(--paper); color: var(--ink); font: 16px/1.55 system-ui, "Segoe UI",
  "DejaVu Sans", sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: .5rem 0 .4rem; }
h2 { font-size: 1.3rem; margin: 3rem 0 .6rem; padding-top: .8rem;
  border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1.6rem 0 .4rem; }
code { font: .9em ui-monospace, "DejaVu Sans Mono", monospace; background: var(--soft);
  padding: .1em .35em; border-radius: .3em; }
nav ul { padding-left: 1.2rem; } a { color: var(--accent); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .9rem .3rem 0; text-align: left; vertical-align: top;
  border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--quiet); font-size: .88rem;
  vertical-align: bottom; }
td.number, th.number { text-align: right; } td.short { white-space: nowrap; }
td a { color: inherit; text-decoration: none; border-bottom: 1px dotted var(--quiet); }
td a:hover, td a:focus { color: var(--accent); border-bottom-style: solid; }
td.number { white-space: nowrap; } .band { color: var(--quiet); font-size: .82em;
  margin-left: .5em; }
.note, .quiet { color: var(--quiet); font-size: .9rem; margin: .4rem 0;
  max-width: 48rem; }
.wrong { border-left: 3px solid var(--wrong); padding-left: .8rem; }
.figures { display: grid; gap: 1.5rem 2rem; align-items: start;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); }
figure { margin: 0; min-width: 0; } figure.broad { grid-column: 1 / -1; }
figure svg { max-width: 100%; height: auto; }
figcaption { font-weight: 600; margin-bottom: .4rem; }
.pictures { display: grid; gap: .8rem;
  grid-template-columns: repeat(auto-fill, minmax(8.5rem, 1fr)); }
.pictures > div { font-size: .78rem; line-height: 1.35; white-space: pre-line; }
.pictures img { width: 100%; aspect-ratio: 1; object-fit: contain; display: block;
  background: var(--soft); border: 2px solid var(--line); border-radius: .3rem;
  margin-bottom: .25rem; }
.pictures .bad img { border-color: var(--wrong); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1rem; }
dt { color: var(--quiet); } dd { margin: 0; min-width: 0; }
@media (max-width: 30rem) { dl { grid-template-columns: 1fr; }
  dd { margin-bottom: .4rem; } }
@media print { .scroll { overflow: visible; } figure { break-inside: avoid; } }
"""

_BROAD = ("map", "pictures")


def page(
    title: str,
    results: Sequence[Result],
    about: Mapping[str, str],
    failures: Sequence[str] = (),
) -> str:
    """The page; `about` says under which heads what it was made of, and how."""
    return "\n".join(_page(title, results, about, failures)) + "\n"


def _page(
    title: str,
    results: Sequence[Result],
    about: Mapping[str, str],
    failures: Sequence[str],
) -> Iterator[str]:
    yield from beginning(title)
    if "command" in about:
        yield f'<p class="quiet"><code>{html_text(about["command"])}</code></p>'
    for failure in failures:
        yield f'<p class="wrong">{html_text(failure)}</p>'
    if not can_draw():
        yield f'<p class="note">{html_text(MISSING)}</p>'
    yield from _contents(results)
    for number, result in enumerate(results, start=1):
        yield from section(number, result)
    yield from ending(about)


def beginning(title: str, style: str = "") -> Iterator[str]:
    """The head of a page and its title, with more style if it takes more."""
    yield "<!DOCTYPE html>"
    yield '<html lang="en"><head><meta charset="utf-8">'
    yield '<meta name="viewport" content="width=device-width, initial-scale=1">'
    title = html_text(title)
    yield f"<title>{title}</title><style>{_STYLE}{style}</style></head><body>"
    yield f"<h1>{title}</h1>"


def ending(about: Mapping[str, str]) -> Iterator[str]:
    """How all that was made, and the end of the page."""
    yield "<h2>How this was made</h2><dl>"
    for head, text in about.items():
        yield f"<dt>{html_text(head)}</dt><dd>{html_text(text)}</dd>"
    yield "</dl></body></html>"


def _contents(results: Sequence[Result]) -> Iterator[str]:
    if len(results) < 2:
        return
    yield "<nav><ul>"
    for number, result in enumerate(results, start=1):
        yield f'<li><a href="#part-{number}">{html_text(result.title)}</a></li>'
    yield "</ul></nav>"


def section(number: int, result: Result, drawn: str = "") -> Iterator[str]:
    """A part of a page, to which `#part-NUMBER` leads.

    `drawn` is the folder in which the figures lie as PDF files, if they do.
    """
    yield f'<section><h2 id="part-{number}">{html_text(result.title)}</h2>'
    if result.text:
        yield f"<p>{html_text(result.text)}</p>"
    for table in result.tables:
        yield from _table(table)
    if result.figures and can_draw():
        yield '<h3>Figures</h3><div class="figures">'
        for place, figure in enumerate(result.figures):
            file = f"{drawn}/{file_of(number, place, figure)}" if drawn else ""
            yield _figure(figure, 100 * number + place, file)
        yield "</div>"
    yield "</section>"


def file_of(number: int, place: int, of: Figure | Table, ending: str = ".pdf") -> str:
    """The name of the file of a figure or table at a place, from 0, of a part.

    >>> file_of(2, 0, Figure("curves", "Learning curve", {}))
    '2-1-learning-curve.pdf'
    """
    words = re.sub(r"[^a-z0-9]+", "-", of.title.lower()).strip("-")
    return f"{number}-{place + 1}-{words}"[:_LONGEST] + ending


def _table(table: Table) -> Iterator[str]:
    kinds = [_column_class(table, place) for place in range(len(table.columns))]
    yield f'<h3>{html_text(table.title)}</h3><div class="scroll"><table><thead><tr>'
    yield "".join(
        f"<th{kind}>{html_text(head)}</th>"
        for head, kind in zip(table.columns, kinds, strict=True)
    )
    yield "</tr></thead><tbody>"
    for i, row in enumerate(table.rows):
        cells = (
            f"<td{kind}>{_cell(it, table.links.get((i, j), ''))}</td>"
            for j, (it, kind) in enumerate(zip(row, kinds, strict=True))
        )
        yield f"<tr>{''.join(cells)}</tr>"
    yield "</tbody></table></div>"
    if table.note:
        yield f'<p class="note">{html_text(table.note)}</p>'


def _cell(cell: Cell, to: str) -> str:
    """The cell, its band in small; it leads to where it is said that it does."""
    told, _, band = format_cell(cell).partition(" [")
    text = html_text(told if isinstance(cell, Estimate) else format_cell(cell))
    if to:
        text = f'<a href="{html_text(to)}">{text}</a>'
    if isinstance(cell, Estimate) and band:
        text += f'<span class="band">[{html_text(band)}</span>'
    return text


def _column_class(table: Table, column: int) -> str:
    if table.has_numbers(column):
        return ' class="number"'
    short = all(len(format_cell(row[column])) <= _SHORT for row in table.rows)
    return ' class="short"' if short else ""


def _figure(figure: Figure, number: int, file: str) -> str:
    broad = ' class="broad"' if figure.kind in _BROAD else ""
    body = _pictures(figure) if figure.kind == "pictures" else _drawn(figure, number)
    note = html_text(figure.note)
    if file and figure.kind != "pictures":
        note += f' <a href="{html_text(file)}">PDF</a>'
    told = f'<p class="note">{note.strip()}</p>' if note else ""
    head = f"<figcaption>{html_text(figure.title)}</figcaption>"
    return f"<figure{broad}>{head}{body}{told}</figure>"


def _drawn(figure: Figure, number: int) -> str:
    label = html_text(figure.title)
    return svg(figure, number).replace(
        "<svg", f'<svg role="img" aria-label="{label}"', 1
    )


def _pictures(figure: Figure) -> str:
    data = figure.data
    captions = [str(caption) for caption in data["captions"]]
    good = data.get("good") or [True] * len(captions)
    cards = []
    for picture, caption, fine in zip(data["pictures"], captions, good, strict=True):
        source = b64encode(jpeg(picture)).decode()
        told = html_text(caption)
        cards.append(
            f'<div class="{"good" if fine else "bad"}">'
            f'<img alt="{told}" src="data:image/jpeg;base64,{source}">{told}</div>'
        )
    return f'<div class="pictures">{"".join(cards)}</div>' if cards else "<p>None.</p>"
