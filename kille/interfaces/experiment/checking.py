"""`kille experiment check`: find what is wrong with studies before they are played."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from kille.interfaces.experiment.people import people_summary
from kille.interfaces.terminal import FINE, complain, complain_all, console
from kille.lab.errors import StudyError
from kille.lab.study import Study
from kille.lab.study_files import read_and_check
from kille.lab.study_files.warnings import warnings_of
from ttr import TTRError
from ttr.safety.consent import Consent

MISTAKES = StudyError, TTRError
"""Errors of the user, reported in a line or a few."""


def check_files(files: Sequence[Path], consent: Consent) -> int:
    """Report for each file what it would play, or all that is wrong with it."""
    codes = [_check_file(path, consent) for path in files]
    return max(codes, default=FINE)


def _check_file(path: Path, consent: Consent) -> int:
    try:
        study = read_and_check(path, consent)
    except MISTAKES as error:
        return complain_all(error)
    tell_doubts(study)
    line = f"{path}: fine, {study.in_numbers()}{people_summary(study)}"
    console().print(line, markup=False)
    return FINE


def tell_doubts(study: Study) -> None:
    """Warn of what is no mistake, but probably not intended."""
    for it in warnings_of(study):
        complain(f"{it} (this can be played)")
