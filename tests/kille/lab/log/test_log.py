"""The log: what is kept, whole, by one writer, of one study."""

from __future__ import annotations

import math
import os
import random
import re
import signal
import sqlite3
import stat
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import permutations
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

import little_study
from kille.lab import log
from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.log import Log
from kille.lab.log.folders import FILE
from kille.lab.log.outcomes import Broken, Finished, RunError, play_to_outcome
from kille.lab.log.sources import sources
from kille.lab.study import Named, Run, Study, Theory

WORDS = st.text(st.characters(exclude_categories=["Cs"]), max_size=8)
COUNTS = st.integers(0, 2**40)
DEGREES = st.floats(allow_nan=False, allow_infinity=False)
TURNS = st.builds(
    Turn,
    COUNTS,
    *[WORDS] * 5,
    COUNTS,
    st.booleans(),
    st.booleans(),
    st.lists(WORDS, max_size=3).map(tuple),
)
ANSWERS = st.builds(
    Answer,
    COUNTS,
    *[WORDS] * 5,
    degree=DEGREES,
    degrees=st.dictionaries(WORDS, DEGREES, max_size=3),
    accepted=st.booleans(),
    judge=WORDS,
    lessons=COUNTS,
)
PLAYED = st.builds(
    Played,
    st.lists(TURNS, max_size=3).map(tuple),
    st.lists(ANSWERS, max_size=3).map(tuple),
    COUNTS,
    st.dictionaries(WORDS, DEGREES, max_size=2),
)
STUDY = little_study.study()


def run_of(study: Study, number: int) -> Run:
    return list(study.runs())[number]


def finished(study: Study, run: Run) -> Finished:
    found = play_to_outcome(study, run, little_study.play)
    assert isinstance(found, Finished)
    return found


@pytest.mark.slow
@given(PLAYED, st.floats(0, 1e6))
def test_what_is_kept_is_what_is_read(played: Played, seconds: float) -> None:
    it = Finished(run_of(STUDY, 1), played, seconds)
    with TemporaryDirectory() as folder:
        with Log.open(STUDY, Path(folder)) as kept:
            kept.write(it)
        assert list(log.read(Path(folder))) == [it]


def test_what_is_no_number_is_none_afterwards(tmp_path: Path) -> None:
    answer = Answer(1, "test", "noun", "cup", "", "admit")
    with Log.open(STUDY, tmp_path) as kept:
        kept.write(Finished(run_of(STUDY, 0), Played((), (answer,)), 1))
    ((_, played, _),) = log.read(tmp_path)
    assert math.isnan(played.answers[0].degree)


def test_dialogues_are_read_in_the_order_of_the_study(tmp_path: Path) -> None:
    runs = list(STUDY.runs())[:3]
    for number, order in enumerate(permutations(runs)):
        folder = tmp_path / str(number)
        with Log.open(STUDY, folder) as kept:
            for run in order:
                kept.write(finished(STUDY, run))
        assert [it.run for it in log.read(folder)] == runs


def test_a_dialogue_is_found_by_its_name_and_by_its_number(tmp_path: Path) -> None:
    with Log.open(STUDY, tmp_path) as kept:
        for run in STUDY.runs():
            kept.write(finished(STUDY, run))
    for number, run in enumerate(STUDY.runs(), start=1):
        found = log.find_outcome(tmp_path, str(run))
        assert found == log.find_outcome(tmp_path, str(number))
        assert found.run == run
    with pytest.raises(RunError, match=r"no dialogue good/Ann/table/9 .* one is good/"):
        log.find_outcome(tmp_path, "good/Ann/table/9")


def test_what_broke_is_kept_with_its_reason_until_it_is_forgotten(
    tmp_path: Path,
) -> None:
    study = little_study.study(theories=(little_study.GOOD, little_study.BAD))
    with Log.open(study, tmp_path) as kept:
        for run in study.runs():
            kept.write(play_to_outcome(study, run, little_study.play))
    (broken,) = log.broken_runs(tmp_path)
    assert broken.run == Run("bad", "Ann", "table", 2)
    assert broken.reason.startswith("ValueError: nobody likes")
    assert "little_study.py, line" in broken.reason
    assert "Traceback" in broken.trace
    assert len(list(log.read(tmp_path))) == log.count_outcomes(tmp_path) - 1 == 5
    with Log.open(study, tmp_path) as kept:
        assert kept.forget_broken() == 1
        assert broken.run not in kept.reasons()
    assert log.count_outcomes(tmp_path) == 5


