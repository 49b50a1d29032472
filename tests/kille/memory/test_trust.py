"""A memory that is not what it seems is refused in one line, and left as it was."""

from __future__ import annotations

import os
import sqlite3
import stat
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from kille.memory import (
    Memory,
    MemoryFileError,
    MemoryReader,
    Sighting,
    Turn,
    schema,
)
from kille.memory.checking import check
from kille.memory.errors import explain_failures
from kille.memory.exporting import export
from kille.memory.files import open_to_read

from .test_files import refusal, taught
from .test_schema import of_version_1, of_version_2

OPENINGS = pytest.mark.parametrize("opening", [Memory.open, Memory.open_to_read])


def change(path: Path, statements: str) -> None:
    """Change a file as somebody can who has SQLite and no scruples."""
    with closing(sqlite3.connect(path)) as connection:
        connection.executescript(
            "PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON;"
            f"{statements}"
        )
        connection.commit()


def redefine(path: Path, table: str, old: str, new: str) -> None:
    """Change what the schema says of a table, behind SQLite's back."""
    change(
        path,
        "PRAGMA writable_schema = ON;"
        f"UPDATE sqlite_master SET sql = replace(sql, '{old}', '{new}') "
        f"WHERE name = '{table}'",
    )


def name_in_journal(path: Path, named: Path) -> Path:
    """Put a journal beside a memory that has SQLite delete another file."""
    name = os.fsencode(named)
    journal = path.with_name(f"{path.name}-journal")
    head = bytes.fromhex("d9d505f920a163d7") + bytes(4 * 5)
    tail = len(name).to_bytes(4, "big") + sum(name).to_bytes(4, "big")
    tail += bytes.fromhex("d9d505f920a163d7")
    place = (0x40000000 // 16384 + 1).to_bytes(4, "big")
    journal.write_bytes(head.ljust(512, b"\0") + place + name + tail)
    return journal


FORGETFUL = """
    CREATE TRIGGER forgetful AFTER INSERT ON lessons
    BEGIN DELETE FROM lessons; END
"""

PARTS = {
    FORGETFUL: "a trigger that kille never makes, forgetful",
    "CREATE TRIGGER t INSTEAD OF INSERT ON v BEGIN SELECT 1; END": "trigger",
    "CREATE VIEW v AS SELECT 1": "a view that kille never makes, v",
    "CREATE TABLE more (x)": "a table that kille never makes, more",
    "CREATE INDEX more ON turns (text)": "an index that kille never makes, more",
    "CREATE INDEX more ON turns (lower(text)) WHERE time > 'x'": "an index",
    "CREATE VIRTUAL TABLE more USING fts5(x)": "a table that kille never makes, more",
    "CREATE TABLE 'x\x1b[31m' (x)": r"a table that kille never makes, x\x1b[31m",
    "DROP INDEX lessons_by_word": "no index lessons_by_word",
    "DROP TABLE pictures": "no table pictures",
    "ANALYZE": "a table that kille never makes, sqlite_stat1",
    "ALTER TABLE turns ADD COLUMN more": "a table turns that is not as kille makes it",
    "ALTER TABLE turns ADD COLUMN more AS (text)": "a table turns that is not",
    "ALTER TABLE turns RENAME COLUMN text TO words": "a table turns that is not",
    "PRAGMA user_version = -1": "the version -1, which no kille writes",
    "PRAGMA user_version = -2147483648": "the version -2147483648",
    "PRAGMA user_version = 0": "the version 0, which no kille writes",
    "PRAGMA user_version = 2": "a table lessons that is not as kille makes it",
}


@OPENINGS
@pytest.mark.parametrize("harm", PARTS)
def test_a_memory_has_the_parts_that_kille_makes_and_no_others(
    opening: Callable[[Path], object],
    harm: str,
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
) -> None:
    taught(path, said(1), seen)
    if " v " in harm and "TRIGGER" in harm:
        change(path, "CREATE VIEW v AS SELECT 1 AS x")
    change(path, harm)
    before = path.read_bytes()
    line = refusal(opening, path)
    assert f"{path} has " in line
    assert PARTS[harm] in line
    assert "kille memory check" in line
    assert "\x1b" not in line
    assert path.read_bytes() == before


@OPENINGS
@pytest.mark.parametrize(
    ("table", "old", "new"),
    [
        (
            "turns",
            "UNIQUE (dialogue, number)",
            "UNIQUE (dialogue, number) ON CONFLICT IGNORE",
        ),
        ("lessons", "name TEXT NOT NULL", "name TEXT NOT NULL ON CONFLICT REPLACE"),
        ("lessons", "DEFAULT 1", "DEFAULT 0"),
        ("lessons", "holds IN (0, 1)", "holds IN (0, 2)"),
        ("lessons", "REFERENCES turns", "REFERENCES scans"),
        ("scans", "descriptors BLOB", "descriptors TEXT"),
        ("scans", " ON DELETE CASCADE", ""),
        ("lessons_by_word", "(kind, name)", "(kind, name) WHERE 0"),
    ],
)
def test_the_statements_are_those_of_kille(
    opening: Callable[[Path], object],
    table: str,
    old: str,
    new: str,
    path: Path,
) -> None:
    Memory.open(path).close()
    redefine(path, table, old, new)
    assert f"{table} that is not as kille makes it" in refusal(opening, path)


@OPENINGS
def test_a_statement_under_the_name_of_another_is_found(
    opening: Callable[[Path], object], path: Path
) -> None:
    Memory.open(path).close()
    for kind, name in (("table", "lessons"), ("index", "lessons_by_word")):
        change(
            path,
            "PRAGMA writable_schema = ON; INSERT INTO sqlite_master VALUES "
            f"('{kind}', '{name}', 'lessons', 0, '{FORGETFUL}')",
        )
        assert "kille memory check" in refusal(opening, path)


@OPENINGS
@pytest.mark.parametrize("make", [of_version_1, of_version_2])
def test_an_older_memory_is_checked_before_it_is_brought_up_to_date(
    opening: Callable[[Path], object], make: Callable[[Path], None], path: Path
) -> None:
    make(path)
    change(path, FORGETFUL)
    before = path.read_bytes()
    assert "forgetful" in refusal(opening, path)
    assert path.read_bytes() == before


ROWS = {
    "UPDATE lessons SET name = x'637570'": "blob as name in lessons",
    "UPDATE lessons SET time = 'noon'": "text as time in lessons",
    "UPDATE lessons SET holds = 0.5": "",
    "UPDATE lessons SET holds = 2": "",
    "UPDATE lessons SET kind = 'verb'": "",
    "UPDATE scans SET points = 'far'": "text as points in scans",
    "UPDATE sightings SET x = 'left'": "text as x in sightings",
    "UPDATE turns SET number = 'one'": "text as number in turns",
    "UPDATE turns SET text = x'00'": "blob as text in turns",
    "DELETE FROM turns": "rows in lessons whose turns are missing",
    "DELETE FROM dialogues": "rows in turns whose dialogues are missing",
    "DELETE FROM lessons": "whose lessons are missing",
    "DELETE FROM sightings": "lessons without what was seen in them",
    "UPDATE lessons SET kind = 'relation'": "lessons without what was seen in them",
    "UPDATE sqlite_sequence SET seq = 0": "a wrong count of all lessons ever",
    "UPDATE sqlite_sequence SET seq = 9223372036854775807": "a wrong count",
    "UPDATE sqlite_sequence SET seq = 'many'": "a wrong count",
    "UPDATE sqlite_sequence SET name = NULL": "a wrong count",
    "INSERT INTO sqlite_sequence VALUES ('lessons', 5)": "two counts",
    "DELETE FROM sqlite_sequence": "no count of all lessons ever",
    "UPDATE lessons SET id = -1; UPDATE sightings SET lesson = -1;"
    "UPDATE scans SET lesson = -1; UPDATE traits SET lesson = -1;"
    "UPDATE pictures SET lesson = -1; UPDATE crops SET lesson = -1": "never gives",
}


@OPENINGS
@pytest.mark.parametrize("harm", ROWS)
def test_a_memory_has_the_values_that_kille_writes(
    opening: Callable[[Path], object],
    harm: str,
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
) -> None:
    taught(path, said(1), seen)
    change(path, harm)
    before = path.read_bytes()
    assert ROWS[harm] in refusal(opening, path)
    assert path.read_bytes() == before


def renumber(lesson: int) -> str:
    """The statements that give the only lesson another number."""
    tables = ("sightings", "scans", "traits", "pictures", "crops")
    return f"UPDATE lessons SET id = {lesson};" + ";".join(
        f"UPDATE {table} SET lesson = {lesson}" for table in tables
    )


@OPENINGS
@pytest.mark.parametrize(("last", "beyond"), [(0, -1), (2**62, 2**62 + 1)])
def test_lessons_are_numbered_so_far_and_no_farther(
    opening: Callable[[Path], MemoryReader],
    last: int,
    beyond: int,
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
) -> None:
    taught(path, said(1), seen)
    change(path, f"{renumber(last)}; UPDATE sqlite_sequence SET seq = {last}")
    with opening(path) as memory:
        assert memory.lesson(last).word.name == "cup"
    change(path, renumber(beyond))
    refusal(opening, path)
    assert "it has lessons with numbers that kille never gives" in check(path).faults
    change(path, f"{renumber(last)}; UPDATE sqlite_sequence SET seq = {beyond}")
    assert "a wrong count of all lessons ever" in refusal(opening, path)


@pytest.mark.parametrize(
    "harm",
    [
        "UPDATE lessons SET name = 'cup' || char(27) || '[31m'",
        "UPDATE lessons SET surface = 'cup' || char(8238) || 'puc'",
        "UPDATE lessons SET article = char(10)",
        "UPDATE lessons SET name = ''",
        "UPDATE lessons SET name = hex(zeroblob(501))",
        "UPDATE lessons SET name = cast(x'eda080' AS TEXT)",
        "UPDATE lessons SET surface = cast(x'ff' AS TEXT)",
    ],
)
def test_a_word_that_is_none_is_damage(
    harm: str, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, harm)
    questions: list[Callable[[MemoryReader], object]] = [
        lambda memory: memory.words(),
        lambda memory: memory.lessons(),
        lambda memory: memory.lesson(1),
        lambda memory: memory.latest(),
        lambda memory: memory.lesson_without_sight(1),
        lambda memory: list(memory.objects()),
    ]
    with Memory.open_to_read(path) as memory:
        for question in questions:
            line = refusal(lambda _, ask=question: ask(memory), path)
            assert "is damaged" in line
            assert "kille memory check" in line
            assert line.isprintable()


@pytest.mark.parametrize(
    "harm",
    [
        "UPDATE sightings SET x = 9e999",
        "UPDATE lessons SET time = -9e999",
        "UPDATE pictures SET boxes = '[[1e999, 0, 0, 0]]'",
        "UPDATE pictures SET boxes = '{0}'",
        "UPDATE crops SET intrinsics = '[NaN, 1, 1, 1]'",
    ],
)
def test_numbers_that_are_none_are_damage(
    harm: str, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, harm.format("[" * 100_000))
    with Memory.open_to_read(path) as memory:
        assert "is damaged" in refusal(lambda _: memory.lesson(1), path)


@OPENINGS
def test_a_value_larger_than_any_is_one_line(
    opening: Callable[[Path], object],
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("kille.safety.databases.LARGEST_VALUE", 100_000)
    taught(path, said(1), seen)
    change(path, "UPDATE turns SET text = hex(zeroblob(60000))")
    assert "larger than any that kille keeps" in refusal(
        lambda _: asked(opening(path)), path
    )


def asked(memory: object) -> None:
    assert isinstance(memory, MemoryReader)
    with memory:
        memory.turns()


@OPENINGS
def test_text_is_in_utf_8(opening: Callable[[Path], object], path: Path) -> None:
    path.parent.mkdir()
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA encoding = 'UTF-16le'")
        schema.migrate(connection)
        connection.commit()
    assert "text in UTF-16le" in refusal(opening, path)


@OPENINGS
@pytest.mark.parametrize("mark", ["application_id", "user_version"])
def test_an_empty_database_with_the_mark_of_another_is_left_alone(
    opening: Callable[[Path], object], mark: str, path: Path
) -> None:
    path.parent.mkdir()
    with closing(sqlite3.connect(path)) as connection:
        connection.execute(f"PRAGMA {mark} = 7")
        connection.commit()
    before = path.read_bytes()
    assert "another program" in refusal(opening, path)
    assert path.read_bytes() == before


@OPENINGS
def test_a_journal_that_names_another_file_is_refused(
    opening: Callable[[Path], object], path: Path, tmp_path: Path
) -> None:
    """SQLite would delete the file that it names."""
    Memory.open(path).close()
    named = tmp_path / "precious"
    named.write_text("precious")
    journal = name_in_journal(path, named)
    assert "a journal beside it" in refusal(opening, path)
    assert named.read_text() == "precious"
    assert journal.exists()


@OPENINGS
@pytest.mark.parametrize("made", ["pipe", "loop", "folder"])
def test_a_journal_that_is_no_file_is_refused(
    opening: Callable[[Path], object], made: str, path: Path
) -> None:
    """SQLite would wait for the pipe for ever."""
    Memory.open(path).close()
    journal = path.with_name(f"{path.name}-journal")
    match made:
        case "pipe":
            os.mkfifo(journal)
        case "loop":
            journal.symlink_to(journal)
        case "folder":
            journal.mkdir()
    assert "a journal beside it that kille never writes" in refusal(opening, path)
    assert check(path).faults == ("it has a journal beside it that kille never writes",)
    path.unlink()
    assert "does not exist" in refusal(check, path)


def test_a_lesson_that_does_not_come_back_is_not_learned(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory._connection.execute(
            "CREATE TEMP TRIGGER forgetful AFTER INSERT ON crops "
            "BEGIN DELETE FROM lessons; END"
        )
        line = refusal(lambda _: memory.learn_object(said(1), "cup", "cup", seen), path)
        assert "did not keep lesson 1 as it was taught" in line
        assert (memory.lessons(), memory.turns()) == ((), ())


@pytest.mark.parametrize(
    "change",
    [
        "UPDATE lessons SET name = 'mug'",
        "UPDATE lessons SET holds = 0",
        "UPDATE lessons SET sensor = 'other'",
        "UPDATE turns SET text = 'This is a mug.'",
        "UPDATE sightings SET x = 1",
        "UPDATE scans SET points = zeroblob(length(points))",
        "UPDATE scans SET descriptors = zeroblob(length(descriptors))",
        "UPDATE scans SET points = x'00'",
        "UPDATE crops SET intrinsics = '[1]'",
        "DELETE FROM scans WHERE id = 2",
        "DELETE FROM traits WHERE cue = 'size'",
        "UPDATE traits SET cue = 'sizes' WHERE cue = 'size'",
        "UPDATE traits SET vector = zeroblob(length(vector))",
        "UPDATE pictures SET boxes = '[]'",
        "UPDATE crops SET depth = NULL",
        "DELETE FROM crops",
    ],
)
def test_a_lesson_that_comes_back_otherwise_is_not_learned(
    change: str, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory._connection.execute(
            f"CREATE TEMP TRIGGER other AFTER INSERT ON crops BEGIN {change}; END"
        )
        line = refusal(lambda _: memory.learn_object(said(1), "cup", "cup", seen), path)
        assert "did not keep" in line
        assert (memory.lessons(), memory.turns()) == ((), ())


# --- permissions ---------------------------------------------------------------------


def modes(folder: Path) -> dict[str, int]:
    return {it.name: stat.S_IMODE(it.stat().st_mode) for it in folder.iterdir()}


@pytest.fixture(params=[0o000, 0o022, 0o077, 0o777])
def umask(request: pytest.FixtureRequest) -> object:
    before = os.umask(request.param)
    yield
    os.umask(before)


def test_only_its_user_can_read_a_memory(
    tmp_path: Path, said: Callable[[int], Turn], seen: Sighting, umask: object
) -> None:
    path = tmp_path / "memory.db"
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        assert modes(tmp_path) == dict.fromkeys(
            ("memory.db", "memory.db-wal", "memory.db-shm"), 0o600
        )
        export(memory, tmp_path / "memory.zip")
    assert modes(tmp_path) == {"memory.db": 0o600, "memory.zip": 0o600}


def test_only_its_user_can_read_an_exported_folder(
    tmp_path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.transient() as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        export(memory, tmp_path / "exported")
    assert modes(tmp_path) == {"exported": 0o700}
    assert set(modes(tmp_path / "exported").values()) <= {0o600, 0o755, 0o700}
    assert modes(tmp_path / "exported" / "lessons" / "1")["features.npz"] == 0o600


def test_a_memory_behind_a_link_is_its_users_alone(tmp_path: Path) -> None:
    (tmp_path / "link.db").symlink_to(tmp_path / "memory.db")
    Memory.open(tmp_path / "link.db").close()
    assert modes(tmp_path)["memory.db"] == 0o600


def test_a_memory_that_others_may_read_is_left_so(tmp_path: Path) -> None:
    path = tmp_path / "memory.db"
    Memory.open(path).close()
    path.chmod(0o644)
    Memory.open(path).close()
    assert modes(tmp_path) == {"memory.db": 0o644}


@pytest.fixture
def careless_sqlite(monkeypatch: pytest.MonkeyPatch) -> None:
    """An SQLite that was built to be fast: Debian's overwrites what is deleted."""
    connect = sqlite3.connect

    def careless(*arguments: Any, **options: Any) -> sqlite3.Connection:
        connection = connect(*arguments, **options)
        connection.execute("PRAGMA secure_delete = OFF")
        connection.execute("PRAGMA synchronous = OFF")
        return connection

    monkeypatch.setattr(sqlite3, "connect", careless)


@pytest.mark.usefixtures("careless_sqlite")
def test_what_was_forgotten_cannot_be_found_in_the_file(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    """Neither in its pages, used or free, nor beside it."""
    taught(path, said(1), seen)
    with Memory.open(path) as memory:
        vectors = [memory.lesson(1).seen.traits["colour"].tobytes()]  # type: ignore[union-attr]
        vectors += [it.points.tobytes()[-200:] for it in seen.scans]
        assert all(it in path.read_bytes() for it in vectors)
        memory.forget(1)
    assert not any(it in path.read_bytes() for it in vectors)


@pytest.mark.usefixtures("careless_sqlite")
def test_commits_are_durable_before_they_return(path: Path) -> None:
    with Memory.open(path) as memory:
        found = memory._connection.execute("PRAGMA synchronous").fetchone()
    assert found == (2,), "FULL: a commit waits until the disk has it"


def test_what_is_no_fault_of_the_file_is_not_blamed_on_it() -> None:
    stopped = sqlite3.OperationalError("interrupted")
    stopped.sqlite_errorcode = sqlite3.SQLITE_INTERRUPT
    with (
        pytest.raises(sqlite3.OperationalError, match="interrupted"),
        explain_failures("memory.db"),
    ):
        raise stopped


@pytest.mark.skipif(not os.path.isdir("/proc/self/fd"), reason="needs /proc")
def test_a_file_that_is_refused_is_not_kept_open(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, "CREATE TABLE strange (a)")
    with pytest.raises(MemoryFileError) as refused:
        open_to_read(path)
    links = [it for it in Path("/proc/self/fd").iterdir() if it.is_symlink()]
    assert "memory.db has " in str(refused.value)
    assert str(path) not in {os.readlink(it) for it in links if it.is_symlink()}


def test_what_cannot_be_opened_is_a_memory_file_error(tmp_path: Path) -> None:
    (tmp_path / "loop.db").symlink_to(tmp_path / "loop.db")
    with pytest.raises(MemoryFileError):
        Memory.open(tmp_path / "loop.db")


@OPENINGS
def test_a_file_whose_free_pages_are_counted_wrong_is_damaged(
    opening: Callable[[Path], object], path: Path
) -> None:
    """Every row can be read; writing would go on from the damage."""
    Memory.open(path).close()
    with path.open("r+b") as file:
        file.seek(36)
        file.write((5).to_bytes(4, "big"))
    assert "is damaged" in refusal(opening, path)


def test_a_connection_trusts_no_schema_and_checks_pages(path: Path) -> None:
    expected = {"trusted_schema": 0, "cell_size_check": 1}
    for opening in (Memory.open, Memory.open_to_read):
        with opening(path) as memory:
            asked = memory._connection.execute
            found = {it: asked(f"PRAGMA {it}").fetchone()[0] for it in expected}
            assert found == expected
            assert asked("PRAGMA page_size").fetchone() == (16_384,)
