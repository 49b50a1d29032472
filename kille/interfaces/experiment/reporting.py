"""`kille experiment report` and `compare`: print the results and write the page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.text import Text

from kille.interfaces.experiment.checking import MISTAKES
from kille.interfaces.grids import print_table
from kille.interfaces.terminal import FINE, complain_all, console
from kille.lab import log, reports
from kille.lab.log import write_tables
from kille.lab.results import Result
from ttr.safety.consent import Consent


def report(folder: Path, command: str, consent: Consent) -> int:
    """Write and print the tables and the page of a folder of results.

    To show its theories, Python is run only where there is consent to that.
    """
    try:
        write_tables(folder)
        study = log.study(folder, consent)
        page, results = reports.report(folder, command=command, study=study)
        print_results(results)
    except MISTAKES as error:
        return complain_all(error)
    console().print(f"\nreport: {page}", markup=False)
    return FINE


def compare(
    one: Path, other: Path, page: Path | None, command: str, consent: Consent
) -> int:
    """Print how two folders of results differ; write a page if one is named."""
    try:
        if page is None:
            print_results(reports.compare_results(one, other, consent))
            return FINE
        found = reports.compare(one, other, page, command=command, consent=consent)
        print_results(found.results)
        console().print(f"\nreport: {page}", markup=False)
    except MISTAKES as error:
        return complain_all(error)
    return FINE


def print_results(results: Sequence[Result]) -> None:
    """Print tables, and the findings in them."""
    out = _wide_console()
    for result in filter(lambda it: it.tables, results):
        out.print(Text(f"\n{result.title}", style="bold"), soft_wrap=False)
        _print_text(out, result)
        for table in result.tables:
            print_table(out, table)


def print_summary(results: Sequence[Result]) -> None:
    """Print the first table, and the findings in the others."""
    out = _wide_console()
    for table in results[0].tables[:1] if results else ():
        print_table(out, table)
    for result in results:
        _print_text(out, result)


def _print_text(out: Console, result: Result) -> None:
    if result.text:
        out.print(Text(f"\n{result.text}"), soft_wrap=False)


def _wide_console() -> Console:
    """A console; a pipe counts as 100 columns wide."""
    out = console()
    if not out.is_terminal:
        out.width = 100
    return out