# --- of one study --------------------------------------------------------------------


def test_another_study_is_refused_and_nothing_lost(tmp_path: Path) -> None:
    with Log.open(STUDY, tmp_path) as kept:
        kept.write(finished(STUDY, run_of(STUDY, 0)))
    other = replace(STUDY, source="another")
    with (
        pytest.raises(RunError, match="another study: the study has changed"),
        Log.open(other, tmp_path),
    ):
        pass
    assert log.count_outcomes(tmp_path) == 1


def test_a_study_whose_learner_has_changed_is_another(tmp_path: Path) -> None:
    learner = tmp_path / "own.py"
    learner.write_text("a = 1")
    theory = Theory("a", learners={"noun": f"{learner}:Own"})
    study = replace(STUDY, theories={"a": theory}, folder=tmp_path)
    with Log.open(study, tmp_path / "out"):
        pass
    with Log.open(study, tmp_path / "out"):
        pass
    learner.write_text("a = 2")
    with (
        pytest.raises(RunError, match=r"another study: own\.py has changed"),
        Log.open(study, tmp_path / "out"),
    ):
        pass


def test_a_study_whose_folder_has_changed_is_another(tmp_path: Path) -> None:
    (tmp_path / "people").mkdir()
    settings = {"folder": "people"}
    tutors = {"people": Named("people", "statements", settings)}
    study = replace(STUDY, tutors=tutors, folder=tmp_path)
    with Log.open(study, tmp_path / "out"):
        pass
    (tmp_path / "people" / "more.csv").write_text("1")
    with (
        pytest.raises(RunError, match="another study: people has changed"),
        Log.open(study, tmp_path / "out"),
    ):
        pass


def test_a_log_says_what_it_is_of(tmp_path: Path) -> None:
    study = replace(STUDY, folder=tmp_path, file=Path("numbers.toml"))
    with Log.open(study, tmp_path / "results" / "first"):
        pass
    moved = tmp_path / "results" / "second"
    (tmp_path / "results" / "first").rename(moved)
    about = log.about(moved)
    assert (about.title, about.source) == ("Numbers", study.source)
    assert about.file == tmp_path.resolve() / "numbers.toml"
    assert about.planned == 6
    assert "kille" in about.versions


# --- by one writer -------------------------------------------------------------------


def test_a_second_writer_is_refused_at_once_and_a_reader_is_not(tmp_path: Path) -> None:
    with Log.open(STUDY, tmp_path) as kept:
        kept.write(finished(STUDY, run_of(STUDY, 0)))
        with (
            pytest.raises(RunError, match=f"another run .process {os.getpid()}."),
            Log.open(STUDY, tmp_path),
        ):
            pass
        assert log.count_outcomes(tmp_path) == 1
    with Log.open(STUDY, tmp_path) as kept:
        assert len(kept.reasons()) == 1


def test_dialogues_are_whole_or_not_there_whenever_the_writer_is_killed(
    tmp_path: Path,
) -> None:
    chance, before = random.Random(5), 0
    for _ in range(3):
        acknowledged = before + killed(tmp_path, chance.uniform(0, 0.1))
        before = log.count_outcomes(tmp_path)
        assert acknowledged <= before <= acknowledged + 1
    study = little_study.study(SEEDS)
    for run, played, _ in log.read(tmp_path):
        assert played == little_study.play(study, run)


SEEDS = 2_000
WRITING = f"""
import os, signal, sys
from pathlib import Path
import little_study
from kille.lab.log import Log
from kille.lab.log.outcomes import play_to_outcome

study = little_study.study({SEEDS})
with Log.open(study, Path(sys.argv[1])) as kept:
    over = kept.reasons()
    os.write(1, b".")
    for run in study.runs():
        if run not in over:
            kept.write(play_to_outcome(study, run, little_study.play))
            os.write(1, b".")
    signal.pause()
"""


