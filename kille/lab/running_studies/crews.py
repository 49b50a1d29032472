"""Those who play the dialogues of a study: this process, others here, or a cluster.

What is played follows from the study and the run alone, so it does not matter who plays
it, or in what order.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import AbstractContextManager, closing, contextmanager
from functools import partial
from importlib.util import find_spec
from typing import TypeAlias

from kille.lab.log.outcomes import Outcome, Play, PlayAll, RunError, play_to_outcome
from kille.lab.running_studies.schedulers import Scheduler
from kille.lab.running_studies.threads import one_thread
from kille.lab.study import Run, Study

MISSING = "Dask is not installed: pip install 'kille[cluster]'"

Crew: TypeAlias = Callable[[Study, Play], AbstractContextManager[PlayAll]]
"""Those who play a study, as long as they are needed.

>>> from kille.lab.running_studies import Crew, crew
>>> by: Crew = crew(1)
>>> callable(by)
True
"""


@contextmanager
def play_runs(
    study: Study,
    runs: Sequence[Run],
    play: Play | None = None,
    by: Crew | None = None,
) -> Iterator[Iterator[Outcome]]:
    """Play runs, and yield their outcomes as they end; the crew is released after it.

    They are played `default_play` by this process, if nothing else is said.
    """
    if not runs:
        yield iter(())
        return
    crew = (by or alone)(study, play or default_play())
    with crew as play_all, closing(play_all(runs)) as outcomes:
        yield outcomes


def default_play() -> Play:
    """The function that plays a dialogue, `kille.lab.playing_dialogues.play`."""
    from kille.lab.playing_dialogues import play

    return play


def crew(workers: int | None = None, scheduler: Scheduler | None = None) -> Crew:
    """A crew of so many processes on this machine, or of a cluster.

    By default it is one process for each core; one is this process itself. RunError
    where a cluster is asked for, and Dask is missing or certificates cannot be used.

    >>> crew(1) is alone
    True
    """
    if scheduler:
        scheduler.check()
        if not find_spec("distributed"):
            raise RunError(f"{MISSING}, or play on this machine without --scheduler")
        from kille.lab.running_studies.clusters import cluster_crew

        return partial(cluster_crew, scheduler)
    workers = cores() if workers is None else workers
    if workers == 1:
        return alone
    from kille.lab.running_studies.local import local_crew

    return partial(local_crew, workers)


def cores() -> int:
    """The number of processors that this process may use."""
    return len(os.sched_getaffinity(0))


@contextmanager
def alone(study: Study, play: Play) -> Iterator[PlayAll]:
    """This process plays all by itself, one dialogue after the other.

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
    >>> with alone(cups, play) as play_all:
    ...     [it.played.lessons for it in play_all(cups.runs())]
    [1]
    """

    def play_all(runs: Sequence[Run]) -> Generator[Outcome, None, None]:
        with one_thread():
            for it in runs:
                yield play_to_outcome(study, it, play)

    yield play_all
