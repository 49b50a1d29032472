"""Dialogue files: what is a story, and what comes of playing it with a game."""

from __future__ import annotations

import json
import os
from pathlib import Path
from xml.etree import ElementTree

import pytest

from ttr import (
    Basic,
    ListOf,
    Model,
    Record,
    RecType,
    TTRError,
    record,
    rectype,
    replace,
)
from ttr.cli.main import main
from ttr.dialogues.dialogue import Trial
from ttr.dialogues.stories import (
    Line,
    Mismatch,
    Outcome,
    Setting,
    StoryError,
    format_story,
    junit,
    play,
    read_stories,
    setting,
)
from ttr.theories.theory import Theory
from ttr.updates import Game, first, nbest, rule

DOOR = (Path(__file__).parent.parent / "games" / "door.ttr").read_text("utf-8")

OPENED = """
--- the door is opened
U> Greet
S> GreetBack
S> Ask
= s : [shared : [open = [Ask] : Moves]]
U> Answer
S> Open
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "story.dlg"


@pytest.fixture
def door(tmp_path: Path) -> Setting:
    (tmp_path / "door.ttr").write_text(DOOR)
    return setting("door.ttr door", tmp_path)


# --- reading -------------------------------------------------------------------------


def error_of(path: Path) -> str:
    with pytest.raises(StoryError) as caught:
        read_stories(path)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_stories_have_titles_and_lines_in_order(file: Path) -> None:
    file.write_text(
        "# two of them\n--- one\nU> Hello.\nS> Hello.\n\n"
        "  --- two\n@ show cup\n= s : State\nS~ .*\n"
    )
    one, two = read_stories(file)
    assert (one.title, two.title) == ("one", "two")
    assert [(line.number, line.mark, line.text) for line in one.lines] == [
        (3, "U>", "Hello."),
        (4, "S>", "Hello."),
    ]
    assert [line.mark for line in two.lines] == ["@", "=", "S~"]
    assert one.lines[0].place == f"{file}:3"


def test_a_story_without_a_title_is_named_after_its_file(file: Path) -> None:
    file.write_text("U> Hello.\n")
    (only,) = read_stories(file)
    assert only.title == "story"


def test_a_comment_ends_a_line_but_pointing_does_not(file: Path) -> None:
    file.write_text("U> #2 This is a cup. # the second\nU> # nothing\nS> a#b\n")
    (only,) = read_stories(file)
    assert [line.text for line in only.lines] == ["#2 This is a cup.", "", "a#b"]


def test_bytes_before_the_first_letter_and_line_ends_of_windows(file: Path) -> None:
    file.write_bytes(b"\xef\xbb\xbf--- one\r\nU> Hello.\r\nS> Hello.\r\n")
    (only,) = read_stories(file)
    assert only.title == "one"
    assert [line.text for line in only.lines] == ["Hello.", "Hello."]


@pytest.mark.parametrize("line", ["U: Hello.", "u> Hello.", "Hello.", "S Hello.", ">"])
def test_a_misspelt_mark_is_named_with_its_line(file: Path, line: str) -> None:
    file.write_text(f"--- one\nU> Hello.\n{line}\n")
    told = error_of(file)
    assert told.startswith(f"{file}:3: ")
    assert "U>" in told
    assert repr(line) in told


@pytest.mark.parametrize("text", ["", "\n\n", "# only a comment\n", "--- a title\n"])
def test_a_file_without_a_story(file: Path, text: str) -> None:
    file.write_text(text)
    assert "has no story" in error_of(file)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    assert "there is no file" in error_of(tmp_path / "nowhere.dlg")
    assert "is a folder" in error_of(tmp_path)
    latin = tmp_path / "latin.dlg"
    latin.write_bytes("U> Grüße".encode("latin-1"))
    assert "UTF-8" in error_of(latin)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_a_file_that_may_not_be_read(file: Path) -> None:
    file.write_text("U> Hello.\n")
    file.chmod(0)
    assert "Permission denied" in error_of(file)


def test_the_game_of_a_file_is_that_of_its_stories(file: Path) -> None:
    file.write_text("@ game a.ttr a\n--- one\nU> A\n--- two\n@ game b.ttr b\nU> B\n")
    one, two = read_stories(file)
    assert one.game is not None
    assert two.game is not None
    assert (one.game.number, two.game.text) == (1, "game b.ttr b")
    assert [line.mark for line in one.lines + two.lines] == ["U>", "U>"]


def test_a_game_in_the_middle_of_a_story_is_an_error(file: Path) -> None:
    file.write_text("U> A\n@ game a.ttr a\n")
    assert error_of(file).startswith(f"{file}:2: ")


# --- differences ---------------------------------------------------------------------


def test_a_mismatch_says_where_what_and_what_instead() -> None:
    line = Line("a.dlg", 7, "S>", "Hello.")
    told = str(Mismatch(line, "Hello.", "silence"))
    assert told.splitlines() == ["a.dlg:7", "  expected: Hello.", "     found: silence"]


def test_the_words_that_differ_are_marked() -> None:
    line = Line("a.dlg", 7, "S>", "I see a red cup.")
    told = str(Mismatch(line, "I see a red cup.", "I see a cup now."))
    assert told.splitlines() == [
        "a.dlg:7",
        "  expected: I see a red cup.",
        "                    ^^^",
        "     found: I see a cup now.",
        "                        ^^^",
    ]


def test_nothing_is_marked_where_no_word_is_the_same() -> None:
    told = str(Mismatch(Line("a.dlg", 1, "S>", ""), "Good day.", "Hello."))
    assert "^" not in told


# --- playing -------------------------------------------------------------------------


def played(file: Path, door: Setting, text: str) -> Mismatch | None:
    file.write_text(f"@ game door.ttr door\n{text}")
    (story,) = read_stories(file)
    return play(story).mismatch


def differs(file: Path, door: Setting, text: str) -> tuple[int, str, str]:
    """Line after the first, expectation and finding of the difference that there is."""
    mismatch = played(file, door, text)
    assert mismatch is not None
    return mismatch.line.number - 1, mismatch.expected, mismatch.found


@pytest.mark.parametrize(
    "text",
    [
        OPENED,
        "U> [e : greet(guest, host)]\nS> [e : greet(host, guest)]\nS> Ask\n",
        "U>\nS>\n",
        "@ event Greet\nS> GreetBack\nS~ [e : ask(host, guest)] \\/ Open\n",
        "U~ Greet 0.6 | Answer 0.3\nS> GreetBack\nS> Ask\n",
        "@ perhaps Greet 0.6 | Answer .3\nS> GreetBack\nS> Ask\n",
        "U~ Greet 0.4 | Answer 0.3\nS>\n",
        "@ start {private = {agenda = []}, shared = {said = [], open = [Ask]}}\n"
        "= s : [shared : [open = [Ask] : Moves]]\nU> Answer\nS> Open\n",
        "@ start {private = {agenda = []}, shared = {said = [], open = []}}\n"
        "U> Answer\nS>\n= s : Board\n",
    ],
)
def test_stories_that_are_as_written(file: Path, door: Setting, text: str) -> None:
    assert played(file, door, text) is None


@pytest.mark.parametrize(
    ("text", "difference"),
    [
        ("U> Greet\nS> Ask\n", (2, "Ask", "GreetBack")),
        ("U> Greet\nS~ Open\n", (2, "Open", "GreetBack")),
        ("U> Greet\nS> GreetBack\nS> [e : ask(host, guest)] \\/ Open\nU>", None),
        ("U> Answer\nS> Open\n", (2, "Open", "silence")),
        ("U> Greet\nS>\n", (2, "silence", "GreetBack")),
        (
            "U> Greet\nS> GreetBack\nU>\n",
            (3, "nothing more to be said before this", "Ask"),
        ),
        ("U> Greet\n", (1, "nothing more to be said before this", "GreetBack")),
        (
            "U>\n= s : [shared : [open = [Ask] : Moves]]\n",
            (2, "[shared : [open = [Ask] : Moves]]", "at shared.open: [] : "),
        ),
    ],
)
def test_where_a_story_differs(
    file: Path, door: Setting, text: str, difference: tuple[int, str, str] | None
) -> None:
    found = differs(file, door, text)
    if difference is None:  # `S>` is to the letter: a type above does not do
        assert (found[0], found[2]) == (3, "Ask")
        return
    assert found[:2] == difference[:2]
    assert found[2].startswith(difference[2])


def test_a_move_that_is_more_than_the_story_says_is_told_with_the_mark_for_that(
    file: Path, door: Setting
) -> None:
    mismatch = played(file, door, "U> Greet\nS> GreetBack\nS> Ask \\/ Open\n")
    assert mismatch is not None
    help_line = "  help: it is more than Ask \\/ Open says: write S~ Ask \\/ Open"
    assert help_line in str(mismatch).splitlines()
    other = played(file, door, "U> Greet\nS> Open\n")
    assert other is not None
    assert not other.hint


def test_a_mismatch_shows_the_rules_of_its_turn(file: Path, door: Setting) -> None:
    mismatch = played(file, door, "U> Greet\nS> GreetBack\nS> Open\n")
    assert mismatch is not None
    assert [step.rule.name for step in mismatch.trace] == [
        "greeted",
        "greeted_back",
        "asked",
    ]
    assert "    asked: What was asked is open.\n" in str(mismatch)
    assert "      shared.open: + [e : ask(host, guest)]" in str(mismatch)


WRONG = {
    "U> Gret": ("nothing is called Gret", "did you mean Greet?", 4),
    "U> Ind": ("is no event that the game door takes", "", None),
    "U~ Greet 0.7 | Answer 0.9": ("come to at most 1, found 1.6", "", 4),
    "U~ Greet | Answer 0.9": ("ends with its probability", "", 4),
    "U~ Greet 0.1 | Answr 0.9": ("nothing is called Answr", "Answer", 16),
    "@ evnt Greet": ("there is no `@ evnt`", "did you mean event?", None),
    "@ fly": ("there is no `@ fly`", "there are game, start, event", None),
    "@ event Gret": ("nothing is called Gret", "Greet", 9),
    "@ start {private = {}}": ("before anything else", "", None),
    "= s : [x": ("expected", "", 9),
    "= s : Bord": ("nothing is called Bord", "Board", 7),
    "= t : Board": ("`= s : T`", "", None),
    "= s : guest": ("expected a type, found guest", "", None),
}


@pytest.mark.parametrize(("line", "told"), WRONG.items())
def test_a_line_that_cannot_be_played(
    file: Path, door: Setting, line: str, told: tuple[str, str, int | None]
) -> None:
    message, hint, column = told
    with pytest.raises(StoryError) as caught:
        played(file, door, f"U>\n{line}\n")
    error = caught.value
    assert str(error).startswith(f"{file}:3: ")
    assert message in error.message
    assert hint in str(error)
    assert (error.span.column if error.span else None) == column


def test_what_the_system_says_must_be_a_type(file: Path, door: Setting) -> None:
    with pytest.raises(StoryError, match=r":3: .*Opne"):
        played(file, door, "U> Greet\nS> Opne\n")


@pytest.mark.parametrize(
    ("start", "told"),
    [
        ("{private = {agenda = []}}", "is not of its type, at shared"),
        ("Board", "a story starts in a record, found Board"),
        ("{private = nobody}", "nothing is called nobody"),
    ],
)
def test_a_start_that_is_none(file: Path, door: Setting, start: str, told: str) -> None:
    with pytest.raises(StoryError, match=r":2: ") as caught:
        played(file, door, f"@ start {start}\nU>\n")
    assert told in str(caught.value)


REFERENCES = {
    "door.ttr dor": "door.ttr has no game dor: did you mean door?",
    "dor.ttr door": "there is no file dor.ttr: did you mean door.ttr?",
    "nowhere/door.ttr door": "there is no file nowhere/door.ttr",
    "broken.ttr door": "broken.ttr:1: ",
    "empty.ttr": "name a game of empty.ttr: there is none in it",
    "door": "a game is named as FILE.ttr NAME",
    "game.py:dor": "game.py has no game dor",
    "gone.py:door": "there is no file gone.py",
    "raising.py:door": "raising.py cannot be run: ZeroDivisionError",
}


@pytest.mark.parametrize(
    ("reference", "told"),
    [
        ("no.such.module:door", "there is no module no.such.module: name a game as"),
        ("json:dumps", "json has no game dumps: there is none in it"),
    ],
)
def test_a_module_without_the_game_that_a_user_names(reference: str, told: str) -> None:
    with pytest.raises(StoryError, match=told):
        setting(reference, Path())


@pytest.mark.parametrize(("reference", "told"), REFERENCES.items())
def test_a_story_of_a_game_that_is_not_there(
    file: Path, door: Setting, reference: str, told: str
) -> None:
    (file.parent / "broken.ttr").write_text("basic\n")
    (file.parent / "empty.ttr").write_text("basic Ind\n")
    (file.parent / "game.py").write_text("door = 3\n")
    (file.parent / "raising.py").write_text("1 / 0\n")
    file.write_text(f"@ game {reference}\nU>\n")
    with pytest.raises(StoryError) as caught:
        play(read_stories(file)[0])
    assert str(caught.value).startswith(f"{file}:1: ")
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_story_without_a_game_says_how_to_name_one(file: Path) -> None:
    file.write_text("--- one\nU>\n")
    with pytest.raises(StoryError, match=r":2: the story names no game: begin"):
        play(read_stories(file)[0])
    file.write_text("@ gmae door.ttr\nU>\n")
    with pytest.raises(StoryError, match=r"names no game: did you mean game\?"):
        play(read_stories(file)[0])


def test_the_only_game_of_a_file_needs_no_name(file: Path, door: Setting) -> None:
    file.write_text("@ game door.ttr\nU> Greet\nS> GreetBack\nS> Ask\n")
    assert play(read_stories(file)[0]).mismatch is None


# --- games in Python, and games with a language ---------------------------------------

PYTHON = """
from dataclasses import dataclass

