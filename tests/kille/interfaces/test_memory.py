"""`kille memory`: what was taught is listed, shown, forgotten and moved."""

from __future__ import annotations

import io
import json
import os
import pty
import re
import sqlite3
import subprocess
from contextlib import closing
from pathlib import Path

import cv2
import numpy as np
import pytest

from kille.agent.agent import Agent
from kille.interfaces.memory.half_blocks import half_blocks
from kille.memory import Arrangement, Memory, Picture, Scan, Sighting, Turn, Word
from kille.perception.thumbnails import evidence_of
from kille.scene import Box, Configuration, Frame, Intrinsics, Point, Region

from .conftest import COMMAND, Run

BOX = Box(200, 100, 260, 140)


def frame_and_thing() -> tuple[Frame, Region]:
    """A red thing on grey."""
    colour = np.full((480, 640, 3), 128, np.uint8)
    mask = np.zeros((480, 640), np.bool_)
    mask[BOX.top : BOX.bottom, BOX.left : BOX.right] = True
    colour[mask] = 220, 20, 20
    depth = np.full((480, 640), 0.9, np.float32)
    frame = Frame(colour, depth, Intrinsics(525, 525, 320, 240), 0.0, {})
    return frame, Region(mask, BOX, Point(-0.1, 0.2, 0.9))


@pytest.fixture
def taught(memory: Path) -> Path:
    """A memory of two cups, a box without a picture, and where a cup is."""
    frame, thing = frame_and_thing()
    scan = Scan(np.zeros((7, 128), np.uint8), np.zeros((7, 3), np.float32))
    size = np.log(np.array([0.21, 0.11, 0.06], np.float32))
    cup = Sighting(
        "synthetic",
        0.0,
        (scan,),
        thing.place,
        {"size": size},
        evidence_of(frame, thing),
    )
    stand = Configuration((-0.1, 0.25, 0.0))
    left = Arrangement(
        "synthetic", 1.0, "cup", "can_of_paint", stand, evidence_of(frame, thing, thing)
    )
    with Memory.open(memory) as it:
        it.begin_dialogue("2026-01-31T12:00:00+00:00")

        def said(number: int, text: str) -> Turn:
            time = f"2026-01-31T12:0{number}:00+00:00"
            return Turn(1, number, "tutor", text, "s : Naming", time)

        it.learn_object(said(1, "This is a cup."), "cup", "cup", cup)
        it.learn_object(said(2, "This is a [cup]."), "cup", "cup", cup)
        paint = Sighting("photo", 0.0, (), None)
        said_of_paint = said(3, "This is a can of paint.")
        it.learn_object(said_of_paint, "can_of_paint", "can of paint", paint)
        there = said(4, "The cup is left of the can of paint.")
        it.learn_relation(there, "left_of", "left of", left)
    return memory


# --- show ----------------------------------------------------------------------------


def test_a_word_is_shown_by_its_lessons(kille: Run, taught: Path) -> None:
    outcome = kille("memory", "show", "cup")
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out.splitlines() == [
        "cup (a thing), lesson 1",
        "  tutor, 2026-01-31 12:01: This is a cup.",
        "  dialogue 1, turn 1, seen through synthetic, by 7 features, 0.93 m from the "
        "camera",
        "  20 x 10 x 5 cm",
        "",
        "cup (a thing), lesson 2",
        "  tutor, 2026-01-31 12:02: This is a [cup].",
        "  dialogue 1, turn 2, seen through synthetic, by 7 features, 0.93 m from the "
        "camera",
        "  20 x 10 x 5 cm",
    ]


@pytest.mark.parametrize("named", [("can", "of", "paint"), ("can_of_paint",), ("3",)])
def test_a_word_of_several_words_or_a_number_will_do(
    kille: Run, taught: Path, named: tuple[str, ...]
) -> None:
    out = kille("memory", "show", *named).out
    assert out.startswith("can of paint (a thing), lesson 3\n")
    assert "no picture was kept" in out


def test_words_are_counted_as_the_robot_counts_them(kille: Run, memory: Path) -> None:
    with Agent("synthetic:empty?seed=43", memory, scans=2) as robot:
        robot.do("show cup")
        for text in ("This is a cup.", "This is a cup.", "This is not a mug."):
            robot.hear(text)
        robot.hear("This is striped.")
        robot.do("show mug")
        robot.hear("This is not a cup.")
        said = robot.hear("What do you know?")
    assert "cup (2 lessons)" in said
    assert "striped (one lesson)" in said
    assert "mug" not in said
    listed = json.loads(kille("memory", "list", "--json").out)
    told = {it["word"]: (it["lessons"], it["denied"]) for it in listed}
    assert told == {"cup": (2, 1), "mug": (0, 1), "striped": (1, 0)}


