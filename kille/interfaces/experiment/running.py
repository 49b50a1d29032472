"""`kille experiment run` and `resume`: play dialogues, with a bar, until stopped."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from shlex import quote
from typing import TypeAlias

from kille.interfaces.experiment.bars import bar
from kille.interfaces.experiment.checking import (
    MISTAKES,
    tell_doubts,
)
from kille.interfaces.experiment.logs import study_of_log
from kille.interfaces.experiment.people import crew_for, has_people
from kille.interfaces.experiment.reporting import print_summary
from kille.interfaces.experiment.stopping import stoppable
from kille.interfaces.terminal import FAILED, FINE, complain, complain_all, console
from kille.lab import log, reports
from kille.lab.errors import StudyError
from kille.lab.log import write_tables
from kille.lab.running_studies import Progress, Scheduler, Summary, run
from kille.lab.study import Study
from kille.lab.study_files import check, read, read_and_check
from kille.lab.study_files.consent import check_allowed, python_in
from ttr.safety.consent import OWN_FOLDER, Consent

SHOWN = 10
"""The most broken dialogues that are listed; the table of runs has them all."""


@dataclass(frozen=True)
class StudyRequest:
    """Who is to play a study, and the options as the user gave them."""

    workers: int | None
    scheduler: Scheduler | None
    command: str
    consent: Consent = OWN_FOLDER
    trusts: bool = False
    """May Python that a log names be run?"""
    study: Path | None = None
    """A study to use instead of that of the log."""


First: TypeAlias = Callable[[Study, Path], object]


def keep_as_is(study: Study, folder: Path) -> None:
    """Do nothing first: broken dialogues are not played again."""


def run_study(path: Path, folder: Path | None, request: StudyRequest) -> int:
    """Play a study into a folder, or go on with it; returns the exit code."""
    folder = folder or Path(f"{path.stem}.results")
    try:
        study = read_and_check(path, request.consent)
        tell_doubts(study)
        return _run(study, folder, request)
    except MISTAKES as error:
        return complain_all(error)


def resume_study(folder: Path, request: StudyRequest, first: First = keep_as_is) -> int:
    """Go on with the study in a folder, after calling `first` on it."""
    try:
        study = study_for_folder(folder, request)
        if faults := check(study):
            raise StudyError(faults)
        first(study, folder)
        return _run(study, folder, request)
    except MISTAKES as error:
        return complain_all(error)


def study_for_folder(folder: Path, request: StudyRequest) -> Study:
    """The study that the user names for a folder, or else that of its log."""
    if request.study is not None:
        study = read(request.study, request.consent)
        check_allowed(study)
        return study
    return study_of_log(folder, request.consent, request.trusts)


def _run(study: Study, folder: Path, request: StudyRequest) -> int:
    console().print(f"{study.title}: {study.in_numbers()}", markup=False)
    by = crew_for(study, request.workers, request.scheduler)
    shown = nullcontext(_show_nothing) if has_people(study) else bar()
    with shown as show_progress, stoppable() as stop:

        def check_and_show(it: Progress) -> None:
            stop.check()
            show_progress(it)

        try:
            summary = run(study, folder, by=by, told=check_and_show)
        except KeyboardInterrupt:
            return _report_stop(study, folder, stop.code)
    write_tables(folder)
    page, results = reports.report(folder, command=request.command, study=study)
    print_summary(results)
    _report_end(study, folder, page, summary)
    return FAILED if summary.broken else FINE


def _report_stop(study: Study, folder: Path, code: int) -> int:
    over, planned = log.count_outcomes(folder), log.about(folder).planned
    return complain(
        f"stopped with {over:,} of {planned:,} dialogues over; go on with: "
        f"{_resume_command(study, folder)}",
        code,
    )


def _resume_command(study: Study, folder: Path) -> str:
    """The command to go on with; a log by itself runs none of the Python it names."""
    if not python_in(study):
        return f"kille experiment resume {quote(str(folder))}"
    return f"kille experiment run {quote(str(study.file))} --out {quote(str(folder))}"


def _report_end(study: Study, folder: Path, page: Path, summary: Summary) -> None:
    out = console()
    before = summary.planned - summary.played
    line = f"{summary.played:,} dialogue{'s' if summary.played != 1 else ''} played"
    if before:
        line += f", {before:,} {'were' if before != 1 else 'was'} over before"
    out.print(f"{line}: {folder}", markup=False)
    out.print(f"report: {page}", markup=False)
    if not summary.broken:
        return
    broken = log.broken_runs(folder)
    complain(f"{len(broken):,} of {summary.planned:,} dialogues broke:")
    for it in broken[:SHOWN]:
        complain(f"{it.run}: {it.reason}")
    more = len(broken) - SHOWN
    hint = f"and {more:,} more; " if more > 0 else ""
    trust = " --trust" if python_in(study) else ""
    complain(
        f"{hint}kille experiment show {quote(str(folder))} RUN says where, and "
        f"kille experiment resume {quote(str(folder))} --again{trust} plays them again"
    )


def _show_nothing(it: Progress) -> None:
    """Ignore progress: where people type, nothing moves."""