from beside import Greet
from ttr import Model, replace
from ttr.types.syntax import ListOf, RecType
from ttr import rectype
from ttr.updates import Game, rule

Board = rectype(agenda=ListOf(RecType))
WORDS = {"Hello.": Greet}


@dataclass
class Unused:
    x: int


@rule(when=Board, on=Greet)
def hear(s, e):
    "Who says hello is greeted."
    return replace(s, agenda=[] if s.agenda else [Greet])


def words(text):
    if text in WORDS:
        return WORDS[text]
    raise LookupError(text)


plain = Game("plain", Board, {"agenda": []}, hear, Model(), "agenda")
game = Game(
    "talk", Board, {"agenda": []}, hear, Model(), "agenda",
    hear=WORDS.get, say=lambda move: "Hello to\\n you."
)
"""
BESIDE = """
from ttr import Ind, Pred, rectype, this

Greet = rectype(x=Ind, e=Pred("greet", Ind)(this.x))
"""


@pytest.fixture
def python(tmp_path: Path) -> Path:
    (tmp_path / "talk.py").write_text(PYTHON)
    (tmp_path / "beside.py").write_text(BESIDE)
    return tmp_path


def test_a_game_in_python_has_the_names_of_its_module(python: Path) -> None:
    file = python / "a.dlg"
    file.write_text("@ game talk.py:plain\nU> Greet\nS> [x : Ind, e : greet(x)]\n")
    assert play(read_stories(file)[0]).mismatch is None


def test_a_game_with_a_language_hears_and_says_words(python: Path) -> None:
    file = python / "a.dlg"
    file.write_text(
        "@ game talk.py:game\nU> Hello.\nS> Hello to you.\nU> Hm.\nS>\n"
        "U~ Hm. 0.5 | Mh. 0.5\nS>\nU~ Hello. 1 | Hm. 0\nS~ Hello.*\n"
        "@ event Greet\nS~ Hell.*\n"
    )
    told: list[str] = []
    assert play(read_stories(file)[0], echo=told.append).mismatch is None
    assert told[:2] == ["U> Hello.", "S> Hello to you."]
    file.write_text("@ game talk.py:game\nU> Hello.\nS~ (\n")
    with pytest.raises(StoryError, match=r":3: .*no regular expression"):
        play(read_stories(file)[0])


def test_a_rule_that_fails_is_a_difference(file: Path) -> None:
    theory = Theory.parse("Board := [x : Rec]\n")

    @rule(when=theory["Board"])
    def broken(s: object) -> object:
        raise ValueError("oh")

    game = Game("broken", theory["Board"], record(x=record()), broken)
    file.write_text("U>\nS>\n")
    found = play(read_stories(file)[0], Setting.of(game, theory)).mismatch
    assert found is not None
    assert (found.line.number, found.expected) == (1, "a turn without an error")
    assert found.found == "the rule broken failed: ValueError: oh"


def test_a_language_that_fails_is_told(python: Path) -> None:
    file = python / "a.dlg"
    with (python / "talk.py").open("a") as module:
        module.write(
            "deaf = Game('deaf', Board, {'agenda': []}, hear, hear=words)\n"
            "mute = Game('mute', Board, {'agenda': []}, hear, Model(), 'agenda',\n"
            "    say=lambda move: WORDS['nothing'])\n"
        )
    file.write_text("@ game talk.py:deaf\nU> Good day.\n")
    with pytest.raises(StoryError, match=r":2: what the game hears by failed: Lookup"):
        play(read_stories(file)[0])
    file.write_text("@ game talk.py:mute\nU> Greet\n")
    found = play(read_stories(file)[0]).mismatch
    assert found is not None
    assert found.found.startswith("the game mute found no words for ")
    assert found.found.endswith("KeyError: 'nothing'")


# --- writing -------------------------------------------------------------------------


def test_a_story_that_is_written_plays_again(file: Path, door: Setting) -> None:
    theory, game = door.theory, door.game
    greet, answer = theory["Greet"], theory["Answer"]
    events = [None, nbest((greet, 0.75), (answer, 0.25)), answer, record(e="s1")]
    turns = game.play(events[:3])
    text = format_story("a visit", [Trial.of(turn, door) for turn in turns], door)
    assert text == (
        "--- a visit\n@ game door.ttr door\nU>\nU~ Greet 0.75 | Answer 0.25\n"
        "S> GreetBack\nS> Ask\nU> Answer\nS> Open\n"
    )
    file.write_text(text)
    assert play(read_stories(file)[0]).mismatch is None


def test_events_of_a_game_that_hears_words_are_written_as_events(python: Path) -> None:
    talk = setting("talk.py:game", python)
    greet = talk.theory["Greet"]
    events = [greet, None, nbest((greet, 0.5))]
    turns = talk.game.play(events)
    text = format_story("talk", [Trial.of(turn, talk) for turn in turns], talk)
    assert "@ event Greet\nS> Hello to you.\nU>\n@ perhaps Greet 0.5\n" in text
    file = python / "again.dlg"
    file.write_text(text)
    assert play(read_stories(file)[0]).mismatch is None


def test_a_reference_moves_with_the_folder(tmp_path: Path, door: Setting) -> None:
    assert door.reference_from(tmp_path / "a" / "b") == "../../door.ttr door"
    python = Setting(door.game, door.theory, "games.py:door", tmp_path)
    assert python.reference_from(tmp_path / "a") == "../games.py:door"
    module = Setting(door.game, door.theory, "some.games:door", tmp_path)
    assert module.reference_from(tmp_path / "a") == "some.games:door"


# --- the command ---------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, door: Setting, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.dlg").write_text(f"@ game door.ttr door\n{OPENED}")
    (tmp_path / "bad.dlg").write_text(
        "@ game door.ttr door\n--- fine\nU>\n--- wrong\nU> Greet\nS> Ask\n"
        "--- broken\nU> Gret\n"
    )
    return tmp_path


def test_play_prints_what_is_said(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", "good.dlg"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "--- the door is opened",
        "U> Greet",
        "S> GreetBack",
        "S> Ask",
        "U> Answer",
        "S> Open",
        "good.dlg: 1 story as written",
    ]
    assert main(["play", "--trace", "good.dlg"]) == 0
    assert "\n   asked: What was asked is open.\n" in capsys.readouterr().out


def test_play_says_what_differs_and_goes_on(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", "--quiet", "bad.dlg", "good.dlg"]) == 1
    out = capsys.readouterr().out
    assert "bad.dlg:6\n  expected: Ask\n     found: GreetBack\n" in out
    assert "bad.dlg:8: nothing is called Gret" in out
    assert "bad.dlg: 2 of 3 stories differ\ngood.dlg: 1 story as written\n" in out


def test_play_for_machines(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["play", "--json", "bad.dlg"]) == 1
    fine, wrong, broken = json.loads(capsys.readouterr().out)
    assert fine == {"file": "bad.dlg", "title": "fine", "difference": None}
    assert wrong["difference"]["line"]["number"] == 6
    assert wrong["difference"]["rules"][0]["rule"] == "greeted"
    assert "Gret" in broken["error"]


def test_a_file_that_is_not_there_is_wrong_use(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["play", "--quiet", "gone.dlg", "good.dlg"]) == 2
    printed = capsys.readouterr()
    assert printed.err == "ttr: there is no file gone.dlg\n"
    assert printed.out == "good.dlg: 1 story as written\n"
    assert main(["play", "gone.dlg", "--junit", "report.xml"]) == 2
    root = ElementTree.parse(folder / "report.xml").getroot()
    assert (root.get("tests"), root.get("errors")) == ("1", "1")


@pytest.mark.parametrize("option", ["--junit", "--html", "--log"])
def test_a_report_that_cannot_be_written_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str], option: str
) -> None:
    assert main(["play", "--quiet", "good.dlg", option, "no/such/folder"]) == 2
    told = capsys.readouterr().err
    assert told == "ttr: no/such/folder cannot be written: no such file or directory\n"


ALLOWED = {
    "testsuites": {"time", "tests", "failures", "errors"},
    "testsuite": {"name", "file", "time", "tests", "failures", "errors"},
    "testcase": {"name", "classname", "time"},
    "failure": {"message", "type"},
    "error": {"message", "type"},
}
"""What the schema of Jenkins' xUnit plugin lets the elements have."""


