"""`kille evaluate`: run protocols, print their tables, write their report."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from shlex import join
from typing import Any, NamedTuple

from rich.progress import BarColumn, TextColumn, TimeElapsedColumn

from kille.interfaces.grids import print_result, results_console
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain,
    console,
    print_json,
    transient_bar,
)
from kille.lab.protocols.protocols_for_data import (
    OBJECTS,
    RELATIONS,
    Plan,
    choose_plans,
    object_plans,
    relation_plans,
    run_plan,
)
from kille.lab.reports.drawing import MISSING, can_draw
from kille.lab.reports.result_pages import page
from kille.lab.results import ExperimentError, Result
from kille.lab.theories.candidates import MethodFailedError, Methods, candidates
from kille.lab.versions import versions
from kille.sensors.sensor import SensorError
from ttr import TTRError
from ttr.safety.files import check_outputs, why_unread, write_whole

_PAGES = (".html", ".htm")  # so that no picture of the data is overwritten
_USUAL = {"objects": ("default", "kille"), "relations": ("default", "kille", "angle")}


@dataclass(frozen=True)
class EvaluationRequest:
    """The measurement to make, as the user typed it."""

    what: str
    data: str | None
    protocol: str | None
    methods: tuple[str, ...]
    seed: int
    report: Path | None
    teach: tuple[str, ...] = ()
    ask: tuple[str, ...] = ()
    words: tuple[str, ...] = ()

    @property
    def who(self) -> tuple[str, ...]:
        """The methods that take part."""
        return self.methods or _USUAL[self.what]

    @property
    def title(self) -> str:
        """The title of the report."""
        return f"How well are {self.what} learned?"


class Printer(NamedTuple):
    """How results are printed: each as soon as it is there, and all at the end."""

    result: Callable[[Result], None]
    end: Callable[[Mapping[str, Any], Mapping[str, Result], Sequence[str]], None]


def _print_json(
    about: Mapping[str, Any], found: Mapping[str, Result], failures: Sequence[str]
) -> None:
    results = [_as_object(name, result) for name, result in found.items()]
    report = {**about, "failed": list(failures), "results": results}
    print_json(report)


as_tables = Printer(
    lambda result: print_result(results_console(), result), lambda *_: None
)
"""For people."""

as_json = Printer(lambda result: None, _print_json)
"""For machines: one object."""


def evaluate(request: EvaluationRequest, printer: Printer) -> int:
    """Run the protocols; returns the exit code, 1 if a method failed."""
    failures: list[str] = []

    def failed(failure: MethodFailedError) -> None:
        failures.append(str(failure))
        complain(failure)

    found: dict[str, Result] = {}
    try:
        methods, plans = _prepare(request)
        for plan in plans:
            result, methods = _measure(plan, methods, request.seed, failed)
            if result is None:
                break
            found[plan.name] = result
            printer.result(result)
        about = _about(request, plans)
        printer.end(about, found, failures)
        _write(request, about, found, failures)
    except (ExperimentError, SensorError, TTRError) as error:
        return complain(error)
    return FAILED if failures else FINE


def _prepare(request: EvaluationRequest) -> tuple[Methods, list[Plan]]:
    """The methods and plans that take part; ExperimentError if they cannot be found."""
    from kille.perception import methods as known

    _check_report(request)
    try:
        if request.what == "objects":
            methods = candidates(request.who, known.OBJECTS)
            plans = object_plans(request.data, request.teach, request.ask)
            return methods, choose_plans(plans, request.protocol, OBJECTS)
        methods = candidates(request.who, known.RELATIONS)
        plans = relation_plans(request.data)
        return methods, choose_plans(plans, request.protocol, RELATIONS)
    except OSError as error:
        raise ExperimentError(why_unread(error.filename, error)) from error


def _check_report(request: EvaluationRequest) -> None:
    """Refuse a report that cannot be written before anything is measured."""
    if request.report is None:
        return
    check_outputs([Path(request.data)] if request.data else [], [request.report])
    if request.report.is_dir():
        raise ExperimentError(
            f"{request.report} is a folder: name a file for the report"
        )
    if request.report.suffix.lower() not in _PAGES:
        raise ExperimentError(
            f"the report is a page: name a file that ends in .html, "
            f"not {request.report.name}"
        )
    folder = Path(os.path.realpath(request.report)).parent
    if not folder.is_dir():
        raise ExperimentError(
            f"{request.report} cannot be written: there is no folder {folder.name}"
        )


def _measure(
    plan: Plan,
    methods: Methods,
    seed: int,
    failed: Callable[[MethodFailedError], None],
) -> tuple[Result | None, Methods]:
    """Run a protocol; on a terminal a bar shows the progress."""
    bar = transient_bar(
        console(stderr=True),
        BarColumn(bar_width=24),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeElapsedColumn(),
        TextColumn("{task.description}", markup=False),
    )
    with bar:
        task = bar.add_task(plan.name, total=1.0)

        def progress(share: float, doing: str) -> None:
            bar.update(task, completed=share, description=doing)

        return run_plan(plan, methods, seed=seed, progress=progress, failed=failed)


def _write(
    request: EvaluationRequest,
    about: Mapping[str, Any],
    found: Mapping[str, Result],
    failures: Sequence[str],
) -> None:
    if request.report is None or not found:
        return
    lines = {key: _format_line(value) for key, value in about.items()}
    write_whole(
        request.report, page(request.title, list(found.values()), lines, failures)
    )
    console(stderr=True).print(
        f"report: {request.report}" + f" ({MISSING})" * (not can_draw())
    )


def _about(request: EvaluationRequest, plans: Sequence[Plan]) -> dict[str, Any]:
    """How the report was made, with the methods that took part in any plan."""
    took_part = dict.fromkeys(
        name for plan in plans for name in plan.compares or request.who
    )
    return {
        "command": join(["kille", *request.words]),
        "data": request.data or "simulated",
        "seed": request.seed,
        "methods": list(took_part),
        "versions": versions(),
    }


def _format_line(value: Any) -> str:
    match value:
        case dict():
            return ", ".join(f"{key} {it}" for key, it in value.items())
        case list():
            return ", ".join(value)
    return str(value)


# --- for machines --------------------------------------------------------------------


def _as_object(name: str, result: Result) -> dict[str, Any]:
    return {
        "protocol": name,
        "title": result.title,
        "tables": [
            {
                "title": table.title,
                "columns": list(table.columns),
                "rows": [list(row) for row in table.rows],
                "note": table.note,
            }
            for table in result.tables
        ],
        "facts": result.facts,
    }
