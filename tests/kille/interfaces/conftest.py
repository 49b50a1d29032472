"""Running the commands: in this process, or as programs of their own."""

from __future__ import annotations

import ctypes
import io
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from kille.interfaces.cli import main

COMMAND = [sys.executable, "-m", "kille.interfaces.cli"]


@dataclass(frozen=True)
class Outcome:
    """What a command printed, and its exit code."""

    code: int
    out: str
    err: str

    @property
    def complaint(self) -> str:
        """The one line that went to the standard error."""
        (line,) = self.err.splitlines()
        return line


Run = Callable[..., Outcome]


@pytest.fixture(autouse=True)
def memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The memory of a user who has none yet."""
    path = tmp_path / "home" / "memory.db"
    monkeypatch.setenv("KILLE_MEMORY", str(path))
    return path


@pytest.fixture
def kille(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs a command in this process, with this text to read."""

    def run(*words: str, typed: str = "") -> Outcome:
        monkeypatch.setattr(sys, "stdin", io.StringIO(typed))
        try:
            code = main(words)
        except SystemExit as left:
            code = int(left.code or 0)
        out, err = capsys.readouterr()
        return Outcome(code, out, err)

    return run


@pytest.fixture
def program() -> Run:
    """Runs a command as a program, who may not do what only root may."""

    def run(*words: str, typed: bytes = b"", **settings: str) -> Outcome:
        done = subprocess.run(
            [*COMMAND, *words],
            input=typed,
            capture_output=True,
            env=os.environ | settings,
            preexec_fn=_as_anyone,
            check=False,
        )
        return Outcome(done.returncode, done.stdout.decode(), done.stderr.decode())

    return run


def _as_anyone() -> None:
    """Give up what lets root read and write everything, if this is root."""
    drop, override, search = 24, 1, 2  # PR_CAPBSET_DROP, CAP_DAC_…
    if os.geteuid() == 0:
        libc = ctypes.CDLL(None)
        libc.prctl(drop, override, 0, 0, 0)
        libc.prctl(drop, search, 0, 0, 0)