def test_the_report_for_ci(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = ["bad.dlg", "good.dlg"]
    assert main(["play", "--quiet", *files, "--junit", "report.xml"]) == 1
    root = ElementTree.parse(folder / "report.xml").getroot()
    for element in root.iter():
        assert set(element.attrib) == ALLOWED[element.tag]
    counts = [(it.get("tests"), it.get("failures"), it.get("errors")) for it in root]
    assert counts == [("3", "1", "1"), ("1", "0", "0")]
    (failure,) = root.iter("failure")
    assert failure.get("message") == "bad.dlg differs in line 6"
    assert "expected: Ask" in (failure.text or "")
    (error,) = root.iter("error")
    assert (error.get("message") or "").startswith("bad.dlg:8: nothing is called Gret")
    assert sorted(it.name for it in folder.iterdir() if it.suffix == ".part") == []


def test_characters_that_no_xml_may_have_are_made_visible() -> None:
    told = junit([Outcome("a.dlg", "bell \x07 & <b>", error=TTRError("\x00"))])
    (case,) = ElementTree.fromstring(told.encode()).iter("testcase")
    assert case.get("name") == r"bell \x07 & <b>"


def test_moments_are_shown_to_a_witness_as_they_come(file: Path, door: Setting) -> None:
    file.write_text(f"@ game door.ttr door\n{OPENED}")
    seen: list[Trial] = []
    result = play(read_stories(file)[0], witness=seen.append)
    assert tuple(seen) == result.dialogue.trials
    assert [one.line for one in seen] == ["U> Greet", "U> Answer"]
    assert seen[0].said == ("GreetBack", "Ask")


# --- words that look like something else ----------------------------------------------


def parrot(words: str | None = None) -> Setting:
    """A game that says what it hears, or always the same."""
    T = Basic("Text")
    board = rectype(said=ListOf(T), agenda=ListOf(RecType))
    move = rectype(words=T)

    @rule(when=board, on=T)
    def repeats(s: Record, e: str) -> Record:
        return replace(s, agenda=[rectype(words=T @ e)])

    @rule(when=board, on=move)
    def has_said(s: Record, e: Record) -> Record:
        return replace(s, agenda=[])

    game = Game(
        "parrot",
        board,
        record(said=[], agenda=[]),
        first(has_said, repeats),
        Model().witnessed(T, by=lambda one: isinstance(one, str)),
        "agenda",
        hear=str,
        say=lambda told: str(told.type["words"].value) if words is None else words,
    )
    return Setting.of(game)


@pytest.mark.parametrize(
    "words", ["a # b", "# a", "a #", r"a \# b", r"\\#", "#2", "S> a", "--- a", r"\n"]
)
def test_a_story_written_with_any_words_plays(file: Path, words: str) -> None:
    setting = parrot()
    turns = [
        Trial.of(turn, setting, f"U> {words}") for turn in setting.game.play([words])
    ]
    file.write_text(format_story(f"of\n{words}", turns, setting), encoding="utf-8")
    (story,) = read_stories(file)
    assert play(story, setting).mismatch is None
    assert story.lines[0].text == words


def test_a_move_without_words_is_silence(file: Path) -> None:
    setting = parrot("")
    turns = [Trial.of(turn, setting, "U> a") for turn in setting.game.play(["a"])]
    text = format_story("silence", turns, setting)
    assert "S>" not in text
    file.write_text(f"{text}S>\n", encoding="utf-8")
    (story,) = read_stories(file)
    assert play(story, setting).mismatch is None


def test_a_line_of_a_story_is_one_line() -> None:
    setting = parrot()
    turns = [
        Trial.of(turn, setting, "U> a\u2028b") for turn in setting.game.play(["a"])
    ]
    with pytest.raises(StoryError, match="has a line break in it"):
        format_story("two lines", turns, setting)
