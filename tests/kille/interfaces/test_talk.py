"""`kille talk`: from a pipe and at a terminal, and whatever way it ends."""

from __future__ import annotations

import os
import pty
import re
import select
import shutil
import signal
import subprocess
import termios
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

import numpy as np
import pytest

from kille.memory import Memory, MemoryFileError

from .conftest import COMMAND, Run

EMPTY = "synthetic:empty?seed=3"
SHOWN = "@ show cup\n"
STORIES = Path(__file__).parents[2] / "dialogues"


def talked(kille: Run, typed: str, *options: str) -> list[str]:
    """The lines that a conversation prints, without the first view."""
    outcome = kille("talk", "--sensor", EMPTY, *options, typed=typed)
    assert outcome.code == 0
    assert outcome.err == ""
    first, *others = outcome.out.splitlines()
    assert first == "Nothing is in view."
    return others


# --- from a pipe ---------------------------------------------------------------------


def test_a_lesson_and_a_question(kille: Run) -> None:
    said = talked(kille, f"{SHOWN}This is a cup.\n\n  \nWhat is this?\n")
    assert said[0] == "U> @ show cup"
    assert said[1] == "One thing is in view:"
    assert re.fullmatch(r"  #1  0\.\d\d m away, .*← this", said[2])
    assert said[3:] == [
        "U> This is a cup.",
        "S> OK, I learned a cup.",
        "U> What is this?",
        "S> This is a cup.",
    ]


def test_what_was_learned_is_known_the_next_time(kille: Run) -> None:
    talked(kille, f"{SHOWN}This is a cup.\n")
    assert talked(kille, f"{SHOWN}What is this?\n")[-1] == "S> This is a cup."


def test_a_farewell_ends_it(kille: Run) -> None:
    said = talked(kille, "Goodbye.\nThis is a cup.\n")
    assert said == ["U> Goodbye.", "S> Goodbye."]


def test_mistakes_are_told_in_a_line_and_the_talk_goes_on(kille: Run) -> None:
    typed = (
        "@ show unicorn\n@ fly\n@ point 7\n@ picture /nowhere/a.png\n"
        "#3 This is a cup.\n@ scene nowhere\nHello.\n"
    )
    outcome = kille("talk", "--sensor", EMPTY, typed=typed)
    assert outcome.code == 0
    complaints = outcome.err.splitlines()
    assert len(complaints) == 6
    assert all(line.startswith("kille: ") for line in complaints)
    assert outcome.out.splitlines()[-1] == "S> Hello."


def test_mistakes_and_answers_come_in_order(program: Run, tmp_path: Path) -> None:
    both = tmp_path / "both"
    with both.open("wb") as sink:
        subprocess.run(
            [*COMMAND, "talk", "--sensor", EMPTY],
            input=b"Hello.\n@ fly\nThank you.\n",
            stdout=sink,
            stderr=subprocess.STDOUT,
            check=True,
        )
    lines = both.read_text().splitlines()
    assert [line[:12] for line in lines[1:]] == [
        "U> Hello.",
        "S> Hello.",
        "U> @ fly",
        "kille: unkno",
        "U> Thank you",
        "S> You are w",
    ]


def test_bytes_that_are_no_text_are_only_not_understood(program: Run) -> None:
    typed = b"\xff\xfe\x00 is this\nHello.\n"
    outcome = program("talk", "--sensor", EMPTY, typed=typed)
    assert outcome.code == 0
    assert outcome.err == ""
    assert "Sorry, I did not understand" in outcome.out
    assert outcome.out.endswith("S> Hello.\n")


def test_help_and_the_menu(kille: Run) -> None:
    said = talked(kille, "help\n@\n")
    menu = said.index("U> @")
    assert said[1] == "S> You can say:"
    assert "  This is a cup." in said[:menu]
    for command in ("show cup", "place book", "point 2", "scene SENSOR", "restart"):
        assert any(line.strip().startswith(f"@ {command}") for line in said[:menu])
        assert any(line.strip().startswith(f"@ {command}") for line in said[menu:])


def test_what_can_be_shown(kille: Run) -> None:
    (line,) = talked(kille, "@ things\n")[1:]
    assert line.startswith("You can show: apple, banana, teddy bear")


