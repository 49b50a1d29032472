"""What is wrong with files, for people, editors and programs; and watching them."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
from pathlib import Path
from queue import Queue
from threading import Thread

import pytest

from ttr.cli.main import main
from ttr.editing.findings import check_file

KENNEL = "basic Ind\npred dog(Ind)\n"
PARK = 'import "kennel.ttr"\nDog := [x : Ind, c : dog(x)]\ncheck Dog <= [x : Ind]\n'
PATIENCE = 60  # seconds


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "kennel.ttr").write_text(KENNEL)
    (tmp_path / "park.ttr").write_text(PARK)
    return tmp_path


# --- findings ------------------------------------------------------------------------


def test_editors_get_a_line_for_each_error_and_each_hint(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "a.ttr").write_text(KENNEL + "X := [x : Ind, c : dgo(x)]\ncheck X <= X\n")
    (folder / "b.ttr").write_text(KENNEL + "check Ind <= ~Ind\n")
    assert main(["check", "--format", "gcc", "a.ttr", "b.ttr", "park.ttr"]) == 1
    assert capsys.readouterr().out == (
        "a.ttr:3:20: error: there is no predicate dgo\n"
        "a.ttr:3:20: note: did you mean dog?\n"
        "b.ttr:3:1: error: failed: check Ind <= ~Ind: expected yes, found no: "
        "Ind is not below ~Ind\n"
    )


def test_every_message_for_editors_is_on_one_line() -> None:
    theories = Path(__file__).resolve().parent.parent / "theories"
    found = [
        line
        for file in ("failing.ttr", "mistakes.ttr", "rule_mistakes.ttr")
        for finding in check_file(theories / file).findings
        for line in str(finding).split("\n")
    ]
    assert len(found) > 20
    form = re.compile(r".+\.ttr:[0-9]+:[0-9]+: (error|warning|note): \S.*")
    assert [line for line in found if not form.fullmatch(line)] == []


def test_json_is_a_format(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--format", "json", "park.ttr"]) == 0
    by_format = capsys.readouterr().out
    assert main(["check", "--json", "park.ttr"]) == 0
    assert capsys.readouterr().out == by_format
    assert json.loads(by_format)[0]["asked"] == 1


def test_unsaved_texts_stand_for_files(folder: Path) -> None:
    unsaved = {"kennel.ttr": "basic Ind\npred hug(Ind)\r\n"}
    found = check_file(folder / "park.ttr", text_of=lambda path: unsaved.get(path.name))
    assert [one.message for one in found.findings] == ["there is no predicate dog"]
    assert {path.name for path in found.files} == {"park.ttr", "kennel.ttr"}
    assert check_file(folder / "park.ttr").holds


def test_a_text_beyond_the_limit_is_not_checked(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KILLE_LIMITS", "0.0001")
    found = check_file("park.ttr", text_of=lambda path: "basic A # " + "a" * 100)
    assert "it has 110 bytes, and no more than 50 bytes are read" in found.unreadable


STORY = """@ game {game}
--- one
U> Greet
S> GreetBack
S> {said}
"""


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (
            STORY.format(game="door.ttr door", said="Open"),
            5,
            "expected Open, found Ask",
        ),
        (STORY.format(game="door.ttr dor", said="Ask"), 1, "did you mean door?"),
        (STORY.format(game="dor.ttr door", said="Ask"), 1, "there is no file dor.ttr"),
        ("U> Greet\nHello\n", 2, "a line begins with"),
        ("@ game door.ttr door\nU> Gret\n", 2, "nothing is called Gret here"),
    ],
)
def test_stories_are_checked(
    text: str, line: int, message: str, tmp_path: Path
) -> None:
    games = Path(__file__).resolve().parent.parent / "games"
    (tmp_path / "door.ttr").write_text((games / "door.ttr").read_text())
    (tmp_path / "a.dlg").write_text(text)
    (found,) = check_file(tmp_path / "a.dlg").findings
    assert found.line == line
    assert message in found.message


def test_a_story_runs_no_python(folder: Path) -> None:
    (folder / "trap.py").write_text("open('sprung', 'w').close()\n")
    (folder / "a.dlg").write_text("@ game trap.py:game\nU> Hello\n")
    found = check_file("a.dlg")
    assert found.holds
    assert found.summary == (
        "a.dlg: 1 story read, none played: no theory has their game"
    )
    assert not (folder / "sprung").exists()


# --- watching ------------------------------------------------------------------------


class Watching:
    """`ttr check --watch` as a process whose lines are waited for."""

    def __init__(self, *words: str) -> None:
        command = [sys.executable, "-m", "ttr.cli.main", "check", "--watch", *words]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        self.lines: Queue[str] = Queue()
        self.reading = Thread(target=self._read, daemon=True)
        self.reading.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.lines.put(line.rstrip("\n"))
        self.process.stdout.close()
        self.lines.put("the end")

    def end(self) -> None:
        self.process.kill()
        self.process.wait(PATIENCE)
        self.reading.join(PATIENCE)

    def up_to(self, start: str) -> list[str]:
        """The lines up to one that starts so."""
        found: list[str] = []
        while not found or not found[-1].startswith(start):
            found.append(self.lines.get(timeout=PATIENCE))
        return found


def replace_text(path: Path, text: str) -> None:
    """Give a file another text at once, so that nobody reads half of it."""
    new = path.with_suffix(".new")
    new.write_text(text)
    new.replace(path)


def test_files_are_checked_again_when_what_they_import_changes(folder: Path) -> None:
    watching = Watching("--format", "gcc", "park.ttr")
    try:
        first = watching.up_to("ttr: watching")
        assert first == [
            "ttr: checking park.ttr",
            "ttr: watching 2 files (Ctrl-C ends)",
        ]
        replace_text(folder / "kennel.ttr", "basic Ind\n")
        assert "park.ttr:2:22: error: there is no predicate dog" in watching.up_to(
            "ttr: watching"
        )
        replace_text(folder / "kennel.ttr", KENNEL)
        assert watching.up_to("ttr: watching") == first
        watching.process.send_signal(signal.SIGINT)
        assert watching.up_to("the end") == ["the end"]
        assert watching.process.wait(PATIENCE) == 130
    finally:
        watching.end()
