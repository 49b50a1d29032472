"""A tutor who says the lines of a file `.dlg`, whatever the robot replies.

`U>` is what they say, `@` what happens: `look`, `point 2`, `restart`, and in front of
simulated scenes `place 2 3.5 4` and `remove 2`. What the file has the robot say after
`S>` is what they expect; an answer is right if it is that sentence.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from kille.lab.scenes import WHOLE
from kille.lab.scenes.table_commands import PLACED, is_step
from kille.lab.study import Study
from kille.lab.tutors.tutor import Asked, Happens, Move, Says, Shows, Task, Turns
from ttr.dialogues.stories import Line, read_stories


class Scripted:
    """A tutor who says these lines, all of them in the first task."""

    def __init__(self, name: str, lines: Sequence[Line]) -> None:
        self.name = name
        self._left = tuple(lines)

    def turns(self, task: Task) -> Turns:
        """The lines, in front of what the task shows; nothing in any later task."""
        lines, self._left = self._left, ()
        if lines and task.of is not None:
            yield Shows(task.of)
        yield from _moves(lines)


def read_script(name: str, path: Path) -> Scripted:
    """The tutor who plays the stories of a file, one after the other.

    `StoryError` where the file has none.
    """
    return Scripted(name, script_lines(path))


def script_lines(path: Path) -> tuple[Line, ...]:
    """The lines of all stories of a file; `StoryError` where it has none."""
    return tuple(line for story in read_stories(path) for line in story.lines)


# --- what nobody could play -----------------------------------------------------------


def unplayable_lines(lines: Sequence[Line], study: Study) -> Iterator[str]:
    """The lines of a script that nobody could play in this study, and why."""
    kinds = {scene.kind for scene in study.scenes.values()}
    known = {**_EVERYWHERE} if kinds & WHOLE else {**_EVERYWHERE, **_SIMULATED}
    for line in lines:
        text = " ".join(line.text.split())
        if line.mark == "U~":
            yield f"{line.place}: nobody mishears in a study: write U> and one text"
        elif line.mark == "@" and not re.fullmatch("|".join(known.values()), text):
            told = f"@ {text} is no command in these scenes"
            yield f"{line.place}: {told}: write {', '.join(known)}"
        elif line.mark == "@" and not all(map(is_step, text.split()[2:])):
            yield f"{line.place}: @ {text}: {PLACED}"


_THING = r"#?[1-9]\d{0,5}"
_NUMBER = r"[-+]?(\d+\.?\d*|\.\d+)"
_EVERYWHERE = {"look": "look", "restart": "restart", "point 2": f"point {_THING}"}
_SIMULATED = {
    "place 2 3.5 4": f"place {_THING} {_NUMBER} {_NUMBER}",
    "remove 2": f"remove {_THING}",
}
"""What may happen in a script, as it is written, in all scenes or in simulated ones."""


def _moves(lines: Sequence[Line]) -> Iterator[Move]:
    for place, line in enumerate(lines):
        match line.mark:
            case "U>":
                yield Says(line.text, "says", _expected_reply(lines[place + 1 :]))
            case "@":
                yield Happens(line.text)


def _expected_reply(after: Sequence[Line]) -> Asked | None:
    """What the robot should reply, if the script says so."""
    expected = []
    for line in after:
        if line.mark != "S>":
            break
        expected.append(line.text)
    return Asked("reply", "\n".join(expected), 0) if expected else None
