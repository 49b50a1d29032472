"""Python of one's own: tutors, rules and learners that a user has written."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from traceback import extract_tb
from typing import Any

from kille.lab.settings import suggest_name, why_no_file
from ttr.safety.consent import Consent, NotAllowedError
from ttr.safety.python_files import run_named

WRITTEN = "FILE.py:NAME or MODULE:NAME"
"""How one's own Python is named."""


class OwnCodeError(Exception):
    """Python of one's own that cannot be used: why, and on which line, 0 if unknown."""

    def __init__(self, message: str, line: int = 0) -> None:
        super().__init__(message, line)
        self.message, self.line = message, line

    def __str__(self) -> str:
        return self.message


def load_object(
    reference: str, folder: Path, prefix: str, consent: Consent | None
) -> Any:
    """What `FILE.py:NAME`, from a folder, or `MODULE:NAME` names; a file is run anew.

    Without a `consent`, it is the caller who names it. Raises `OwnCodeError`, caused by
    whatever the code raises.
    """
    where, _, name = reference.rpartition(":")
    path = os.path.expanduser(where)
    if path.endswith(".py") and (told := why_no_file(folder / path)):
        raise OwnCodeError(told)
    try:
        module = run_named(path, folder, prefix, consent)
    except NotAllowedError as error:
        raise OwnCodeError(error.message) from error
    except (Exception, SystemExit) as error:
        if _is_missing(path, error):
            told = f"there is no module {path}: write {WRITTEN}"
            raise OwnCodeError(told) from error
        line = failing_line(str(folder / path), error)
        told = f"{where} cannot be run: {describe_exception(error)}"
        raise OwnCodeError(told, line) from error
    if not hasattr(module, name):
        own = [it for it in vars(module) if not it.startswith("_")]
        what = name or "object without a name"
        raise OwnCodeError(f"{where} has no {what}: {suggest_name(name, own)}")
    return getattr(module, name)


def load_maker(
    reference: str, folder: Path, prefix: str, consent: Consent | None, what: str
) -> Callable[..., Any]:
    """The class or function of this name that makes a `what`, as `load_object` has it.

    Raises `OwnCodeError` also where it cannot be called.
    """
    made = load_object(reference, folder, prefix, consent)
    if not callable(made):
        where, _, name = reference.rpartition(":")
        raise OwnCodeError(f"{name} of {where} makes no {what}: name a class")
    make: Callable[..., Any] = made
    return make


def _is_missing(path: str, error: BaseException) -> bool:
    """Whether there is no module of this name, or none that it would be in."""
    if not isinstance(error, ModuleNotFoundError) or error.name is None:
        return False
    return not path.endswith(".py") and f"{path}.".startswith(f"{error.name}.")


def describe_exception(error: BaseException) -> str:
    """What was raised, and the first line of what it says.

    >>> describe_exception(ValueError("no weights")), describe_exception(SystemExit())
    ('ValueError: no weights', 'SystemExit')
    """
    first = next(iter(str(error).splitlines()), "")
    return f"{type(error).__name__}: {first}".removesuffix(": ")


def failing_line(path: str, error: BaseException | None) -> int:
    """The line of a file at which it failed, the last on the way there; or else 0."""
    if error is None:
        return 0
    if isinstance(error, SyntaxError) and error.filename == path:
        return error.lineno or 1
    passed = extract_tb(error.__traceback__)
    return next((it.lineno or 1 for it in passed[::-1] if it.filename == path), 0)
