"""No reader of inputs fails on some hundreds of hostile inputs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

FUZZ = Path(__file__).resolve().parent.parent / "benchmarks" / "fuzz.py"


@pytest.mark.deep
def test_no_reader_fails_on_hostile_inputs(tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, FUZZ, "--count", "300", "--kept", tmp_path],
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