def killed(folder: Path, seconds: float) -> int:
    """Has another process write dialogues, and kills it; how many it said it wrote."""
    writer = subprocess.Popen(
        [sys.executable, "-c", WRITING, str(folder)],
        env=os.environ | {"PYTHONPATH": str(Path(little_study.__file__).parent)},
        stdout=subprocess.PIPE,
    )
    assert writer.stdout
    assert writer.stdout.read(1) == b"."
    time.sleep(seconds)
    writer.kill()
    told, _ = writer.communicate()
    assert writer.returncode == -signal.SIGKILL
    return len(told)


# --- files ---------------------------------------------------------------------------


def test_a_full_disk_is_one_line_and_loses_nothing_that_was_kept(
    tmp_path: Path,
) -> None:
    first, second, *_ = STUDY.runs()
    with Log.open(STUDY, tmp_path) as kept:
        kept.write(finished(STUDY, first))
        with full(kept._connection):
            long = Turn(1, "lessons", "Ann", "instruct", "x" * 100_000, "")
            with pytest.raises(RunError, match=r"full: all dialogues .* are kept"):
                kept.write(Finished(second, Played((long,), ()), 1))
        assert log.count_outcomes(tmp_path) == 1
        kept.write(finished(STUDY, second))
    assert list(log.read(tmp_path)) == [
        finished(STUDY, run)._replace(seconds=it.seconds)
        for run, it in zip((first, second), log.read(tmp_path), strict=True)
    ]


@contextmanager
def full(connection: sqlite3.Connection) -> Iterator[None]:
    """The file may not grow, as when there is no room."""
    (pages,) = connection.execute("PRAGMA page_count").fetchone()
    connection.execute(f"PRAGMA max_page_count = {pages}")
    yield
    connection.execute("PRAGMA max_page_count = 4294967294")


def test_what_is_no_log_is_refused_and_left_as_it_is(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"no log\.db in .*: name a folder of results"):
        log.about(tmp_path)
    path = tmp_path / FILE
    path.write_bytes(b"something else" * 100)
    for attempt in (read_it, write_it):
        with pytest.raises(RunError, match="no log of a study"):
            attempt(tmp_path)
    assert path.read_bytes() == b"something else" * 100


def test_the_database_of_another_program_is_refused(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / FILE) as other:
        other.execute("CREATE TABLE notes (text)")
    other.close()
    before = (tmp_path / FILE).read_bytes()
    for attempt in (read_it, write_it):
        with pytest.raises(RunError, match="no log of a study"):
            attempt(tmp_path)
    assert (tmp_path / FILE).read_bytes() == before


@pytest.mark.parametrize(
    ("harm", "fault"),
    [
        (
            "CREATE TRIGGER forgetful AFTER INSERT ON runs BEGIN DELETE FROM runs; END",
            "a trigger that kille never makes, forgetful",
        ),
        ("CREATE VIEW more AS SELECT 1", "a view that kille never makes, more"),
        (
            "DROP TABLE about; CREATE TABLE about (name, value)",
            "no index sqlite_autoindex_about_1",
        ),
        ("UPDATE runs SET seconds = 'long'", "text as seconds in runs"),
        ("UPDATE turns SET words = x'00'", "blob as words in turns"),
        ("DELETE FROM runs", "rows in answers whose runs are missing"),
    ],
)
def test_a_log_with_what_kille_never_writes_is_refused(
    harm: str, fault: str, tmp_path: Path
) -> None:
    play_one(tmp_path)
    with sqlite3.connect(tmp_path / FILE) as other:
        other.executescript(harm)
    other.close()
    for attempt in (read_it, write_it):
        with pytest.raises(RunError, match=re.escape(f"{FILE} has {fault}")):
            attempt(tmp_path)


