"""What becomes of a run: a dialogue that was played, or why it could not be."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import NamedTuple, TypeAlias

from kille.lab.dialogues import Played
from kille.lab.errors import StudyError
from kille.lab.study import Run, Study

Play: TypeAlias = Callable[[Study, Run], Played]
"""What plays one dialogue of a study."""

LONGEST = 300


class RunError(StudyError):
    """Dialogues that cannot be played, kept or found: one line, with a way out.

    >>> from pathlib import Path
    >>> from kille.lab.log import about
    >>> about(Path("nowhere"))
    Traceback (most recent call last):
        ...
    kille.lab.log.outcomes.RunError: there is no log.db in nowhere: name a folder of
    results, such as kille experiment run makes
    """

    def __init__(self, fault: str) -> None:
        super().__init__([fault])

    def __reduce__(self) -> tuple[object, ...]:
        return RunError, self.faults


class Finished(NamedTuple):
    """A dialogue as it went, and how many seconds it took.

    >>> from kille.lab.study import Run
    >>> finished = Finished(Run("both", "Ann", "table", 1), Played((), ()), 0.5)
    >>> print(finished.run)
    both/Ann/table/1
    """

    run: Run
    played: Played
    seconds: float


class Broken(NamedTuple):
    """A dialogue that could not be played to its end: why in one line, and where.

    >>> from kille.lab.study import Run
    >>> broken = Broken(Run("both", "Ann", "table", 1), "the tutor left", "", 0.5)
    >>> print(broken.run, broken.reason)
    both/Ann/table/1 the tutor left
    """

    run: Run
    reason: str
    trace: str
    seconds: float


Outcome: TypeAlias = Finished | Broken
"""What became of a run.

>>> from kille.lab.log import Broken, Outcome
>>> from kille.lab.study import Run
>>> isinstance(Broken(Run("both", "Ann", "table", 1), "left", "", 0.5), Outcome)
True
"""

PlayAll: TypeAlias = Callable[[Sequence[Run]], Generator[Outcome, None, None]]
"""Plays many dialogues; what became of them, as they end."""

DEADLY = "every worker that played it died: is there memory enough?"
"""Why a dialogue is broken that nobody lived through."""


def play_to_outcome(study: Study, run: Run, play: Play) -> Outcome:
    """Play a run; whatever the theory or the tutor in it raises makes it broken.

    >>> def play(study, run):
    ...     return {}[run.theory]
    >>> study, run = Study("", {}, {}, {}, (), ()), Run("a", "Ann", "table", 1)
    >>> play_to_outcome(study, run, play).reason
    "KeyError: 'a' (<doctest ...>, line 2, in play)"
    """
    start = time.perf_counter()
    try:
        played = play(study, run)
    except (Exception, SystemExit) as error:
        return broken_run(run, error, time.perf_counter() - start)
    return Finished(run, played, time.perf_counter() - start)


def broken_run(run: Run, error: BaseException, seconds: float) -> Broken:
    """A run that failed with this error after `seconds`."""
    trace = "".join(traceback.format_exception(error))
    return Broken(
        run, _keepable(reason_of(_root_cause(error))), _keepable(trace), seconds
    )


def _keepable(text: str) -> str:
    """A text that a database takes: surrogates are escaped."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def _root_cause(error: BaseException) -> BaseException:
    """The error that caused all others, such as one of a user's learner."""
    while error.__cause__ is not None:
        error = error.__cause__
    return error


def reason_of(error: BaseException) -> str:
    """What went wrong and where, in one line."""
    told = " ".join(f"{type(error).__name__}: {error}".split()).rstrip(": ")
    if len(told) > LONGEST:
        told = f"{told[: LONGEST - 1]}…"
    frames = traceback.extract_tb(error.__traceback__)
    if not frames:
        return told
    last = frames[-1]
    return f"{told} ({Path(last.filename).name}, line {last.lineno}, in {last.name})"
