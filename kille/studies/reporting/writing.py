"""The report of a study: a page that a paper can cite, with its figures and dialogues.

The page needs nothing but itself; the figures as PDF files and the dialogues behind the
numbers lie in folders beside it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import chain, combinations
from pathlib import Path

from kille.experiments.figures import MISSING, can_draw, pdf
from kille.experiments.report import beginning, ending, file_of, section
from kille.experiments.results import Result
from kille.studies.reporting import curves
from kille.studies.reporting.conditions import by_conditions
from kille.studies.reporting.contrasts import contrasted
from kille.studies.reporting.costs import costs
from kille.studies.reporting.findings import (
    Theories,
    in_detail,
    meanings,
    measures_of,
    overall,
)
from kille.studies.reporting.layouts import STYLE, Described, side_by_side
from kille.studies.reporting.pages import pages
from kille.studies.reporting.places import Places, places_of
from ttr import TTRError
from ttr.display import markup
from ttr.files import why_unwritten, write_whole

__all__ = ["Subject", "every_two", "results_of", "write"]

_FEW = 5
"""So many dialogues that broke are named one by one."""


@dataclass(frozen=True)
class Subject:
    """What is reported on: the dialogues of each theory, and all that is told of them.

    `which` are the theories that are compared, two by two; `broken` are dialogues that
    were not played to their end, each with the reason; `warnings` are what a reader has
    to know of the others; `files` are those beside the report that hold the numbers.
    """

    title: str
    theories: Theories
    described: Mapping[str, Described]
    which: Sequence[tuple[str, str]]
    about: Mapping[str, str]
    lead: str = ""
    source: str = ""
    broken: Sequence[tuple[str, str]] = ()
    warnings: Sequence[str] = ()
    files: Sequence[str] = ()


def every_two(theories: Iterable[str]) -> list[tuple[str, str]]:
    """Each two of them, in their order."""
    return list(combinations(theories, 2))


def results_of(subject: Subject, places: Places) -> list[Result]:
    """What was found, in tables and figures."""
    theories = subject.theories
    if not theories:
        return []
    measures = measures_of(theories)
    first = Result(
        "What they do",
        (overall(theories, measures, places),),
        (*curves.learning(theories), *costs(theories)),
    )
    details = Result(
        "In detail",
        tuple(it for it in in_detail(theories, places) if len(it.rows) > 1),
        (*curves.words(theories), *curves.confusions(theories)),
    )
    certainty = Result("How sure they are", (), tuple(curves.reliable(theories)))
    found = [
        first,
        *contrasted(theories, subject.which, measures, places),
        *by_conditions(theories, measures, places),
        certainty,
        details,
        meanings(measures),
    ]
    return [it for it in found if it.tables or it.figures]


def write(subject: Subject, page: Path) -> list[Result]:
    """Writes the page, and its figures and dialogues into folders beside it.

    They are called as the page is, `PAGE-figures` and `PAGE-dialogues`. Gives what was
    found. Raises `TTRError` where a file cannot be written.
    """
    try:
        return _write(subject, page)
    except OSError as error:
        raise TTRError(why_unwritten(error.filename or page, error)) from error


def _write(subject: Subject, page: Path) -> list[Result]:
    dialogues = _emptied(page.with_name(f"{page.stem}-dialogues"), *_PAGES)
    everything = [it for them in subject.theories.values() for it in them]
    places = places_of(list(subject.theories), everything, dialogues.name)
    found = results_of(subject, places)
    for name, text in pages(subject.theories, places, page.name):
        (dialogues / name).write_text(text, "utf-8")
    figures = _emptied(page.with_name(f"{page.stem}-figures"), _FIGURES)
    for part, result in enumerate(found, start=_FIRST):
        for place, figure in enumerate(result.figures if can_draw() else ()):
            file = figures / file_of(part, place, figure)
            file.write_bytes(pdf(figure))
    write_whole(page, "\n".join(_page(subject, found, figures.name)) + "\n")
    return found


_PAGES = "dialogue-[0-9]*.html", "theory-[0-9]*.html", "theories-[0-9]*.html"
_FIGURES = "[0-9]*-[0-9]*-*.pdf"


def _emptied(folder: Path, *of: str) -> Path:
    """The folder without what an earlier report has left there."""
    folder.mkdir(exist_ok=True)
    for file in chain.from_iterable(map(folder.glob, of)):
        file.unlink()
    return folder


_FIRST = 2  # the first part of the page are the theories


def _page(subject: Subject, found: Sequence[Result], figures: str) -> Iterator[str]:
    yield from beginning(subject.title, STYLE + markup.STYLE)
    if "command" in subject.about:
        yield f'<p class="quiet"><code>{escape(subject.about["command"])}</code></p>'
    for paragraph in re.split(r"\n\s*\n", subject.lead.strip()):
        yield f"<p>{escape(paragraph)}</p>"
    yield from _wrong(subject)
    if not can_draw():
        yield f'<p class="note">{escape(MISSING)}</p>'
    yield from _contents(["The theories", *(it.title for it in found)])
    yield '<section><h2 id="part-1">The theories</h2>'
    yield from side_by_side(subject.described)
    yield "</section>"
    for number, result in enumerate(found, start=_FIRST):
        yield from section(number, result, figures)
    if subject.source:
        yield "<h2>The study</h2><details><summary>its file</summary>"
        yield f"<pre>{escape(subject.source)}</pre></details>"
    if subject.files:
        links = ", ".join(
            f'<a href="{escape(it, quote=True)}">{escape(it)}</a>'
            for it in subject.files
        )
        yield f"<p>The numbers, for R and others: {links}.</p>"
    yield from ending(subject.about)


def _contents(titles: Sequence[str]) -> Iterator[str]:
    yield "<nav><ul>"
    for number, title in enumerate(titles, start=1):
        yield f'<li><a href="#part-{number}">{escape(title)}</a></li>'
    yield "</ul></nav>"


def _wrong(subject: Subject) -> Iterator[str]:
    """What a reader has to know; the dialogues that broke, of many the first ones."""
    told = [f"{name} broke: {reason}" for name, reason in subject.broken[:_FEW]]
    if len(subject.broken) > _FEW:
        told.append(f"{len(subject.broken) - _FEW} more dialogues broke.")
    for text in (*subject.warnings, *told):
        yield f'<p class="wrong">{escape(text)}</p>'
