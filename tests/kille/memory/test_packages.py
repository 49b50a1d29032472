"""What is exported and imported again is what it was; damage changes nothing."""

from __future__ import annotations

import io
import json
import os
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.memory import (
    Arrangement,
    Dialogue,
    Lesson,
    Memory,
    MemoryReader,
    ObjectLesson,
    RelationLesson,
    Sighting,
    Turn,
)
from kille.memory.exporting import MemorySize, export
from kille.memory.importing import open_package
from kille.memory.merging import MergeResult
from kille.memory.packages import PackageError
from kille.scene import Configuration
from ttr.safety.limits import FACTOR, Limit

from .conftest import ARRANGEMENTS, NAMES, SIGHTINGS, SURFACES, plain

PLACES = ["package.zip", "package"]


def content(memory: MemoryReader) -> object:
    """All that a memory holds, as values that can be compared."""
    return (
        memory.dialogues(),
        memory.turns(),
        [lesson_content(memory.lesson(it.key)) for it in memory.lessons()],
    )


def lesson_content(lesson: ObjectLesson | RelationLesson) -> object:
    seen = lesson.seen
    shown = plain(seen) if isinstance(seen, Sighting) else seen
    return lesson.key, lesson.word, lesson.turn, lesson.holds, shown, seen.picture


def imported(path: Path, memory: Memory) -> tuple[int, int]:
    """Imports, and says how many lessons were new and how many were not."""
    with open_package(path) as package:
        gained = memory.merge(package)
    return len(gained.lessons), gained.known


@contextmanager
def small_memory(seen: Sighting) -> Iterator[Memory]:
    """A memory of two dialogues and three lessons, the first of which is forgotten."""
    with Memory.transient() as memory:
        for began in ("2026-01-31T12:00", "2026-02-01T12:00"):
            dialogue = memory.begin_dialogue(began)
            memory.record_turn(
                Turn(dialogue, 1, "robot", "I see…\u2028a thing.", "", "")
            )
        turn = Turn(1, 2, "tutor", "This is a cup.", "s : Naming", "2026-01-31T12:01")
        memory.forget(memory.learn_object(turn, "cup", "cup", seen))
        memory.learn_object(turn, "cup", "cup", seen)
        turn = Turn(
            2, 2, "tutor", "It is left of it.", "s : Naming", "2026-02-01T12:01"
        )
        stand = Configuration((-0.1, 0.0, 0.0), contact=0.5, others=((1.0, 2.0, 3.0),))
        left = Arrangement("photo", 2.0, "cup", "box", stand)
        memory.learn_relation(turn, "left_of", "left of", left)
        yield memory


# --- laws ----------------------------------------------------------------------------


@settings(max_examples=25)
@given(
    taught=st.lists(
        st.tuples(
            st.booleans(),
            NAMES,
            SURFACES,
            SIGHTINGS | ARRANGEMENTS,
            st.sampled_from(["", "an"]),
            st.booleans(),
        ),
        max_size=4,
    ),
    place=st.sampled_from(PLACES),
)
def test_import_undoes_export(
    taught: list[tuple[bool, str, str, Sighting | Arrangement, str, bool]], place: str
) -> None:
    with tempfile.TemporaryDirectory() as folder, Memory.transient() as memory:
        dialogue = memory.begin_dialogue("now")
        for number, (new, name, text, seen, article, holds) in enumerate(taught):
            dialogue = memory.begin_dialogue("now") if new else dialogue
            turn = Turn(dialogue, number, "tutor", text, "", "now")
            told = {"article": article, "holds": holds}
            if isinstance(seen, Arrangement):
                memory.learn_relation(turn, name, text, seen, **told)
            elif number % 2:
                memory.learn_attribute(turn, name, text, seen, **told)
            else:
                memory.learn_object(turn, name, text, seen, **told)
        path = Path(folder) / place
        export(memory, path)
        before = content(memory)
        with Memory.transient() as again:
            assert imported(path, again) == (len(taught), 0)
            assert content(again) == before
            assert imported(path, again) == (0, len(taught))
            assert content(again) == before
        assert imported(path, memory) == (0, len(taught))
        assert content(memory) == before


