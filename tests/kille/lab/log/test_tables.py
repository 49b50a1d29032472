"""Tables: one line for each thing observed, the same bytes whoever played."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping
from pathlib import Path

import pytest

import little_study
from kille.lab import log
from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.log import Broken, Finished, Log, RunError
from kille.lab.log.tables import TABLES, write_tables
from kille.lab.running_studies import run
from little_study import BAD, GOOD, folder_of, play

STUDY = little_study.study(theories=(GOOD, BAD))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    run(STUDY, tmp_path, play)
    write_tables(tmp_path)
    return tmp_path


def rows(folder: Path, name: str) -> list[Mapping[str, str]]:
    with (folder / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_there_is_a_line_for_each_thing_observed(folder: Path) -> None:
    played = [it.played for it in log.read(folder)]
    runs = [str(it) for it in STUDY.runs()]
    assert [row["run"] for row in rows(folder, "runs")] == runs
    assert [row["run"] for row in rows(folder, "times")] == runs
    assert len(rows(folder, "turns")) == sum(len(it.turns) for it in played)
    assert len(rows(folder, "answers")) == sum(len(it.answers) for it in played)


def test_each_line_says_by_itself_what_it_is_of(folder: Path) -> None:
    for name in TABLES:
        for row in rows(folder, name):
            keys = (row["theory"], row["tutor"], row["scene"], row["seed"])
            assert row["run"] == "/".join(keys)


def test_what_broke_has_a_line_that_says_why(folder: Path) -> None:
    (row,) = [row for row in rows(folder, "runs") if row["broken"]]
    assert row["run"] == "bad/Ann/table/2"
    assert row["broken"].startswith("ValueError: nobody likes")
    assert row["answers"] == row["fact_guesses"] == ""


def test_answers_are_as_they_were_given(folder: Path) -> None:
    given = [answer for it in log.read(folder) for answer in it.played.answers]
    for row, answer in zip(rows(folder, "answers"), given, strict=True):
        assert (row["right"], row["said"]) == (answer.right, answer.said)
        assert float(row["degree"]) == answer.degree
        assert json.loads(row["degrees"]) == answer.degrees
        assert row["is_right"] == str(int(answer.is_right))
        assert float(row["margin"]) == answer.margin


def test_the_tutor_of_a_turn_is_not_that_of_its_run(tmp_path: Path) -> None:
    study = little_study.study()
    turn = Turn(1, "test", "Bob", "ask_name", 'He said: "What, or\nwho?"', "…", 3)
    one = Finished(next(study.runs()), Played((turn,), ()), 1)
    with Log.open(study, tmp_path) as kept:
        kept.write(one)
    write_tables(tmp_path)
    (row,) = rows(tmp_path, "turns")
    assert (row["tutor"], row["turn_tutor"]) == ("Ann", "Bob")
    assert (row["given"], row["answer"]) == (turn.given, turn.answer)


def test_what_is_not_known_is_left_empty(tmp_path: Path) -> None:
    study = little_study.study()
    answer = Answer(1, "test", "noun", "cup", "", "admit")
    one = Finished(next(study.runs()), Played((), (answer,)), 1)
    with Log.open(study, tmp_path) as kept:
        kept.write(one)
    write_tables(tmp_path)
    (row,) = rows(tmp_path, "answers")
    assert row["degree"] == row["margin"] == row["said"] == ""


def test_tables_are_the_same_bytes_in_whatever_order_dialogues_ended(
    folder: Path,
) -> None:
    other = folder / "backwards"
    with Log.open(STUDY, other) as kept:
        for it in reversed(list(log.outcomes(folder))):
            kept.write(it._replace(seconds=it.seconds + 1))
    write_tables(other)
    assert folder_of(other) == folder_of(folder)


def test_tables_are_written_anew(folder: Path) -> None:
    before = folder_of(folder)
    (folder / "runs.csv").write_text("")
    write_tables(folder)
    assert folder_of(folder) == before
    assert not list(folder.glob("*.part"))


def test_parquet_holds_what_csv_holds(folder: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    for name in TABLES:
        found = parquet.read_table(folder / f"{name}.parquet").to_pylist()
        for row, line in zip(found, rows(folder, name), strict=True):
            told = {key: "" if it is None else str(it) for key, it in row.items()}
            assert told == line


def test_tables_without_a_log_or_a_place_are_one_line(
    tmp_path: Path, folder: Path
) -> None:
    with pytest.raises(RunError, match=r"no log\.db"):
        write_tables(tmp_path / "nowhere")
    (folder / "runs.csv").unlink()
    (folder / "runs.csv").mkdir()
    with pytest.raises(RunError, match=r"runs\.csv cannot be written"):
        write_tables(folder)


def test_all_that_broke_has_tables_too(tmp_path: Path) -> None:
    study = little_study.study(seeds=1)
    with Log.open(study, tmp_path) as kept:
        for it in study.runs():
            kept.write(Broken(it, "no cups", "", 1))
    write_tables(tmp_path)
    assert [row["broken"] for row in rows(tmp_path, "runs")] == ["no cups"] * 2
    assert rows(tmp_path, "turns") == []
