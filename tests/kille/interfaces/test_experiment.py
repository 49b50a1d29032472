"""`kille experiment`: from a file to a report, and whatever may be wrong on the way."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from kille.lab import log

pytestmark = pytest.mark.slow

COMMAND = [sys.executable, "-m", "kille.interfaces.cli"]

Run = Callable[..., Any]

STUDY = """
title = "Two ways to learn"
seeds = 2

[theories.driven]
mode = "driven"

[theories.assisted]
mode = "assisted"

[tutors.Ann]
kind = "simulated"

[scenes.table]
kind = "drawn"

[[phases]]
do = "teach"
what = "nouns"

[[phases]]
name = "test"
do = "ask"
what = "nouns"
"""
BROKEN = """
def noun(*given):
    return Forgetful()


class Forgetful:
    lessons = 0

    def learn_one(self, x, label):
        self.lessons += 1
        if self.lessons > 5:
            raise ValueError("I forget")

    def predict_proba_one(self, x):
        return {"cup": 0.5}
"""


OWN = '[theories.assisted.learners]\nnoun = "own.py:Sure"\n\n[tutors.Ann]'
LEARNER = """
class Sure:
    label = ""

    def learn_one(self, x, label):
        self.label = label

    def predict_proba_one(self, x):
        return {self.label: 0.9}
"""


CERTIFIED = "--tls-ca", "ca.pem", "--tls-cert", "cert.pem", "--tls-key", "key.pem"


@pytest.fixture
def study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A study in the working directory."""
    monkeypatch.chdir(tmp_path)
    path = Path("ways.toml")
    path.write_text(STUDY)
    return path


def test_a_study_is_run_shown_replayed_and_reported(kille: Run, study: Path) -> None:
    done = kille("experiment", "run", str(study), "--workers", "1")
    assert (done.code, done.err) == (0, "")
    assert "4 dialogues: 2 theories × 1 tutor × 1 scene × 2 seeds" in done.out
    assert "4 dialogues played: ways.results" in done.out
    assert re.search(r"^accuracy +[01]\.\d+ +[01]\.\d+$", done.out, re.MULTILINE)
    assert "The accuracy of assisted" in done.out or "assisted and driven" in done.out
    folder = Path("ways.results")
    for name in ("report.html", "runs.csv", "turns.csv", "answers.csv", "log.db"):
        assert (folder / name).is_file()

    done = kille("experiment", "show", str(folder))
    assert "4 of 4 dialogues are over" in done.out
    done = kille("experiment", "show", str(folder), "driven/Ann/table/2")
    assert done.out.startswith("driven/Ann/table/2: 32 turns")
    assert "robot    OK, I learned a" in done.out
    done = kille("experiment", "show", str(folder), "3", "--json")
    told = json.loads(done.out)
    assert told["run"] == "driven/Ann/table/2"
    assert [turn["number"] for turn in told["turns"]] == list(range(1, 33))

    done = kille("experiment", "replay", str(folder), "assisted/Ann/table/1")
    assert (done.code, done.out) == (0, "assisted/Ann/table/1: the same, 32 turns\n")
    done = kille("experiment", "replay", str(folder), "--workers", "1")
    assert (done.code, done.out) == (0, "4 of 4 dialogues go as they went\n")

    done = kille("experiment", "report", str(folder))
    assert done.code == 0
    assert "accuracy" in done.out
    assert "report: ways.results/report.html" in done.out


def test_a_dialogue_that_goes_differently_is_told_with_why(
    kille: Run, study: Path
) -> None:
    Path("own.py").write_text(LEARNER)
    study.write_text(STUDY.replace("[tutors.Ann]", OWN))
    kille("experiment", "run", str(study), "--workers", "1")
    Path("own.py").write_text(LEARNER.replace("0.9", "0.8"))
    done = kille("experiment", "replay", "ways.results", "--trust", "--workers", "1")
    assert done.code == 1
    assert (
        done.complaint == "kille: own.py has changed since these dialogues were played"
    )
    running, *told = done.out.splitlines()
    assert running == f"running {Path('own.py').resolve()}, which the log names"
    assert told[0].startswith("assisted/Ann/table/1: ")
    assert told[-1] == "2 of 4 dialogues go as they went"
    done = kille("experiment", "run", str(study), "--workers", "1")
    assert "own.py has changed since" in done.complaint