def test_what_does_not_hold_has_a_column_of_its_own(kille: Run, taught: Path) -> None:
    assert "  denied  " not in kille("memory", "list").out
    seen = Sighting("synthetic", 0.0, (), None)
    with Memory.open(taught) as it:
        dialogue = it.begin_dialogue("2026-02-01T12:00:00+00:00")
        turn = Turn(dialogue, 1, "tutor", "Not a cup.", "", "2026-02-01T12:00")
        it.learn_object(turn, "cup", "cup", seen, holds=False)
    listed = kille("memory", "list").out
    assert re.search(r"word +kind +lessons +denied +last taught", listed)
    assert re.search(r"cup +object +2 +1 ", listed)


def test_a_kind_of_a_kind_is_listed_and_shown(kille: Run, taught: Path) -> None:
    cup, vessel = (Word(it, it, "object", "a") for it in ("cup", "vessel"))
    with Memory.open(taught) as memory:
        dialogue = memory.begin_dialogue("2026-02-01T12:00:00+00:00")
        turn = Turn(dialogue, 1, "tutor", "Cups are vessels.", "", "2026-02-01T12:00")
        key = memory.learn_kind(turn, cup, vessel)
    listed = kille("memory", "list").out
    assert re.search(r"cup +subkind +1 ", listed)
    shown = kille("memory", "show", str(key)).out
    assert f"cup (a kind of thing), lesson {key}" in shown
    assert "a kind of vessel" in shown
    facts = kille("memory", "show", str(key), "--json").out
    assert json.loads(facts)[0]["kind_of"] == "vessel"


def test_by_what_things_are_known_is_listed_and_shown(kille: Run, taught: Path) -> None:
    cup = Word("cup", "cup", "object", "a")
    with Memory.open(taught) as memory:
        dialogue = memory.begin_dialogue("2026-02-01T12:00:00+00:00")
        turn = Turn(dialogue, 1, "tutor", "Cups are white.", "", "2026-02-01T12:00")
        white = Word("is_white", "white", "attribute")
        key = memory.learn_criterion(turn, cup, "quality", white, 0.9)
        colour = Word("colour", "colour", "attribute")
        other = memory.learn_criterion(turn, cup, "cue", colour, 0.0)
    assert re.search(r"cup +criterion +2 ", kille("memory", "list").out)
    shown = kille("memory", "show", str(key)).out
    assert f"cup (by what a kind of thing is known), lesson {key}" in shown
    assert "white with a degree of 0.9" in shown
    assert "the colour does not matter" in kille("memory", "show", str(other)).out
    [facts] = json.loads(kille("memory", "show", str(key), "--json").out)
    assert (facts["by"], facts["criterion"], facts["degree"]) == (
        "quality",
        "white",
        0.9,
    )


def test_a_relation_is_shown_by_where_things_were(kille: Run, taught: Path) -> None:
    out = kille("memory", "show", "#4").out
    assert out.startswith("left of (where a thing is), lesson 4\n")
    assert "cup from can of paint: 10 cm left, 25 cm farther" in out


def test_pictures_are_written_where_one_wants_them(
    kille: Run, taught: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "new" / "pictures"
    out = kille("memory", "show", "cup", "--out", str(folder)).out
    names = {it.name for it in folder.iterdir()}
    kinds = ("frame.jpg", "crop.jpg", "mask.png", "depth.png")
    assert names == {f"{n}-cup-{kind}" for n in (1, 2) for kind in kinds}
    assert all(str(folder / name) in out for name in names)
    assert cv2.imread(str(folder / "1-cup-frame.jpg")).shape == (120, 160, 3)
    crop = cv2.imread(str(folder / "1-cup-crop.jpg"))
    mask = cv2.imread(str(folder / "1-cup-mask.png"), cv2.IMREAD_GRAYSCALE)
    assert crop[mask > 0].mean(axis=0) == pytest.approx((20, 20, 220), abs=8)
    (fact,) = json.loads(
        kille("memory", "show", "1", "--json", "--out", str(folder)).out
    )
    assert set(fact["pictures"]) == {"frame", "crop", "mask", "depth"}


def test_facts_for_machines(kille: Run, taught: Path) -> None:
    (cup,) = json.loads(kille("memory", "show", "1", "--json").out)
    assert cup["metres"] == pytest.approx([0.2, 0.1, 0.05], abs=1e-6)
    assert (cup["word"], cup["turn"]["text"]) == ("cup", "This is a cup.")
    (left,) = json.loads(kille("memory", "show", "left of", "--json").out)
    assert (left["target"], left["landmark"]) == ("cup", "can_of_paint")
    assert left["configuration"] == {"offset": [-0.1, 0.25, 0.0]}


def on_a_terminal(*words: str, typed: bytes = b"", **settings: str) -> tuple[int, str]:
    """The exit code of a program, and what its terminal shows."""
    ours, theirs = pty.openpty()
    environment = os.environ | {"TERM": "xterm-256color", "COLORTERM": "truecolor"}
    with subprocess.Popen(
        [*COMMAND, *words],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        env=environment | settings,
    ) as child:
        os.close(theirs)
        os.write(ours, typed)
        shown = b""
        while piece := _read(ours):
            shown += piece
    os.close(ours)
    return child.returncode, shown.decode()


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 65536)
    except OSError:  # as Linux tells that nobody writes to it any more
        return b""


