"""Those who play dialogues in processes of their own: here, or on a cluster of Dask.

Runs are sent in batches that take about as long as each other, few at a time, so that
little is lost when all is stopped. What a worker had that dies is played by another.
Runs with which several died are played alone at the end: if one dies again, it was that
run.
"""

from __future__ import annotations

import logging
import math
import threading
import time
import warnings
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from functools import lru_cache
from importlib.metadata import version
from queue import Empty, SimpleQueue
from typing import Any

import cloudpickle
import dask
from distributed import Client, Future, KilledWorker, LocalCluster
from distributed.client import ClosedClientError

from kille.studies.log.outcomes import Broken, Outcome, Play, RunError, outcome
from kille.studies.running.crews import PlayAll
from kille.studies.running.local import Workers
from kille.studies.running.threads import one_thread
from kille.studies.study import Run, Study

__all__ = ["elsewhere", "led", "play_batch", "quietly"]

BATCH_SECONDS = 1.0
LARGEST = 100
AHEAD = 2
"""How many batches each worker has, so that it never waits for the next."""
GLANCE = 2.0
"""After so many seconds it is seen who is still there."""
PATIENCE = 60.0
"""So long there may be no workers at all."""
CONNECTING = 10.0
STARTING = 60.0
"""So long it may take until processes of this machine answer, if it is busy."""
WAITING = 10.0
CLOSING = 5.0

_SETTINGS: dict[str, object] = {
    "distributed.scheduler.allowed-failures": 1,
    "distributed.comm.retry.count": 0,
    # What Dask would learn of this machine many times a second takes time to learn.
    "distributed.scheduler.work-stealing": False,
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "10s",
}


@contextmanager
def led(begun: Workers, study: Study, play: Play) -> Iterator[PlayAll]:
    """Processes of this machine, led by a scheduler in this one, as `Crew` has it."""
    place = "this machine"
    with quietly(), dask.config.set(_SETTINGS), _scheduler() as scheduler:
        begun.join(scheduler.scheduler_address, _SETTINGS)
        with _connected(scheduler, place, STARTING) as client:
            _wait(client, begun)
            yield _Cluster(client, place, study, play).play_all


@contextmanager
def _scheduler() -> Iterator[LocalCluster]:
    """A scheduler in this process, which hears this machine alone."""
    cluster = LocalCluster(
        n_workers=0, host="127.0.0.1", protocol="tcp://", dashboard_address=None
    )
    try:
        yield cluster
    finally:
        with suppress(Exception):
            cluster.close(timeout=CLOSING)


def _wait(client: Client, begun: Workers) -> None:
    """Until all are there, or have had long enough."""
    until = time.monotonic() + STARTING
    while time.monotonic() < until:
        begun.check()
        with suppress(TimeoutError):
            client.wait_for_workers(begun.count, timeout=GLANCE)
            return


@contextmanager
def elsewhere(scheduler: str, study: Study, play: Play) -> Iterator[PlayAll]:
    """The workers of a cluster that is there already.

    RunError where nobody is at this address, or the workers have no such kille.
    """
    with quietly(), _connected(scheduler, scheduler, CONNECTING) as client:
        _check_workers(client, scheduler)
        yield _Cluster(client, scheduler, study, play).play_all


