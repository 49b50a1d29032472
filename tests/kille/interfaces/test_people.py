"""Studies with people at the keyboard, as they are sat through at a terminal."""

from __future__ import annotations

import csv
import fcntl
import os
import re
import select
import struct
import subprocess
import sys
import termios
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from kille.interfaces.experiment.people import in_turn, people_in
from kille.lab import log
from kille.lab.study import Run
from kille.lab.study_files.file import parse

pytestmark = pytest.mark.slow

COMMAND = [sys.executable, "-m", "kille.interfaces.cli"]
COLUMNS = 80
PATIENCE = 120.0
"""Seconds until what should be on the screen is missed."""

STUDY = """
title = "Wizards"
seeds = 1

[theories.daring]
mode = "driven"

[theories.careful]
mode = "assisted"

[tutors.me]
kind = "keyboard"

[scenes.table]
kind = "drawn"
kinds = ["cup"]

[[phases]]
do = "teach"

[[phases]]
do = "ask"
"""
DIALOGUE = ["This is a cup.", ".", "What is this?", "."]
"""What is typed in one dialogue of it."""

Kille = Callable[..., Any]
FOLDER = Path("wizards.results")


@pytest.fixture
def study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A study in the working directory."""
    monkeypatch.chdir(tmp_path)
    path = Path("wizards.toml")
    path.write_text(STUDY)
    return path


def lines(*parts: list[str]) -> str:
    return "".join(f"{line}\n" for part in parts for line in part)


class Terminal:
    """A terminal at which a command runs."""

    def __init__(self, *words: str) -> None:
        self.screen, inner = os.openpty()
        size = struct.pack("HHHH", 24, COLUMNS, 0, 0)
        fcntl.ioctl(inner, termios.TIOCSWINSZ, size)
        self.program = subprocess.Popen(
            [*COMMAND, "experiment", *words],
            stdin=inner,
            stdout=inner,
            stderr=inner,
            start_new_session=True,
            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
            env=os.environ | {"TERM": "dumb"},
        )
        os.close(inner)
        self._new, self.shown = b"", ""

    def until(self, text: str) -> None:
        """Wait for a text that was not waited for yet."""
        end = time.monotonic() + PATIENCE
        while text.encode() not in self._new and self._read(end):
            pass
        before, found, self._new = self._new.partition(text.encode())
        self.shown += (before + found).decode()
        assert found, f"{text} is missing: {self.shown}"

    def type(self, *typed: str) -> None:
        """Type each of these where a line is asked for."""
        for line in typed:
            self.until("me (you): ")
            self.press(f"{line}\n")

    def begin(self) -> None:
        self.until("Press Enter to begin: ")
        self.press("\n")

    def press(self, keys: str) -> None:
        os.write(self.screen, keys.encode())

    def interrupt(self) -> None:
        """Press Ctrl-C, and once more if it comes before readline listens."""
        end = time.monotonic() + PATIENCE
        while self.program.poll() is None and b"kille: " not in self._new:
            assert time.monotonic() < end, f"nothing is stopped: {self.shown}"
            self.press("\x03")
            again = time.monotonic() + 5
            while b"kille: " not in self._new and self._read(again):
                pass

    def end(self) -> int:
        """Wait for its end; the exit code."""
        while self._read(time.monotonic() + PATIENCE):
            pass
        self.shown += self._new.decode()
        return self.program.wait(PATIENCE)

    def hang_up(self) -> None:
        """Close the terminal, if that was not done yet."""
        if self.screen >= 0:
            os.close(self.screen)
            self.screen = -1

    def _read(self, end: float) -> bool:
        """Whether more was shown until then."""
        ready = select.select([self.screen], [], [], max(0.0, end - time.monotonic()))
        if not ready[0]:
            return False
        # Linux says so when nobody has the terminal open any more.
        with suppress(OSError):
            more = os.read(self.screen, 4096)
            self._new += more
            return bool(more)
        return False


@pytest.fixture
def terminal() -> Iterator[Callable[..., Terminal]]:
    """Opens terminals, which are closed again."""
    opened: list[Terminal] = []

    def open_(*words: str) -> Terminal:
        opened.append(Terminal(*words))
        return opened[-1]

    yield open_
    for it in opened:
        it.program.kill()
        it.program.wait()
        it.hang_up()


# --- at a terminal -------------------------------------------------------------------


def test_a_person_is_led_through_a_study(study: Path, terminal: Any) -> None:
    it = terminal("run", str(study))
    for _ in range(2):
        it.begin()
        it.type(*DIALOGUE)
    it.until("Dialogue 2 is over, and kept.")
    talk = it.shown
    assert it.end() == 0
    for told in (
        "Dialogue 1 of 2, 2 steps: me is the tutor.",
        "The robot was taught nothing yet.",
        "It is another robot now, and was taught nothing yet.",
        "Step 2, ask: ask what #1 is, and say nothing of the answer.",
    ):
        assert told in talk
    assert not re.search("daring|careful|driven|assisted", talk)
    assert max(map(len, talk.splitlines())) <= COLUMNS
    assert "2 dialogues played" in it.shown
    played = [it.played for it in log.read(FOLDER)]
    assert [len(it.turns) for it in played] == [4, 4]
    assert [it.answers[0].said for it in played] == ["cup", "cup"]


def test_what_was_over_is_kept_when_a_person_leaves(
    kille: Kille, study: Path, terminal: Any
) -> None:
    it = terminal("run", str(study))
    it.begin()
    it.type(*DIALOGUE)
    it.begin()
    it.type("This is a cup.", "\x04")
    assert it.end() == 130
    *_, why, last = it.shown.splitlines()
    assert why == "The input has ended."
    assert last.startswith("kille: stopped with 1 of 2 dialogues over; go on with: ")
    done = kille("experiment", "resume", str(FOLDER), typed=lines(DIALOGUE))
    assert "Dialogue 2 of 2" in done.out
    assert "1 dialogue played, 1 was over before" in done.out


def test_ctrl_c_stops_a_person(study: Path, terminal: Any) -> None:
    it = terminal("run", str(study))
    it.begin()
    it.type("This is a cup.")
    it.until("me (you): ")
    it.interrupt()
    assert it.end() == 130
    assert "\nkille: stopped with 0 of 2 dialogues over" in it.shown.replace("\r", "")


def test_a_closed_terminal_loses_nothing_that_was_over(
    kille: Kille, study: Path, terminal: Any
) -> None:
    it = terminal("run", str(study))
    it.begin()
    it.type(*DIALOGUE)
    it.begin()
    it.until("me (you): ")
    it.hang_up()
    assert it.program.wait(PATIENCE) != 0
    assert log.count_outcomes(FOLDER) == 1
    done = kille("experiment", "resume", str(FOLDER), typed=lines(DIALOGUE))
    assert (done.code, log.count_outcomes(FOLDER)) == (0, 2)


# --- through a pipe ------------------------------------------------------------------


def test_lines_may_come_from_a_file(kille: Kille, study: Path) -> None:
    done = kille("experiment", "run", str(study), typed=lines(DIALOGUE, DIALOGUE))
    assert (done.code, done.err) == (0, "")
    assert "me (you): This is a cup.\nRobot: OK, I learned a cup.\n" in done.out


@pytest.mark.parametrize("typed", ["", "This is a cup.\n.\n"])
def test_a_file_that_ends_too_early_makes_up_no_dialogue(
    kille: Kille, study: Path, typed: str
) -> None:
    done = kille("experiment", "run", str(study), typed=typed)
    assert done.code == 130
    assert done.out.endswith("\nThe input has ended.\n")
    assert done.complaint.startswith("kille: stopped with 0 of 2 dialogues over")
    assert log.count_outcomes(FOLDER) == 0


def test_a_file_in_another_code_is_told_and_not_played(
    program: Kille, study: Path
) -> None:
    study.write_text(STUDY.replace('mode = "driven"', 'language = "sv"'))
    swedish = lines(["Det här är en kopp.", "."] * 2).encode("latin-1")
    done = program("experiment", "run", str(study), typed=swedish)
    assert done.code == 130
    assert "\nWhat was typed is not UTF-8: save it so" in done.out
    assert log.count_outcomes(FOLDER) == 0


# --- what is played, and kept --------------------------------------------------------


def test_theories_are_met_in_an_order_that_does_not_tell_them(study: Path) -> None:
    third = '[theories.third]\n\n[tutors.you]\nkind = "keyboard"\n\n[tutors.me]'
    text = STUDY.replace("seeds = 1", "seeds = 12").replace("[tutors.me]", third)
    it = parse(text, study)
    runs = in_turn(it)
    assert sorted(map(str, runs)) == sorted(map(str, it.runs()))
    assert [run.tutor for run in runs] == ["you"] * 36 + ["me"] * 36
    for nth in range(3):
        met = Counter(run.theory for run in runs[nth::3])
        assert met == dict.fromkeys(it.theories, 8)
    firsts = [run.theory for run in runs[::3]]
    assert firsts[:12] != firsts[12:]
    assert len({tuple(firsts[place : place + 3]) for place in range(0, 12, 3)}) > 1
    assert in_turn(it) == runs


def test_in_which_order_theories_were_met_is_kept(kille: Kille, study: Path) -> None:
    study.write_text(STUDY.replace("seeds = 1", "seeds = 2"))
    kille("experiment", "run", str(study), typed=lines(*[DIALOGUE] * 4))
    with open(FOLDER / "runs.csv", encoding="utf-8") as file:
        rows = [*csv.DictReader(file)]
    orders = {row["run"]: float(row["fact_order"]) for row in rows}
    met = map(str, in_turn(log.study(FOLDER)))
    assert orders == {run: place for place, run in enumerate(met, start=1)}
    assert [row["run"] for row in rows] == [*map(str, log.study(FOLDER).runs())]


MIXED = STUDY.replace("[tutors.me]", '[tutors.Ann]\nkind = "simulated"\n\n[tutors.me]')


def test_people_come_first(kille: Kille, study: Path) -> None:
    study.write_text(MIXED)
    done = kille("experiment", "check", str(study))
    assert done.out.endswith("× 1 seed, a person takes part in 2\n")
    done = kille("experiment", "run", str(study), typed=lines(DIALOGUE, DIALOGUE))
    assert done.code == 0
    assert "Dialogue 2 is over, and kept.\n2 more are played without you.\n" in done.out
    assert log.count_outcomes(FOLDER) == 4


def test_only_what_a_person_has_typed_cannot_be_replayed(
    kille: Kille, study: Path
) -> None:
    study.write_text(MIXED)
    kille("experiment", "run", str(study), typed=lines(DIALOGUE, DIALOGUE))
    done = kille("experiment", "replay", str(FOLDER), "careful/Ann/table/1")
    assert done.out == "careful/Ann/table/1: the same, 4 turns\n"
    done = kille("experiment", "replay", str(FOLDER), "careful/me/table/1")
    assert done.complaint == (
        "kille: a person takes part in careful/me/table/1 of wizards.results, and "
        "would type anew: name dialogues that are played without people, if there are "
        "any"
    )


@pytest.mark.parametrize("others", [("--workers", "2"), ("--scheduler", "tcp://a:1")])
def test_only_one_process_can_ask_a_person(
    kille: Kille, study: Path, others: tuple[str, ...]
) -> None:
    done = kille("experiment", "run", str(study), *others)
    assert done.code == 2
    assert done.complaint.endswith("play it with --workers 1")
    assert not FOLDER.exists()


def test_people_type_to_a_theory_with_meanings(kille: Kille, study: Path) -> None:
    own = (
        'mode = "assisted"\nmeanings.It = "[x : Ind, look : Look, d : shown(x, look)]"'
    )
    study.write_text(STUDY.replace('mode = "assisted"', own))
    done = kille("experiment", "run", str(study), typed=lines(DIALOGUE, DIALOGUE))
    assert done.code == 0


def test_who_takes_part_is_told(study: Path) -> None:
    tutors = (
        '[tutors.both]\nkind = "several"\nof = ["me", "Ann"]\n'
        '[tutors.Ann]\nkind = "simulated"\n[tutors.me]'
    )
    text = STUDY.replace("[tutors.me]", tutors).replace('"driven"', '"person"')
    it = parse(text, study)
    told = {str(run): people_in(it, run) for run in it.runs()}
    assert told == {
        "daring/both/table/1": ("me is the tutor", "daring plays the robot"),
        "careful/both/table/1": ("me is the tutor",),
        "daring/Ann/table/1": ("daring plays the robot",),
        "careful/Ann/table/1": (),
        "daring/me/table/1": ("me is the tutor", "daring plays the robot"),
        "careful/me/table/1": ("me is the tutor",),
    }
    swap = parse(f'{text}\n[[phases]]\ndo = "change_tutor"\nto = "me"\n', study)
    both = ("me is the tutor", "daring plays the robot")
    told = {run.theory: people_in(swap, run) for run in swap.runs()}
    assert told == {"daring": both, "careful": both[:1]}
    swap = parse(f'{text}\n[[phases]]\ndo = "change_tutor"\nto = "Ann"\n', study)
    assert people_in(swap, Run("careful", "Ann", "table", 1)) == ()
    assert people_in(swap, Run("careful", "me", "table", 1)) == both[:1]
    swap = parse(f'{text}\n[[phases]]\ndo = "swap"\n', study)
    assert people_in(swap, Run("careful", "Ann", "table", 1)) == both[:1]


def test_who_has_two_turns_is_told_once(study: Path) -> None:
    tutors = (
        '[tutors.both]\nkind = "several"\nof = ["me", "Ann", "me"]\n'
        '[tutors.Ann]\nkind = "simulated"\n[tutors.me]'
    )
    it = parse(STUDY.replace("[tutors.me]", tutors), study)
    run = Run("careful", "both", "table", 1)
    assert people_in(it, run) == ("me is the tutor",)


def test_theories_without_people_do_not_count_for_who_is_first(study: Path) -> None:
    robots = '[theories.own]\n\n[theories.second]\nmode = "person"\n\n[tutors.me]'
    text = STUDY.replace('"driven"', '"person"').replace("[tutors.me]", robots)
    text = text.replace('"keyboard"', '"simulated"').replace("seeds = 1", "seeds = 8")
    runs = in_turn(parse(text, study))
    assert [run.seed for run in runs] == [seed for seed in range(1, 9) for _ in "ab"]
    firsts = Counter(run.theory for run in runs[::2])
    assert firsts == {"daring": 4, "second": 4}


FORGETFUL = """
class Forgetful:
    lessons = 0

    def learn_one(self, x, label):
        self.lessons += 1
        if self.lessons > 5:
            raise ValueError("I forget")

    def predict_proba_one(self, x):
        return {"cup": 0.5}
"""


def test_a_person_is_told_of_a_dialogue_that_broke(kille: Kille, study: Path) -> None:
    Path("own.py").write_text(FORGETFUL)
    own = '[theories.daring]\nlearners.noun = "own.py:Forgetful"\n'
    two = STUDY.replace("seeds = 1", "seeds = 2").replace("[theories.careful]\n", "")
    text = two.replace("[theories.daring]\n", own).replace('mode = "assisted"\n', "")
    study.write_text(text)
    typed = lines(["This is a cup.", "What is this?"] * 6, DIALOGUE)
    done = kille("experiment", "run", str(study), typed=typed)
    assert done.code == 1
    assert "\nDialogue 1 broke off.\n\nDialogue 2 of 2" in done.out
    assert "Dialogue 2 is over, and kept.\n" in done.out
    assert "1 of 2 dialogues broke" in done.err