@pytest.mark.parametrize("harm", ["facts = '['", "seconds = 1, facts = '{'"])
def test_a_dialogue_that_is_none_any_more_is_one_line(
    harm: str, tmp_path: Path
) -> None:
    play_one(tmp_path)
    with sqlite3.connect(tmp_path / FILE) as other:
        other.execute(f"UPDATE runs SET {harm}")
    other.close()
    with pytest.raises(RunError, match="is damaged"):
        list(log.read(tmp_path))


def test_only_its_user_can_read_a_log(tmp_path: Path) -> None:
    write_it(tmp_path)
    modes = {it.name: stat.S_IMODE(it.stat().st_mode) for it in tmp_path.iterdir()}
    assert modes == {FILE: 0o600, ".lock": 0o600}


def test_a_folder_that_cannot_be_made_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(RunError, match=r"cannot be written: .* name another"):
        write_it(tmp_path / "file" / "out")


def test_a_log_can_be_read_where_nothing_can_be_written(tmp_path: Path) -> None:
    with Log.open(STUDY, tmp_path) as kept:
        kept.write(finished(STUDY, run_of(STUDY, 0)))
    tmp_path.chmod(stat.S_IRUSR | stat.S_IXUSR)
    try:
        assert len(list(log.read(tmp_path))) == 1
    finally:
        tmp_path.chmod(stat.S_IRWXU)


def read_it(folder: Path) -> None:
    log.about(folder)


def write_it(folder: Path) -> None:
    with Log.open(STUDY, folder):
        pass


def play_one(folder: Path) -> None:
    with Log.open(STUDY, folder) as kept:
        kept.write(finished(STUDY, run_of(STUDY, 0)))


@pytest.mark.parametrize(
    ("odd", "told"),
    [
        (Turn(1, "a", "Ann", "instruct", "\ud800", ""), r"can't encode .*ud800"),
        (Turn(2**70, "a", "Ann", "instruct", "", ""), "too large"),
        (Turn(1, "a", "Ann", "instruct", "", "", None), "NoneType"),  # type: ignore[arg-type]
    ],
)
def test_what_cannot_be_kept_breaks_its_own_dialogue_alone(
    tmp_path: Path, odd: Turn, told: str
) -> None:
    first, second, *_ = STUDY.runs()
    with Log.open(STUDY, tmp_path) as kept:
        found = kept.write(Finished(first, Played((odd,), ()), 1))
        kept.write(finished(STUDY, second))
    assert isinstance(found, Broken)
    assert (log.broken_runs(tmp_path), log.count_outcomes(tmp_path)) == ((found,), 2)
    assert re.search(told, found.reason)
    assert "Traceback" in found.trace


def test_a_reason_with_half_a_character_can_be_kept(tmp_path: Path) -> None:
    def play(study: Study, run: Run) -> Played:
        raise ValueError("\ud800")

    with Log.open(STUDY, tmp_path) as kept:
        kept.write(play_to_outcome(STUDY, run_of(STUDY, 0), play))
    (broken,) = log.broken_runs(tmp_path)
    assert broken.reason.startswith(r"ValueError: \ud800 (")


def test_a_reason_is_one_line_however_long_the_message() -> None:
    def play(study: Study, run: Run) -> Played:
        raise RuntimeError("so\n" * 1000)

    found = play_to_outcome(STUDY, run_of(STUDY, 0), play)
    assert isinstance(found, Broken)
    assert "\n" not in found.reason
    assert len(found.reason) < 400


def test_a_tutor_who_leaves_the_program_breaks_his_own_dialogue_alone() -> None:
    def play(study: Study, run: Run) -> Played:
        raise SystemExit(0)

    found = play_to_outcome(STUDY, run_of(STUDY, 0), play)
    assert isinstance(found, Broken)
    assert found.reason.startswith("SystemExit")


def test_what_is_at_home_is_looked_at_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "lessons.dlg").write_text("This is a cup.")
    tutor = Named("Ann", "scripted", {"file": "~/lessons.dlg"})
    study = replace(STUDY, tutors={"Ann": tutor}, folder=tmp_path / "studies")
    assert list(sources(study)) == ["the study", "../lessons.dlg"]