class _Cluster:
    """Sends batches, and takes what becomes of them."""

    def __init__(self, client: Client, place: str, study: Study, play: Play) -> None:
        self.client, self.place = client, place
        self.payload = cloudpickle.dumps((study, play))
        self.sent: dict[Future, Sequence[Run]] = {}
        self.over: SimpleQueue[Future] = SimpleQueue()
        self.pace = BATCH_SECONDS
        self.seen = time.monotonic()
        self.count, self.glance = 1, 0.0

    def play_all(self, runs: Sequence[Run]) -> Generator[Outcome, None, None]:
        """Plays all, in any order."""
        left, suspects = deque(runs), list[Run]()
        try:
            yield from self._play_many(left, suspects)
            for run in suspects:
                yield self._play_alone(run)
        finally:
            with suppress(Exception):
                self.client.cancel(list(self.sent), force=True)

    def _play_many(self, left: deque[Run], suspects: list[Run]) -> Iterator[Outcome]:
        while left or self.sent:
            while left and len(self.sent) < AHEAD * self._workers():
                self._send(left)
            future = self._next()
            runs = self.sent.pop(future)
            found = self._result(future)
            if found is None:
                suspects += runs
                continue
            self._keep_pace(found)
            yield from found

    def _play_alone(self, run: Run) -> Outcome:
        self._send(deque([run]))
        future = self._next()
        del self.sent[future]
        found = self._result(future)
        if found is not None:
            return found[0]
        return Broken(run, _DEADLY, "", 0.0)

    def _send(self, left: deque[Run]) -> None:
        # The last are small, so that all workers come to their end together.
        share = math.ceil(len(left) / (AHEAD * self._workers()))
        size = max(1, min(LARGEST, round(BATCH_SECONDS / self.pace), share))
        runs = [left.popleft() for _ in range(size)]
        try:
            future = self.client.submit(play_batch, self.payload, runs, pure=False)
        except ClosedClientError as error:
            raise self._gone() from error
        self.sent[future] = runs
        future.add_done_callback(self.over.put)

    def _next(self) -> Future:
        """The next batch that is over; RunError where nobody is there any more."""
        while True:
            with suppress(Empty):
                future = self.over.get(timeout=GLANCE)
                self.seen = time.monotonic()
                return future
            self._check_there()

    def _check_there(self) -> None:
        """RunError where there has been no worker for long."""
        if self._counted():
            self.seen = time.monotonic()
        elif time.monotonic() - self.seen > PATIENCE:
            raise RunError(f"no worker is left at {self.place}: {_GO_ON}")

    def _workers(self) -> int:
        """How many were there a moment ago, at least one: others may come and go."""
        if time.monotonic() > self.glance:
            self.count = max(1, self._counted())
            self.glance = time.monotonic() + GLANCE
        return self.count

    def _counted(self) -> int:
        """How many are there now; RunError where the scheduler is gone."""
        if self.client.status != "running":
            raise self._gone()
        try:
            return len(self.client.nthreads())
        except (OSError, RuntimeError) as error:
            raise self._gone() from error

    def _gone(self) -> RunError:
        return RunError(f"the scheduler at {self.place} is gone: {_GO_ON}")

    def _result(self, future: Future) -> list[Outcome] | None:
        """What became of a batch; None where workers died with it."""
        found: list[list[Outcome]] = []
        # "lost" is what was played by a worker that is gone, and is being played anew.
        while not found and future.status in ("pending", "finished", "lost"):
            with suppress(TimeoutError):
                found = self._gathered(future)
            if not found:  # whoever had it is gone, and another plays it anew
                self._check_there()
        if found:
            return found[0]
        if future.status != "error":
            raise self._gone()
        error = future.exception()
        if isinstance(error, KilledWorker):
            return None
        told = f"the workers at {self.place} cannot play: {error}"
        raise RunError(" ".join(told.split())) from error

    def _gathered(self, future: Future) -> list[list[Outcome]]:
        """What a batch gave, if it did; TimeoutError where that takes long."""

        async def gathered() -> list[list[Outcome]]:
            found = self.client.gather([future], errors="skip", asynchronous=True)
            return list(await found)

        try:
            return list(self.client.sync(gathered, callback_timeout=GLANCE))
        except TimeoutError:
            raise
        except (CancelledError, OSError):
            raise self._gone() from None

    def _keep_pace(self, found: Sequence[Outcome]) -> None:
        mean = sum(it.seconds for it in found) / len(found)
        self.pace = max(1e-6, 0.7 * self.pace + 0.3 * mean)


_DEADLY = "every worker that played it died: is there memory enough?"
_GO_ON = "what was over is kept; run it again to go on"


# --- what the workers do -------------------------------------------------------------


_ONE_AT_A_TIME = threading.Lock()


def play_batch(payload: bytes, runs: Sequence[Run]) -> list[Outcome]:
    """Plays these runs in a worker, one after the other, whatever threads it has."""
    with _ONE_AT_A_TIME, one_thread():
        study, play = _loaded(payload)
        return [outcome(study, run, play) for run in runs]


@lru_cache(1)
def _loaded(payload: bytes) -> tuple[Study, Play]:
    """The study and who plays it, taken out once in each process."""
    found: tuple[Study, Play] = cloudpickle.loads(payload)
    return found


def kille_here() -> str:
    """The version of kille that a worker has."""
    return version("kille")


# --- connecting ----------------------------------------------------------------------


class _Connecting(Client):  # type: ignore[misc]
    """A client that is closed at once where it finds nobody.

    Dask would close it when it is collected as garbage, and could wait for itself then.
    What its loop was still waiting for when it was closed is nobody's error.
    """

    def start(self, **settings: Any) -> None:
        """Connects to the scheduler."""
        try:
            super().start(**settings)
        except BaseException:
            with suppress(Exception):
                self.close(timeout=CLOSING)
            raise
        finally:
            self.loop.asyncio_loop.set_exception_handler(lambda *_: None)


@contextmanager
def _connected(address: Any, place: str, seconds: float) -> Iterator[Client]:
    try:
        client = _Connecting(address, timeout=seconds, set_as_default=False)
    except (OSError, ValueError, RuntimeError) as error:
        raise RunError(
            f"no scheduler can be reached at {place}: is it running, and its address "
            f"right, such as tcp://127.0.0.1:8786?"
        ) from error
    try:
        yield client
    finally:
        with suppress(Exception):
            client.close(timeout=CLOSING)


def _check_workers(client: Client, place: str) -> None:
    try:
        client.wait_for_workers(1, timeout=WAITING)
    except TimeoutError as error:
        raise RunError(
            f"the scheduler at {place} has no workers: start some with dask worker "
            f"{place}"
        ) from error
    try:
        found = set(client.run(kille_here).values())
    except Exception as error:
        why = " ".join(str(error).split())
        raise RunError(
            f"the workers at {place} cannot play: {why}; install kille there"
        ) from error
    if found != {version("kille")}:
        raise RunError(
            f"the workers at {place} have kille {', '.join(sorted(found))}, and here "
            f"it is {version('kille')}: install the same in both places"
        )


_LOGGERS = (
    "asyncio",
    "distributed",
    "distributed.client",
    "tornado",
    "tornado.application",
)


@contextmanager
def quietly() -> Iterator[None]:
    """What Dask logs is for those who mend it: one line of an error says enough."""
    loggers = [logging.getLogger(name) for name in _LOGGERS]
    before = [it.level for it in loggers]
    for it in loggers:
        it.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", module="distributed")
            yield
    finally:
        for it, level in zip(loggers, before, strict=True):
            it.setLevel(level)
