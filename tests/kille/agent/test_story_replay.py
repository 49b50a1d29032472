"""Playing stories: what counts as a difference, and lines that cannot be played."""

from __future__ import annotations

from pathlib import Path

import pytest

from kille.agent.story_replay import play
from kille.memory import Memory
from ttr.dialogues.stories import Mismatch, StoryError, read_stories


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "story.dlg"


def played(file: Path, text: str) -> Mismatch | None:
    """The difference, if any, after playing the first story of this text."""
    file.write_text(text)
    return play(read_stories(file)[0])


def differs(file: Path, text: str) -> tuple[int, str, str]:
    """Line, expectation and finding of the difference that there is."""
    mismatch = played(file, text)
    assert mismatch is not None
    return mismatch.line.number, mismatch.expected, mismatch.found


@pytest.mark.parametrize(
    "text",
    [
        "U> Hello.\nS> Hello.\n",
        "U> Hello.\nS~ H.l+o\\.\n",
        "U> Hello.\nS> Hello.\nU> Goodbye.\nS> Goodbye.\n",
        "@ show cup\nS>\n",
        "@ show cup\nU> This is a cup.\nS> OK, I learned a cup.\n",
        "@ scene synthetic:desk\nU> Hello.\nS> Hello.\n@ scene synthetic:empty\n"
        "U> What is this?\nS> I see nothing on the table.\n",
        "U> Hello.\nS> Hello.\n= s : [shared : [latest : GreetBack]]\n",
    ],
)
def test_stories_that_are_as_written(file: Path, text: str) -> None:
    assert played(file, text) is None


def test_another_sentence(file: Path) -> None:
    text = "U> Hello.\nS> Good day.\n"
    assert differs(file, text) == (2, "Good day.", "Hello.")


def test_another_pattern(file: Path) -> None:
    assert differs(file, "U> Hello.\nS~ Hell\n") == (2, "Hell", "Hello.")


def test_silence_where_words_are_written(file: Path) -> None:
    assert differs(file, "@ show cup\nS> Oh!\n") == (2, "Oh!", "silence")


def test_words_where_silence_is_written(file: Path) -> None:
    assert differs(file, "U> Hello.\nS>\n") == (2, "silence", "Hello.")


@pytest.mark.parametrize("next_line", ["U> Hello.", "@ show cup", ""])
def test_words_that_are_not_written(file: Path, next_line: str) -> None:
    number, expected, found = differs(file, f"U> Hello.\n{next_line}\n")
    assert number == (2 if next_line else 1)
    assert expected == "nothing more to be said before this"
    assert found == "Hello."


def test_a_judgement_that_does_not_hold_says_what_failed(file: Path) -> None:
    text = "U> Hello.\nS> Hello.\n= s : [shared : [latest : Learned]]\n"
    number, expected, found = differs(file, text)
    assert number == 3
    assert "learned(spkr, addr)" in expected
    assert "shared.latest.e" in found


WRONG = {
    "S~ (": "is no regular expression",
    "= s : [": "story.dlg:2",
    "= s : Nonesuch": "Nonesuch",
    "= [shared : Rec]": "= s : T",
    "= r : State": "= s : T",
    "= s : tutor": "is no type of states",
    "@ fly": "unknown command",
    "@ show unicorn": "unicorn",
    "@ scene nowhere": "nowhere",
    "@ point 3": "no thing #3",
    "U> #3 This is a cup.": "no thing #3",
    "@ wait for me": "waiting takes some seconds",
    "@ wait": "waiting takes some seconds",
    "@ meanwhile": "unknown command",
    "@ time soon": "seconds since the beginning",
    "@ time 2026-01-01": "a date stands before anything else",
    "@ time 1e9": "seconds since the beginning",
    "@ time 99999999999999999999": "no dialogue goes on for so long",
    "U~ Hello. 0.6 | Goodbye.": "ends with its probability",
    "U~ Hello. 0.6 | Goodbye. 0.9": "come to at most 1, found 1.5",
}


@pytest.mark.parametrize(("line", "told"), WRONG.items())
def test_a_line_that_cannot_be_played(file: Path, line: str, told: str) -> None:
    first = "U> Hello.\n" + ("" if line[0] in "S=" else "S> Hello.\n")
    with pytest.raises(StoryError) as caught:
        played(file, f"{first}{line}\n")
    place = f"{file}:{1 + first.count(chr(10))}: "
    assert str(caught.value).startswith(place)
    assert told in str(caught.value)


