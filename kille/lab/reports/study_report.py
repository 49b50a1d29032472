"""The report of a study: a page that a paper can cite, with its figures and dialogues.

The page needs nothing but itself; the figures as PDF files, the tables as LaTeX and the
dialogues behind the numbers lie in folders beside it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations
from pathlib import Path

from kille.lab.measures.measures import ACCURACY
from kille.lab.reports import curves
from kille.lab.reports.conditions import by_conditions
from kille.lab.reports.contrasts import contrasted
from kille.lab.reports.costs import costs
from kille.lab.reports.dialogue_pages import pages
from kille.lab.reports.drawing import MISSING, can_draw, pdf
from kille.lab.reports.findings import (
    Theories,
    for_figures,
    in_detail,
    meanings,
    measures_of,
    overall,
)
from kille.lab.reports.latex_tables import latex_table
from kille.lab.reports.layouts import Described, side_by_side
from kille.lab.reports.links import Places, places_of
from kille.lab.reports.repeated_tests import Tests
from kille.lab.reports.result_pages import beginning, ending, file_of, section
from kille.lab.reports.styles import PAGE, THEORIES
from kille.lab.reports.summary import in_short
from kille.lab.results import Result
from ttr import TTRError
from ttr.display import html as markup
from ttr.escapes import html_address, html_text
from ttr.safety.files import why_unwritten, write_whole

_FEW = 5
"""So many reasons why dialogues broke are told, and so many dialogues named of each."""


@dataclass(frozen=True)
class Subject:
    """What is reported on: the dialogues of each theory, and all that is told of them.

    `which` are the theories that are compared, two by two; `main` is the name of the
    measure whose differences are tested by themselves; `tests` the phases, those
    together that ask alike; `numbers` says how many dialogues there are, of what;
    `broken` are dialogues that were not played to their end, each with the reason;
    `warnings` are what a reader has to know of the others; `files` are those beside the
    report that hold the numbers.
    """

    title: str
    theories: Theories
    described: Mapping[str, Described]
    which: Sequence[tuple[str, str]]
    tests: Tests
    about: Mapping[str, str]
    main: str = ACCURACY.name
    lead: str = ""
    numbers: str = ""
    source: str = ""
    broken: Sequence[tuple[str, str]] = ()
    warnings: Sequence[str] = ()
    files: Sequence[str] = ()


def every_two(theories: Iterable[str]) -> list[tuple[str, str]]:
    """Each two of them, in their order."""
    return list(combinations(theories, 2))


def results_of(subject: Subject, places: Places) -> list[Result]:
    """What was found, in tables and figures; first, what has to be known of it."""
    theories = subject.theories
    if not theories:
        return []
    measures = measures_of(theories)
    drawn = for_figures(theories)
    first = Result(
        "What they do",
        (overall(theories, measures, places),),
        (*curves.learning(drawn, subject.tests), *costs(drawn, subject.tests)),
        text="\n".join(subject.warnings),
    )
    details = Result(
        "In detail",
        tuple(it for it in in_detail(theories, places) if len(it.rows) > 1),
        (*curves.words(drawn), *curves.confusions(drawn)),
    )
    certainty = Result("How sure they are", (), tuple(curves.reliable(drawn)))
    found = [
        first,
        *contrasted(theories, subject.which, measures, places, subject.main),
        *by_conditions(theories, measures, places),
        certainty,
        details,
        meanings(measures),
    ]
    return [it for it in found if it.tables or it.figures]


def write(subject: Subject, page: Path) -> list[Result]:
    """Writes the page, and its figures, tables and dialogues into folders beside it.

    They are called as the page is: `PAGE-figures` (PDF), `PAGE-tables` (LaTeX) and
    `PAGE-dialogues`. Gives what was
    found. Raises `TTRError` where a file cannot be written.
    """
    try:
        return _write(subject, page)
    except OSError as error:
        raise TTRError(why_unwritten(error.filename or page, error)) from error


def _write(subject: Subject, page: Path) -> list[Result]:
    dialogues = _emptied(page.with_name(f"{page.stem}-dialogues"), *_PAGES)
    everything = [it for them in subject.theories.values() for it in them]
    address = html_address(dialogues.name)
    places = places_of(list(subject.theories), everything, address)
    found = results_of(subject, places)
    for name, text in pages(subject.theories, places, page.name):
        (dialogues / name).write_text(text, "utf-8")
    parts = {_GIST: _gist(subject, found, places)}
    parts |= dict(enumerate(_untold(found), start=_FIRST))
    figures = _emptied(page.with_name(f"{page.stem}-figures"), _FIGURES)
    for part, result in parts.items():
        for place, figure in enumerate(result.figures if can_draw() else ()):
            file = figures / file_of(part, place, figure)
            file.write_bytes(pdf(figure))
    tables = _emptied(page.with_name(f"{page.stem}-tables"), _TABLES)
    for part, result in parts.items():
        for place, table in enumerate(result.tables):
            file = tables / file_of(part, place, table, ".tex")
            file.write_text(latex_table(table), "utf-8")
    lines = _page(subject, parts, html_address(figures.name), tables)
    write_whole(page, "\n".join(lines) + "\n")
    return found


def _gist(subject: Subject, found: Sequence[Result], places: Places) -> Result:
    if not found:
        return Result("In short", text="No dialogue was played to its end.")
    measures = measures_of(subject.theories)
    return in_short(subject.theories, measures, found[1:], places, subject.main)


def _untold(found: Sequence[Result]) -> Iterator[Result]:
    """What was found, without the warnings: on a page they stand before all else."""
    yield from (replace(it, text="") for it in found[:1])
    yield from found[1:]


_PAGES = "dialogue-[0-9]*.html", "theory-[0-9]*.html", "theories-[0-9]*.html"
_FIGURES = "[0-9]*-[0-9]*-*.pdf"
_TABLES = "[0-9]*-[0-9]*-*.tex"


def _emptied(folder: Path, *of: str) -> Path:
    """The folder without what an earlier report has left there."""
    folder.mkdir(exist_ok=True)
    for file in chain.from_iterable(map(folder.glob, of)):
        file.unlink()
    return folder


_GIST, _THEORIES, _FIRST = 1, 2, 3
"""The numbers of the parts of the page: in short, the theories, all that was found."""


def _page(
    subject: Subject, parts: Mapping[int, Result], figures: str, tables: Path
) -> Iterator[str]:
    yield from beginning(subject.title, PAGE + THEORIES + markup.STYLE)
    for paragraph in filter(None, re.split(r"\n\s*\n", subject.lead.strip())):
        yield f"<p>{html_text(paragraph)}</p>"
    if subject.numbers:
        yield f'<p class="quiet">{html_text(subject.numbers)}</p>'
    yield from _wrong(subject)
    if not can_draw():
        yield f'<p class="note">{html_text(MISSING)}</p>'
    yield from _contents(parts)
    yield from section(_GIST, parts[_GIST], figures)
    yield f'<section><h2 id="part-{_THEORIES}">The theories</h2>'
    yield from side_by_side(subject.described)
    yield "</section>"
    for number, result in parts.items():
        if number >= _FIRST:
            yield from section(number, result, figures)
    if subject.source:
        yield "<h2>The study</h2><details><summary>its file</summary>"
        yield f"<pre>{html_text(subject.source)}</pre></details>"
    if subject.files:
        links = ", ".join(
            f'<a href="{html_address(it)}">{html_text(it)}</a>' for it in subject.files
        )
        yield f"<p>The numbers, for R and others: {links}.</p>"
    if written := sorted(tables.glob(_TABLES)):
        folder = html_address(tables.name)
        links = ", ".join(
            f'<a href="{folder}/{html_address(it.name)}">{html_text(it.stem)}</a>'
            for it in written
        )
        yield f"<p>The tables, for LaTeX: {links}.</p>"
    yield from ending(subject.about)


def _contents(parts: Mapping[int, Result]) -> Iterator[str]:
    titles = {_THEORIES: "The theories"} | {
        number: it.title for number, it in parts.items()
    }
    yield "<nav><ul>"
    for number, title in sorted(titles.items()):
        yield f'<li><a href="#part-{number}">{html_text(title)}</a></li>'
    yield "</ul></nav>"


def _wrong(subject: Subject) -> Iterator[str]:
    """What a reader has to know of the numbers, and what broke."""
    for text in (*subject.warnings, *_broken(subject.broken)):
        yield f'<p class="wrong">{html_text(text)}</p>'


def _broken(broken: Sequence[tuple[str, str]]) -> Iterator[str]:
    """The reasons for which dialogues broke, each with the first of these."""
    reasons: dict[str, list[str]] = {}
    for name, reason in broken:
        reasons.setdefault(reason, []).append(name)
    for reason, names in list(reasons.items())[:_FEW]:
        named = ", ".join(names[:_FEW])
        more = f" and {len(names) - _FEW:,} more" if len(names) > _FEW else ""
        yield f"{_dialogues(len(names))} broke: {reason}: {named}{more}"
    others = sum(map(len, list(reasons.values())[_FEW:]))
    if others:
        yield f"{_dialogues(others)} more broke, for other reasons."


def _dialogues(count: int) -> str:
    return f"{count:,} dialogue{'s' if count != 1 else ''}"
