"""Running a study: all its dialogues are played, and kept in its log.

Only the one who runs it writes to the log; those who play send back what became of
their dialogues.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from kille.lab.log import Log
from kille.lab.log.outcomes import Broken, Play
from kille.lab.running_studies.crews import Crew, play_runs
from kille.lab.study import Study


@dataclass(frozen=True)
class Progress:
    """How far a study has come: how many of its dialogues are over, or broke.

    >>> Progress(over=3, planned=10, broken=1).planned
    10
    """

    over: int
    planned: int
    broken: int = 0


@dataclass(frozen=True)
class Summary:
    """What came of running a study: how many dialogues there are, and which broke.

    >>> Summary(planned=10, played=9, broken=1).broken
    1
    """

    planned: int
    played: int
    """How many were played this time; the others were over already."""
    broken: int


def run(
    study: Study,
    folder: Path,
    play: Play | None = None,
    by: Crew | None = None,
    told: Callable[[Progress], None] = lambda progress: None,
) -> Summary:
    """Play what is left of a study; each dialogue is logged when it is over.

    Stopped at any moment, and run again, it goes on. `by` are those who play, by
    default this process alone; `told` hears of every dialogue that is over. StudyError
    where the folder is of another study or in use, or nobody can play.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> from kille.lab.dialogues import Played
    >>> def play(study, run):
    ...     return Played((), (), lessons=run.seed)
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     run(cups, Path(folder), play)
    Summary(planned=1, played=1, broken=0)
    """
    with Log.open(study, folder) as log:
        before = log.reasons()
        planned = tuple(study.runs())
        left = [it for it in planned if it not in before]
        over, broken = len(before), sum(map(bool, before.values()))
        told(Progress(over, len(planned), broken))
        with play_runs(study, left, play, by) as outcomes:
            for it in outcomes:
                over += 1
                broken += isinstance(log.write(it), Broken)
                told(Progress(over, len(planned), broken))
    return Summary(len(planned), len(left), broken)


def forget_broken(study: Study, folder: Path) -> int:
    """Delete all broken runs, so that they are played again; how many.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from kille.lab.study_files import parse
    >>> text = '''
    ...     title = "Cups"
    ...     seeds = 1
    ...     [theories.plain]
    ...     [tutors.ann]
    ...     kind = "simulated"
    ...     [scenes.table]
    ...     kind = "drawn"
    ...     [[phases]]
    ...     do = "teach"
    ... '''
    >>> from kille.lab.dialogues import Played
    >>> def play(study, run):
    ...     return Played((), (), lessons=run.seed)
    >>> cups = parse(text, Path("cups.toml"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     summary = run(cups, Path(folder), play)
    ...     forget_broken(cups, Path(folder))
    0
    """
    with Log.open(study, folder) as log:
        return log.forget_broken()
