"""Words that a terminal, browser or spreadsheet would obey, through the commands."""

from __future__ import annotations

import csv
import io
import json
import logging
import sys
from collections.abc import Callable, Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from rich.cells import cell_len

from kille.interfaces.doctor import as_json, as_text
from kille.interfaces.doctor.findings import DoctorFinding
from kille.interfaces.grids import print_table
from kille.interfaces.replay import in_brief, replay
from kille.interfaces.standard_streams import prepare_streams
from kille.interfaces.terminal import console
from kille.lab.people.typed_lines import read_line
from kille.lab.results import Table
from kille.memory import Memory, Sighting, Turn

Run = Callable[..., Any]

WORD = "\x1b]0;pwned\x07\x9b1m\u202egrab[bold]<script>x</script>"
SEEN = r"\x1b]0;pwned\x07\x9b1m\u202egrab[bold]<script>x</script>"


def obeyed(text: str) -> list[str]:
    """What of a text a terminal would obey."""
    return [c for c in text.replace("\n", "") if not c.isprintable()]


@pytest.fixture
def quiet(kille: Run) -> Run:
    """Runs a command, which says nothing that a terminal would obey."""

    def run(*words: str, typed: str = "") -> Any:
        done = kille(*words, typed=typed)
        assert obeyed(done.out) == []
        assert obeyed(done.err) == []
        return done

    return run


class Tags(HTMLParser):
    """The tags of a page and the attributes of each, and its text."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags, self.text = set[str](), ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert not any(name.startswith("on") for name, _ in attrs)
        self.tags.add(tag)

    def handle_data(self, data: str) -> None:
        self.text += data


# --- a memory ------------------------------------------------------------------------


@pytest.fixture
def taught(memory: Path) -> Path:
    """A memory in which all but the name of the word is hostile."""
    with Memory.open(memory) as it:
        said = Turn(it.begin_dialogue(WORD), 1, WORD, f"{WORD}\nmore", WORD, WORD)
        it.learn_object(said, "cup", "cup", Sighting(WORD, 0.0, (), None))
    return memory


@pytest.mark.usefixtures("taught")
def test_a_memory_speaks_to_no_terminal(
    quiet: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "250")
    for words in (("show", "1"), ("show", WORD), ("show", f"{WORD}?")):
        done = quiet("memory", *words)
        assert SEEN in done.out + done.err
    (lesson,) = json.loads(quiet("memory", "show", "1", "--json").out)
    assert lesson["sensor"] == WORD
    exported = tmp_path / f"{WORD.replace('/', '')}.zip"
    assert quiet("memory", "export", str(exported)).code == 0
    assert quiet("memory", "import", str(exported)).code == 0
    assert quiet("memory", "forget", "cup", "--yes").code == 0


def test_a_word_that_speaks_to_a_terminal_is_not_learned(memory: Path) -> None:
    with Memory.open(memory) as it:
        said = Turn(it.begin_dialogue("now"), 1, "Ann", "", "", "now")
        with pytest.raises(ValueError, match=r"cannot have the character '\\x1b'"):
            it.learn_object(said, "cup", WORD, Sighting("s", 0.0, (), None))


def test_two_words_that_differ_are_listed_apart(
    quiet: Run, memory: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "250")
    words = "cup", "cu\u200bp", r"cu\u200bp", "cup\xa0", r"cup\xa0", r"cup\x07"
    with Memory.open(memory) as it:
        for number, word in enumerate(words, start=1):
            said = Turn(it.begin_dialogue("now"), number, "Ann", "", "", "now")
            it.learn_object(said, f"w{number}", word, Sighting("s", 0.0, (), None))
    _, _, *lines = quiet("memory", "list").out.splitlines()
    assert len({line.split("  ")[0] for line in lines}) == len(words)


# --- names of files, and what is typed -----------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        (WORD,),
        ("talk", f"--{WORD}"),
        ("talk", "--sensor", WORD),
        ("talk", "--memory", f"/dev/null/{WORD}"),
        ("replay", WORD),
        ("record", WORD, "--sensor", WORD),
        ("convert", WORD, WORD),
        ("memory", "list", "--memory", WORD),
        ("memory", "import", WORD),
        ("evaluate", "objects", WORD),
        ("evaluate", "objects", "--protocol", WORD),
        ("evaluate", "relations", "--method", f"{WORD}.py:x"),
        ("experiment", "check", WORD),
        ("experiment", "show", WORD),
        ("experiment", "compare", WORD, WORD),
        ("demo", "--out", f"/dev/null/{WORD}.png"),
        ("demo", "--seed", WORD),
    ],
    ids=lambda words: " ".join(words).replace(WORD, "X"),
)
def test_a_complaint_repeats_no_code(words: tuple[str, ...], quiet: Run) -> None:
    done = quiet(*words)
    assert done.code == 2
    assert len(done.err.splitlines()) == 1
    assert r"\x1b" in done.err


def test_what_is_typed_is_shown_as_it_is_seen(quiet: Run) -> None:
    done = quiet("talk", "--sensor", "synthetic:empty", typed=f"{WORD}\n@ {WORD}\n")
    assert rf"U> {SEEN}" in done.out
    assert r"S> Sorry, I did not understand" in done.out


def test_a_file_may_be_named_as_markup(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FORCE_COLOR", "1")  # bars are drawn as in a terminal
    file = Path("[/x]:smile:.dlg")
    file.parent.mkdir()
    file.write_text("--- [/bold]hello\nU> Hello.\nS> Hello.\n")
    assert replay([file], in_brief, None) in (0, 1)
    assert "[/x]:smile:.dlg" in capsys.readouterr().out


def test_a_device_is_called_what_it_says(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = [DoctorFinding(f"Kinect {WORD}", True, False, WORD, WORD)]
    as_text(found)
    shown = capsys.readouterr().out
    assert obeyed(shown) == []
    assert SEEN in shown
    as_json(found)
    facts = capsys.readouterr().out
    assert obeyed(facts) == []
    assert json.loads(facts)[0]["state"] == WORD


def test_people_in_a_study_see_what_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO(f"{WORD}\n"))
    assert read_line(f"{WORD}\n{WORD}> ") == WORD
    shown = capsys.readouterr().out
    assert obeyed(shown) == []
    assert shown.startswith(f"{SEEN}\n{SEEN}> ")


def test_columns_are_as_wide_as_what_is_in_them() -> None:
    out = console()
    out.file, out.width = io.StringIO(), 60
    rows = (("\x1b[31m", 1), ("\u202e犬", 22))
    print_table(out, Table(WORD, ("\x1b", "n"), rows))
    shown = out.file.getvalue()
    assert obeyed(shown) == []
    *_, one, other = shown.splitlines()
    assert cell_len(one.rstrip()) == cell_len(other.rstrip())


@pytest.fixture
def logged() -> Iterator[None]:
    """What nobody else takes is printed by Python's last resort."""
    last = logging.lastResort
    assert last is not None
    before = last.formatter
    yield
    last.setFormatter(before)