def test_a_terminal_shows_a_picture(taught: Path) -> None:
    code, shown = on_a_terminal("memory", "show", "1")
    assert code == 0
    assert "▀" in shown
    assert "48;2;2" in shown  # a red background
    _, plain = on_a_terminal("memory", "show", "1", NO_COLOR="1")
    assert "▀" not in plain
    _, plain = on_a_terminal("memory", "show", "1", PYTHONIOENCODING="ascii")
    assert "▀" not in plain


@pytest.mark.parametrize("size", [(1, 1), (1, 900), (900, 1), (3, 5), (480, 640)])
def test_a_picture_of_any_size_fits(size: tuple[int, int]) -> None:
    text = half_blocks(np.full((*size, 3), 200, np.uint8), 40, 12)
    lines = text.plain.split("\n")
    assert 1 <= len(lines) <= 12
    assert {len(line) for line in lines} <= set(range(1, 41))
    assert {str(span.style) for span in text.spans} == {"#c8c8c8 on #c8c8c8"}


def test_a_word_nobody_taught(kille: Run, taught: Path) -> None:
    for action in (("show",), ("forget", "--yes")):
        for word, told in (("cupp", "did you mean cup?"), ("xyz", "list tells all")):
            outcome = kille("memory", *action, word)
            assert (outcome.code, outcome.out) == (2, "")
            assert told in outcome.complaint
        assert "there is no lesson 9" in kille("memory", *action, "9").complaint


def test_what_another_program_made_up_spoils_no_terminal(memory: Path) -> None:
    junk = b"\xff\xd8\xff junk"
    with Memory.open(memory) as it:
        said = Turn(it.begin_dialogue("now"), 1, "tutor", "\x1b[41mcup\n", "", "now")
        seen = Sighting("\x1b]0;", 0.0, (), None, picture=Picture(junk, ()))
        it.learn_object(said, "cup", "[cup]", seen)
    code, shown = on_a_terminal("memory", "show", "cup")
    assert code == 0
    assert "cannot be decoded" in shown
    _, listed = on_a_terminal("memory", "list")
    _, gone = on_a_terminal("memory", "forget", "cup", "--yes")
    assert "[cup]" in listed
    shown += listed + gone
    assert not any(code in shown for code in ("\x1b[41m", "\x1b]0"))


