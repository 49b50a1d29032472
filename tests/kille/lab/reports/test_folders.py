"""Reports of folders of results, by what their logs hold."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

import little_study
from kille.lab import reports
from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.errors import StudyError
from kille.lab.log import Log, RunError
from kille.lab.log.outcomes import play_to_outcome
from kille.lab.results import Estimate, Result, Table
from kille.lab.study import Run, Study
from kille.lab.study_files import parse

STUDY = """
title = "Numbers & <guesses>"
about = "Who guesses better?"
seeds = {seeds}

[theories.good]
[theories.{other}]
mode = "driven"

[tutors.Ann]
kind = "simulated"

[scenes.table]
kind = "drawn"

[[phases]]
do = "teach"
"""

pytestmark = pytest.mark.usefixtures("undrawn")


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """As it is where matplotlib is not installed, which is quicker, too."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)


def ran(
    folder: Path, seeds: str = "4", other: str = "other", text: str = STUDY
) -> Path:
    """A folder of results; of a theory called bad one dialogue breaks."""
    study = parse(text.format(seeds=seeds, other=other), Path("numbers.toml"))
    with Log.open(study, folder) as log:
        for run in study.runs():
            log.write(play_to_outcome(study, run, little_study.play))
    return folder


def table(results: Sequence[Result], title: str) -> Table:
    (found,) = (it for one in results for it in one.tables if it.title == title)
    return found


def test_a_folder_has_its_report(tmp_path: Path) -> None:
    folder = ran(tmp_path / "results")
    (folder / "answers.csv").write_text("")
    page, results = reports.report(folder, command="kille experiment report results")
    text = page.read_text("utf-8")
    assert page.parent == folder
    for told in (
        "<h1>Numbers &amp; &lt;guesses&gt;</h1>",
        "Who guesses better?",
        "<dd>1 to 4</dd>",
        "<dt>to repeat it</dt><dd>kille experiment run numbers.toml</dd>",
        'href="answers.csv"',
        "mode",
        "driven",
    ):
        assert told in text
    assert table(results, "All measures").rows[0] == ("dialogues", 4, 4)


def test_what_broke_is_told_and_the_rest_is_there(tmp_path: Path) -> None:
    page, results = reports.report(ran(tmp_path / "results", other="bad"))
    text = page.read_text("utf-8")
    assert re.search(
        r"1 dialogue broke: ValueError: nobody likes .*: bad/Ann/table/2", text
    )
    assert table(results, "All measures").rows[0] == ("dialogues", 4, 3)
    assert "7 of 8 played to their end" in text
    assert "7 of 8 dialogues: 2 theories × 1 tutor × 1 scene × 4 seeds" in text


def test_theories_are_shown_though_all_their_dialogues_broke(tmp_path: Path) -> None:
    folder, study = tmp_path / "results", STUDY.replace("[theories.good]", "")
    found = parse(study.format(seeds="[2]", other="bad"), Path("numbers.toml"))
    with Log.open(found, folder) as log:
        for run in found.runs():
            log.write(play_to_outcome(found, run, little_study.play))
    page, results = reports.report(folder)
    assert not results
    assert "No dialogue was played to its end." in page.read_text("utf-8")
    assert "strategy" in page.read_text("utf-8")


def test_dialogues_that_were_cut_short_are_told(tmp_path: Path) -> None:
    """All dialogues are of four turns."""
    for turns, is_told in (("4", True), ("5", False)):
        folder = ran(tmp_path / turns, f"3\nturns = {turns}")
        page, results = reports.report(folder)
        told = "good: 3 of 3 dialogues came to turn 4, the last that the study allows: "
        assert (told in page.read_text("utf-8")) == is_told
        assert results[0].text.startswith(told) == is_told
        assert ("if there was anything still to be asked" in results[0].text) == is_told