def test_what_is_over_is_not_played_again(kille: Run, study: Path) -> None:
    words = "--out", "first", "--workers", "1"
    kille("experiment", "run", str(study), *words)
    before = [it.seconds for it in log.outcomes(Path("first"))]
    done = kille("experiment", "run", str(study), *words)
    assert "0 dialogues played, 4 were over before: first" in done.out
    study.unlink()
    done = kille("experiment", "resume", "first", "--workers", "1")
    assert (done.code, done.err) == (0, "")
    assert [it.seconds for it in log.outcomes(Path("first"))] == before


def test_two_folders_of_results_are_compared(kille: Run, study: Path) -> None:
    kille("experiment", "run", str(study), "--workers", "1")
    Path("other.toml").write_text(STUDY.replace("ways", "rooms"))
    kille("experiment", "run", "other.toml", "--out", "other", "--workers", "1")
    page = "--report", "page.html"
    done = kille("experiment", "compare", "ways.results", "other", *page)
    assert (done.code, done.err) == (0, "")
    assert "report: page.html" in done.out
    assert Path("page.html").read_text().startswith("<!DOCTYPE html>")


def test_all_that_is_wrong_is_said_at_once(kille: Run, study: Path) -> None:
    wrong = STUDY.replace('"driven"', '"drivn"').replace("seeds = 2", "seedz = 2")
    study.write_text(wrong)
    for action in ("check", "run"):
        done = kille("experiment", action, str(study))
        assert (done.code, done.out) == (2, "")
        lines = done.err.splitlines()
        assert len(lines) >= 2
        assert all(line.startswith("kille: ways.toml:") for line in lines)
    assert not Path("ways.results").exists()


def test_a_study_without_fault_says_what_it_would_play(kille: Run, study: Path) -> None:
    done = kille("experiment", "check", str(study))
    told = "ways.toml: fine, 4 dialogues: 2 theories × 1 tutor × 1 scene × 2 seeds\n"
    assert (done.code, done.out, done.err) == (0, told, "")


def test_what_is_probably_not_meant_is_told_before_it_is_played(
    kille: Run, study: Path
) -> None:
    study.write_text(STUDY.replace("seeds = 2", "seeds = 2\nturns = 24"))
    for action in (["check"], ["run", "--workers", "1"]):
        done = kille("experiment", *action, str(study))
        assert done.code == 0
        assert done.complaint == (
            "kille: ways.toml:4: a dialogue takes 32 turns at least, and ends after "
            "24: write turns = 32 or more (this can be played)"
        )


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["run", "none.toml"], "there is no file none.toml"),
        (["resume", "none"], "there is no log.db in none"),
        (["show", "none"], "there is no log.db in none"),
        (["replay", "none"], "there is no log.db in none"),
        (["report", "none"], "there is no log.db in none"),
        (["compare", "none", "nothing"], "there is no log.db in none"),
        (["run", "ways.toml", "--workers", "0"], "0 is no whole number from 1"),
        (["run", "ways.toml", "--worker", "2"], "did you mean --workers?"),
        (
            ["run", "ways.toml", "--scheduler", "tls://127.0.0.1:1"],
            "tls://127.0.0.1:1 needs certificates: give --tls-ca, --tls-cert and",
        ),
        (["run", "ways.toml", "--tls-ca", "ca.pem"], "are given together"),
        (["run", "ways.toml", *CERTIFIED], "need a --scheduler"),
        (
            ["run", "ways.toml", "--scheduler", "tcp://lab:1", *CERTIFIED],
            "tcp://lab:1 is without TLS, and takes no certificates: is it tls://lab:1?",
        ),
        (
            ["run", "ways.toml", "--scheduler", "tls://lab:1", *CERTIFIED],
            "ca.pem cannot be read: [Errno 2] No such file or directory",
        ),
    ],
)
def test_a_mistake_is_one_line(
    kille: Run, study: Path, words: list[str], told: str
) -> None:
    done = kille("experiment", *words)
    assert done.code == 2
    assert told in done.complaint


