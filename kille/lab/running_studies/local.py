"""Processes of this machine that play dialogues, led over sockets that only they have.

Each worker has a channel of its own: one end of an unnamed pair of sockets. It is sent
a run while it plays another, so that it never waits, and sends back each outcome. A
worker that dies is replaced. The run that it was playing is played once more, alone and
after all others; if a worker dies with it again, it is that run's doing.
"""

from __future__ import annotations

import os
import pickle
import signal
import socket
import sys
from collections import deque
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from multiprocessing import Pipe
from multiprocessing.connection import Connection, wait
from subprocess import DEVNULL, Popen
from typing import Self

from kille.lab.log.outcomes import DEADLY, Broken, Outcome, Play, PlayAll, RunError
from kille.lab.running_studies.threads import READ_WHEN_LOADED
from kille.lab.running_studies.workers import READY
from kille.lab.study import Run, Study

AHEAD = 2
"""How many runs each worker has: the one that it plays, and the next."""
MOST = 5
"""After so many workers in a row that died before they were ready, no other begins."""

_NONE_BEGIN = "no workers can be begun on this machine: try --workers 1"


@contextmanager
def local_crew(workers: int, study: Study, play: Play) -> Iterator[PlayAll]:
    """A crew of so many processes on this machine."""
    from joblib import wrap_non_picklable_objects  # of the extra `experiments`

    # What a script defines itself can only be sent by value.
    by_value = wrap_non_picklable_objects(play, keep_wrapper=False)
    with Workers(workers, pickle.dumps((study, by_value))) as begun:
        yield begun.play_all


@dataclass
class _Hand:
    """The runs of a worker, which plays the first of them once it is ready."""

    runs: deque[Run] = field(default_factory=deque)
    is_ready: bool = False


class Workers:
    """At most so many workers, for a study and what plays it, pickled as `payload`."""

    def __init__(self, count: int, payload: bytes) -> None:
        self.count, self._payload = count, payload
        self._hands: dict[Connection, _Hand] = {}
        self._failed = 0
        self._control, theirs = socket.socketpair()
        single = dict.fromkeys((*READ_WHEN_LOADED, "OPENCV_FOR_THREADS_NUM"), "1")
        modules = {"PYTHONPATH": os.pathsep.join(map(str, sys.path))}
        forking = "kille.lab.running_studies.workers"
        with theirs:
            try:
                self._process = Popen(
                    [sys.executable, "-P", "-m", forking, str(theirs.fileno())],
                    env=os.environ | single | modules,
                    stdin=DEVNULL,
                    pass_fds=[theirs.fileno()],
                    start_new_session=True,  # Ctrl-C is for who sends the runs
                )
            except OSError as error:
                self._control.close()
                raise RunError(_NONE_BEGIN) from error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        """End all workers, whatever they do."""
        # The group has its name for as long as its first process is not waited for.
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        self._control.close()
        for channel in self._hands:
            channel.close()

    def play_all(self, runs: Sequence[Run]) -> Generator[Outcome, None, None]:
        """Play all runs, in any order."""
        suspects: list[Run] = []
        yield from self._play(runs, suspects)
        for run in suspects:
            deadly: list[Run] = []
            yield from self._play([run], deadly)
            for it in deadly:
                yield Broken(it, DEADLY, "", 0.0)

    def _play(self, runs: Sequence[Run], deadly: list[Run]) -> Iterator[Outcome]:
        """Play these runs; those with which a worker dies become `deadly`."""
        left = deque(runs)
        while count := len(left) + sum(len(it.runs) for it in self._hands.values()):
            for _ in range(min(self.count, count) - len(self._hands)):
                self._begin()
            self._deal(left)
            for channel in wait(list(self._hands)):
                assert isinstance(channel, Connection)
                yield from self._hear(channel, left, deadly)

    def _begin(self) -> None:
        """Start another worker, which has yet to load the study."""
        ours, theirs = Pipe()
        with theirs:
            try:
                socket.send_fds(self._control, [b"."], [theirs.fileno()])
            except ConnectionError as error:
                raise RunError(_NONE_BEGIN) from error
        self._hands[ours] = _Hand()
        with suppress(ConnectionError):  # it has died: that will be heard
            ours.send_bytes(self._payload)

    def _deal(self, left: deque[Run]) -> None:
        """Send runs to all workers that are free; the last are shared evenly."""
        for ahead in range(AHEAD if len(left) > self.count else 1):
            for channel, hand in self._hands.items():
                if left and hand.is_ready and len(hand.runs) <= ahead:
                    hand.runs.append(left.popleft())
                    with suppress(ConnectionError):  # it has died: that will be heard
                        channel.send(hand.runs[-1])

    def _hear(
        self, channel: Connection, left: deque[Run], deadly: list[Run]
    ) -> Iterator[Outcome]:
        """Receive an outcome from a worker, or bury it if it died."""
        try:
            said = channel.recv()
        except (EOFError, OSError):
            self._bury(channel, left, deadly)
            return
        hand = self._hands[channel]
        if isinstance(said, RunError):
            raise said
        if said is READY:
            hand.is_ready, self._failed = True, 0
        else:
            hand.runs.popleft()
            yield said

    def _bury(self, channel: Connection, left: deque[Run], deadly: list[Run]) -> None:
        """Take back the runs of a worker that died; the first may be why."""
        channel.close()
        hand = self._hands.pop(channel)
        if not hand.is_ready:
            self._failed += 1
            if self._failed >= MOST:
                raise RunError(_NONE_BEGIN)
        elif hand.runs:
            deadly.append(hand.runs.popleft())
            left.extendleft(reversed(hand.runs))
