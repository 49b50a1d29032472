"""Dialogue files: what is a story, and what is said of a file that has none."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from kille.stories import Line, Mismatch, StoryError, read_stories


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "story.dlg"


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
    assert "is not there" in error_of(tmp_path / "nowhere.dlg")
    assert "is a folder" in error_of(tmp_path)
    latin = tmp_path / "latin.dlg"
    latin.write_bytes("U> Grüße".encode("latin-1"))
    assert "UTF-8" in error_of(latin)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_a_file_that_may_not_be_read(file: Path) -> None:
    file.write_text("U> Hello.\n")
    file.chmod(0)
    assert "Permission denied" in error_of(file)


def test_a_mismatch_says_where_what_and_what_instead() -> None:
    line = Line("a.dlg", 7, "S>", "Hello.")
    told = str(Mismatch(line, "Hello.", "silence"))
    assert told.splitlines()[0] == "a.dlg:7"
    assert "expected: Hello." in told
    assert "found: silence" in told
