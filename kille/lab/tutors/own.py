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
from kille.lab.own_code import describe_exception, failing_line
from kille.lab.settings import suggest_name, why_no_file
from kille.lab.tutors.tutor import Tutor
from ttr.safety.consent import Consent, NotAllowedError
from ttr.safety.python_files import run_named

Make = Callable[..., Tutor]


def load_maker(name: str, folder: Path, consent: Consent | None = None) -> Make:
    """What makes a tutor: `FILE.py:NAME`, from a folder, or `MODULE:NAME`.

    The caller chose this name; for one that was found in a file, `consent` says which
    Python may be run. Raises `StudyError` where there is none.
    """
    where, colon, what = name.rpartition(":")
    if not colon:
        raise StudyError([f"{name} names no tutor: write FILE.py:NAME or MODULE:NAME"])
    if where.endswith(".py") and (told := why_no_file(_file(where, folder))):
        raise StudyError([told])
    try:
        python = os.path.expanduser(where)
        module = run_named(python, folder, "_tutor_", consent)
    except NotAllowedError as error:
        raise StudyError([error.message]) from error
    except (Exception, SystemExit) as error:
        told = describe_error(where, folder, error)
        raise StudyError([f"{where} cannot be used: {told}"]) from error
    made: Make | None = getattr(module, what, None)
    if made is None:
        own = [it for it in vars(module) if not it.startswith("_")]
        raise StudyError([f"{where} has no {what}: {suggest_name(what, own)}"])
    if not callable(made):
        raise StudyError([f"{what} of {where} makes no tutor: name a class"])
    return made


def describe_error(where: str, folder: Path, error: BaseException) -> str:
    """What was raised, and on which line of the file, if it does not say so itself."""
    line = failing_line(str(_file(where, folder)), error)
    says = isinstance(error, SyntaxError) or not line
    return (
        describe_exception(error)
        if says
        else f"{describe_exception(error)} (line {line})"
    )


def _file(where: str, folder: Path) -> Path:
    return folder / os.path.expanduser(where)
