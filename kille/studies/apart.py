"""Theories with meanings of their own, each played by a process of its own.

States, rules and words are made of the types of one theory, which a process reads once.
A theory that has others is asked for in a process that was begun with these; that lives
for as long as this one, and is asked again for the next dialogue.
"""

from __future__ import annotations

import atexit
import json
import os
import pickle
import signal
import subprocess
import traceback
from contextlib import suppress
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from threading import Lock
from typing import Any

from kille.dialogue.redefining import ALLOWED, VARIABLE
from kille.studies.errors import TheoryError
from kille.studies.study import Theory
from ttr.safety.python_files import separate_python

_ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"
)
"""Sums are added up in the same order as where other theories are played."""

SOON = 5.0
"""Seconds in which a process ends that is not asked any more."""


def is_apart(theory: Theory) -> bool:
    """Whether its meanings are not those of this process."""
    return own_types(theory) not in ("", os.environ.get(VARIABLE))


def own_types(theory: Theory) -> str:
    """What the variable of its process says, see `kille.dialogue.redefining`."""
    own = theory.meanings
    return own if isinstance(own, str) else json.dumps(dict(own)) if own else ""


def allowed_for(theory: Theory) -> str:
    """The folders from which its meanings may import, as a variable says them."""
    folders = theory.consent.folders if theory.consent is not None else ()
    return os.pathsep.join(map(str, folders))


def ask(theory: Theory, what: str, *given: object) -> Any:
    """What a function, `MODULE:NAME`, gives in the process of a theory's meanings.

    Raises what it raises there, and `TheoryError` where the process cannot begin.
    """
    process = _process(own_types(theory), allowed_for(theory), _changed(theory))
    return process.ask(what, given)


def _changed(theory: Theory) -> int:
    """When the file with its meanings was changed last, if it has one."""
    if not isinstance(theory.meanings, str):
        return 0
    try:
        return Path(theory.meanings).stat().st_mtime_ns
    except OSError as error:
        raise TheoryError(f"there is no file {theory.meanings}") from error


@lru_cache
def _process(own: str, allowed: str, _: int) -> _Process:
    """The process with these types, as they were when they were changed last."""
    return _Process(own, allowed)


class _Process:
    """A process with other types, to which functions and values are sent.

    If it ends, or is left before it has answered, it is begun anew when it is asked
    next: so one dialogue that it does not survive does not break the others.
    """

    def __init__(self, own: str, allowed: str) -> None:
        self._variables = {**_ONE_THREAD, VARIABLE: own, ALLOWED: allowed}
        self._asking = Lock()
        self._process: subprocess.Popen[bytes] | None = None
        atexit.register(self._end)

    def ask(self, what: str, given: tuple[object, ...]) -> Any:
        """What the function gives for these values there."""
        question = pickle.dumps((what, given))
        with self._asking:
            try:
                found, told, trace = self._answer(question)
            except (EOFError, OSError) as error:
                self._kill()
                ended = "the process of a theory with meanings of its own has ended"
                raise TheoryError(f"{ended}: play the study again") from error
            except BaseException:  # else it would answer this to who asks next
                self._kill()
                raise
        if not trace:
            return pickle.loads(found)
        raised = _error(found, told)
        raised.add_note(trace)
        raise raised

    def _answer(self, question: bytes) -> tuple[bytes, str, str]:
        if self._process is None:
            command, around = separate_python("-m", "kille.studies.apart")
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env={**around, **self._variables},
            )
        asks, answers = self._process.stdin, self._process.stdout
        assert asks is not None
        assert answers is not None
        asks.write(question)
        asks.flush()
        answer: tuple[bytes, str, str] = pickle.load(answers)
        return answer

    def _kill(self) -> None:
        if self._process is not None:
            self._process.kill()
        self._end()

    def _end(self) -> None:
        if self._process is None:
            return
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                pipe.close()  # type: ignore[union-attr]
        try:
            self._process.wait(SOON)
        except subprocess.TimeoutExpired:
            self._process.kill()
        self._process = None


def _error(found: bytes, told: str) -> Exception:
    """An error that was raised there; its words only, if it is not known here."""
    try:
        error: Exception = pickle.loads(found)
    except Exception:
        return RuntimeError(told)
    return error


# --- in the other process -------------------------------------------------------------


def answer() -> None:
    """Answer all that is asked, until nobody asks any more.

    What others print goes to the errors, and they read nothing: the input is for what
    is asked, the output for the answers.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who asks ends this process
    asked, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    while True:
        try:
            what, given = pickle.load(asked)
        except EOFError:
            return
        with suppress(BrokenPipeError):
            answers.write(_answered(what, given))
            answers.flush()


def _answered(what: str, given: tuple[object, ...]) -> bytes:
    """What a function gives; or its error, the words of it, and where it was."""
    try:
        module, _, name = what.partition(":")
        found = pickle.dumps(getattr(import_module(module), name)(*given))
        return pickle.dumps((found, "", ""))
    except Exception as error:
        told, trace = f"{type(error).__name__}: {error}", traceback.format_exc()
        with suppress(Exception):
            return pickle.dumps((pickle.dumps(error), told, trace))
        return pickle.dumps((b"", told, trace))


if __name__ == "__main__":
    answer()
