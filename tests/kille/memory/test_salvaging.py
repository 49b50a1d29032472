"""What is wrong with a memory is said, and what can be read of it is saved."""

from __future__ import annotations

import os
import shutil
import sqlite3
import tempfile
from collections.abc import Callable
from contextlib import closing
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from kille.memory import (
    Arrangement,
    Memory,
    MemoryFileError,
    ObjectLesson,
    RelationLesson,
    Scan,
    Sighting,
    Turn,
)
from kille.memory.checking import check
from kille.memory.exporting import MemorySize
from kille.memory.lessons import has_same_content
from kille.memory.salvaging import Salvage, salvage
from kille.memory.sqlite_pages import page_size, rows_in
from kille.scene import Configuration, Point

from .test_files import taught
from .test_schema import assert_kept, of_version_1, of_version_2
from .test_trust import (
    FORGETFUL,
    PARTS,
    ROWS,
    change,
    modes,
    name_in_journal,
    redefine,
    renumber,
)

LESSONS = 12


def teach(path: Path, lessons: int = LESSONS) -> None:
    """Make a memory of several words, with one lesson forgotten."""
    rng = np.random.default_rng(7)
    with Memory.open(path) as memory:
        for number in range(lessons):
            dialogue = memory.begin_dialogue(f"day {number}")
            turn = Turn(dialogue, 1, "tutor", f"This is a word{number}.", "", "now")
            n = 20 * (number % 5)
            scan = Scan(
                rng.integers(0, 256, (n, 128), dtype=np.uint8),
                rng.random((n, 3), dtype=np.float32),
            )
            traits = {"size": rng.random(3, dtype=np.float32)}
            seen = Sighting("synthetic", number, (scan, scan), Point(0, 0, 1), traits)
            memory.learn_object(turn, f"word{number}", f"word {number}", seen)
        turn = Turn(1, 2, "tutor", "It is left of it.", "", "now")
        stand = Arrangement("s", 0, "word0", "word1", Configuration((0.1, 0.0, 0.0)))
        memory.learn_relation(turn, "left_of", "left of", stand)
        if lessons >= 4:
            memory.forget(4)


def lessons_of(path: Path) -> dict[int, ObjectLesson | RelationLesson]:
    with Memory.open_to_read(path) as memory:
        return {it.key: memory.lesson(it.key) for it in memory.lessons()}


def saved_from(path: Path) -> tuple[Salvage, dict[int, ObjectLesson | RelationLesson]]:
    """What is saved of a file, which stays as it was."""
    before = {it.name: it.read_bytes() for it in path.parent.iterdir()}
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "new.db"
        done = salvage(path, target)
        assert modes(Path(folder)) == {"new.db": 0o600}
        found = lessons_of(target)
        assert check(target).faults == ()
    assert {it.name: it.read_bytes() for it in path.parent.iterdir()} == before
    return done, found


def assert_saved_whole(path: Path, sound: Path) -> None:
    done, found = saved_from(path)
    assert done.losses == ()
    expected = lessons_of(sound)
    assert found.keys() == expected.keys()
    assert all(has_same_content(found[key], expected[key]) for key in found)


# --- rows ----------------------------------------------------------------------------

VALUES = (
    st.none()
    | st.integers(-(2**63), 2**63 - 1)
    | st.sampled_from([0, 1, -1, 127, 128, 2**15, 2**23, 2**31, 2**47, -(2**47) - 1])
    | st.floats(allow_nan=False)
    | st.text(st.characters(exclude_categories=["Cs"]))
    | st.binary()
    | st.integers(0, 3000).map(lambda n: bytes(n))
)


@cache
def empty(size: int, reserved: int) -> bytes:
    """A database whose pages have this size, with bytes reserved at their ends."""
    with closing(sqlite3.connect(":memory:")) as connection:
        connection.execute(f"PRAGMA page_size = {size}")
        connection.execute("VACUUM")
        content = bytearray(connection.serialize())
    content[20] = reserved
    # Where the cells of the first page begin.
    content[105:107] = ((size - reserved) % 65536).to_bytes(2, "big")
    return bytes(content)


