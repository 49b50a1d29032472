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
from kille.lab.reports.conditions import compare_conditions
from kille.lab.reports.contrasts import contrast_results
from kille.lab.reports.costs import cost_figures
from kille.lab.reports.dialogue_pages import pages
from kille.lab.reports.drawing import can_draw, pdf
from kille.lab.reports.elements import Markup, element, fold, link
from kille.lab.reports.findings import (
    Theories,
    detail_tables,
    known_measures,
    measure_meanings,
    overall_table,
    shorten_theory_names,
)
from kille.lab.reports.latex_tables import latex_table
from kille.lab.reports.layouts import Described, side_by_side
from kille.lab.reports.links import Places, places_of
from kille.lab.reports.repeated_tests import Tests
from kille.lab.reports.result_pages import (
    contents,
    file_of,
    section,
    warnings,
    whole_page,
)
from kille.lab.reports.styles import PAGE, THEORIES
from kille.lab.reports.summary import summary_result
from kille.lab.results import Result
from ttr import TTRError
from ttr.display import html as ttr_html
from ttr.escapes import html_address
from ttr.safety.files import why_unwritten, write_whole

_FEW = 5
"""How many reasons why dialogues broke are shown, and how many dialogues of each."""


@dataclass(frozen=True)
class Subject:
    """What is reported on: the dialogues of each theory, and all that is said of them.

    `which` are the theories to compare, two by two; `main` is the name of the measure
    whose differences are tested by themselves; `tests` are the phases, those that ask
    alike together; `numbers` says how many dialogues there are, and of what; `broken`
    are dialogues that were not played to their end, each with the reason; `warnings`
    say what a reader has to know of the others; `files` hold the numbers, and lie
    beside the report.
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
    """All pairs of theories, in their order."""
    return list(combinations(theories, 2))


def results_of(subject: Subject, places: Places) -> list[Result]:
    """What was found, in tables and figures; the warnings are the text of the first."""
    theories = subject.theories
    if not theories:
        return []
    measures = known_measures(theories)
    drawn = shorten_theory_names(theories)
    first = Result(
        "What they do",
        (overall_table(theories, measures, places),),
        (
            *curves.learning_curves(drawn, subject.tests),
            *cost_figures(drawn, subject.tests),
        ),
        text="\n".join(subject.warnings),
    )
    details = Result(
        "In detail",
        tuple(it for it in detail_tables(theories, places) if len(it.rows) > 1),
        (*curves.word_figures(drawn), *curves.confusion_figures(drawn)),
    )
    certainty = Result(
        "How sure they are", (), tuple(curves.reliability_figures(drawn))
    )
    found = [
        first,
        *contrast_results(theories, subject.which, measures, places, subject.main),
        *compare_conditions(theories, measures, places),
        certainty,
        details,
        measure_meanings(measures),
    ]
    return [it for it in found if it.tables or it.figures]


def write(subject: Subject, page: Path) -> list[Result]:
    """Write the page, and its figures, tables and dialogues into folders beside it.

    The folders are named after the page: `PAGE-figures` (PDF), `PAGE-tables` (LaTeX)
    and `PAGE-dialogues`. Returns what was found. TTRError where a file cannot be
    written.
    """
    try:
        return _write(subject, page)
    except OSError as error:
        raise TTRError(why_unwritten(error.filename or page, error)) from error


_PAGES = "dialogue-[0-9]*.html", "theory-[0-9]*.html", "theories-[0-9]*.html"
_FIGURES = "[0-9]*-[0-9]*-*.pdf"
_TABLES = "[0-9]*-[0-9]*-*.tex"

_SUMMARY, _THEORIES, _FIRST = 1, 2, 3
"""The numbers of the parts of the page: in short, the theories, all that was found."""


def _write(subject: Subject, page: Path) -> list[Result]:
    dialogues = _clear_folder(page, "dialogues", *_PAGES)
    everything = [it for them in subject.theories.values() for it in them]
    address = html_address(dialogues.name)
    places = places_of(list(subject.theories), everything, address)
    found = results_of(subject, places)
    for name, text in pages(subject.theories, places, page.name):
        (dialogues / name).write_text(text, "utf-8")
    # On the page the warnings, which are the text of the first, stand before all else.
    shown = [*(replace(it, text="") for it in found[:1]), *found[1:]]
    parts = {_SUMMARY: _summary(subject, found, places)}
    parts |= dict(enumerate(shown, start=_FIRST))
    figures = _clear_folder(page, "figures", _FIGURES)
    tables = _clear_folder(page, "tables", _TABLES)
    for part, result in parts.items():
        for place, figure in enumerate(result.figures if can_draw() else ()):
            (figures / file_of(part, place, figure)).write_bytes(pdf(figure))
        for place, table in enumerate(result.tables):
            file = tables / file_of(part, place, table, ".tex")
            file.write_text(latex_table(table), "utf-8")
    body = _body(subject, parts, html_address(figures.name), tables)
    style = PAGE + THEORIES + ttr_html.STYLE
    write_whole(page, whole_page(subject.title, body, subject.about, style))
    return found


def _clear_folder(page: Path, what: str, *patterns: str) -> Path:
    """The folder beside a page without what an earlier report has left there."""
    folder = page.with_name(f"{page.stem}-{what}")
    folder.mkdir(exist_ok=True)
    for file in chain.from_iterable(map(folder.glob, patterns)):
        file.unlink()
    return folder


def _summary(subject: Subject, found: Sequence[Result], places: Places) -> Result:
    if not found:
        return Result("In short", text="No dialogue was played to its end.")
    measures = known_measures(subject.theories)
    return summary_result(subject.theories, measures, found[1:], places, subject.main)


def _body(
    subject: Subject, parts: Mapping[int, Result], figures: str, tables: Path
) -> Iterator[str]:
    for paragraph in filter(None, re.split(r"\n\s*\n", subject.lead.strip())):
        yield element("p", paragraph)
    if subject.numbers:
        yield element("p", subject.numbers, class_="quiet")
    yield from warnings([*subject.warnings, *_broken_lines(subject.broken)])
    titles = {number: it.title for number, it in parts.items()}
    yield from contents({_THEORIES: "The theories"} | titles)
    yield from section(_SUMMARY, parts[_SUMMARY], figures)
    theories = element("h2", "The theories", id=f"part-{_THEORIES}")
    yield element("section", theories, *side_by_side(subject.described))
    for number, result in parts.items():
        if number >= _FIRST:
            yield from section(number, result, figures)
    if subject.source:
        yield element("h2", "The study")
        yield fold("its file", element("pre", subject.source))
    names = {it: html_address(it) for it in subject.files}
    yield from _files("The numbers, for R and others", names)
    folder = html_address(tables.name)
    latex = sorted(tables.glob(_TABLES))
    names = {it.stem: f"{folder}/{html_address(it.name)}" for it in latex}
    yield from _files("The tables, for LaTeX", names)


def _files(what: str, addresses: Mapping[str, str]) -> Iterator[Markup]:
    """Links to files beside the page, by their names, if there are any."""
    if addresses:
        links = (link(name, address) for name, address in addresses.items())
        yield element("p", f"{what}: ", Markup(", ".join(links)), ".")


def _broken_lines(broken: Sequence[tuple[str, str]]) -> Iterator[str]:
    """The reasons why dialogues broke, each with the first of these dialogues."""
    reasons: dict[str, list[str]] = {}
    for name, reason in broken:
        reasons.setdefault(reason, []).append(name)
    for reason, names in list(reasons.items())[:_FEW]:
        first = ", ".join(names[:_FEW])
        more = f" and {len(names) - _FEW:,} more" if len(names) > _FEW else ""
        yield f"{_count_dialogues(len(names))} broke: {reason}: {first}{more}"
    others = sum(map(len, list(reasons.values())[_FEW:]))
    if others:
        yield f"{_count_dialogues(others)} more broke, for other reasons."


def _count_dialogues(count: int) -> str:
    return f"{count:,} dialogue{'s' if count != 1 else ''}"
