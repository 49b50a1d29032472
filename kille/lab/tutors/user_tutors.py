"""Tutors of one's own: what makes them is found in a file, or in a module.

It is a class, or a function, that is called with the tutor's `name`, `words` (see
`kille.lab.tutors.words.Words`) and the settings of the study, and gives a `Tutor`.
A file is run anew for each dialogue, so that what it draws by chance, or counts, does
not go on from the dialogue before.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from kille.lab.errors import StudyError
from kille.lab.tutors.tutor import Tutor
from kille.lab.user_code import (
    WRITTEN,
    OwnCodeError,
    describe_exception,
    failing_line,
    load_maker,
)
from ttr.safety.consent import Consent

MakeTutor = Callable[..., Tutor]


def load_tutor_maker(
    name: str, folder: Path, consent: Consent | None = None
) -> MakeTutor:
    """What makes a tutor: `FILE.py:NAME`, from a folder, or `MODULE:NAME`.

    The caller chose this name; for one that was found in a file, `consent` says which
    Python may be run. Raises `StudyError` where there is none.
    """
    if ":" not in name:
        raise StudyError([f"{name} names no tutor: write {WRITTEN}"])
    try:
        return load_maker(name, folder, "_tutor_", consent, "tutor")
    except OwnCodeError as error:
        line = f" (line {error.line})" if error.line else ""
        is_told = isinstance(error.__cause__, SyntaxError)
        raise StudyError([f"{error}{'' if is_told else line}"]) from error


def describe_error(name: str, folder: Path, error: BaseException) -> str:
    """What a tutor raised, and on which line of the file."""
    path = folder / os.path.expanduser(name.rpartition(":")[0])
    line = failing_line(str(path), error)
    return f"{describe_exception(error)}{f' (line {line})' if line else ''}"