@given(
    rows=st.lists(st.tuples(VALUES, VALUES, VALUES), max_size=60),
    keys=st.integers(-(2**40), 2**40),
    size=st.sampled_from([512, 1024, 4096, 65536]),
    reserved=st.sampled_from([0, 1, 32]),
)
@example([(bytes(n), None, None) for n in range(440, 560)], 0, 512, 0)
@example([(bytes(n), None, None) for n in range(400, 560)], 0, 512, 32)
def test_rows_are_read_from_pages_as_sqlite_reads_them(
    rows: list[tuple[object, ...]], keys: int, size: int, reserved: int
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "any.db"
        path.write_bytes(empty(size, reserved))
        with closing(sqlite3.connect(path)) as connection:
            connection.execute("PRAGMA synchronous = OFF")
            connection.execute("CREATE TABLE any (a, b, c)")
            for number, row in enumerate(rows):
                connection.execute(
                    "INSERT INTO any (rowid, a, b, c) VALUES (?, ?, ?, ?)",
                    (keys + number * 1000, *row),
                )
            connection.commit()
            expected = connection.execute(
                "SELECT rowid, a, b, c FROM any ORDER BY rowid"
            ).fetchall()
        found = rows_in(path.read_bytes())
    assert [(it.key, *it.values) for it in found.tables.get("any", ())] == expected
    assert (found.strays, found.unreadable) == ([], 0)


def database(*statements: str) -> bytes:
    """The bytes of a database with pages of 512 bytes, made by these statements."""
    with closing(sqlite3.connect(":memory:")) as connection:
        connection.execute("PRAGMA page_size = 512")
        for statement in statements:
            connection.execute(statement)
        connection.commit()
        return connection.serialize()


def test_a_record_whose_head_is_longer_than_it_says_cannot_be_read() -> None:
    content = database(
        "CREATE TABLE any (a)", f"INSERT INTO any VALUES (x'{'07' * 59}')"
    )
    head, shorter = bytes([3, 0x81, 12 + 2 * 59 - 128]), bytes([2, 0x81, 4])
    assert content.count(head + bytes([7] * 59)) == 1
    (row,) = rows_in(content).tables["any"]
    assert row.values == (bytes([7] * 59),)
    found = rows_in(content.replace(head + bytes([7]), shorter + bytes([7])))
    assert (list(found.tables["any"]), found.unreadable) == ([], 1)


def test_rows_behind_a_page_that_is_lost_are_read_as_those_of_their_table() -> None:
    content = database(
        "CREATE TABLE any (a)",
        *(f"INSERT INTO any VALUES (zeroblob({100 + n}))" for n in range(60)),
    )
    whole = rows_in(content)
    leaves = [n for n in range(2, len(content) // 512) if content[n * 512] == 0x0D]
    lost = leaves[len(leaves) // 2] * 512
    found = rows_in(content[:lost] + bytes(512) + content[lost + 512 :])
    assert found.unreadable == 1
    assert found.tables["any"][0] == whole.tables["any"][0]
    assert found.tables["any"][-1] == whole.tables["any"][-1]
    assert found.strays == []


@given(st.binary(max_size=5000), st.binary(max_size=200), st.integers(0, 5000))
def test_any_bytes_have_rows_or_none(content: bytes, more: bytes, at: int) -> None:
    for head in (b"", b"SQLite format 3\0\x02\0" + bytes(82)):
        rows_in(head + content[:at] + more + content[at:])


# The length of the row, its key, the length of its head, the type of its value: a byte.
SECOND = bytes([3, 2, 2, 1, 78])


def rows_of_three(folder: Path, harm: bytes) -> tuple[list[object], int]:
    """Which of the rows 77, 78 and 79 are read where the second is another, and how
    many are not."""
    path = folder / "three.db"
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE any (a)")
        connection.execute("INSERT INTO any VALUES (77), (78), (79)")
        connection.commit()
    content = path.read_bytes()
    assert content.count(SECOND) == 1
    found = rows_in(content.replace(SECOND, harm))
    return [it.values[0] for it in found.tables["any"]], found.unreadable


@pytest.mark.parametrize(
    "harm",
    [
        pytest.param(bytes([3, 2, 2, 10, 78]), id="a type that SQLite never writes"),
        pytest.param(bytes([3, 2, 2, 11, 78]), id="another that it never writes"),
        pytest.param(bytes([3, 2, 2, 2, 78]), id="a value that is cut off"),
        pytest.param(bytes([3, 2, 9, 1, 78]), id="a head longer than the row"),
        pytest.param(bytes([3, 2, 2, 8, 78]), id="more than its value"),
    ],
)
def test_a_row_that_is_broken_costs_no_other(tmp_path: Path, harm: bytes) -> None:
    assert rows_of_three(tmp_path, harm) == ([77, 79], 1)


def test_what_was_put_aside_is_no_row_any_more(tmp_path: Path) -> None:
    """Pages that were put aside keep what was in them, unless it is overwritten."""
    path = tmp_path / "deleted.db"
    path.write_bytes(empty(512, 0))
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA secure_delete = OFF")
        for table in ("kept", "broken", "gone"):
            connection.execute(f"CREATE TABLE {table} (a)")
        gone = [(b"forgotten" + bytes(300),)] * 200
        connection.executemany("INSERT INTO gone VALUES (?)", gone)
        connection.execute("INSERT INTO kept VALUES ('kept')")
        connection.execute("DROP TABLE gone")
        connection.commit()
        (root,) = connection.execute(
            "SELECT rootpage FROM sqlite_master WHERE name = 'broken'"
        ).fetchone()
        (free,) = connection.execute("PRAGMA freelist_count").fetchone()
    content = bytearray(path.read_bytes())
    assert free > 126, "they are told by more than one page"
    assert b"forgotten" in content
    content[(root - 1) * 512 : root * 512] = b"\xff" * 512
    found = rows_in(bytes(content))
    assert [it.values for it in found.tables["kept"]] == [("kept",)]
    assert (found.strays, found.unreadable) == ([], 1)
    count = (int.from_bytes(content[32:36], "big") - 1) * 512 + 4
    content[count : count + 4] = (1 << 24).to_bytes(4, "big")
    assert rows_in(bytes(content)).strays == [], "as many as go on the page are free"
    content[32:36] = bytes(4)
    assert len(rows_in(bytes(content)).strays) > 100, "nothing says that they are free"


@pytest.mark.parametrize("size", [0, 1, 512, 16384])
def test_a_beginning_that_is_lost_says_no_size(path: Path, size: int) -> None:
    teach(path)
    content = path.read_bytes()
    sound = {it.key for it in rows_in(content).tables["lessons"]}
    lost = bytes(16) + size.to_bytes(2, "big") + content[18:]
    assert page_size(lost) is None
    assert sound <= {it.key for it in rows_in(lost).strays}


def test_more_is_not_reserved_than_sqlite_ever_does(path: Path) -> None:
    teach(path)
    content = bytearray(path.read_bytes())
    sound = rows_in(bytes(content))
    content[20] = 255
    assert rows_in(bytes(content)) == sound


# --- saving --------------------------------------------------------------------------


def test_a_sound_memory_is_sound_and_saved_whole(path: Path) -> None:
    teach(path)
    assert check(path).faults == ()
    assert_saved_whole(path, path)


def test_it_is_said_how_much_a_sound_memory_holds(path: Path) -> None:
    path.parent.mkdir()
    path.touch()
    assert check(path).amount == MemorySize(0, 0, 0)
    with Memory.open(path) as memory:
        memory.begin_dialogue("the day before")
    assert check(path).amount == MemorySize(1, 0, 0)
    path.unlink()
    teach(path)
    assert check(path).amount == MemorySize(LESSONS, LESSONS + 1, LESSONS)


@pytest.mark.parametrize("make", [of_version_1, of_version_2])
def test_a_memory_of_an_older_version_is_looked_through(
    make: Callable[[Path], None], path: Path
) -> None:
    make(path)
    before = path.read_bytes()
    assert check(path).faults == ()
    assert path.read_bytes() == before
    change(path, "UPDATE scans SET points = x'00'")
    assert [it[:25] for it in check(path).faults] == ["lesson 2 cannot be read: "]


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sound") / "memory.db"
    teach(path)
    return path


@settings(max_examples=25)
@given(
    wounds=st.lists(
        st.tuples(st.integers(0, 60), st.sampled_from([b"\0", b"\xff", b"\x0d", b"a"])),
        max_size=3,
    ),
    kept=st.floats(0.05, 1),
)
@example(wounds=[(0, b"\0")], kept=1)
@example(wounds=[(0, b"\xff")], kept=1)
@example(wounds=[], kept=0.5)
def test_what_is_saved_of_a_damaged_memory_was_in_it(
    sound: Path, wounds: list[tuple[int, bytes]], kept: float
) -> None:
    """Pages are overwritten, and the end is lost."""
    expected = lessons_of(sound)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "memory.db"
        content = bytearray(sound.read_bytes())
        for page, byte in wounds:
            if (page + 1) * 16384 <= len(content):
                content[page * 16384 : (page + 1) * 16384] = byte * 16384
        path.write_bytes(content[: int(kept * len(content))])
        try:
            _, found = saved_from(path)
        except MemoryFileError:
            assert kept < 0.5 or wounds
            return
    for key, lesson in found.items():
        assert lesson.word == expected[key].word
        assert lesson.turn.speaker in ("tutor", "unknown")
    if not wounds and kept == 1:
        assert found.keys() == expected.keys()


def pages_of(path: Path, table: str) -> int:
    """The number of the page in which the tree of a table begins."""
    with closing(sqlite3.connect(path)) as connection:
        query = "SELECT rootpage FROM sqlite_master WHERE name = ?"
        return int(connection.execute(query, (table,)).fetchone()[0])


def overwrite(path: Path, page: int, content: bytes = b"\xff" * 16384) -> None:
    with path.open("r+b") as file:
        file.seek((page - 1) * 16384)
        file.write(content)


def test_nothing_but_its_first_page_is_lost(path: Path) -> None:
    teach(path)
    broken = path.with_name("broken.db")
    shutil.copy(path, broken)
    overwrite(broken, 1)
    with pytest.raises(MemoryFileError, match="--salvage"):
        check(broken)
    done, found = saved_from(broken)
    assert found.keys() == lessons_of(path).keys()
    assert done.losses == ()


@pytest.mark.parametrize("table", ["turns", "lessons", "scans"])
def test_leaves_below_a_broken_page_are_found(table: str, path: Path) -> None:
    """Rows are found without the tree that led to them, and none that was forgotten."""
    teach(path, 250)
    root = pages_of(path, table)
    content = path.read_bytes()[(root - 1) * 16384 : root * 16384]
    broken = path.with_name("broken.db")
    shutil.copy(path, broken)
    overwrite(broken, root)
    assert check(broken).faults
    _, found = saved_from(broken)
    expected = lessons_of(path)
    if content[0] == 5:  # a page that only leads to others
        assert found.keys() == expected.keys()
        assert all(has_same_content(found[key], expected[key]) for key in found)
    else:
        assert found.keys() <= expected.keys()


def test_each_broken_page_is_counted_once(path: Path) -> None:
    teach(path)
    for number, table in enumerate(("turns", "arrangements"), 1):
        overwrite(path, pages_of(path, table))
        assert rows_in(path.read_bytes()).unreadable == number
    done, _ = saved_from(path)
    assert "2 rows or pages that cannot be read" in done.losses


@pytest.mark.parametrize("count", [0, 4095, 2**32 - 1])
def test_what_is_said_of_free_pages_leads_to_no_crash(path: Path, count: int) -> None:
    """A list of free pages is a chain of pages, each with a count of pages that is
    believed as far as the page goes."""
    teach(path, 40)
    with Memory.open(path) as memory:
        for key in range(20, 40):
            memory.forget(key)
    content = path.read_bytes()
    trunk = int.from_bytes(content[32:36], "big")
    assert trunk > 0
    overwrite(path, trunk, content[32:36] + count.to_bytes(4, "big") + bytes(16376))
    overwrite(path, pages_of(path, "turns"))
    found = rows_in(path.read_bytes())
    lessons = {it.key for it in found.tables["lessons"]}
    assert lessons == {*range(1, 20), 40, 41} - {4}
    assert found.unreadable == 1


def test_lessons_without_their_turns_are_kept(path: Path) -> None:
    teach(path)
    expected = lessons_of(path)
    change(path, "DELETE FROM turns; DELETE FROM dialogues")
    assert check(path).faults
    done, found = saved_from(path)
    assert found.keys() == expected.keys()
    assert {it.turn.speaker for it in found.values()} == {"unknown"}
    assert len({(it.turn.dialogue, it.turn.number) for it in found.values()}) == LESSONS
    assert "lesson 1 (word0) is kept, but not who taught it when" in done.losses


def test_a_turn_without_its_dialogue_is_kept(path: Path) -> None:
    teach(path)
    expected = lessons_of(path)
    change(path, "DELETE FROM dialogues WHERE id = 3")
    done, found = saved_from(path)
    assert all(has_same_content(found[key], expected[key]) for key in expected)
    assert done.losses == ()


def test_a_lesson_of_which_nothing_was_seen_is_told_of(path: Path) -> None:
    teach(path)
    change(path, "DELETE FROM sightings WHERE lesson = 1; DELETE FROM scans")
    done, found = saved_from(path)
    assert 1 not in found
    assert done.losses == ("lesson 1 (word0): nothing is left of what was seen",)


def test_a_lesson_without_its_place_is_kept(path: Path) -> None:
    teach(path)
    change(path, "DELETE FROM sightings WHERE lesson = 2")
    _, found = saved_from(path)
    assert isinstance(found[2].seen, Sighting)
    assert (found[2].seen.place, len(found[2].seen.scans)) == (None, 2)


def test_what_was_seen_without_its_lesson_is_told_of(path: Path) -> None:
    teach(path)
    change(path, "DELETE FROM lessons WHERE id = 2")
    done, found = saved_from(path)
    assert 2 not in found
    assert done.losses == (
        "lesson 2: what was seen is left, but not what word it taught",
    )


def test_each_lesson_that_is_damaged_is_told_of_up_to_twenty(path: Path) -> None:
    teach(path, 24)
    change(path, "UPDATE scans SET points = x'00' WHERE lesson < 4")
    assert len(check(path).faults) == 3
    change(path, "UPDATE scans SET points = x'00'")
    assert len(check(path).faults) == 20


def test_bytes_where_a_number_should_be_are_no_text(path: Path) -> None:
    teach(path)
    change(path, "UPDATE sightings SET x = x'31' WHERE lesson = 3")
    done, found = saved_from(path)
    assert done.losses == ("1 row or pages that cannot be read",)
    lesson = found[3]
    assert isinstance(lesson, ObjectLesson)
    assert lesson.seen.place is None


def test_a_lesson_that_is_damaged_is_left_out(path: Path) -> None:
    teach(path)
    change(path, "UPDATE scans SET points = x'00' WHERE lesson = 3")
    (fault,) = check(path).faults
    assert fault.startswith("lesson 3 cannot be read: ")
    done, found = saved_from(path)
    assert found.keys() == set(range(1, LESSONS + 2)) - {3, 4}
    assert [it[:20] for it in done.losses] == ["lesson 3 is damaged:"]


# What was in a table that is gone is gone; one trigger needs a view that is not there.
WHOLE = [it for it in PARTS if not it.startswith(("DROP TABLE", "CREATE TRIGGER t"))]


@pytest.mark.parametrize("harm", WHOLE)
def test_a_memory_with_strange_parts_is_saved_whole(
    harm: str, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    sound = path.parent / "sound.db"
    shutil.copy(path, sound)
    change(path, harm)
    assert check(path).faults
    _, found = saved_from(path)
    if "ADD COLUMN" not in harm:
        assert has_same_content(found[1], lessons_of(sound)[1])
    assert found[1].word.name == "cup"


@pytest.mark.parametrize("harm", ROWS)
def test_every_refusal_is_a_fault(
    harm: str, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, harm)
    assert check(path).faults
    saved_from(path)


def test_a_name_that_was_made_bytes_is_text_again(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, "UPDATE lessons SET name = CAST(name AS BLOB)")
    _, found = saved_from(path)
    assert found[1].word.name == "cup"


@pytest.mark.parametrize("key", [-1, 2**62 + 1])
def test_a_lesson_with_a_number_that_none_has_is_told_of(
    key: int, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, renumber(key))
    done, found = saved_from(path)
    assert found == {}
    assert done.losses == (f"lesson {key} (cup) has a number that kille never gives",)


@pytest.mark.parametrize("key", [0, 2**62])
def test_the_first_and_the_last_number_are_saved(
    key: int, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    change(path, f"{renumber(key)}; UPDATE sqlite_sequence SET seq = {key}")
    done, found = saved_from(path)
    assert (done.losses, set(found)) == ((), {key})


def test_a_letter_that_was_overwritten_is_a_gap(path: Path) -> None:
    teach(path)
    change(path, "UPDATE lessons SET surface = cast(x'63ff70' AS TEXT) WHERE id = 1")
    done, found = saved_from(path)
    assert found[1].word.surface == "c\N{REPLACEMENT CHARACTER}p"
    assert done.losses == ()


def test_a_name_that_was_made_a_number_is_lost_and_told_of(path: Path) -> None:
    teach(path)
    redefine(path, "lessons", "name TEXT", "name BLOB")
    change(path, "UPDATE lessons SET name = 5 WHERE id = 1")
    done, found = saved_from(path)
    assert found.keys() == set(range(2, LESSONS + 2)) - {4}
    assert done.losses == (
        "1 row or pages that cannot be read",
        "lesson 1: what was seen is left, but not what word it taught",
    )


def test_a_key_that_stands_in_a_row_as_well_is_not_believed(path: Path) -> None:
    """SQLite stores the key of a row with it, and nothing in its place in the row."""
    teach(path)
    redefine(path, "sightings", "INTEGER PRIMARY KEY REFERENCES", "INTEGER REFERENCES")
    change(path, "UPDATE sightings SET lesson = 99 WHERE rowid = 1")
    done, found = saved_from(path)
    assert done.losses == ("1 row or pages that cannot be read",)
    lessons = [it for it in found.values() if isinstance(it, ObjectLesson)]
    places = {it.key: it.seen.place for it in lessons}
    assert (places[1], places[2]) == (None, Point(0, 0, 1))


def test_a_journal_that_names_another_file_is_told_of_and_not_obeyed(
    path: Path, tmp_path: Path
) -> None:
    teach(path)
    named = tmp_path / "precious"
    named.write_text("precious")
    sound = tmp_path / "sound.db"
    shutil.copy(path, sound)
    name_in_journal(path, named)
    health = check(path)
    assert health.faults == ("it has a journal beside it that kille never writes",)
    assert health.amount is None
    assert_saved_whole(path, sound)
    assert named.read_text() == "precious"


def test_memories_of_older_versions_are_saved(path: Path) -> None:
    for make in (of_version_1, of_version_2):
        path = path.with_name(f"{make.__name__}.db")
        make(path)
        change(path, FORGETFUL)
        target = path.with_name(f"new-{path.name}")
        assert salvage(path, target).losses == ()
        with Memory.open_to_read(target) as memory:
            if make is of_version_1:
                assert_kept(memory)
            assert [it.key for it in memory.lessons()] in ([2, 3, 7], [2, 7])


def test_what_waits_in_the_log_of_a_killed_program_is_saved(
    path: Path, said: Callable[[int], Turn], seen: Sighting, tmp_path: Path
) -> None:
    killed = tmp_path / "killed" / path.name
    killed.parent.mkdir()
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        for name in (path.name, f"{path.name}-wal"):
            shutil.copy(path.with_name(name), killed.parent)
    _, found = saved_from(killed)
    assert [it.word.name for it in found.values()] == ["cup"]


def test_a_dialogue_in_which_nothing_was_said_is_saved(path: Path) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
    done, found = saved_from(path)
    assert (done.saved.dialogues, done.losses, found) == (1, (), {})


def test_nothing_is_written_over(path: Path) -> None:
    teach(path, 1)
    before = path.read_bytes()
    for target in (path, path.parent):
        with pytest.raises(MemoryFileError, match="is there already"):
            salvage(path, target)
    with pytest.raises(MemoryFileError, match="cannot be made"):
        salvage(path, path.parent / "missing" / "new.db")
    assert path.read_bytes() == before
    assert os.listdir(path.parent) == [path.name]


@pytest.mark.parametrize("content", [b"", b"diary\n" * 999, bytes(40_000)])
def test_where_nothing_is_nothing_is_saved(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "diary.txt"
    path.write_bytes(content)
    with pytest.raises(MemoryFileError, match="nothing of a kille memory"):
        salvage(path, tmp_path / "new.db")
    assert os.listdir(tmp_path) == ["diary.txt"]


def test_a_memory_that_others_may_open_is_sound_but_noted(path: Path) -> None:
    teach(path, 1)
    assert check(path).notes == ()
    path.chmod(0o644)
    health = check(path)
    assert health.faults == ()
    assert "others on this machine may open it (mode 644)" in health.notes[0]
    for bit in range(6):
        path.chmod(0o600 | 1 << bit)
        assert len(check(path).notes) == 1


def test_what_is_wrong_is_said_once(path: Path) -> None:
    teach(path)
    redefine(path, "lessons", "surface TEXT NOT NULL", "surface TEXT         ")
    change(path, "UPDATE lessons SET surface = NULL WHERE id = 2")
    redefine(path, "lessons", "surface TEXT         ", "surface TEXT NOT NULL")
    assert check(path).faults == ("its pages: NULL value in lessons.surface",)


@pytest.mark.parametrize("kept", [0.1, 0.5, 0.99])
def test_a_memory_that_was_cut_is_damaged(path: Path, kept: float) -> None:
    teach(path)
    os.truncate(path, int(kept * path.stat().st_size))
    assert check(path).faults[0].startswith(("it is damaged: ", "its pages: "))
