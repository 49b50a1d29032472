"""Processes of this machine that play, led by a scheduler of Dask in this one."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from subprocess import PIPE, Popen, TimeoutExpired
from typing import Self

from kille.studies.log.outcomes import Play, RunError
from kille.studies.running.crews import PlayAll
from kille.studies.running.threads import READ_WHEN_LOADED
from kille.studies.study import Study

__all__ = ["Workers", "here"]

ENDING = 5.0
"""Seconds in which all have ended that are not needed any more."""


@contextmanager
def here(workers: int, study: Study, play: Play) -> Iterator[PlayAll]:
    """So many processes of this machine, as `Crew` has it."""
    with Workers(workers) as begun:
        # Loading Dask takes a while, in which they load what they need.
        from kille.studies.running.clusters import led

        with led(begun, study, play) as play_all:
            yield play_all


class Workers:
    """Processes that play for one scheduler, see `kille.studies.running.workers`."""

    def __init__(self, count: int) -> None:
        self.count = count
        single = dict.fromkeys((*READ_WHEN_LOADED, "OPENCV_FOR_THREADS_NUM"), "1")
        modules = {"PYTHONPATH": os.pathsep.join(map(str, sys.path))}
        self._process = Popen(
            [sys.executable, "-P", "-m", "kille.studies.running.workers"],
            env=os.environ | single | modules,
            stdin=PIPE,
            text=True,
            start_new_session=True,  # Ctrl-C is for the one who sends the runs
        )
        assert self._process.stdin is not None
        self._asks = self._process.stdin

    def join(self, address: str, settings: dict[str, object]) -> None:
        """They work for the scheduler at this address from now on."""
        asked = {"address": address, "workers": self.count, "settings": settings}
        with suppress(BrokenPipeError):
            print(json.dumps(asked), file=self._asks, flush=True)

    def check(self) -> None:
        """RunError where they are gone, and no others come."""
        if self._process.poll() is not None:
            raise RunError("no workers can be begun on this machine: try --workers 1")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        """Ends them all, whatever they do."""
        with suppress(BrokenPipeError):
            self._asks.close()
        try:
            self._process.wait(ENDING)
        except TimeoutExpired:
            self._process.kill()
            self._process.wait()