def test_a_number_alone_points(kille: Run) -> None:
    typed = "@ show car\n@ place book at -0.25 0.1\n#2\nThis is a book.\n"
    said = talked(kille, typed)
    view = said[said.index("U> #2") :]
    assert view[1] == "2 things are in view:"
    assert "← this" not in view[2]
    assert "← this" in view[3]
    assert view[-1] == "S> OK, the one on the left (#2) is a book."


def test_a_picture_of_what_is_in_view(kille: Run, tmp_path: Path) -> None:
    path = tmp_path / "view.png"
    said = talked(kille, f"{SHOWN}@ picture {path}\n")
    assert said[-1] == f"The picture is in {path}."
    assert path.read_bytes().startswith(b"\x89PNG")


def test_a_trace_shows_the_judgements_and_fits_the_line(kille: Run) -> None:
    said = talked(kille, f"{SHOWN}This is a cup.\nWhat is this?\n", "--trace", "whole")
    assert all(len(line) <= 100 for line in said)
    text = re.sub(r"\s+", " ", " ".join(said))
    assert re.search(r"heard s\d+ : instruct\(tutor, robot\)", text)
    assert 'word "cup", noun : [look : Look, x : Ind, c : cup(x, look)]' in text
    assert "learn_word: The tutor names a thing in view" in text
    assert re.search(r"judged some : cup\(o1, look\d\) p = 0\.\d\d|p = 1\.00", text)
    assert re.search(r"said s\d+ : assert_name\(robot, tutor\)", text)


def test_a_short_trace_says_what_was_heard_done_and_said(kille: Run) -> None:
    lines = f"{SHOWN}This is a cup.\nWhat is this?\nBlah blah.\n@ trace\n"
    said = talked(kille, lines, "--trace")
    told = said[said.index("U> This is a cup.") + 1 : said.index("U> What is this?")]
    assert [line.split()[0] for line in told] == [
        *("heard", "rules", "why", "new", "new", "…", "said", "S>")
    ]
    assert re.search(
        r"s\d+ : instruct\(tutor, robot\), that cup\(o1, look\d\)", told[0]
    )
    assert told[1].split("  ")[-1] == "glance, hear, refer, learn_word, say, keep"
    assert "learn_word: The tutor names a thing in view" in told[2]
    assert "private.nouns: + cup" in told[4]
    assert told[5].strip() == "… and 2 more; @ trace shows all"
    asked = said[said.index("U> What is this?") + 1 :]
    assert re.search(r"judged +some : cup\(o1, look\d\) +p = ", "\n".join(asked))
    assert said[-1] == "The latest turn changed nothing."


def test_the_latest_turn_is_shown_in_full_when_asked_for(kille: Run) -> None:
    said = talked(kille, f"{SHOWN}This is a cup.\n@ trace\n")
    assert "rule" not in "\n".join(said[: said.index("U> @ trace")])
    text = re.sub(r"\s+", " ", " ".join(said))
    assert "rule learn_word: The tutor names a thing in view" in text
    assert "private.agenda: +" in text


# --- logged --------------------------------------------------------------------------


def test_a_log_plays_again_as_it_was(kille: Run, tmp_path: Path) -> None:
    talked(kille, f"{SHOWN}This is a cup.\n")
    log = tmp_path / "talk.dlg"
    typed = f"{SHOWN}What is this?\nWhy?\n@ picture {tmp_path}/a.png\nForget cup.\n"
    said = talked(kille, typed, "--log", str(log), "--mode", "driven")
    lines = log.read_text().splitlines()
    assert f"@ sensor {EMPTY}" in lines
    assert "@ strategy driven paper answering" in lines
    assert "@ memory talk.memory.db" in lines
    assert [it for it in lines if it[:2] == "S>"] == [it for it in said if "S>" in it]
    assert kille("replay", "--quiet", str(log)).out == f"{log}: 1 story as written\n"
    assert log.with_suffix(".memory.db").stat().st_mode & 0o077 == 0


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("talk.txt", "is no name for a log: call it NAME.dlg"),
        ("talk.sv.dlg", "is no name for a log: call it NAME.dlg"),
        ("no/talk.dlg", "no/talk.dlg"),
    ],
)
def test_a_log_that_cannot_be_written(kille: Run, name: str, told: str) -> None:
    outcome = kille("talk", "--sensor", EMPTY, "--log", name, typed="Hello.\n")
    assert outcome.code == 2
    assert told in outcome.complaint


# --- at a terminal -------------------------------------------------------------------


