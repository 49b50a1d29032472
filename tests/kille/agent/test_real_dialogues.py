"""A tutor who knows what is in real captures talks to the whole robot about them."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[3] / "benchmarks" / "real_dialogues.py"


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_dialogue_about_real_scenes(data: Path, seed: int) -> None:
    # Every turn is checked as it is played: see the script.
    play_dialogue = runpy.run_path(str(SCRIPT))["play_dialogue"]
    counts = play_dialogue(seed, 12, data / "ycbv_scenes")
    assert counts["turns"] >= 12


def test_what_was_not_played_is_told_as_well(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # As after Ctrl-C in the first dialogue.
    monkeypatch.setattr(sys, "argv", [str(SCRIPT), "--dialogues", "0"])
    runpy.run_path(str(SCRIPT), run_name="__main__")
    assert capsys.readouterr().out == ""