@pytest.mark.parametrize("sensor", ["synthetic:attic", "nowhere", ""])
def test_a_first_scene_that_cannot_be_opened(file: Path, sensor: str) -> None:
    with pytest.raises(StoryError) as caught:
        played(file, f"--- one\n@ scene {sensor}\nU> Hello.\n")
    assert str(caught.value).startswith(f"{file}:2: ")


def test_time_goes_on_as_the_story_says(file: Path) -> None:
    text = (
        "@ show cup\nU> This is a cup.\nS> OK, I learned a cup.\n@ time 600\n"
        "U> What is this?\nS> This is a cup.\nU> Why?\nS~ .* 10 minutes ago .*\n"
    )
    assert played(file, text) is None


def test_time_does_not_go_back(file: Path) -> None:
    with pytest.raises(StoryError, match="2: time only goes on"):
        played(file, "@ time 5\n@ time 4.9\n")


def test_a_story_says_how_it_begins(file: Path) -> None:
    opening = "@ strategy driven four\n@ sensor synthetic:empty\n@ time 2017-05-22\n"
    chosen = (
        '[private : [strategy : [mode = "driven" : Text, wording = "four" : Text]]]'
    )
    assert played(file, f"{opening}= s : {chosen}\nU> Hello.\nS> Hello.\n") is None


@pytest.mark.parametrize(
    ("opening", "told"),
    [
        ("@ strategy lazy", "no strategy 'lazy': choose of driven, "),
        ("@ time never", "a date at the beginning"),
        ("@ memory none.db", "does not exist"),
        ("@ sensor nowhere", "nowhere"),
    ],
)
def test_a_beginning_that_cannot_be(file: Path, opening: str, told: str) -> None:
    with pytest.raises(StoryError, match=f"1: .*{told}"):
        played(file, f"{opening}\nU> Hello.\nS> Hello.\n")


def test_a_restart_knows_what_it_knew_and_forgets_what_was_said(file: Path) -> None:
    text = (
        "@ show cup\nU> This is a cup.\nS> OK, I learned a cup.\n@ restart\n"
        "= s : [shared : [latest = {} : Rec]]\n"
        "U> What is this?\nS> This is a cup.\n"
    )
    assert played(file, text) is None


def test_a_path_is_from_the_folder_of_the_story_and_may_hold_variables(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("KILLE_SCENE", "synthetic:empty")
    text = "@ scene $KILLE_SCENE\nU> What is this?\nS> I see nothing on the table.\n"
    assert played(file, text) is None
    (file.parent / "pictures").mkdir()
    with pytest.raises(StoryError, match="the folder is empty"):
        played(file, "@ scene pictures\n")


def test_a_variable_that_is_not_set_is_named(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("KILLE_SCENE", raising=False)
    with pytest.raises(StoryError, match=r"story\.dlg:1: .*KILLE_SCENE"):
        played(file, "@ scene ${KILLE_SCENE}/0001\n")


def test_lines_are_told_as_they_are_played(file: Path) -> None:
    file.write_text("@ show cup\nU> Hello.\nS~ Hel.*\n")
    told: list[str] = []
    assert play(read_stories(file)[0], echo=told.append) is None
    assert told == ["@ show cup", "U> Hello.", "S> Hello."]


def test_a_story_may_go_on_with_an_earlier_memory(file: Path, tmp_path: Path) -> None:
    file.write_text(
        "--- one\n@ show cup\nU> This is a cup.\nS> OK, I learned a cup.\n"
        "--- two\n@ show cup\nU> What is this?\nS> This is a cup.\n"
    )
    for story in read_stories(file):
        assert play(story, Memory.open(tmp_path / "m.db")) is None


def test_a_story_of_a_game_is_not_for_the_robot(file: Path) -> None:
    with pytest.raises(StoryError, match=r"story\.dlg:1: .*`ttr play`"):
        played(file, "@ game door.ttr door\nU> Greet\n")


def test_a_difference_comes_with_the_rules_of_its_turn(file: Path) -> None:
    mismatch = played(file, "U> Hello.\nS> Good day.\n")
    assert mismatch is not None
    assert [step.rule.name for step in mismatch.trace][:1] == ["hear"]
