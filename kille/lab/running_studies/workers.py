"""The processes of this machine that play dialogues, forked from one that loaded all.

    python -m kille.lab.running_studies.workers CONTROL

`kille.lab.running_studies.local` starts it. CONTROL is the number of an open socket, on
which one byte comes for each worker that is wanted, and with it the worker's channel.
All sockets are pairs that were handed on: they have no name, so nobody else can connect
to them. When the control socket is closed, the whole process group is killed; so no
worker outlives the process that it works for, whatever ends that one.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import socket
import sys
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection

from kille.lab.log.outcomes import Outcome, Play, RunError, broken_run, play_to_outcome
from kille.lab.running_studies.threads import one_thread
from kille.lab.study import Run, Study

READY = None
"""What a worker sends first, when it has loaded the study."""


def fork_workers(control: socket.socket, work: Callable[[Connection], None]) -> None:
    """Fork a worker for each channel that arrives, until the control socket closes."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)  # these are for whoever sends the runs
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # then the system forgets the dead
    while channel := _next_channel(control):
        # A worker that cannot be forked is noticed, as its channel is closed.
        with suppress(OSError):
            _fork(control, channel, work)
        os.close(channel)


def _next_channel(control: socket.socket) -> int | None:
    """The next file descriptor that arrives; None when the other side is gone."""
    try:
        _, channels, _, _ = socket.recv_fds(control, 1, 1)
    except ConnectionError:
        return None
    return channels[0] if channels else None


def _fork(
    control: socket.socket, channel: int, work: Callable[[Connection], None]
) -> None:
    """Fork a process that does this work and then exits."""
    if os.fork():
        return
    try:
        for number in (signal.SIGTERM, signal.SIGCHLD):
            signal.signal(number, signal.SIG_DFL)
        control.close()
        os.set_inheritable(channel, False)
        work(Connection(channel))
    except ConnectionError:
        pass  # nobody waits for an answer any more
    except BaseException:
        sys.excepthook(*sys.exc_info())
    finally:
        os._exit(1)


def serve(channel: Connection) -> None:
    """Play each run that arrives on a channel, and send back its outcome.

    The first message is the study and what plays it, pickled.
    """
    try:
        study, play = _load_study(channel.recv_bytes())
        channel.send(READY)
        with one_thread():
            while True:
                run = channel.recv()
                channel.send_bytes(_play_pickled(study, run, play))
    except EOFError:
        return
    except RunError as error:
        channel.send(error)


def _load_study(payload: bytes) -> tuple[Study, Play]:
    try:
        study, play = pickle.loads(payload)
    except Exception as error:
        why = " ".join(f"{type(error).__name__}: {error}".split())
        raise RunError(f"workers cannot load the study: {why}") from error
    return study, play


def _play_pickled(study: Study, run: Run, play: Play) -> bytes:
    """Play a run and pickle its outcome; one that cannot be pickled is broken."""
    found: Outcome = play_to_outcome(study, run, play)
    try:
        return pickle.dumps(found)
    except Exception as error:
        return pickle.dumps(broken_run(run, error, found.seconds))


def load() -> None:
    """Import what plays dialogues, so that all workers share it."""
    import kille.lab.playing_dialogues  # noqa: F401

    gc.collect()
    gc.freeze()


if __name__ == "__main__":
    load()
    fork_workers(socket.socket(fileno=int(sys.argv[1])), serve)
    os.killpg(0, signal.SIGKILL)