def test_the_same_memory_gives_the_same_bytes(tmp_path: Path, seen: Sighting) -> None:
    with small_memory(seen) as memory:
        assert export(memory, tmp_path / "a.zip") == MemorySize(2, 4, 2)
        export(memory, tmp_path / "b.zip")
    assert (tmp_path / "a.zip").read_bytes() == (tmp_path / "b.zip").read_bytes()


def test_what_is_unpacked_from_a_zip_is_its_users_alone(
    tmp_path: Path, seen: Sighting
) -> None:
    with small_memory(seen) as memory:
        export(memory, tmp_path / "a.zip")
    with zipfile.ZipFile(tmp_path / "a.zip") as packed:
        assert {it.external_attr >> 16 for it in packed.infolist()} == {0o600}


@pytest.mark.skipif(os.name != "posix", reason="only POSIX can sync all files at once")
def test_a_folder_is_on_its_disk_before_it_has_its_name(
    tmp_path: Path, seen: Sighting, monkeypatch: pytest.MonkeyPatch
) -> None:
    named: list[bool] = []
    monkeypatch.setattr(os, "sync", lambda: named.append((tmp_path / "a").exists()))
    with small_memory(seen) as memory:
        export(memory, tmp_path / "a")
    assert named == [False]
    assert (tmp_path / "a").is_dir()


def test_others_can_read_it(tmp_path: Path, seen: Sighting) -> None:
    with small_memory(seen) as memory:
        export(memory, tmp_path / "a.zip")
        export(memory, tmp_path / "a")
    with zipfile.ZipFile(tmp_path / "a.zip") as packed:
        for name in packed.namelist():
            assert packed.read(name) == (tmp_path / "a" / name).read_bytes()
        lines = packed.read("lessons.jsonl").decode().split("\n")
        cup, left = map(json.loads, lines[:-1])
        features = np.load(io.BytesIO(packed.read("lessons/2/features.npz")))
        depth = packed.read("lessons/2/depth.png")
    assert (cup["lesson"], cup["name"], cup["kind"]) == (2, "cup", "object")
    assert cup["place"] == list(seen.place or ())
    assert (features["descriptors_1"] == seen.scans[1].descriptors).all()
    assert (features["trait_size"] == seen.traits["size"]).all()
    assert seen.picture is not None
    assert seen.picture.crop is not None
    assert depth == seen.picture.crop.depth
    assert (left["target"], left["landmark"], left["turn"]) == ("cup", "box", 2)
    assert left["configuration"]["contact"] == 0.5


# --- merging -------------------------------------------------------------------------


def test_two_memories_become_one(tmp_path: Path, seen: Sighting) -> None:
    path = tmp_path / "other.zip"
    with small_memory(seen) as other:
        export(other, path)
    with Memory.transient() as memory:
        dialogue = memory.begin_dialogue("2025-01-01T12:00")
        turn = Turn(dialogue, 1, "tutor", "This is a book.", "", "2025-01-01T12:01")
        memory.learn_object(turn, "book", "book", seen)
        assert imported(path, memory) == (2, 0)
        assert imported(path, memory) == (0, 2)
        assert [it.number for it in memory.dialogues()] == [1, 2, 3]
        lessons = memory.lessons()
        assert [it.word.name for it in lessons] == ["book", "cup", "left_of"]
        assert [it.key for it in lessons] == [1, 2, 3]
        assert [it.turn.dialogue for it in lessons] == [1, 2, 3]
        assert len(memory.turns()) == 5


def test_a_dialogue_that_went_on_is_the_same(tmp_path: Path, seen: Sighting) -> None:
    path = tmp_path / "later.zip"
    with small_memory(seen) as memory, small_memory(seen) as later:
        turn = Turn(2, 3, "tutor", "This is a book.", "", "2026-02-01T12:02")
        later.learn_object(turn, "book", "book", seen)
        export(later, path)
        assert imported(path, memory) == (1, 2)
        assert content(memory) == content(later)


