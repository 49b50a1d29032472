"""Other people's programs on an emulated Kinect."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, NamedTuple

from kinect_emulator.host import Host
from kinect_emulator.kinect import Kinect
from kinect_emulator.server import Server

PATIENCE = 80_000
"""Microframes (ten seconds) that the bus waits for a client on a busy machine."""

_TOO_LONG = 120.0


class Ran(NamedTuple):
    """What a program did: its exit status and what it wrote."""

    status: int
    out: str
    err: str


def environment(library: Path, path: Path) -> dict[str, str]:
    """What lets a program load that library and find the emulator's socket."""
    before = os.environ.get("LD_LIBRARY_PATH")
    folder = str(library.parent)
    folders = f"{folder}:{before}" if before else folder
    return {**os.environ, "LD_LIBRARY_PATH": folders, "KINECT_EMULATOR": str(path)}


def run(
    command: Sequence[str],
    library: Path,
    server: Server,
    folder: Path,
    enough: Callable[[str], bool] = lambda line: False,
) -> Ran:
    """Run it in that folder on a server that is running, until it ends.

    It gets a Ctrl-C after a line of its output for which `enough` says so, or when it
    has run for much too long.
    """
    errors = folder / "stderr.txt"
    with (
        errors.open("wb") as stderr,
        subprocess.Popen(
            # Line by line, so that each is seen as soon as it is written.
            ["stdbuf", "-oL", *command],
            cwd=folder,
            env=environment(library, server.path),
            stdout=subprocess.PIPE,
            stderr=stderr,
            text=True,
        ) as process,
        _limited(process),
    ):
        assert process.stdout is not None
        out = list(_lines(process, process.stdout, enough))
    return Ran(process.returncode, "".join(out), errors.read_text())


def finished(process: subprocess.Popen[str], seconds: float) -> Ran:
    """What a program did that ends by itself, or after so long by a Ctrl-C."""
    for patience, sign in ((seconds, signal.SIGINT), (30.0, signal.SIGKILL)):
        try:
            out, err = process.communicate(timeout=patience)
            return Ran(process.returncode, out, err)
        except subprocess.TimeoutExpired:
            process.send_signal(sign)
    out, err = process.communicate()
    return Ran(process.returncode, out, err)


class After:
    """Says that it is enough at the line that is the `count`th with that text in it."""

    def __init__(self, text: str, count: int) -> None:
        self._text = text
        self._left = count

    def __call__(self, line: str) -> bool:
        """Whether this is the line."""
        self._left -= self._text in line
        return self._left == 0 and self._text in line


def _lines(
    process: subprocess.Popen[str], stdout: IO[str], enough: Callable[[str], bool]
) -> Iterator[str]:
    for line in stdout:
        yield line
        if enough(line):
            process.send_signal(signal.SIGINT)


@contextmanager
def _limited(process: subprocess.Popen[str]) -> Iterator[None]:
    """Interrupt it when it has run for too long, kill it when that does not help."""
    timers = [
        threading.Timer(_TOO_LONG, process.send_signal, [signal.SIGINT]),
        threading.Timer(_TOO_LONG + 5, process.kill),
    ]
    for timer in timers:
        timer.start()
    try:
        yield
    finally:
        process.wait()
        for timer in timers:
            timer.cancel()
            timer.join()


def patient(*kinects: Kinect, path: Path, speed: float = 1.0) -> Server:
    """A server of those Kinects that waits for a busy machine."""
    return Server(Host(*kinects, patience=PATIENCE), path, speed)
