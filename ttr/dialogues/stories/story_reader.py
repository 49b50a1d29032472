"""Reading dialogue files (`.dlg`): stories that anyone can write.

A line begins with what it is: `---` a title, `@` something that happens in the world or
a setting, `U>` what is said to the system, `U~` what was perhaps said, with
probabilities, `S>` what the system says then, to the letter (nothing after it:
silence), `S~` the same roughly, `=` a judgement that holds of the state, as in
`= s : [shared : [latest : Learned]]`, `#` a comment. All that the system says has to be
in the story, in that order.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ttr.dialogues.settings import StoryError
from ttr.errors import Span
from ttr.safety.files import why_unread
from ttr.safety.inputs import read_text
from ttr.safety.limits import STORIES
from ttr.showing import NotebookValue, Part, Text, Tone, below, table

MARKS = ("---", "@", "U>", "U~", "S>", "S~", "=")

_TONES: dict[str, Tone] = {
    **dict.fromkeys(MARKS, "plain"),
    "U>": "strong",
    "U~": "strong",
    "@": "quiet",
    "=": "code",
}
"""How lines are set in a notebook, by their marks."""

COMMENT = re.compile(r"\s#(?:\s|$)")
"""The start of a comment behind the text of a line."""

_OF_THE_FILE = "game"
"""The word of the `@` line that holds for the stories after it, too."""


@dataclass(frozen=True)
class Line:
    """A line of a story: its place, its mark and the text after it.

    `column` is where the text begins in the line as `written` in the file.

    >>> line = Line("a.dlg", 3, "S>", "Hello.")
    >>> print(line.place, line.wrong("nobody greets here").message)
    a.dlg:3 a.dlg:3: nobody greets here
    """

    file: str
    number: int
    mark: str
    text: str
    column: int = 1
    written: str = ""

    @property
    def place(self) -> str:
        """The file and the number of the line."""
        return f"{self.file}:{self.number}"

    def span(self, start: int, length: int) -> Span:
        """The place of a part of the text, which begins at the index `start`."""
        return Span(self.file, self.number, self.column + start, length, self.written)

    def wrong(self, message: str) -> StoryError:
        """The error that says what is wrong with this line."""
        return StoryError(f"{self.place}: {message}")


@dataclass(frozen=True)
class Story(NotebookValue):
    """A dialogue with a title; `game` is the line that names its game, if any.

    >>> from ttr.dialogues.stories import Line
    >>> story = Story("a greeting", (Line("a.dlg", 1, "U>", "Hello."),))
    >>> [line.mark for line in story.lines]
    ['U>']
    """

    title: str
    lines: tuple[Line, ...]
    game: Line | None = None

    def _shown_as_(self) -> Part:
        def row(line: Line) -> tuple[Part, ...]:
            return Text(line.mark, "quiet"), Text(line.text, _TONES[line.mark])

        inside = [it for it in self.lines if it.mark != "---"]
        return below(Text(self.title, "strong"), table(("", ""), inside, row))


def read_stories(path: Path) -> tuple[Story, ...]:
    """The stories in a file. Raises `StoryError`.

    A line `@ game …` is of its story and of those after it.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "hello.dlg")
    ...     _ = file.write_text("--- a greeting\\nU> Hello.\\nS> Hello.\\n")
    ...     read_stories(file)[0].title
    'a greeting'
    """
    try:
        text = read_text(path, STORIES)
    except (OSError, UnicodeDecodeError) as error:
        raise StoryError(why_unread(path, error)) from None
    return stories_of_text(text, path)


def stories_of_text(text: str, path: Path) -> tuple[Story, ...]:
    """The stories in the text of a file; raises `StoryError`."""
    stories = tuple(_stories(path.stem, _lines(path, text)))
    if not stories:
        raise StoryError(f"{path} has no story: write lines such as `U> Hello.`")
    return stories


def _lines(path: Path, text: str) -> Iterator[Line]:
    for number, written in enumerate(text.splitlines(), start=1):
        line = written.strip()
        if not line or line.startswith("#"):
            continue
        mark = next((mark for mark in MARKS if line.startswith(mark)), None)
        if mark is None:
            raise StoryError(
                f"{path}:{number}: a line begins with {', '.join(MARKS)} or #, "
                f"but found {line[:40]!r}"
            )
        after = written.index(mark) + len(mark)
        begin = after + len(written[after:]) - len(written[after:].lstrip())
        content = _content(written[after:])
        yield Line(str(path), number, mark, content, begin + 1, written)


def _content(text: str) -> str:
    """The text of a line without the comment at its end; `#2` is no comment.

    A backslash stands before a `#` that stands alone and begins no comment.
    """
    plain = COMMENT.split(f" {text}", maxsplit=1)[0].strip()
    return re.sub(r"(?<!\S)\\(\\*#)(?!\S)", r"\1", plain)


def line_of(text: str) -> str:
    """The line of a story that is read as this text; raises `StoryError`.

    >>> line_of("U> no # comment")
    'U> no \\\\# comment'
    """
    if len(text.splitlines()) > 1:
        raise StoryError(f"no line of a story has a line break in it: {text!r}")
    return re.sub(r"(?<!\S)(\\*#)(?!\S)", r"\\\1", text)


def _stories(title: str, lines: Iterator[Line]) -> Iterator[Story]:
    game: Line | None = None
    body: list[Line] = []
    for line in lines:
        if line.mark == "---":
            if body:
                yield Story(title, tuple(body), game)
            title, body = line.text, []
        elif line.mark != "@" or _verb(line) != _OF_THE_FILE:
            body.append(line)
        elif body:
            raise line.wrong("a story says which game it is of before anything else")
        else:
            game = line
    if body:
        yield Story(title, tuple(body), game)


def _verb(line: Line) -> str:
    return line.text.partition(" ")[0]
