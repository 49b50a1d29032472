"""Report an error that nobody foresaw in one line: a command's last line of defence.

Its traceback is written to a file, for the developers. With `KILLE_DEBUG=1` in the
environment it is printed, too.
"""

from __future__ import annotations

import os
import platform
import sys
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tempfile import NamedTemporaryFile

from ttr.escapes import terminal_line, terminal_text

DEBUG = "KILLE_DEBUG"
"""The environment variable that makes a command print tracebacks."""

UNFORESEEN = 2
"""The exit code after an error that nobody foresaw."""

_FILE = "last-error.txt"
_SHOWN = 120
"""How many characters of the error's message are shown."""


def run_guarded(program: str, run: Callable[[], int | None]) -> int:
    """Runs a command and gives the exit code, also after an unforeseen error.

    >>> run_guarded("ttr", lambda: 0)
    0
    """
    try:
        return run() or 0
    except Exception as error:
        return report_unforeseen(program, error)


def report_unforeseen(program: str, error: BaseException) -> int:
    """Says in one line what happened and where to report it; gives the exit code."""
    trace = "".join(traceback.format_exception(error))
    with suppress(Exception):  # what was said before goes before
        sys.stdout.flush()
    with suppress(Exception):
        if os.environ.get(DEBUG):
            sys.stderr.write(terminal_text(trace))
        file = _keep_trace(program, trace)
        line = terminal_line(_report_line(program, error, file))
        sys.stderr.write(f"{program}: {line}\n")
        sys.stderr.flush()
    return UNFORESEEN


def _report_line(program: str, error: BaseException, file: Path | None) -> str:
    kept = f", with the file {file}" if file else f" ({DEBUG}=1 shows where it arose)"
    if isinstance(error, MemoryError):
        return (
            "there is not enough memory for this; if it is small, please report it to "
            f"the developers of Kille{kept}"
        )
    if isinstance(error, RecursionError):
        return (
            "this nests too deep to be followed; if it does not, please report it to "
            f"the developers of Kille{kept}"
        )
    return (
        f"{_error_in_short(error)}: that is a mistake in {program} itself; please "
        f"report it to the developers of Kille{kept}"
    )


def _error_in_short(error: BaseException) -> str:
    """The class of the error and its message, on one line."""
    said = " ".join(str(error).split())
    said = said if len(said) <= _SHOWN else f"{said[: _SHOWN - 1]}…"
    return f"{type(error).__name__}: {said}" if said else type(error).__name__


def _keep_trace(program: str, trace: str) -> Path | None:
    """The file with the traceback, which only the user can read."""
    about = (
        f"{program}, Python {platform.python_version()}, {platform.platform()}\n"
        f"{sys.argv}\n\n{trace}"
    )
    data = about.encode("utf-8", "backslashreplace")
    for write in (_write_to_state, _write_to_temporary):
        with suppress(OSError, RuntimeError):
            return write(data)
    return None


def _write_to_state(data: bytes) -> Path:
    file = state_folder("kille") / _FILE
    file.parent.mkdir(parents=True, exist_ok=True)
    draft = file.with_name(f".{_FILE}.{os.getpid()}")
    try:
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL
        with os.fdopen(os.open(draft, flags, 0o600), "wb") as opened:
            opened.write(data)
        draft.replace(file)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise
    return file


def _write_to_temporary(data: bytes) -> Path:
    with NamedTemporaryFile(prefix="kille-error-", suffix=".txt", delete=False) as file:
        file.write(data)
    return Path(file.name)


def state_folder(program: str) -> Path:
    """The folder for a program's state: histories and reports (XDG)."""
    state = os.environ.get("XDG_STATE_HOME", "")
    home = Path(os.environ.get("HOME") or Path.home())
    return (Path(state) if os.path.isabs(state) else home / ".local/state") / program
