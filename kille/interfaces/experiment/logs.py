"""The study of a folder of results, whose log runs no Python by itself."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from shlex import quote

from kille.interfaces.terminal import console
from kille.lab import log
from kille.lab.errors import StudyError
from kille.lab.study import Study
from kille.lab.study_files.consent import check_allowed, python_in
from ttr.safety.consent import Consent


def study_of_log(folder: Path, consent: Consent, trusts: bool) -> Study:
    """The study of the log in a folder; `StudyError` if it may not be played.

    What it runs of Python is said, if the user trusts it; else it may name none.
    """
    study = log.study(folder, consent)
    named = python_in(study)
    if named and not trusts:
        about = f"{folder} has a study that names Python, {', '.join(named)}"
        raise StudyError([f"{about}, {_unrun(study, consent)}"])
    check_allowed(study)
    for name in named:
        _announce(study, name)
    return study


def consent_to(consent: Consent, trusts: bool) -> Consent:
    """The consent for showing what logs name: Python only if the user trusts them."""
    return replace(consent, python=consent.python and trusts)


def _unrun(study: Study, consent: Consent) -> str:
    """Explain why Python named by a log is not run, and what to do."""
    if not consent.python:
        return "and --no-python refuses it"
    return (
        "and a log runs none by itself: name the study with --study "
        f"{quote(study.file.name)}, or let it run what it names with --trust"
    )


def _announce(study: Study, name: str) -> None:
    where = (study.folder / name).resolve() if name.endswith(".py") else name
    console().print(f"running {where}, which the log names", markup=False)
