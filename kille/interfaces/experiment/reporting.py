"""`kille experiment report` and `compare`: print the results and write the page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from kille.interfaces.experiment.checking import MISTAKES
from kille.interfaces.grids import (
    print_findings,
    print_result,
    print_table,
    results_console,
)
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
    out = results_console()
    for result in filter(lambda it: it.tables, results):
        print_result(out, result)


def print_summary(results: Sequence[Result]) -> None:
    """Print the first table, and the findings in the others."""
    out = results_console()
    for table in results[0].tables[:1] if results else ():
        print_table(out, table)
    for result in results:
        print_findings(out, result)
