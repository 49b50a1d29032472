"""`kille experiment replay`: play dialogues again and compare."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from kille.interfaces.experiment.bars import bar
from kille.interfaces.experiment.checking import MISTAKES
from kille.interfaces.experiment.crews import choose_crew
from kille.interfaces.experiment.people import people_in
from kille.interfaces.experiment.running import StudyRequest, study_for_folder
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain,
    complain_all,
    console,
    hang_text,
)
from kille.lab import log
from kille.lab.log import Broken, Outcome, RunError
from kille.lab.log.sources import changed_sources, sources
from kille.lab.running_studies import Difference, Progress, replay
from kille.lab.study import Run


def replay_all(folder: Path, names: Sequence[str], request: StudyRequest) -> int:
    """Replay dialogues of a folder, all if none is named; returns 1 if any differs."""
    try:
        befores = [log.find_outcome(folder, it) for it in names] or [
            *log.outcomes(folder)
        ]
        found = _replay(folder, befores, request)
    except MISTAKES as error:
        return complain_all(error)
    out = console()
    for it in befores:
        if names or found[it.run]:
            out.print(_describe_difference(it, found[it.run]), markup=False)
    same = sum(differs is None for differs in found.values())
    if not names:
        out.print(f"{same:,} of {len(found):,} dialogues go as they went", markup=False)
    return FINE if same == len(found) else FAILED


def _replay(
    folder: Path, befores: Sequence[Outcome], request: StudyRequest
) -> dict[Run, Difference | None]:
    """The first difference of each dialogue when played again."""
    study = study_for_folder(folder, request)
    for it in befores:
        if people_in(study, it.run):
            raise RunError(
                f"a person takes part in {it.run} of {folder}, and would type anew: "
                "name dialogues that are played without people, if there are any"
            )
    for name in changed_sources(log.about(folder).sources, sources(study)):
        complain(f"{name} has changed since these dialogues were played")
    workers = 1 if len(befores) == 1 else request.workers
    by = choose_crew(workers, request.scheduler)
    found: dict[Run, Difference | None] = {}
    with bar() as show_progress:
        for before, differs in replay(study, befores, by=by):
            found[before.run] = differs
            show_progress(Progress(len(found), len(befores)))
    return found


def _describe_difference(before: Outcome, found: Difference | None) -> str:
    if found is None:
        went = "breaks as it did" if isinstance(before, Broken) else _size(before)
        return f"{before.run}: the same, {went}"
    change = f"{found.where} was {found.before!r} and is {found.now!r}"
    return hang_text(f"{before.run}: ", change)


def _size(before: Outcome) -> str:
    played = getattr(before, "played", None)
    return f"{len(played.turns) if played else 0:,} turns"
