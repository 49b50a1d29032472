"""The summary of what a study found, which a reader sees first."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from kille.lab.measures.measures import Measure
from kille.lab.reports.conditions import last_phase_figures
from kille.lab.reports.findings import Theories, estimate_measure
from kille.lab.reports.links import Places
from kille.lab.reports.repeated_tests import main_measure, phases_of, restrict_to_phase
from kille.lab.reports.row_figures import row_figures
from kille.lab.reports.short_names import shorten_names
from kille.lab.results import Cell, Estimate, Figure, Result, Table

_BESIDE = ("κ robot–tutor", "words", "corrections", "questions")
"""The measures shown beside the main one, if they are known."""
_LINES = 4
"""Of a paragraph of more lines only the first is shown."""
_DRAWN = 2
"""The most figures."""


def summary_result(
    theories: Theories,
    measures: Sequence[Measure],
    found: Iterable[Result],
    places: Places,
    chosen: str = "",
) -> Result:
    """How much each theory gets right and at what cost, and what was found of it.

    `chosen` is the name of a further measure to show.
    """
    main = main_measure(measures)
    tables = (_theory_table(theories, measures, main, places, (*_BESIDE, chosen)),)
    if main is None:
        text = "Nothing was asked to which the tutor knew an answer: nothing is right."
        return Result("In short", tables, text=text)
    figures = [
        *last_phase_figures(theories, main, places),
        *_phase_figures(theories, main),
    ] or list(_theory_figures(theories, main))
    return Result(
        "In short", tables, tuple(figures[:_DRAWN]), text=_summary_lines(found)
    )


def _summary_lines(found: Iterable[Result]) -> str:
    parts = (part.splitlines() for it in found for part in it.text.split("\n\n"))
    shown = (part if len(part) <= _LINES else part[:1] for part in parts)
    return "\n".join(chain.from_iterable(shown))


def _theory_table(
    theories: Theories,
    measures: Sequence[Measure],
    main: Measure | None,
    places: Places,
    beside: Sequence[str],
) -> Table:
    """A row for each theory; the main measure also in the last phase of several."""
    columns = dict(_columns(theories, measures, main, beside))
    rows = tuple(zip(theories, *columns.values(), strict=True))
    links = {
        (row, column): places.theory(name)
        for row, name in enumerate(theories)
        for column in range(1, 1 + len(columns))
    }
    return Table("How well, and at what cost", ("theory", *columns), rows, "", links)


def _columns(
    theories: Theories,
    measures: Sequence[Measure],
    main: Measure | None,
    beside: Sequence[str],
) -> Iterator[tuple[str, Sequence[Cell]]]:
    yield "dialogues", [len(them) for them in theories.values()]
    if main is not None:
        yield main.name, _estimates(main, theories)
        phases = phases_of(theories, main)
        if len(phases) > 1:
            last = restrict_to_phase(theories, main, phases[-1])
            yield f"{main.name} in {phases[-1]}", _estimates(main, last)
    for measure in measures:
        estimates = _estimates(measure, theories)
        is_shown = measure.name in beside and measure is not main
        if is_shown and any(it.value for it in estimates):
            yield measure.name, estimates


def _estimates(measure: Measure, theories: Theories) -> list[Estimate]:
    return [estimate_measure(measure, them) for them in theories.values()]


def _phase_figures(theories: Theories, main: Measure) -> Iterator[Figure]:
    """How much is right in each phase, if something is asked in several."""
    phases = phases_of(theories, main)
    if len(phases) < 2:
        return
    parts = [restrict_to_phase(theories, main, phase) for phase in phases]
    series = {
        name: [estimate_measure(main, it[name]) for it in parts] for name in theories
    }
    title = f"{main.name.capitalize()}, phase by phase"
    yield from row_figures(title, phases, series, {"xlabel": main.name})


def _theory_figures(theories: Theories, main: Measure) -> Iterator[Figure]:
    if len(theories) < 2:
        return
    series = {main.name: [estimate_measure(main, them) for them in theories.values()]}
    labels = list(shorten_names(theories).values())
    yield from row_figures(
        main.name.capitalize(), labels, series, {"xlabel": main.name}
    )
