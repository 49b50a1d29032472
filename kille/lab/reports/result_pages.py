"""Pages of HTML with results: tables, figures, and how to repeat them.

A page needs nothing but itself, by day and by night, on a wide and on a narrow window.
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence

from kille.lab.reports.drawing import MISSING, can_draw, jpeg, svg
from kille.lab.reports.elements import (
    NOTHING,
    Markup,
    description_list,
    element,
    join,
    link,
    scrolling_table,
)
from kille.lab.results import Cell, Estimate, Figure, Result, Table, format_cell
from ttr.aliases import former_names
from ttr.escapes import html_text

__all__ = ["beginning", "ending", "file_of", "page", "section"]

__getattr__ = former_names(__name__, {"shown": "kille.lab.results:format_cell"})

_SHORT = 14  # characters: such cells are not broken
_LONGEST = 60  # characters in the name of a file
_BROAD = ("map", "pictures")
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


def page(
    title: str,
    results: Sequence[Result],
    about: Mapping[str, str],
    failures: Sequence[str] = (),
) -> str:
    """The page; `about` says under which heads what it was made of, and how.

    >>> found = Result("What was found", text="Nothing.")
    >>> "<h1>Cups" in page("Cups", [found], {"made with": "kille report"})
    True
    """
    parts = dict(enumerate(results, start=1))
    command = about.get("command", "")
    return whole_page(
        title,
        [
            *([element("p", element("code", command), class_="quiet")] * bool(command)),
            *warnings(failures),
            *(contents({number: it.title for number, it in parts.items()})),
            *(line for number, it in parts.items() for line in section(number, it)),
        ],
        about,
    )


def whole_page(
    title: str, body: Iterable[str], about: Mapping[str, str] | None, style: str = ""
) -> str:
    """A page of this body, with how it was made at its end if `about` says so."""
    end = [_END] if about is None else ending(about)
    return "\n".join([*beginning(title, style), *body, *end]) + "\n"


_END = "</body></html>"


def beginning(title: str, style: str = "") -> Iterator[str]:
    """The head of a page and its title, with further style sheets if it needs any.

    >>> "<title>Cups</title>" in "".join(beginning("Cups"))
    True
    """
    yield "<!DOCTYPE html>"
    yield '<html lang="en"><head><meta charset="utf-8">'
    yield '<meta name="viewport" content="width=device-width, initial-scale=1">'
    yield f"{element('title', title)}<style>{_STYLE}{style}</style></head><body>"
    yield element("h1", title)


def ending(about: Mapping[str, str]) -> Iterator[str]:
    """How all that was made, and the end of the page.

    >>> "</html>" in "".join(ending({"made with": "kille report"}))
    True
    """
    yield element("h2", "How this was made") + description_list(about.items())
    yield _END


def warnings(texts: Iterable[str]) -> Iterator[Markup]:
    """Warnings, and a note if there are no figures since matplotlib is missing."""
    yield from (element("p", text, class_="wrong") for text in texts)
    if not can_draw():
        yield element("p", MISSING, class_="note")


def contents(titles: Mapping[int, str]) -> Iterator[Markup]:
    """Links to the parts of a page by their numbers, if there are several."""
    if len(titles) > 1:
        lines = (
            element("li", link(title, f"#part-{number}"))
            for number, title in sorted(titles.items())
        )
        yield element("nav", element("ul", *lines))


def section(number: int, result: Result, drawn: str = "") -> Iterator[str]:
    """A part of a page, to which `#part-NUMBER` leads.

    `drawn` is the folder in which the figures lie as PDF files, if they do.

    >>> text = "".join(section(1, Result("What was found", text="Nothing.")))
    >>> 'id="part-1"' in text
    True
    """
    yield f"<section>{element('h2', result.title, id=f'part-{number}')}"
    if result.text:
        yield element("p", result.text)
    for table in result.tables:
        yield element("h3", table.title) + table_element(table)
    if result.figures and can_draw():
        figures = (
            _figure_element(
                figure,
                100 * number + place,
                f"{drawn}/{file_of(number, place, figure)}" if drawn else "",
            )
            for place, figure in enumerate(result.figures)
        )
        yield element("h3", "Figures") + element("div", *figures, class_="figures")
    yield "</section>"


def file_of(number: int, place: int, of: Figure | Table, ending: str = ".pdf") -> str:
    """The name of the file of a figure or table at a place, from 0, of a part.

    >>> file_of(2, 0, Figure("curves", "Learning curve", {}))
    '2-1-learning-curve.pdf'
    """
    words = re.sub(r"[^a-z0-9]+", "-", of.title.lower()).strip("-")
    return f"{number}-{place + 1}-{words}"[:_LONGEST] + ending


def table_element(table: Table) -> Markup:
    """A table and its note, without its title."""
    classes = [_column_class(table, place) for place in range(len(table.columns))]
    heads = zip(table.columns, classes, strict=True)
    rows = (
        (
            element("td", _cell(it, table.links.get((i, j), "")), class_=class_)
            for j, (it, class_) in enumerate(zip(row, classes, strict=True))
        )
        for i, row in enumerate(table.rows)
    )
    note = element("p", table.note, class_="note") if table.note else NOTHING
    return (
        scrolling_table(
            (element("th", it, class_=class_) for it, class_ in heads), rows
        )
        + note
    )


def _cell(cell: Cell, address: str) -> Markup:
    """The cell, which may lead to an address, with its interval in small print."""
    if not isinstance(cell, Estimate):
        return link(format_cell(cell), address)
    value, bracket, interval = format_cell(cell).partition(" [")
    if not interval:
        return link(value, address)
    small = element("span", bracket.strip(), interval, class_="band")
    return link(value, address) + small


def _column_class(table: Table, column: int) -> str:
    if table.has_numbers(column):
        return "number"
    is_short = all(len(format_cell(row[column])) <= _SHORT for row in table.rows)
    return "short" if is_short else ""


def _figure_element(figure: Figure, number: int, file: str) -> Markup:
    note = join([figure.note])
    if figure.kind == "pictures":
        body = _picture_cards(figure)
    else:
        body = _drawing(figure, number)
        if file:
            note = join([note, " " * bool(note), link("PDF", file)])
    return element(
        "figure",
        element("figcaption", figure.title),
        body,
        element("p", note, class_="note") if note else NOTHING,
        class_="broad" if figure.kind in _BROAD else "",
    )


def _drawing(figure: Figure, number: int) -> Markup:
    label = html_text(figure.title)
    return Markup(
        svg(figure, number).replace("<svg", f'<svg role="img" aria-label="{label}"', 1)
    )


def _picture_cards(figure: Figure) -> Markup:
    data = figure.data
    captions = [str(caption) for caption in data["captions"]]
    good = data.get("good") or [True] * len(captions)
    cards = []
    for picture, caption, fine in zip(data["pictures"], captions, good, strict=True):
        source = f"data:image/jpeg;base64,{b64encode(jpeg(picture)).decode()}"
        image = element("img", alt=caption, src=source)
        cards.append(element("div", image, caption, class_="good" if fine else "bad"))
    return element("div", *cards, class_="pictures") if cards else element("p", "None.")