def test_an_address_without_tls_is_warned_of_before_anybody_is_there(
    kille: Run, study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("kille.lab.running_studies.clusters.CONNECTING", 0.5)
    done = kille("experiment", "run", str(study), "--scheduler", "tcp://127.0.0.1:1")
    warning, error = done.err.splitlines()
    assert done.code == 2
    assert "without TLS: any user of this machine can run programs as you" in warning
    assert "no scheduler can be reached at tcp://127.0.0.1:1" in error


def test_another_study_does_not_go_into_the_same_folder(
    kille: Run, study: Path
) -> None:
    kille("experiment", "run", str(study), "--workers", "1")
    study.write_text(STUDY.replace("seeds = 2", "seeds = 3"))
    done = kille("experiment", "run", str(study), "--workers", "1")
    assert done.code == 2
    assert "ways.results has dialogues of another study" in done.complaint
    assert log.count_outcomes(Path("ways.results")) == 4


def test_what_happens_is_not_shown_as_if_it_were_said(kille: Run, study: Path) -> None:
    Path("one.dlg").write_text("--- one\n@ place 2 7 3\n@ point 2\nU> This is a cup.\n")
    scripted = STUDY.replace('"simulated"', '"scripted"\nfile = "one.dlg"')
    study.write_text(scripted.replace("seeds = 2", "seeds = 1"))
    done = kille("experiment", "run", str(study), "--workers", "1")
    assert "2 dialogues played: ways.results" in done.out
    done = kille("experiment", "show", "ways.results", "driven/Ann/table/1")
    assert "    2  Ann      (happens: place 2 7 3)\n" in done.out
    assert "    3  Ann      (happens: point 2)\n" in done.out
    assert "    4  Ann      This is a cup.\n" in done.out


def test_what_breaks_is_listed_at_the_end(kille: Run, study: Path) -> None:
    Path("own.py").write_text(BROKEN)
    learner = '[theories.assisted.learners]\nnoun = "own.py:noun"\n\n[tutors.Ann]'
    study.write_text(STUDY.replace("[tutors.Ann]", learner))
    done = kille("experiment", "run", str(study), "--workers", "1")
    assert done.code == 1
    told = done.err.splitlines()
    assert told[0] == "kille: 2 of 4 dialogues broke:"
    assert "assisted/Ann/table/1" in told[1]
    assert "I forget" in told[1]
    assert "resume ways.results --again --trust" in told[-1]
    assert len(list(log.read(Path("ways.results")))) == 2

    done = kille("experiment", "show", "ways.results", "assisted/Ann/table/1")
    assert done.code == 1
    assert "Traceback" in done.out
    again = "resume", "ways.results", "--again", "--trust", "--workers", "1"
    done = kille("experiment", *again)
    assert "2 dialogues played, 2 were over before" in done.out


def test_a_person_may_be_the_tutor(kille: Run, study: Path) -> None:
    study.write_text(
        STUDY.replace('"simulated"', '"keyboard"').replace("seeds = 2", "seeds = 1")
    )
    done = kille(
        "experiment", "run", str(study), typed="This is a cup.\n" + ".\n" * 100
    )
    assert (done.code, done.err) == (0, "")
    assert "OK, I learned a cup." in done.out
    done = kille("experiment", "run", str(study), "--workers", "2")
    assert "--workers 1" in done.complaint
    done = kille("experiment", "replay", "ways.results")
    assert "a person takes part" in done.complaint


def test_on_a_terminal_a_bar_shows_how_far_it_has_come(study: Path) -> None:
    reading, terminal = os.openpty()
    done = subprocess.Popen(
        [*COMMAND, "experiment", "run", str(study), "--workers", "1"],
        stdout=subprocess.DEVNULL,
        stderr=terminal,
        env=os.environ | {"TERM": "xterm", "COLUMNS": "80"},
    )
    os.close(terminal)
    shown = b""
    # Linux says so when nobody has the terminal open any more.
    with suppress(OSError):
        while more := os.read(reading, 4096):
            shown += more
    os.close(reading)
    assert done.wait() == 0
    assert b"4 of 4" in shown
    assert b"Traceback" not in shown