class Terminal:
    """A program at a terminal of its own, and what it has shown so far."""

    def __init__(self, *words: str) -> None:
        self._ours, theirs = pty.openpty()
        self._child = subprocess.Popen(
            [*COMMAND, *words],
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
            start_new_session=True,
            env=os.environ | {"TERM": "xterm", "COLUMNS": "90"},
        )
        os.close(theirs)
        self.shown = ""

    def settings(self) -> list[object]:
        """How the terminal treats keys: whether it echoes them, and so on."""
        return termios.tcgetattr(self._ours)

    def type(self, keys: str) -> None:
        os.write(self._ours, keys.encode())

    def wait_for(self, text: str, seconds: float = 60.0) -> str:
        """What is shown up to this text, from where the last one ended."""
        ends = time.monotonic() + seconds
        while text not in self.shown:
            assert time.monotonic() < ends, f"{text!r} is not in {self.shown!r}"
            if select.select([self._ours], [], [], 0.1)[0]:
                self.shown += os.read(self._ours, 65536).decode()
        before, _, self.shown = self.shown.partition(text)
        return before

    def interrupt(self) -> None:
        # Python's own readline misses a signal between the prompt and its waiting; who
        # sees nothing happen presses the keys again.
        for _ in range(10):
            self._child.send_signal(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self._child.wait(2)
                return

    def code(self) -> int:
        return self._child.wait(60)

    def close(self) -> None:
        self._child.kill()
        self._child.wait()
        os.close(self._ours)


@contextmanager
def at_terminal(*words: str) -> Iterator[Terminal]:
    terminal = Terminal(*words)
    try:
        yield terminal
    finally:
        terminal.close()


@pytest.mark.slow
def test_a_talk_at_a_terminal_has_history_over_sessions(memory: Path) -> None:
    with at_terminal("talk", "--sensor", EMPTY) as screen:
        welcome = screen.wait_for("U> ")
        assert f"I look through {EMPTY} and know no words" in welcome
        assert "help says what else" in welcome
        screen.type("@ show cup\r")
        screen.wait_for("One thing is in view")
        screen.wait_for("U> ")
        screen.type("This is a cut\x7fp.\r")  # mended with backspace
        screen.wait_for("OK, I learned a cup.")
        screen.wait_for("U> ")
        screen.type("\x1b[A\r")  # the line before, with arrow up
        screen.wait_for("OK, I learned a cup.")
        screen.wait_for("U> ")
        screen.type("\x04")
        assert screen.code() == 0
    assert "This is a cup." in memory.with_name("history").read_text().splitlines()
    with at_terminal("talk", "--sensor", EMPTY) as screen:
        assert "know 1 word for things" in screen.wait_for("U> ")
        screen.type("\x1b[A\r")
        screen.wait_for("S> I see nothing on the table.")
        screen.wait_for("U> ")
        screen.type("Goodbye.\r")
        screen.wait_for("S> Goodbye.")
        assert screen.code() == 0


@pytest.mark.slow
def test_a_live_robot_remarks_on_what_comes_and_the_line_stays_usable(
    memory: Path,
) -> None:
    with at_terminal("talk", "--sensor", EMPTY, "--live") as screen:
        screen.wait_for("U> ")
        screen.type("@ meanwhile show cup\r")
        screen.wait_for("\r\x1b[KS> Something new is here: what is it?")
        screen.wait_for("U> ")
        screen.type("A cut\x7fp.\r")  # mended with backspace
        screen.wait_for("OK, I learned a cup.")
        screen.wait_for("U> ")
        screen.type("@ meanwhile remove cup\r")
        screen.wait_for("S> The cup is gone.")
        screen.wait_for("U> ")
        screen.type("\x1b[A\x1b[A\x01x\x0b\x15Goodbye.\r")
        screen.wait_for("S> Goodbye.")
        assert screen.code() == 0
    assert "A cup." in memory.with_name("history").read_text().splitlines()


@pytest.mark.slow
def test_a_live_robot_says_nothing_while_the_tutor_types() -> None:
    with at_terminal("talk", "--sensor", EMPTY, "--live") as screen:
        screen.wait_for("U> ")
        screen.type("@ meanwhile show cup\r")
        screen.wait_for("\x1b[KU> ")
        screen.type("What")
        screen.wait_for("What")
        with pytest.raises(AssertionError, match="is not in"):
            screen.wait_for("S>", seconds=6.0)
        screen.type(" is this?\r")
        screen.wait_for("is this?")
        assert "Something new" not in screen.wait_for("S> I do not know what this is.")
        screen.wait_for("U> ")
        screen.type("\x04")
        assert screen.code() == 0


@pytest.mark.slow
def test_keys_pressed_while_the_robot_looks_are_not_lost() -> None:
    with at_terminal("talk", "--sensor", EMPTY, "--live") as screen:
        screen.wait_for("U> ")
        for key in "Hello":  # at any moment of looking and waiting
            screen.type(key)
            time.sleep(0.13)
        screen.type(".\r")
        screen.wait_for("S> Hello.")
        screen.type("Goodbye.\r")
        screen.wait_for("S> Goodbye.")
        assert screen.code() == 0


def test_ctrl_c_while_a_live_robot_watches_leaves_the_terminal_as_it_was() -> None:
    with at_terminal("talk", "--sensor", EMPTY, "--live") as screen:
        before = screen.settings()
        screen.wait_for("U> ")
        screen.interrupt()
        assert screen.code() == 130
        assert "Traceback" not in screen.shown
        assert screen.settings() == before


def test_a_live_robot_needs_a_terminal(kille: Run) -> None:
    outcome = kille("talk", "--sensor", EMPTY, "--live", typed="Hello.\n")
    assert outcome.code == 2
    assert "--live needs a terminal" in outcome.complaint


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A loudspeaker that nobody hears, for a voice that there is."""
    if shutil.which("flite") is None:
        pytest.skip("flite is not installed")
    program = tmp_path / "aplay"
    program.write_text("#!/bin/sh\nexec cat > /dev/null\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")


ADMISSION = "S> I do not know what this is. Please tell me."


@pytest.mark.slow
def test_who_types_while_it_speaks_stops_it_and_loses_no_key(player: None) -> None:
    with at_terminal("talk", "--sensor", EMPTY, "--say", "flite") as screen:
        screen.wait_for("U> ")
        screen.type("@ show cup\r")
        screen.wait_for("One thing is in view")
        screen.wait_for("U> ")
        screen.type("What is this?\r")
        screen.wait_for(ADMISSION)
        time.sleep(0.5)
        screen.type("A cup")
        screen.wait_for("(cut off after 'I")
        screen.wait_for("U> A cup")
        screen.type(".\r")
        screen.wait_for("S> OK, I learned a cup.")
        screen.wait_for("U> ")
        screen.type("Goodbye.\r")
        screen.wait_for("S> Goodbye.")
        assert screen.code() == 0


@pytest.mark.slow
def test_enter_while_it_speaks_only_stops_it_and_go_on_has_it_say_the_rest(
    player: None,
) -> None:
    with at_terminal("talk", "--sensor", EMPTY, "--say", "flite") as screen:
        screen.wait_for("U> ")
        screen.type("@ show cup\r")
        screen.wait_for("One thing is in view")
        screen.wait_for("U> ")
        screen.type("What is this?\r")
        screen.wait_for(ADMISSION)
        time.sleep(0.3)
        screen.type("\r")
        screen.wait_for("(cut off after '")
        screen.wait_for("U> ")
        screen.type("Go on.\r")
        assert "S> What is this" not in screen.wait_for(ADMISSION)
        screen.type("\r")
        screen.wait_for("(cut off after '")
        screen.wait_for("U> ")
        screen.type("\x04")
        assert screen.code() == 0


@pytest.mark.slow
def test_ctrl_d_while_it_works_ends_the_talk_when_it_has_answered() -> None:
    with at_terminal("talk", "--sensor", EMPTY) as screen:
        before = screen.settings()
        screen.wait_for("U> ")
        screen.type("@ show cup\r")
        screen.wait_for("show cup\r\n")
        time.sleep(0.02)  # the line has been taken, and the robot looks
        screen.type("\x04")
        screen.wait_for("One thing is in view")
        assert screen.code() == 0
        assert screen.settings() == before


def test_ctrl_c_at_a_terminal_loses_nothing(memory: Path) -> None:
    with at_terminal("talk", "--sensor", EMPTY) as screen:
        screen.wait_for("U> ")
        screen.type("@ show cup\r")
        screen.wait_for("U> ")
        screen.type("This is a cup.\r")
        screen.wait_for("OK, I learned a cup.")
        screen.wait_for("U> ")
        screen.interrupt()
        assert screen.code() == 130
        assert "Traceback" not in screen.shown
    assert words_in(memory) == {"cup"}
    assert memory.with_name("history").exists()


# --- whatever way it ends ------------------------------------------------------------


def words_in(path: Path) -> set[str]:
    with Memory.open(path) as memory:
        return {word.surface for word in memory.words()}


def acknowledged(out: str) -> set[str]:
    """The words that it said in whole lines that it had learned."""
    said = re.findall(r"S> OK, I learned an? (\w+)\.\n", out)
    return set(said)


def up_to_first_lesson(out: IO[str]) -> str:
    """What is said until something has been learned."""
    said = ""
    while not acknowledged(said):
        line = out.readline()
        assert line, f"it ended without a lesson: {said}"
        said += line
    return said


THINGS = ("cup", "book", "banana", "teddy bear")


@contextmanager
def lessons(number: int) -> Iterator[subprocess.Popen[str]]:
    """A talk that is fed many lessons through a pipe, once it has begun.

    Each talk is about another thing, as the robot knows again what an earlier one was
    about, and asks which of its names is right.
    """
    with subprocess.Popen(
        [*COMMAND, "talk", "--sensor", EMPTY],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as child:
        assert child.stdin is not None
        assert child.stdout is not None
        first = 1000 * number
        taught = "".join(f"This is a thing{n}.\n" for n in range(first, first + 200))
        child.stdin.write(f"@ show {THINGS[number]}\n{taught}")
        child.stdin.flush()
        assert child.stdout.readline() == "Nothing is in view.\n"
        yield child


@pytest.mark.slow
def test_kill_9_in_mid_lesson_loses_no_acknowledged_lesson(memory: Path) -> None:
    rng = np.random.default_rng(9)
    known: set[str] = set()
    for number, seconds in enumerate(rng.uniform(0.2, 1.2, size=4)):
        with lessons(number) as child:
            assert child.stdout is not None
            # Some are killed after their first lesson, others perhaps before it.
            said = up_to_first_lesson(child.stdout) if number % 2 else ""
            time.sleep(seconds)
            child.kill()
            known |= acknowledged(said + child.stdout.read())
        kept = words_in(memory)
        assert kept >= known
        # Killed between its commit and its word: at most one each time.
        assert len(kept) <= len(known) + number + 1
    assert known


def test_ctrl_c_in_mid_lesson(memory: Path) -> None:
    with lessons(0) as child:
        time.sleep(0.8)
        child.send_signal(signal.SIGINT)
        assert child.stdout is not None
        assert child.stderr is not None
        said, err = child.stdout.read(), child.stderr.read()
    assert child.returncode == 130
    assert err == "\n"
    kept = words_in(memory)
    assert kept >= acknowledged(said)
    assert len(kept) <= len(acknowledged(said)) + 1


def test_two_talks_cannot_share_a_memory(kille: Run, memory: Path) -> None:
    with lessons(0) as child:
        outcome = kille("talk", "--sensor", EMPTY, typed="Hello.\n")
        with pytest.raises(MemoryFileError):
            Memory.open(memory)
        child.kill()
    assert outcome.code == 2
    assert "is in use" in outcome.complaint


def test_a_pipe_that_closes_ends_the_talk_quietly(memory: Path) -> None:
    with lessons(0) as child:
        assert child.stdout is not None
        assert child.stderr is not None
        child.stdout.close()
        assert child.stderr.read() == ""
    assert child.returncode == 141
    Memory.open(memory).close()


def test_what_a_word_means_is_a_type_on_demand(kille: Run) -> None:
    said = talked(kille, f"{SHOWN}This is a cup.\n@ meaning cup\n")
    assert "cup (noun): [look : Look, x : Ind, c : cup(x, look)]" in said


@pytest.mark.parametrize(
    ("typed", "complaint"),
    [
        ("@ mening cup", "there is no command @ mening: did you mean @ meaning?"),
        ("@ pictrue", "there is no command @ pictrue: did you mean @ picture?"),
        ("@ shwo cup", "there is no command @ shwo: did you mean @ show?"),
        (
            "@ picture a\0b.png",
            r"the picture cannot be written to a\x00b.png: that is no path of a file",
        ),
        ("@ meaning", "@ meaning needs a word: write, for example, @ meaning cup"),
    ],
)
def test_a_mistaken_command_is_answered_by_what_was_meant(
    kille: Run, typed: str, complaint: str
) -> None:
    outcome = kille("talk", "--sensor", EMPTY, typed=f"{typed}\n")
    assert outcome.code == 0
    assert outcome.err == f"kille: {complaint}\n"