@pytest.mark.usefixtures("logged")
def test_what_is_logged_is_safe_to_print() -> None:
    prepare_streams()
    assert logging.lastResort is not None
    record = logging.LogRecord("x", logging.WARNING, "", 1, "%s: odd", (WORD,), None)
    assert logging.lastResort.format(record) == f"{SEEN}: odd"


# --- a study -------------------------------------------------------------------------


STUDY = f"""
title = {json.dumps(WORD)}
about = {json.dumps(WORD)}
seeds = 1

[theories."=1+1 [bold]<script>x<"]
mode = "assisted"

[theories.broken]
mode = "assisted"
learners.noun = "own.py:Broken"

[tutors."@tutor [bold] $x_1$"]
kind = "simulated"

[scenes."-scene \\"onclick='x'"]
kind = "drawn"

[[phases]]
do = "teach"
what = "nouns"

[[phases]]
name = "+test </h3><script>x</script>"
do = "ask"
what = "nouns"
"""
OWN = f"""
class Broken:
    lessons = 0

    def learn_one(self, x, label):
        self.lessons += 1
        if self.lessons > 5:
            raise ValueError({WORD!a})

    def predict_proba_one(self, x):
        return {{"cup": 0.5}}
"""


def test_what_is_wrong_with_a_study_is_safe_to_print(
    quiet: Run, tmp_path: Path
) -> None:
    file = tmp_path / "words.toml"
    file.write_text(f"title = 1\n[{json.dumps(WORD)}]\n[theories.{json.dumps(WORD)}]")
    done = quiet("experiment", "check", str(file))
    assert done.code == 2
    assert SEEN in done.err


def test_a_study_speaks_to_nobody(
    quiet: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("words.toml").write_text(STUDY, "utf-8")
    Path("own.py").write_text(OWN)
    assert quiet("experiment", "check", "words.toml").code == 0
    folder = "javascript:#%41?.results"
    done = quiet("experiment", "run", "words.toml", "--out", folder, "--workers", "1")
    assert done.code == 1
    assert SEEN in done.out
    assert quiet("experiment", "show", folder).code == 0
    assert SEEN in quiet("experiment", "show", folder, "2").out
    json.loads(quiet("experiment", "show", folder, "2", "--json").out)
    json.loads(quiet("experiment", "show", folder, "1", "--json").out)
    quiet("experiment", "replay", folder, "1")
    assert quiet("experiment", "report", folder).code == 0
    pages = sorted(Path(folder).rglob("*.html"))
    assert len(pages) > 3
    for page in pages:
        text = page.read_text("utf-8")
        assert obeyed(text.replace("\t", "").replace("\xa0", "")) == []
        assert "script" not in Tags(text).tags
    report = Path(folder) / "report.html"
    assert SEEN in Tags(report.read_text("utf-8")).text
    with (Path(folder) / "turns.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert {row["theory"][:2] for row in rows} == {"'="}
    assert not any(cell[:1] in tuple("=+@") for row in rows for cell in row.values())
