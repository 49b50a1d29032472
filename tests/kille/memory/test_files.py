"""Every way in which a file can fail a memory ends in one clear line."""

from __future__ import annotations

import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from kille.memory import Memory, MemoryFileError, Sighting, Turn, Word, default_path


def refusal(opening: Callable[[Path], object], path: Path) -> str:
    """The line that refuses this file: it names the file and a way out."""
    with pytest.raises(MemoryFileError) as caught:
        opening(path)
    line = str(caught.value)
    assert "\n" not in line
    assert line.startswith(str(path))
    assert ":" in line.removeprefix(str(path))
    return line


def taught(path: Path, turn: Turn, seen: Sighting) -> None:
    """Make a memory that knows one word."""
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.learn_object(turn, "cup", "cup", seen)


def test_the_user_chooses_the_file(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("KILLE_MEMORY", "~/robot.db")
    assert default_path() == tmp_path / "robot.db"
    monkeypatch.delenv("KILLE_MEMORY")
    assert default_path().name == "memory.db"
    assert default_path().parent.name == "kille"


def test_a_closed_memory_is_one_file(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    assert [file.name for file in path.parent.iterdir()] == ["memory.db"]


def test_the_folders_of_a_memory_are_made(tmp_path: Path) -> None:
    path = tmp_path / "new" / "robots" / "memory.db"
    Memory.open(path).close()
    Memory.open(path).close()
    assert path.is_file()


def test_an_odd_name_is_just_a_name(tmp_path: Path) -> None:
    path = tmp_path / "mein gedächtnis?mode=ro#1%41.db"
    Memory.open(path).close()
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("opening", [Memory.open, Memory.open_to_read])
@pytest.mark.parametrize(
    "content",
    [b"x", b"short", b"dear diary\n" * 400, b"\x89PNG\r\n\x1a\n" + bytes(5000)],
    ids=["byte", "word", "text", "picture"],
)
def test_another_file_is_refused_and_left_alone(
    opening: Callable[[Path], object], content: bytes, tmp_path: Path
) -> None:
    path = tmp_path / "notes"
    path.write_bytes(content)
    assert "is not a kille memory" in refusal(opening, path)
    assert path.read_bytes() == content
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("opening", [Memory.open, Memory.open_to_read])
def test_the_database_of_another_program_is_refused_and_left_alone(
    opening: Callable[[Path], object], tmp_path: Path
) -> None:
    path = tmp_path / "places.sqlite"
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE lessons (id INTEGER)")
    before = path.read_bytes()
    assert "another program" in refusal(opening, path)
    assert path.read_bytes() == before


@pytest.mark.parametrize("opening", [Memory.open, Memory.open_to_read])
def test_a_folder_is_refused(opening: Callable[[Path], object], tmp_path: Path) -> None:
    assert "is a folder" in refusal(opening, tmp_path)


def test_a_file_in_place_of_the_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    line = refusal(Memory.open, tmp_path / "file" / "memory.db")
    assert "is no folder" in line


def test_a_folder_that_cannot_be_made_is_named() -> None:
    assert "is no folder" in refusal(Memory.open, Path("/proc/kille/memory.db"))


def test_a_file_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    path = tmp_path / f"{'n' * 300}.db"
    with pytest.raises(MemoryFileError) as caught:
        Memory.open(path)
    assert str(caught.value).startswith(f"{path} cannot be opened, or its folder not")
    assert list(tmp_path.iterdir()) == []


def test_reading_makes_no_file(path: Path) -> None:
    assert "does not exist" in refusal(Memory.open_to_read, path)
    assert not path.parent.exists()


@pytest.mark.parametrize("opening", [Memory.open, Memory.open_to_read])
@pytest.mark.parametrize("at", [0.3, 0.6, 0.9])
def test_a_file_that_was_cut_is_damaged(
    opening: Callable[[Path], object],
    at: float,
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
) -> None:
    taught(path, said(1), seen)
    os.truncate(path, int(path.stat().st_size * at))
    assert "is damaged" in refusal(opening, path)


@pytest.mark.parametrize("opening", [Memory.open, Memory.open_to_read])
def test_a_file_with_pages_overwritten_is_damaged(
    opening: Callable[[Path], object],
    path: Path,
    said: Callable[[int], Turn],
    seen: Sighting,
) -> None:
    taught(path, said(1), seen)
    with path.open("r+b") as file:
        file.seek(3 * 4096)
        file.write(b"\xff" * 4096)
    assert "is damaged" in refusal(opening, path)


@pytest.mark.parametrize(
    "harm",
    [
        "UPDATE scans SET points = x'00'",
        "UPDATE scans SET descriptors = x''",
        "UPDATE traits SET vector = x'0000c07f'",
        "UPDATE traits SET vector = x'00'",
        "UPDATE sightings SET x = 9e999",
        "UPDATE pictures SET frame = x'00'",
        "UPDATE pictures SET boxes = '[['",
        "UPDATE crops SET intrinsics = '[1]'",
    ],
)
def test_a_lesson_that_is_none_any_more_is_damage(
    harm: str, path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    taught(path, said(1), seen)
    with closing(sqlite3.connect(path)) as connection:
        connection.executescript(harm)
    with Memory.open_to_read(path) as memory:
        assert "is damaged" in refusal(lambda _: memory.lesson(1), path)
        assert len(memory.turns()) == 1


def test_a_memory_has_one_owner(path: Path) -> None:
    with Memory.open(path):
        assert "in use" in refusal(Memory.open, path)
    Memory.open(path).close()


def test_an_owner_keeps_the_file_after_each_lesson(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        with pytest.raises(ValueError, match="never began"):
            memory.record_turn(Turn(9, 1, "tutor", "Hello.", "", "now"))
        assert "in use" in refusal(Memory.open, path)


def test_the_death_of_the_owner_frees_the_file(path: Path) -> None:
    owning = (
        "import sys, pathlib, kille.memory\n"
        "memory = kille.memory.Memory.open(pathlib.Path(sys.argv[1]))\n"
        "print('open', flush=True)\n"
        "sys.stdin.read()\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", owning, str(path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as owner:
        assert owner.stdout is not None
        assert owner.stdout.readline() == b"open\n"
        assert "in use" in refusal(Memory.open, path)
        owner.kill()
    Memory.open(path).close()


def test_one_may_read_while_another_writes(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory, Memory.open_to_read(path) as reader:
        memory.begin_dialogue("now")
        assert reader.words() == ()
        memory.learn_object(said(1), "cup", "cup", seen)
        assert reader.words() == (Word("cup", "cup", "object"),)
        assert next(reader.objects()).seen.place == seen.place


def test_a_full_disk_refuses_the_whole_lesson(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with Memory.open(path) as memory:
        memory.begin_dialogue("now")
        connection, seen = memory._connection, replace(seen, scans=10 * seen.scans)
        (pages,) = connection.execute("PRAGMA page_count").fetchone()
        connection.execute(f"PRAGMA max_page_count = {pages}")
        line = refusal(lambda _: memory.learn_object(said(1), "cup", "cup", seen), path)
        assert "disk is full" in line
        assert (memory.words(), memory.turns()) == ((), ())
        connection.execute("PRAGMA max_page_count = 4294967294")
        memory.learn_object(said(1), "cup", "cup", seen)
        assert len(memory.lessons()) == 1


AS_NOBODY = """
import os, pathlib, sys
from kille.memory import Memory, MemoryFileError
how, path = sys.argv[1], pathlib.Path(sys.argv[2])
path.as_uri()  # imports what it needs while the library may still be read
if os.getuid() == 0:
    os.setgroups([])
    os.setgid(65534)
    os.setuid(65534)
try:
    memory = getattr(Memory, how)(path)
except MemoryFileError as error:
    print(error)
else:
    print(len(memory.words()))
    memory.close()
"""


def as_nobody(how: str, path: Path) -> str:
    """What someone without rights sees who opens or reads this file."""
    run = subprocess.run(
        [sys.executable, "-c", AS_NOBODY, how, str(path)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stderr == ""
    return run.stdout


@pytest.fixture
def protected(said: Callable[[int], Turn], seen: Sighting) -> object:
    """A memory that all may read, in a folder that all may enter, nothing more."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "memory.db"
        taught(path, said(1), seen)
        path.chmod(0o444)
        path.parent.chmod(0o555)
        yield path
        path.parent.chmod(0o755)


def test_a_file_in_a_folder_that_cannot_be_written_is_refused(protected: Path) -> None:
    line = as_nobody("open", protected)
    assert line.startswith(str(protected))
    assert "or its folder is: make both writable" in line


def test_a_new_file_in_a_folder_that_cannot_be_written_is_refused(
    protected: Path,
) -> None:
    line = as_nobody("open", protected.with_name("new.db"))
    assert "cannot be opened, or its folder not written" in line
    assert not protected.with_name("new.db").exists()


def test_a_read_only_file_is_refused_before_anything_is_taught(
    protected: Path,
) -> None:
    protected.parent.chmod(0o777)
    assert f"{protected} is read-only, " in as_nobody("open", protected)


def test_a_file_that_may_not_be_read_is_refused(protected: Path) -> None:
    protected.parent.chmod(0o755)
    protected.chmod(0o000)
    for how in ("open", "open_to_read"):
        assert "cannot be opened" in as_nobody(how, protected)


def test_a_memory_on_a_read_only_medium_can_be_read(protected: Path) -> None:
    assert as_nobody("open_to_read", protected) == "1\n"


def test_a_log_that_cannot_be_read_is_not_passed_over(
    path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    with tempfile.TemporaryDirectory() as folder, Memory.open(path) as memory:
        memory.begin_dialogue("now")
        memory.learn_object(said(1), "cup", "cup", seen)
        killed = Path(folder) / path.name
        for name in (path.name, f"{path.name}-wal"):
            shutil.copy(path.with_name(name), folder)
            killed.with_name(name).chmod(0o644)  # the file itself may be read
        killed.parent.chmod(0o555)
        assert "or its folder not written" in as_nobody("open_to_read", killed)
        killed.parent.chmod(0o755)
        with Memory.open_to_read(killed) as reader:
            assert reader.words() == (Word("cup", "cup", "object"),)
