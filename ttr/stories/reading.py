"""Dialogue files (`.dlg`): stories that anyone can write.

A line begins with what it is: `---` a title, `@` something that happens in the world,
`U>` what the tutor says, `S>` what the robot says then, to the letter (nothing after
it: silence), `S~` the same as a regular expression, `=` a judgement that holds of the
state, as in `= s : [shared : [latest : Learned]]`, `#` a comment. What the robot says
has to be in the story, and in that order.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

__all__ = ["Line", "Mismatch", "Story", "StoryError", "read_stories"]

_MARKS = ("---", "@", "U>", "S>", "S~", "=")


class StoryError(Exception):
    """A dialogue file that cannot be read: one line that says where and why."""


@dataclass(frozen=True)
class Line:
    """A line of a story: its place, its mark and the text after it."""

    file: str
    number: int
    mark: str
    text: str

    @property
    def place(self) -> str:
        """The file and the number of the line."""
        return f"{self.file}:{self.number}"


@dataclass(frozen=True)
class Story:
    """A titled dialogue."""

    title: str
    lines: tuple[Line, ...]


def read_stories(path: Path) -> tuple[Story, ...]:
    """The stories in a file. Raises `StoryError`.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "hello.dlg")
    ...     _ = file.write_text("--- a greeting\\nU> Hello.\\nS> Hello.\\n")
    ...     read_stories(file)[0].title
    'a greeting'
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise StoryError(f"{path} is not there") from None
    except IsADirectoryError:
        raise StoryError(f"{path} is a folder: name a .dlg file in it") from None
    except UnicodeDecodeError:
        raise StoryError(f"{path} is not a text in UTF-8") from None
    except OSError as error:
        raise StoryError(f"{path} cannot be read: {error.strerror}") from None
    stories = _stories(path, list(_lines(path, text)))
    if not stories:
        raise StoryError(f"{path} has no story: write lines such as `U> Hello.`")
    return stories


def _lines(path: Path, text: str) -> Iterator[Line]:
    for number, written in enumerate(text.splitlines(), start=1):
        line = written.strip()
        if not line or line.startswith("#"):
            continue
        mark = next((mark for mark in _MARKS if line.startswith(mark)), None)
        if mark is None:
            raise StoryError(
                f"{path}:{number}: a line begins with {', '.join(_MARKS)} or #, "
                f"but found {line[:40]!r}"
            )
        yield Line(str(path), number, mark, _content(line.removeprefix(mark)))


def _content(text: str) -> str:
    """The text of a line without the comment at its end; `#2` points and is none."""
    return re.split(r"\s#\s", f" {text}", maxsplit=1)[0].strip()


def _stories(path: Path, lines: list[Line]) -> tuple[Story, ...]:
    stories: list[Story] = []
    title, body = path.stem, list[Line]()
    for line in lines:
        if line.mark != "---":
            body.append(line)
            continue
        if body:
            stories.append(Story(title, tuple(body)))
        title, body = line.text, []
    if body:
        stories.append(Story(title, tuple(body)))
    return tuple(stories)


@dataclass(frozen=True)
class Mismatch:
    """Where a story and the robot differ: what the story has, what there was."""

    line: Line
    expected: str
    found: str

    def __str__(self) -> str:
        return (
            f"{self.line.place}\n  expected: {self.expected}\n     found: {self.found}"
        )
