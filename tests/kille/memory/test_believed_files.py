"""A file that was right and has not changed is not checked again, and any other is."""

from __future__ import annotations

import os
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest

from kille.memory import Memory, MemoryFileError, Sighting, Turn, believed_files
from kille.memory.believed_files import believe, fingerprint, is_believed

from .test_files import refusal, taught

pytestmark = pytest.mark.skipif(os.name != "posix", reason="nothing is believed here")


@pytest.fixture(autouse=True)
def _believe_small_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setattr(believed_files, "SMALLEST", 1)


def is_right(path: Path) -> bool:
    return is_believed(path, fingerprint(path))


def damage(path: Path) -> None:
    """Overwrite the page in which the turns are."""
    with closing(sqlite3.connect(path)) as connection:
        query = "SELECT rootpage FROM sqlite_master WHERE name = 'turns'"
        (page,) = connection.execute(query).fetchone()
        (size,) = connection.execute("PRAGMA page_size").fetchone()
    with path.open("r+b") as file:
        file.seek((page - 1) * size)
        file.write(b"\xff" * 200)


@pytest.fixture
def there(path: Path, said: Callable[[int], Turn], seen: Sighting) -> Path:
    """A memory that knows a word."""
    taught(path, said(1), seen)
    return path


def test_what_a_robot_leaves_is_believed(there: Path) -> None:
    assert is_right(there)


def test_what_was_found_right_is_believed(there: Path) -> None:
    believed_files.doubt(there)
    assert not is_right(there)
    Memory.open_to_read(there).close()
    assert is_right(there)


def test_a_changed_file_is_checked(there: Path) -> None:
    when = there.stat()
    damage(there)
    os.utime(there, ns=(when.st_atime_ns, when.st_mtime_ns))
    assert not is_right(there)
    assert "is damaged" in refusal(Memory.open, there)


def test_a_copy_is_checked(there: Path, tmp_path: Path) -> None:
    copy = shutil.copy2(there, tmp_path / "copy.db")
    assert not is_right(copy)
    os.replace(copy, there)
    assert not is_right(there)


def test_a_file_with_a_log_is_checked(there: Path) -> None:
    killed = (
        "import os, pathlib, sys; from kille.memory import Memory;"
        "memory = Memory.open(pathlib.Path(sys.argv[1]));"
        "memory.begin_dialogue('later'); os._exit(1)"
    )
    subprocess.run([sys.executable, "-c", killed, str(there)], check=False)
    assert fingerprint(there) is None
    with Memory.open(there) as memory:
        assert [it.began for it in memory.dialogues()] == ["now", "later"]
    assert is_right(there)


def test_damage_is_told_when_it_is_read_and_found_by_the_next(there: Path) -> None:
    damage(there)
    believe(there, fingerprint(there))  # as if a disk had changed what it holds
    with Memory.open(there) as memory:
        with pytest.raises(MemoryFileError, match=r"is damaged: kille memory check"):
            memory.turns()
        assert not is_right(there)
    assert not is_right(there)
    assert "is damaged" in refusal(Memory.open, there)


def test_what_is_not_of_our_making_is_refused_however_believed(there: Path) -> None:
    with closing(sqlite3.connect(there)) as connection:
        connection.execute("CREATE VIEW more AS SELECT 1")
        connection.commit()
    believe(there, fingerprint(there))
    assert "a view that kille never makes" in refusal(Memory.open, there)


def test_few_marks_are_kept(there: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(believed_files, "MOST", 2)
    for number in range(4):
        Memory.open(there.with_name(f"{number}.db")).close()
    marks = list((Path(os.environ["XDG_CACHE_HOME"]) / "kille").rglob("*"))
    assert sum(it.is_file() for it in marks) == 2
    assert is_right(there.with_name("3.db"))


def test_where_no_mark_can_be_kept_the_file_is_checked(
    there: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "no folder").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "no folder"))
    Memory.open(there).close()
    assert not is_right(there)
    Memory.open(there).close()
