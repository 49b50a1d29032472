"""The workers of a cluster of Dask, which play dialogues.

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
from ssl import SSLError
from typing import Any

import cloudpickle
from distributed import Client, Future, KilledWorker
from distributed.client import ClosedClientError
from distributed.security import Security

from kille.lab.log.outcomes import (
    DEADLY,
    Broken,
    Outcome,
    Play,
    PlayAll,
    RunError,
    play_to_outcome,
)
from kille.lab.running_studies.schedulers import Scheduler
from kille.lab.running_studies.threads import one_thread
from kille.lab.study import Run, Study

BATCH_SECONDS = 1.0
LARGEST = 100
AHEAD = 2
"""How many batches each worker has, so that it never waits for the next."""
GLANCE = 2.0
"""After so many seconds it is seen who is still there."""
PATIENCE = 60.0
"""So long there may be no workers at all."""
CONNECTING = 10.0
WAITING = 10.0
CLOSING = 5.0


@contextmanager
def cluster_crew(scheduler: Scheduler, study: Study, play: Play) -> Iterator[PlayAll]:
    """The workers of a cluster that is there already.

    RunError where nobody is at this address, the certificates do not fit, or the
    workers have no such kille.
    """
    place = scheduler.address
    with silence_dask(), _connect(scheduler, CONNECTING) as client:
        _check_workers(client, place)
        yield _Cluster(client, place, study, play).play_all


class _Cluster:
    """Sends batches of runs to a cluster, and receives their outcomes."""

    def __init__(self, client: Client, place: str, study: Study, play: Play) -> None:
        self.client, self.place = client, place
        self.payload = cloudpickle.dumps((study, play))
        self.sent: dict[Future, Sequence[Run]] = {}
        self.over: SimpleQueue[Future] = SimpleQueue()
        self.pace = BATCH_SECONDS
        self.seen = time.monotonic()
        self.count, self.glance = 1, 0.0

    def play_all(self, runs: Sequence[Run]) -> Generator[Outcome, None, None]:
        """Play all runs, in any order."""
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
        return Broken(run, DEADLY, "", 0.0)

    def _send(self, left: deque[Run]) -> None:
        # The last are small, so that all workers come to their end together.
        share = math.ceil(len(left) / (AHEAD * self._workers()))
        size = max(1, min(LARGEST, round(BATCH_SECONDS / self.pace), share))
        runs = [left.popleft() for _ in range(size)]
        try:
            future = self.client.submit(play_batch, self.payload, runs, pure=False)
        except ClosedClientError as error:
            raise self._gone_error() from error
        self.sent[future] = runs
        future.add_done_callback(self.over.put)

    def _next(self) -> Future:
        """The next batch that is over; RunError if no worker is left."""
        while True:
            with suppress(Empty):
                future = self.over.get(timeout=GLANCE)
                self.seen = time.monotonic()
                return future
            self._check_there()

    def _check_there(self) -> None:
        """RunError if there has been no worker for too long."""
        if self._count_workers():
            self.seen = time.monotonic()
        elif time.monotonic() - self.seen > PATIENCE:
            raise RunError(f"no worker is left at {self.place}: {_GO_ON}")

    def _workers(self) -> int:
        """The number of workers a moment ago, at least one."""
        if time.monotonic() > self.glance:
            self.count = max(1, self._count_workers())
            self.glance = time.monotonic() + GLANCE
        return self.count

    def _count_workers(self) -> int:
        """The number of workers now; RunError if the scheduler is gone."""
        if self.client.status != "running":
            raise self._gone_error()
        try:
            return len(self.client.nthreads())
        except (OSError, RuntimeError) as error:
            raise self._gone_error() from error

    def _gone_error(self) -> RunError:
        return RunError(f"the scheduler at {self.place} is gone: {_GO_ON}")

    def _result(self, future: Future) -> list[Outcome] | None:
        """The outcomes of a batch; None if workers died with it."""
        found: list[list[Outcome]] = []
        # "lost" is what was played by a worker that is gone, and is being played anew.
        while not found and future.status in ("pending", "finished", "lost"):
            with suppress(TimeoutError):
                found = self._gather(future)
            if not found:  # whoever had it is gone, and another plays it anew
                self._check_there()
        if found:
            return found[0]
        if future.status != "error":
            raise self._gone_error()
        error = future.exception()
        if isinstance(error, KilledWorker):
            return None
        told = f"the workers at {self.place} cannot play: {error}"
        raise RunError(" ".join(told.split())) from error

    def _gather(self, future: Future) -> list[list[Outcome]]:
        """The results of a batch, if any; TimeoutError if that takes too long."""

        async def gather() -> list[list[Outcome]]:
            found = self.client.gather([future], errors="skip", asynchronous=True)
            return list(await found)

        try:
            return list(self.client.sync(gather, callback_timeout=GLANCE))
        except TimeoutError:
            raise
        except (CancelledError, OSError):
            raise self._gone_error() from None

    def _keep_pace(self, found: Sequence[Outcome]) -> None:
        mean = sum(it.seconds for it in found) / len(found)
        self.pace = max(1e-6, 0.7 * self.pace + 0.3 * mean)


_GO_ON = "what was over is kept; run it again to go on"


# --- what the workers do -------------------------------------------------------------


_ONE_AT_A_TIME = threading.Lock()


def play_batch(payload: bytes, runs: Sequence[Run]) -> list[Outcome]:
    """Play these runs in a worker one after the other, even if it has threads."""
    with _ONE_AT_A_TIME, one_thread():
        study, play = _load_study(payload)
        return [play_to_outcome(study, run, play) for run in runs]


@lru_cache(1)
def _load_study(payload: bytes) -> tuple[Study, Play]:
    """Unpickle the study and what plays it, once in each process."""
    found: tuple[Study, Play] = cloudpickle.loads(payload)
    return found


def kille_here() -> str:
    """The version of kille on a worker."""
    return version("kille")


# --- connecting ----------------------------------------------------------------------


class _Connecting(Client):  # type: ignore[misc]
    """A client that is closed at once if it cannot connect.

    Dask would close it when it is collected as garbage, and could wait for itself then.
    What its loop was still waiting for when it was closed is nobody's error.
    """

    def start(self, **settings: Any) -> None:
        """Connect to the scheduler."""
        try:
            super().start(**settings)
        except BaseException:
            with suppress(Exception):
                self.close(timeout=CLOSING)
            raise
        finally:
            self.loop.asyncio_loop.set_exception_handler(lambda *_: None)


@contextmanager
def _connect(scheduler: Scheduler, seconds: float) -> Iterator[Client]:
    security = _security(scheduler)
    try:
        client = _Connecting(
            scheduler.address,
            timeout=seconds,
            set_as_default=False,
            security=security,
        )
    except (OSError, ValueError, RuntimeError) as error:
        raise RunError(_why_unreached(scheduler, error)) from error
    try:
        yield client
    finally:
        with suppress(Exception):
            client.close(timeout=CLOSING)


def _security(scheduler: Scheduler) -> Security:
    """How the connection is protected; RunError if TLS has no certificates."""
    files = {
        "tls_ca_file": scheduler.authority,
        "tls_client_cert": scheduler.certificate,
        "tls_client_key": scheduler.key,
    }
    given = {name: str(file) for name, file in files.items() if file}
    found = Security(**given)  # the rest is as Dask is configured
    known = found.get_connection_args("client")["ssl_context"]
    if scheduler.is_encrypted and not known:
        raise RunError(
            f"{scheduler.address} needs certificates: give --tls-ca, --tls-cert and "
            "--tls-key"
        )
    return found


def _why_unreached(scheduler: Scheduler, error: BaseException) -> str:
    """Why the scheduler could not be reached."""
    cause: BaseException | None = error
    while cause and not isinstance(cause, SSLError):
        cause = cause.__cause__
    if cause:
        return (
            f"the scheduler at {scheduler.address} and these certificates do not go "
            f"together: {cause}"
        )
    return (
        f"no scheduler can be reached at {scheduler.address}: is it running, and its "
        f"address right, such as tls://127.0.0.1:8786?"
    )


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
def silence_dask() -> Iterator[None]:
    """Silence the loggers of Dask: one line of an error says enough."""
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
