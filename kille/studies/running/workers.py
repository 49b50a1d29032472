"""Workers of Dask on this machine, forked from one process that has loaded all.

    python -m kille.studies.running.workers

Loading is done once, so that each worker is there at once, and one that dies is soon
replaced. Whom they work for is one line of JSON in the input, see `begin`; they end
when the input does, and so outlive nobody who began them, whatever ends that one.
"""

from __future__ import annotations

import asyncio
import gc
import json
import os
import select
import signal
import sys
import time
from collections.abc import Callable, Coroutine, Iterator
from contextlib import suppress
from tempfile import TemporaryDirectory

__all__ = ["begin"]

GLANCE = 0.2
"""After so many seconds it is seen which worker died, and whether all is over."""
APART = 1.0
"""Seconds between two workers in one place: some may never be able to work."""
FAILED = 87
"""A code of its own: with 1 a library may end a process that does work."""
SOON = 5.0
"""Who fails within so many seconds never worked."""
MOST = 5
"""After so many in a row that never worked no other is begun."""


def begin() -> None:
    """Forks workers for the scheduler that the input names, until the input ends.

    The line has its `address`, how many `workers` there shall be, and the `settings` of
    Dask.
    """
    for it in (signal.SIGINT, signal.SIGTERM):
        signal.signal(it, signal.SIG_IGN)  # meant for who sends the runs
    load()
    line = sys.stdin.readline()
    if not line:
        return
    asked = json.loads(line)
    with suppress(OSError), TemporaryDirectory(prefix="kille-workers-") as folder:

        def work(number: int) -> None:
            silent(working(asked["address"], number, folder, asked["settings"]))

        keep(asked["workers"], work)


def load() -> None:
    """Loads Dask and what plays; what is there then is not looked at any more."""
    import kille.studies.playing
    import kille.studies.running.clusters  # noqa: F401

    gc.collect()
    gc.freeze()


def keep(workers: int, work: Callable[[int], None]) -> None:
    """Keeps so many at work until the input ends, or they fail; ends them then."""
    at_work = dict[int, int]()
    begun = dict[int, float]()
    failed = 0
    try:
        while failed < MOST and not over(GLANCE * bool(begun)):
            for process, code in ended():
                lasted = time.monotonic() - begun[at_work.pop(process)]
                failed = failed + 1 if code == FAILED and lasted < SOON else 0
            for number in set(range(workers)) - set(at_work.values()):
                if time.monotonic() - begun.get(number, -APART) >= APART:
                    begun[number] = time.monotonic()
                    at_work[forked(work, number)] = number
    finally:
        for process in at_work:
            with suppress(ProcessLookupError, ChildProcessError):
                os.kill(process, signal.SIGKILL)
                os.waitpid(process, 0)


def over(seconds: float) -> bool:
    """Whether the input has ended, after so many seconds at most."""
    return bool(select.select([sys.stdin], [], [], seconds)[0])


def forked(work: Callable[[int], None], number: int) -> int:
    """The process that does this work, and nothing after it."""
    process = os.fork()
    if process:
        return process
    code = FAILED
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        work(number)
        code = 0
    finally:
        os._exit(code)


def ended() -> Iterator[tuple[int, int]]:
    """The processes that have ended since it was asked last, and their exit codes."""
    with suppress(ChildProcessError):
        while (found := os.waitpid(-1, os.WNOHANG))[0]:
            yield found[0], os.waitstatus_to_exitcode(found[1])


def silent(work: Coroutine[None, None, None]) -> None:
    """Does it, and says nothing, nor of what is left when its loop is closed."""
    from kille.studies.running.clusters import quietly

    with quietly():
        asyncio.run(work)


async def working(
    address: str, number: int, folder: str, settings: dict[str, object]
) -> None:
    """Works for this scheduler for as long as it is there."""
    import dask
    from distributed import Worker

    with dask.config.set(settings):
        worker = Worker(
            address,
            nthreads=1,
            name=number,
            memory_limit=0,
            dashboard=False,
            local_directory=folder,
        )
        async with worker:
            await worker.finished()


if __name__ == "__main__":
    begin()