def test_a_folder_that_cannot_be_made(kille: Run, taught: Path, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    outcome = kille("memory", "show", "1", "--out", str(tmp_path / "file" / "x"))
    assert outcome.code == 2
    assert "cannot be written" in outcome.complaint


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk_is_not_laid_to_the_pictures(taught: Path, tmp_path: Path) -> None:
    words = ["memory", "show", "cup", "--out", str(tmp_path / "pictures")]
    for shown in (words, words[:3]):
        with Path("/dev/full").open("wb") as full:
            done = subprocess.run(
                [*COMMAND, *shown], stdout=full, stderr=subprocess.PIPE, check=False
            )
        told = b"kille: the output cannot be written: no space left on device\n"
        assert (done.returncode, done.stderr) == (1, told)


# --- forget --------------------------------------------------------------------------


def words(kille: Run) -> list[str]:
    return [it["word"] for it in json.loads(kille("memory", "list", "--json").out)]


def test_a_word_is_forgotten_with_all_its_lessons(kille: Run, taught: Path) -> None:
    outcome = kille("memory", "forget", "cup", "--yes")
    assert outcome.code == 0
    first, second, third = outcome.out.splitlines()
    assert first == (
        "Forgotten: cup (a thing), lesson 1; tutor, 2026-01-31 12:01: This is a cup."
    )
    assert second.startswith("Forgotten: cup (a thing), lesson 2;")
    assert third == "The word cup is gone."
    assert words(kille) == ["can of paint", "left of"]


def test_a_lesson_is_forgotten_and_the_word_stays(kille: Run, taught: Path) -> None:
    facts = json.loads(kille("memory", "forget", "1", "--yes", "--json").out)
    lesson = {"lesson": 1, "word": "cup", "kind": "object"}
    assert facts == {"forgotten": [lesson], "words_gone": []}
    assert "cup" in words(kille)
    facts = json.loads(kille("memory", "forget", "2", "--yes", "--json").out)
    assert facts["words_gone"] == ["cup"]


def test_the_last_lesson(kille: Run, taught: Path) -> None:
    assert (
        "left of (where a thing is), lesson 4"
        in kille("memory", "forget", "--last", "--yes").out
    )
    assert (
        "paint (a thing), lesson 3" in kille("memory", "forget", "--last", "--yes").out
    )
    kille("memory", "forget", "cup", "--yes")
    assert "no lessons" in kille("memory", "forget", "--last", "--yes").complaint


def test_nobody_forgets_by_accident(kille: Run, taught: Path) -> None:
    outcome = kille("memory", "forget", "cup", typed="y\n")
    assert outcome.code == 2
    assert "add --yes" in outcome.complaint
    for wrong in ((), ("cup", "--last")):
        assert "one of them" in kille("memory", "forget", *wrong).complaint
    code, shown = on_a_terminal("memory", "forget", "cup", typed=b"\n")
    assert code == 1
    assert "Forget these 2 lessons for good? [y/N]" in shown
    assert "Nothing was forgotten." in shown
    assert "cup" in words(kille)
    code, shown = on_a_terminal("memory", "forget", "1", typed=b"yes\n")
    assert code == 0
    assert "Forget this lesson" in shown
    assert "Forgotten: cup (a thing), lesson 1" in shown


def test_forgetting_while_the_robot_talks(kille: Run, taught: Path) -> None:
    with Memory.open(taught):
        outcome = kille("memory", "forget", "cup", "--yes")
        assert outcome.code == 2
        assert "is in use by another program" in outcome.complaint
        assert kille("memory", "show", "cup").code == 0
        assert kille("memory", "export", str(taught.with_name("a.zip"))).code == 0
    assert "cup" in words(kille)


def test_forgetting_makes_no_memory(kille: Run, memory: Path) -> None:
    assert "does not exist" in kille("memory", "forget", "cup", "--yes").complaint
    assert not memory.exists()


# --- export and import ---------------------------------------------------------------


@pytest.mark.parametrize("name", ["moved.zip", "moved"])
def test_a_memory_is_moved(kille: Run, taught: Path, tmp_path: Path, name: str) -> None:
    package, new = str(tmp_path / name), str(tmp_path / "new.db")
    out = kille("memory", "export", package).out
    assert out == f"{package} holds {taught}: 1 dialogue, 4 turns, 4 lessons\n"
    out = kille("memory", "import", package, "--memory", new).out
    assert out.startswith(f"{new} learned from {package}: 1 dialogue, 4 turns, 4 less")
    again = kille("memory", "import", package, "--memory", new, "--json").out
    counts = {"dialogues": 0, "turns": 0, "lessons": 0, "lessons_known": 4}
    assert json.loads(again) == counts
    shown = kille("memory", "show", "cup", "--memory", new).out
    assert shown == kille("memory", "show", "cup").out


def test_a_damaged_export_changes_nothing(
    kille: Run, taught: Path, tmp_path: Path
) -> None:
    package, new = tmp_path / "moved.zip", tmp_path / "new.db"
    kille("memory", "export", str(package))
    package.write_bytes(package.read_bytes()[:-1000])
    for target in (new, taught):
        outcome = kille("memory", "import", str(package), "--memory", str(target))
        assert outcome.code == 2
        assert "nothing was changed" in outcome.complaint
    assert not new.exists()
    assert len(json.loads(kille("memory", "show", "cup", "--json").out)) == 2


def test_what_is_there_is_not_overwritten(
    kille: Run, taught: Path, tmp_path: Path
) -> None:
    diary = tmp_path / "diary.zip"
    diary.write_text("Dear diary")
    outcome = kille("memory", "export", str(diary))
    assert outcome.code == 2
    assert "left alone" in outcome.complaint
    assert "left alone" in kille("memory", "export", str(taught)).complaint
    assert diary.read_text() == "Dear diary"
    assert "cannot be read" in kille("memory", "import", "nowhere.zip").complaint


def test_a_narrow_terminal(taught: Path) -> None:
    _, shown = on_a_terminal("memory", "show", "1", COLUMNS="40", NO_COLOR="1")
    assert max(map(len, io.StringIO(shown).read().splitlines())) <= 40


# --- check ---------------------------------------------------------------------------

FORGETFUL = """
    CREATE TRIGGER forgetful AFTER INSERT ON lessons BEGIN DELETE FROM lessons; END
"""


def make_forgetful(path: Path) -> None:
    with closing(sqlite3.connect(path)) as connection:
        connection.execute(FORGETFUL)


def test_a_sound_memory_is_said_to_be_sound(kille: Run, taught: Path) -> None:
    for named in ((), (str(taught),), ("--memory", str(taught))):
        outcome = kille("memory", "check", *named)
        assert (outcome.code, outcome.err) == (0, "")
        assert outcome.out == f"{taught} is sound: 1 dialogue, 4 turns, 4 lessons\n"


def test_what_is_wrong_is_said_and_the_rest_saved(
    kille: Run, taught: Path, tmp_path: Path
) -> None:
    make_forgetful(taught)
    before = taught.read_bytes()
    for words in (("talk", "--sensor", "synthetic:empty"), ("memory", "list")):
        outcome = kille(*words, "--memory", str(taught), typed="Hello.\n")
        assert outcome.code == 2
        assert "a trigger that kille never makes, forgetful" in outcome.complaint
        assert f"kille memory check {taught}" in outcome.complaint
    outcome = kille("memory", "check")
    assert outcome.code == 1
    assert outcome.out.splitlines() == [
        f"{taught} has 1 fault:",
        "  it has a trigger that kille never makes, forgetful",
        f"kille memory check {taught} --salvage NEW.db makes a new memory of what can "
        "be read.",
    ]
    new = tmp_path / "new.db"
    outcome = kille("memory", "check", "--salvage", str(new))
    assert outcome.code == 1
    saved = f"{new} holds what could be saved: 1 dialogue, 4 turns, 4 lessons"
    assert outcome.out.splitlines()[-1] == saved
    assert kille("memory", "check", str(new)).code == 0
    assert taught.read_bytes() == before


def test_what_is_wrong_is_said_to_machines(
    kille: Run, taught: Path, tmp_path: Path
) -> None:
    facts = json.loads(kille("memory", "check", "--json").out)
    assert (facts["sound"], facts["faults"], facts["holds"]["lessons"]) == (True, [], 4)
    with closing(sqlite3.connect(taught)) as connection:
        connection.execute("DELETE FROM sightings WHERE lesson = 3")
        connection.commit()
    new = tmp_path / "new.db"
    outcome = kille("memory", "check", "--json", "--salvage", str(new))
    facts = json.loads(outcome.out)
    assert outcome.code == 1
    assert facts["faults"] == ["it has lessons without what was seen in them"]
    assert facts["salvaged"]["lessons"] == 3
    assert facts["losses"] == [
        "lesson 3 (can_of_paint): nothing is left of what was seen"
    ]


def test_a_memory_whose_beginning_is_lost_can_be_saved(
    kille: Run, taught: Path, tmp_path: Path
) -> None:
    with taught.open("r+b") as file:
        file.write(b"\xff" * 4096)
    assert "--salvage NEW may save the rest" in kille("memory", "check").complaint
    outcome = kille("memory", "check", "--salvage", str(tmp_path / "new.db"))
    assert outcome.code == 1
    assert "it is not a kille memory" in outcome.out
    assert "1 dialogue, 4 turns, 4 lessons" in outcome.out


@pytest.mark.parametrize("salvaging", [(), ("--salvage", "new.db")])
def test_what_is_no_memory_is_one_line(
    kille: Run,
    tmp_path: Path,
    salvaging: tuple[str, ...],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("diary.txt").write_text("dear diary\n" * 999)
    for name in ("diary.txt", "missing.db", "."):
        outcome = kille("memory", "check", name, *salvaging)
        assert (outcome.code, outcome.out) == (2, "")
        assert outcome.complaint.startswith("kille: ")
    assert not Path("new.db").exists()


def test_a_file_is_named_once(kille: Run, taught: Path) -> None:
    outcome = kille("memory", "check", "a.db", "--memory", "b.db")
    assert outcome.code == 2
    assert "one of them" in outcome.err