def test_two_folders_are_compared_by_what_they_share(tmp_path: Path) -> None:
    """The first has seeds 1 to 4, the second 3 to 6; theories are those of one name."""
    one, other = ran(tmp_path / "one"), ran(tmp_path / "two", seeds="[3, 4, 5, 6]")
    results = reports.compare_results(one, other)
    assert table(results, "All measures").columns == (
        "",
        *(f"{it}: {name}" for it in ("one", "two") for name in ("good", "other")),
    )
    (differing,) = (it for it in results if it.title == "How they differ")
    assert "two: good and one: good do equally well" in differing.text
    assert " 2 pairs could not show a difference: that takes 6, " in differing.text
    assert [it.title for it in differing.tables] == ["Question by question"]
    assert "permutation test" not in differing.tables[0].note
    assert results[0].text == (
        "Of 4 and 4 occasions (tutor, scene and seed) 2 are the same: differences are "
        "of these alone, all else is of all."
    )
    page, _ = reports.compare(one, other, tmp_path / "both.html", command="compare")
    assert "two against one" in page.read_text("utf-8")
    assert (tmp_path / "both-dialogues" / "dialogue-1.html").is_file()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            '"simulated"',
            '"simulated"\nerrors = 0.1',
            "The tutor Ann is not the same in",
        ),
        (
            '"drawn"',
            '"drawn"\nnoise = 0.2\neach = 3',
            "The scene table is not the same",
        ),
        ('"drawn"', '"around"', "both (kind): "),
        ('"drawn"', '"drawn"\nnoise = 0.2\neach = 3', "both (noise, each): "),
        ('do = "teach"', 'do = "teach"\nrounds = 2', "The phases are not the same in"),
    ],
)
def test_what_is_called_the_same_and_is_not_is_told(
    tmp_path: Path, old: str, new: str, told: str
) -> None:
    """Else a difference would be held for one of the theories."""
    one = ran(tmp_path / "one")
    other = ran(tmp_path / "two", text=STUDY.replace(old, new))
    [warning] = reports.compare_results(one, other)[0].text.splitlines()
    assert told in warning
    assert warning.endswith("differences may come of that as well.")


def test_other_theories_are_all_compared(tmp_path: Path) -> None:
    one = ran(tmp_path / "one")
    other = ran(tmp_path / "two", other="third")
    found = table(reports.compare_results(one, other), "Question by question")
    assert [(row[0], row[2]) for row in found.rows] == [("one: good", "two: good")]
    assert not reports.compare_results(one, other)[0].text


def test_folders_of_one_name_are_told_apart_by_where_they_are(tmp_path: Path) -> None:
    one, other = ran(tmp_path / "a" / "same"), ran(tmp_path / "b" / "same")
    columns = table(reports.compare_results(one, other), "All measures").columns
    assert columns[1] == f"{one}: good"


@pytest.mark.parametrize("seeds", ["[7, 8]"])
def test_what_shares_nothing_is_not_compared(tmp_path: Path, seeds: str) -> None:
    one, other = ran(tmp_path / "one"), ran(tmp_path / "two", seeds=seeds)
    with pytest.raises(StudyError, match="no dialogues with the same tutor, scene"):
        reports.compare_results(one, other)


def test_a_folder_is_not_compared_with_itself(tmp_path: Path) -> None:
    one = ran(tmp_path / "one")
    with pytest.raises(StudyError, match="are one folder: name two"):
        reports.compare_results(one, one)


def test_where_there_is_no_log_there_is_no_report(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"there is no log\.db"):
        reports.report(tmp_path)


def test_numbers_are_the_same_each_time(tmp_path: Path) -> None:
    first, second = (
        reports.report(ran(tmp_path / name)).results for name in ("one", "two")
    )

    def numbers(results: Sequence[Result]) -> list[object]:
        return [
            row
            for row in table(results, "All measures").rows
            if row[0] != "seconds" and any(isinstance(it, Estimate) for it in row)
        ]

    assert repr(numbers(first)) == repr(numbers(second))
    assert len(numbers(first)) > 5


@pytest.mark.parametrize(
    ("said", "degree", "is_told"),
    [
        ("This is blue.", 0.0, True),
        ("This is green.", 0.0, False),
        ("This is blue.", 0.2, False),
    ],
)
def test_questions_about_words_that_nobody_had_said_are_told(
    tmp_path: Path, said: str, degree: float, is_told: bool
) -> None:
    """What the robot gives no degree, and no tutor has said, cannot be answered."""

    def play(study: Study, run: Run) -> Played:
        seen = Turn(1, "lessons", "Ann", "shows", "look16: green cup", "")
        lesson = Turn(2, "lessons", "Ann", "describe", said, "OK.", 3)
        degrees = {"green": degree, "blue": 0.5}
        answer = Answer(3, "test", "adjective", "green", "blue", "think", 0.5, degrees)
        return Played((seen, lesson), (answer,), 1)

    study = parse(STUDY.format(seeds=2, other="other"), Path("numbers.toml"))
    with Log.open(study, tmp_path) as log:
        for run in study.runs():
            log.write(play_to_outcome(study, run, play))
    page, results = reports.report(tmp_path)
    told = "4 of 4 questions were about words that nobody had said by then"
    assert (told in results[0].text) == is_told
    assert (
        "know (green): no theory can be right" in page.read_text("utf-8")
    ) == is_told