def test_a_dialogue_of_another_robot_at_the_same_time_is_another(
    tmp_path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    path = tmp_path / "other.zip"
    with Memory.transient() as memory, Memory.transient() as other:
        for it, word in ((memory, "cup"), (other, "mug")):
            it.begin_dialogue("now")
            it.learn_object(replace(said(1), text=word), word, word, seen)
        export(other, path)
        assert imported(path, memory) == (1, 0)
        assert [it.text for it in memory.turns()] == ["cup", "mug"]
        assert len(memory.dialogues()) == 2


def test_a_dialogue_is_one_of_ours_only_once(tmp_path: Path) -> None:
    """Two dialogues there that look like one of ours are not both it."""
    path = tmp_path / "other.zip"
    with Memory.transient() as memory, Memory.transient() as other:
        memory.begin_dialogue("now")
        for _ in range(2):
            other.begin_dialogue("now")
        export(other, path)
        for _ in range(2):
            imported(path, memory)
            assert [it.began for it in memory.dialogues()] == ["now", "now"]


def test_a_denial_is_not_the_lesson_that_it_denies(
    tmp_path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    path = tmp_path / "other.zip"
    with Memory.transient() as memory, Memory.transient() as other:
        for it, holds in ((memory, True), (other, False)):
            it.begin_dialogue("now")
            it.learn_object(said(1), "cup", "cup", seen, holds=holds)
        export(other, path)
        assert imported(path, memory) == (1, 0)
        assert [it.holds for it in memory.lessons()] == [True, False]


def test_a_turn_that_taught_a_word_of_two_things_taught_it_twice(
    tmp_path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    """ "These are cups." may be known of one of them already."""
    path = tmp_path / "other.zip"
    with Memory.transient() as memory, Memory.transient() as other:
        for it, things in ((memory, 1), (other, 2)):
            it.begin_dialogue("now")
            for _ in range(things):
                it.learn_object(said(1), "cup", "cup", seen)
        export(other, path)
        assert imported(path, memory) == (1, 1)
        assert imported(path, memory) == (0, 2)
        assert len(memory.lessons()) == 2


def test_of_two_dialogues_the_one_with_more_in_common_is_the_same(
    tmp_path: Path, said: Callable[[int], Turn], seen: Sighting
) -> None:
    path = tmp_path / "other.zip"
    with Memory.transient() as memory, Memory.transient() as other:
        for turns in ((1,), (1, 2, 3), (1, 2)):
            dialogue = memory.begin_dialogue("now")
            for number in turns:
                memory.record_turn(replace(said(number), dialogue=dialogue))
        other.begin_dialogue("now")
        for number in (1, 2, 3):
            other.record_turn(said(number))
        other.learn_object(said(4), "cup", "cup", seen)
        export(other, path)
        assert imported(path, memory) == (1, 0)
        assert memory.lessons()[0].turn.dialogue == 2
        assert len(memory.dialogues()) == 3


@dataclass(frozen=True)
class Elsewhere:
    """A memory that begins with its seventh dialogue."""

    dialogues: tuple[Dialogue, ...] = (Dialogue(7, "now"),)
    turns: tuple[Turn, ...] = (Turn(7, 1, "tutor", "Hello.", "", "now"),)

    def lessons(self) -> Iterator[ObjectLesson | RelationLesson]:
        return iter(())


def test_dialogues_keep_their_numbers_in_an_empty_memory_alone() -> None:
    with Memory.transient() as memory:
        memory.merge(Elsewhere())
        assert [it.number for it in memory.dialogues()] == [7]
        assert [it.dialogue for it in memory.turns()] == [7]
    with Memory.transient() as memory:
        memory.begin_dialogue("before")
        memory.merge(Elsewhere())
        assert [it.number for it in memory.dialogues()] == [1, 2]


def test_what_a_memory_gains_is_counted(tmp_path: Path, seen: Sighting) -> None:
    path = tmp_path / "other.zip"
    with small_memory(seen) as other, Memory.transient() as memory:
        export(other, path)
        memory.begin_dialogue("before")
        with open_package(path) as package:
            assert memory.merge(package) == MergeResult(2, 4, (2, 3), 0)
        with open_package(path) as package:
            assert memory.merge(package) == MergeResult(0, 0, (), 2)


def test_what_was_forgotten_can_be_brought_back(tmp_path: Path, seen: Sighting) -> None:
    path = tmp_path / "before.zip"
    with small_memory(seen) as memory:
        export(memory, path)
        memory.forget(2)
        assert imported(path, memory) == (1, 1)
        brought: Lesson = memory.lessons()[-1]
        assert (brought.word.name, brought.key) == ("cup", 4)


# --- what can go wrong ---------------------------------------------------------------


def refusal(path: Path) -> str:
    """The line that refuses this package."""
    with pytest.raises(PackageError) as caught, open_package(path):
        pass
    line = str(caught.value)
    assert "\n" not in line
    assert line.startswith(str(path))
    return line


@pytest.fixture
def folder(tmp_path: Path, seen: Sighting) -> Path:
    with small_memory(seen) as memory:
        export(memory, tmp_path / "package")
    return tmp_path / "package"


FILES = [
    "memory.json",
    "dialogues.jsonl",
    "turns.jsonl",
    "lessons.jsonl",
    "lessons/2/features.npz",
    "lessons/2/frame.jpg",
    "lessons/2/crop.jpg",
    "lessons/2/mask.png",
    "lessons/2/depth.png",
]


def test_these_are_the_files(folder: Path) -> None:
    found = {it.relative_to(folder).as_posix() for it in folder.rglob("*.*")}
    assert found == set(FILES)


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_missing_or_changed_is_damage(folder: Path, name: str) -> None:
    file = folder / name
    original = file.read_bytes()
    middle = len(original) // 2
    changed = original[:middle] + b"\x00" + original[middle + 1 :]
    for bad in (b"", original[:middle], changed):
        file.write_bytes(bad)
        assert "is damaged" in refusal(folder)
    file.unlink()
    assert "is damaged" in refusal(folder)
    file.write_bytes(original)
    with open_package(folder) as package:
        assert len(list(package.lessons())) == 2


def memory_or_line(path: Path, memory: Memory) -> object:
    """What the memory holds after an import, or the line that refuses it."""
    try:
        imported(path, memory)
    except PackageError as error:
        return str(error)
    return content(memory)


def test_a_zip_with_any_part_changed_is_damaged_or_the_same(
    tmp_path: Path, seen: Sighting
) -> None:
    path = tmp_path / "package.zip"
    with small_memory(seen) as memory:
        export(memory, path)
        before = content(memory)
    original = path.read_bytes()
    for at in np.random.default_rng(3).integers(0, len(original), 60).tolist():
        damaged = bytearray(original)
        damaged[at] ^= 0xFF
        path.write_bytes(damaged)
        with Memory.transient() as again:
            found = memory_or_line(path, again)
            # Some bytes say nothing that is read, as in a date.
            assert found == before or (
                "\n" not in str(found) and again.dialogues() == ()
            )
    for share in (0.0, 0.3, 0.9, 0.999):
        path.write_bytes(original[: int(share * len(original))])
        assert "is damaged" in refusal(path)


def rewritten(
    folder: Path,
    name: str,
    change: Callable[[dict], object],
    reword: Callable[[str], str] = str,
) -> None:
    """Changes the first line of a list, checksum and all; `reword` changes its text."""
    first, *rest = (folder / name).read_text("utf-8").split("\n")
    line = json.loads(first)
    change(line)
    relist(folder, name, "\n".join([reword(json.dumps(line)), *rest]))


def relist(folder: Path, name: str, text: str) -> None:
    """Put another list into a package, checksum and all."""
    (folder / name).write_text(text, "utf-8")
    manifest = json.loads((folder / "memory.json").read_text())
    manifest["files"][name] = sha256(text.encode()).hexdigest()
    (folder / "memory.json").write_text(json.dumps(manifest))


@pytest.mark.parametrize("what", ["dialogue", "turn", "lesson"])
def test_nothing_is_in_a_package_twice(folder: Path, what: str) -> None:
    name = f"{what}s.jsonl"
    lines = (folder / name).read_text("utf-8").split("\n")[:-1]
    relist(folder, name, "\n".join([*lines, lines[-1]]))
    assert f"a {what} is there twice" in refusal(folder)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("turns.jsonl", {"dialogue": 7}),
        ("turns.jsonl", {"dialogue": True}),
        ("turns.jsonl", {"number": 2}),
        ("turns.jsonl", {"number": 2**53 + 1}),
        ("turns.jsonl", {"number": 2**63}),
        ("turns.jsonl", {"text": None}),
        ("turns.jsonl", {"text": "\ud800"}),
        ("dialogues.jsonl", {"dialogue": 2}),
        ("dialogues.jsonl", {"dialogue": -1}),
        ("dialogues.jsonl", {"began": 3}),
        ("lessons.jsonl", {"lesson": "../2"}),
        ("lessons.jsonl", {"lesson": 3}),
        ("lessons.jsonl", {"turn": 9}),
        ("lessons.jsonl", {"kind": "verb"}),
        ("lessons.jsonl", {"kind": "relation"}),
        ("lessons.jsonl", {"kind": ["object"]}),
        ("lessons.jsonl", {"holds": 1}),
        ("lessons.jsonl", {"article": None}),
        ("lessons.jsonl", {"time": float("nan")}),
        ("lessons.jsonl", {"place": [0, 1]}),
        ("lessons.jsonl", {"place": [0, 1, "x"]}),
        ("lessons.jsonl", {"picture": {"boxes": 3}}),
        ("lessons.jsonl", {"files": {}}),
        ("lessons.jsonl", {"files": []}),
    ],
    ids=str,
)
def test_what_no_memory_could_hold_is_refused(
    folder: Path, name: str, change: dict[str, object]
) -> None:
    rewritten(folder, name, lambda line: line.update(change))
    assert "is damaged" in refusal(folder)


def test_what_a_package_says_is_told_in_short(folder: Path) -> None:
    kind = "verb\n\x1b[31m" * 99
    rewritten(folder, "lessons.jsonl", lambda line: line.update(kind=kind))
    line = refusal(folder)
    assert "(there are no lessons of the kind verb" in line
    assert line.isprintable()
    assert len(line) < len(str(folder)) + 200


@pytest.mark.parametrize("bad", ["1e999", "-1e999", "1" + 400 * "0"])
def test_numbers_that_no_memory_can_keep_are_refused(folder: Path, bad: str) -> None:
    def change(line: dict) -> None:
        line["picture"]["intrinsics"]["fx"] = "BAD"

    rewritten(folder, "lessons.jsonl", change, lambda text: text.replace('"BAD"', bad))
    assert "is damaged" in refusal(folder)


@pytest.mark.parametrize(
    "wrong",
    [
        {"offset": "abc"},
        {"offset": ["0", 0, 0]},
        {"offset": [0, 0]},
        {"offset": None},
        {"viewed": [1]},
        {"viewed": 1},
        {"others": [[1]]},
        {"others": [3]},
        {"others": {}},
        {"others": ""},
        {"target_size": "large"},
        {"heading": {}},
        {"contact": True},
    ],
    ids=str,
)
def test_what_is_no_configuration_is_refused(
    folder: Path, wrong: dict[str, object]
) -> None:
    stand = {"offset": [0.1, 0, 0]} | wrong
    more = {"kind": "relation", "target": "cup", "landmark": "car"}
    change = more | {"configuration": stand}
    rewritten(folder, "lessons.jsonl", lambda line: line.update(change))
    assert "is damaged" in refusal(folder)


def test_files_that_we_do_not_know_are_passed_over(folder: Path) -> None:
    (folder / "notes.txt").write_text("mine")
    rewritten(
        folder,
        "lessons.jsonl",
        lambda line: line["files"].update({"../x": "0", "y": "0"}),
    )
    with open_package(folder) as package:
        assert len(list(package.lessons())) == 2


def test_whole_numbers_that_every_program_reads_are_kept(folder: Path) -> None:
    rewritten(folder, "turns.jsonl", lambda line: line.update(number=2**53))
    with open_package(folder) as package:
        assert 2**53 in {it.number for it in package.turns}


def test_another_format_is_named(folder: Path) -> None:
    manifest = json.loads((folder / "memory.json").read_text())
    (folder / "memory.json").write_text(json.dumps(manifest | {"format": "diary"}))
    assert "its format is diary" in refusal(folder)


def test_a_newer_format_is_named(folder: Path) -> None:
    manifest = json.loads((folder / "memory.json").read_text())
    (folder / "memory.json").write_text(json.dumps(manifest | {"version": 5}))
    assert "update kille" in refusal(folder)


def test_a_package_of_the_first_version_is_read(folder: Path) -> None:
    """It says nothing of articles, nor of what words do not hold of."""
    listed = folder / "lessons.jsonl"
    lines = [json.loads(it) for it in listed.read_text("utf-8").splitlines()]
    for line in lines:
        del line["article"], line["holds"]
    text = "".join(f"{json.dumps(line)}\n" for line in lines)
    relist(folder, "lessons.jsonl", text)
    manifest = json.loads((folder / "memory.json").read_text())
    (folder / "memory.json").write_text(json.dumps(manifest | {"version": 1}))
    with open_package(folder) as package, Memory.transient() as memory:
        memory.merge(package)
        assert all(it.holds and it.word.article == "" for it in memory.lessons())
        assert [it.word.name for it in memory.lessons()] == ["cup", "left_of"]


@pytest.mark.parametrize("bytes_", [b"", b"PK", b"Dear diary, " * 99])
def test_another_file_is_refused(tmp_path: Path, bytes_: bytes) -> None:
    path = tmp_path / "diary.zip"
    path.write_bytes(bytes_)
    assert "no exported memory" in refusal(path)


def test_what_is_not_there_cannot_be_read(tmp_path: Path) -> None:
    assert "cannot be read" in refusal(tmp_path / "none.zip")
    assert "no exported memory" in refusal(tmp_path)


def test_what_is_not_ours_is_not_replaced(tmp_path: Path, seen: Sighting) -> None:
    diary, folder = tmp_path / "diary.zip", tmp_path / "folder"
    diary.write_text("Dear diary")
    folder.mkdir()
    (folder / "file").touch()
    with small_memory(seen) as memory:
        for path in (diary, folder):
            with pytest.raises(PackageError, match="left alone"):
                export(memory, path)
        with pytest.raises(PackageError, match="cannot be written"):
            export(memory, diary / "package.zip")
        for path in (Path("."), Path("/")):
            with pytest.raises(PackageError, match="left alone"):
                export(memory, path)
    assert diary.read_text() == "Dear diary"
    assert {it.name for it in tmp_path.rglob("*")} == {"diary.zip", "folder", "file"}


def test_a_link_goes_on_leading_where_it_leads(tmp_path: Path, seen: Sighting) -> None:
    link, target = tmp_path / "link.zip", tmp_path / "packages.zip"
    link.symlink_to(target)
    with small_memory(seen) as memory:
        export(memory, link)
        export(memory, link)
    assert link.is_symlink()
    with open_package(target) as package:
        assert len(list(package.lessons())) == 2


@pytest.mark.skipif(os.name != "posix", reason="names are not put on disk elsewhere")
@pytest.mark.parametrize("place", PLACES)
def test_the_name_of_a_package_is_on_disk_when_it_is_there(
    tmp_path: Path, seen: Sighting, place: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    on_disk: list[list[str]] = []
    fsync = os.fsync

    def watch(opened: int) -> None:
        fsync(opened)
        if os.path.samestat(os.fstat(opened), os.stat(tmp_path)):
            on_disk.append(os.listdir(tmp_path))

    monkeypatch.setattr(os, "fsync", watch)
    with small_memory(seen) as memory:
        export(memory, tmp_path / place)
    assert on_disk == [[place]]


def test_an_older_export_is_replaced_wholly_or_not_at_all(
    tmp_path: Path, seen: Sighting, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "package.zip"
    with small_memory(seen) as memory:
        export(memory, path)
        before = path.read_bytes()
        memory.forget(2)

        def full(_: int) -> None:
            raise OSError(28, "No space left on device")

        with monkeypatch.context() as patched:
            patched.setattr(os, "fsync", full)
            with pytest.raises(PackageError, match="No space left"):
                export(memory, path)
        assert path.read_bytes() == before
        assert [it.name for it in tmp_path.iterdir()] == ["package.zip"]
        export(memory, path)
        with open_package(path) as package:
            assert [it.word.name for it in package.lessons()] == ["left_of"]


def test_a_memory_that_fails_while_it_learns_is_as_it_was(
    tmp_path: Path, path: Path, seen: Sighting
) -> None:
    large = replace(seen, scans=10 * seen.scans)
    with small_memory(large) as other:
        export(other, tmp_path / "package.zip")
    with Memory.open(path) as memory, open_package(tmp_path / "package.zip") as package:
        connection = memory._connection
        (pages,) = connection.execute("PRAGMA page_count").fetchone()
        connection.execute(f"PRAGMA max_page_count = {pages}")
        with pytest.raises(Exception, match="disk is full"):
            memory.merge(package)
        assert (memory.dialogues(), memory.lessons()) == ((), ())


# --- limits --------------------------------------------------------------------------


def refused(path: Path) -> str:
    with pytest.raises(PackageError) as caught, open_package(path):
        pass
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("place", PLACES)
def test_a_file_of_a_package_is_no_larger_than_it_may_be(
    tmp_path: Path, place: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / place
    with Memory.transient() as memory:
        dialogue = memory.begin_dialogue("2026-01-31T12:00")
        memory.record_turn(Turn(dialogue, 1, "robot", "I see a thing. " * 99, "", ""))
        export(memory, path)
    with open_package(path) as package:
        assert len(package.turns) == 1
    few = Limit(1000, "bytes")
    monkeypatch.setattr("kille.memory.packages.MEMBER", few)
    assert "and no more than 1 kB are read" in refused(path)


def test_a_zip_holds_no_more_than_it_may_in_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "package.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for number in range(3):
            archive.writestr(f"{number}", bytes(500))
    monkeypatch.setattr("kille.memory.packages.PACKAGE", Limit(1000, "bytes"))
    assert "it has 1.5 kB, and no more than 1 kB are read" in refused(path)


def test_a_file_that_unpacks_to_more_than_memory_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "package.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("memory.json", bytes(65_000_000))
    assert "it has 65 MB, and no more than 64 MB are read" in refused(path)


@pytest.mark.parametrize("made", ["pipe", "loop", "device", "folder"])
def test_what_is_no_file_is_no_part_of_a_package(
    tmp_path: Path, made: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(FACTOR, "0.005")
    part = tmp_path / "memory.json"
    match made:
        case "pipe":
            os.mkfifo(part)
        case "loop":
            part.symlink_to(part)
        case "device":
            part.symlink_to("/dev/zero")
        case "folder":
            part.mkdir()
    assert "cannot be read" in refused(tmp_path)


def test_the_names_in_a_zip_lead_nowhere(tmp_path: Path) -> None:
    path = tmp_path / "inner" / "package.zip"
    path.parent.mkdir()
    with Memory.transient() as memory:
        memory.begin_dialogue("2026-01-31T12:00")
        export(memory, path)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("../outside", "x")
        link = zipfile.ZipInfo("link")
        link.external_attr = 0o120777 << 16
        archive.writestr(link, "/etc/passwd")
    with open_package(path) as package:
        assert len(package.dialogues) == 1
    assert [it.name for it in tmp_path.rglob("*")] == ["inner", "package.zip"]


@pytest.mark.parametrize("line", [b"[" * 100_000, b'{"dialogue":' + b"9" * 6000 + b"}"])
def test_lines_of_a_package_nest_and_count_only_so_far(
    tmp_path: Path, line: bytes
) -> None:
    path = tmp_path / "package"
    with Memory.transient() as memory:
        export(memory, path)
    manifest = json.loads((path / "memory.json").read_bytes())
    (path / "dialogues.jsonl").write_bytes(line)
    manifest["files"]["dialogues.jsonl"] = sha256(line).hexdigest()
    (path / "memory.json").write_text(json.dumps(manifest))
    assert "is damaged, or is no exported memory" in refused(path)
