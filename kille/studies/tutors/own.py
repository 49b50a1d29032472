"""Tutors of one's own: what makes them is found in a file, or in a module.

It is a class, or a function, that is called with the tutor's `name`, his `words` (see
`kille.studies.tutors.words.Words`) and the settings of the study, and gives a `Tutor`.
A file is run anew for each dialogue, so that what it draws by chance, or counts, does
not go on from the dialogue before.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

from kille.studies.errors import StudyError
from kille.studies.tutors.tutor import Tutor
from ttr.modules import importing_from, run_file

__all__ = ["Make", "maker_of"]

Make = Callable[..., Tutor]


def maker_of(name: str, folder: Path) -> Make:
    """What makes a tutor: `FILE.py:NAME`, from a folder, or `MODULE:NAME`.

    Raises `StudyError` where there is none.
    """
    where, colon, what = name.rpartition(":")
    if not colon:
        raise StudyError([f"{name} names no tutor: write FILE.py:NAME or MODULE:NAME"])
    try:
        module = _module(where, folder)
    except Exception as error:
        raise StudyError([f"{where} cannot be used: {_told(error)}"]) from error
    made: Make | None = getattr(module, what, None)
    if not callable(made):
        found = "nothing" if made is None else repr(made)
        raise StudyError([f"{where}: {what} should make a tutor, but there is {found}"])
    return made


def _module(where: str, folder: Path) -> ModuleType:
    if where.endswith(".py"):
        file = folder / os.path.expanduser(where)
        return run_file(file, f"_tutor_{file.stem}")
    with importing_from(folder.resolve()):
        return importlib.import_module(where)


def _told(error: Exception) -> str:
    first = next(iter(str(error).splitlines()), "")
    return f"{type(error).__name__}: {first}".removesuffix(": ")
