"""Import a package: nothing in it is trusted before it has been checked."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

from kille.memory.exporting import (
    DIALOGUES,
    FORMAT,
    LESSONS,
    TURNS,
    VERSION,
    checksum,
    place,
)
from kille.memory.lessons import (
    Dialogue,
    SeenLesson,
    Turn,
)
from kille.memory.packages import (
    MANIFEST,
    PackageError,
    PackageReader,
    open_to_read,
    report_damage,
)
from kille.memory.packing import (
    FILES,
    Line,
    unpack_dialogue,
    unpack_lesson,
    unpack_turn,
    whole,
)
from ttr.safety.inputs import parse_json, read_lines


class Package:
    """The memory in a package. Made by `open_package`, which has checked its lists.

    `dialogues` and `turns` are those of the memory, in order; each turn is of one of
    the dialogues, and no two have the same number.
    """

    def __init__(self, reader: PackageReader, path: Path) -> None:
        self._reader, self._path = reader, path
        sums = _sums(reader, path)
        self.dialogues: tuple[Dialogue, ...] = tuple(
            unpack_dialogue(_json(it)) for it in _lines(reader, DIALOGUES, sums)
        )
        turns = [unpack_turn(_json(it)) for it in _lines(reader, TURNS, sums)]
        self._turns = {(it.dialogue, it.number): it for it in turns}
        self.turns: tuple[Turn, ...] = tuple(turns)
        # A line as it is written takes far less memory than what is in it.
        lessons = ((_number(it), it) for it in _lines(reader, LESSONS, sums))
        self._lessons = sorted(lessons)
        self._check(turns)

    def lessons(self) -> Iterator[SeenLesson]:
        """All lessons, oldest first, with their pictures, each checked as it is read.

        Raises PackageError at the first that is damaged.
        """
        for _, line in self._lessons:
            with report_damage(self._path):
                lesson = self._lesson(_json(line))
            yield lesson

    def _lesson(self, line: Line) -> SeenLesson:
        key, sums = line["lesson"], line["files"]
        files = {
            name: _checked_content(self._reader, place(key, name), sums[name])
            for name in FILES & sums.keys()
        }
        return unpack_lesson(line, files, self._turns)

    def _check(self, turns: list[Turn]) -> None:
        numbers = [it.number for it in self.dialogues]
        _require_unlike("dialogue", numbers)
        _require_unlike("turn", [(it.dialogue, it.number) for it in turns])
        _require_unlike("lesson", [number for number, _ in self._lessons])
        if lost := {it.dialogue for it in turns} - set(numbers):
            raise ValueError(f"dialogue {min(lost)} is missing")


@contextmanager
def open_package(path: Path) -> Iterator[Package]:
    """Open the package at this path; each of its files has been read and checked once.

    Raises PackageError, one line, if it is damaged, of a newer version or no package.
    """
    with report_damage(path), open_to_read(path) as reader:
        package = Package(reader, path)
        for _ in package.lessons():
            pass
    with open_to_read(path) as reader:
        with report_damage(path):
            package = Package(reader, path)
        yield package


def _sums(reader: PackageReader, path: Path) -> dict[str, str]:
    """The checksums of the lists, from the manifest."""
    manifest = _json(reader.read(MANIFEST))
    if manifest["format"] != FORMAT:
        raise ValueError(f"its format is {manifest['format']}")
    if manifest["version"] not in range(1, VERSION + 1):
        raise PackageError(
            f"{path} is of version {manifest['version']} of the format, this program "
            f"knows {VERSION}: update kille"
        )
    sums: dict[str, str] = manifest["files"]
    return sums


def _lines(reader: PackageReader, name: str, sums: dict[str, str]) -> Iterator[bytes]:
    content = _checked_content(reader, name, sums[name])
    return read_lines(io.BytesIO(content))


def _number(line: bytes) -> int:
    """The number of a lesson."""
    return whole(_json(line), "lesson")


def _checked_content(reader: PackageReader, name: str, known: str) -> bytes:
    content = reader.read(name)
    if checksum(content) != known:
        raise ValueError(f"{name} is not what was exported")
    return content


def _json(content: bytes) -> Line:
    value = parse_json(content, _refuse_constant)
    if not isinstance(value, dict):
        raise TypeError(f"{content[:40]!r} is no object of JSON")
    return value


def _refuse_constant(constant: str) -> NoReturn:
    raise ValueError(f"{constant} is no number of JSON")


def _require_unlike(what: str, names: list[Any]) -> None:
    if len(set(names)) != len(names):
        raise ValueError(f"a {what} is there twice")
