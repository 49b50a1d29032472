"""Before the first turn of a story: which game is played, and where it starts."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ttr.errors import TTRError, suggestion
from ttr.stories.hearing import value
from ttr.stories.reading import Line, Story, StoryError
from ttr.stories.settings import Setting, setting
from ttr.syntax import Record

__all__ = ["opening", "setting_of", "turns_of"]


def setting_of(story: Story) -> Setting:
    """The setting that a story names; raises `StoryError`."""
    if story.game is None:
        first = story.lines[0]
        verb = first.text.partition(" ")[0] if first.mark == "@" else ""
        near = suggestion(verb, ("game",)) or "begin the file with " + (
            "`@ game FILE.ttr NAME`"
        )
        raise first.wrong(f"the story names no game: {near}")
    reference = story.game.text.partition(" ")[2].strip()
    try:
        return setting(reference, Path(story.game.file).parent)
    except StoryError as error:
        raise story.game.wrong(error.message) from error


def opening(story: Story, setting: Setting) -> Setting:
    """The setting, with the start that the story says, if it says one.

    Raises `StoryError` for a start that no state of the game can be.
    """
    first = story.lines[0]
    if not _says_start(first):
        return setting
    verb, _, text = first.text.partition(" ")
    start = value(setting, setting.game.begin(), first, text, len(verb) + 1)
    if not isinstance(start, Record):
        raise first.wrong(f"a story starts in a record, found {text or 'nothing'}")
    try:
        return replace(setting, game=replace(setting.game, start=start))
    except TTRError as error:
        raise first.wrong(error.message) from error


def turns_of(story: Story) -> tuple[Line, ...]:
    """The lines of a story after the one that says where it starts."""
    return story.lines[1:] if _says_start(story.lines[0]) else story.lines


def _says_start(line: Line) -> bool:
    return line.mark == "@" and line.text.partition(" ")[0] == "start"
