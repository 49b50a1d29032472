"""`kille replay`: plays dialogue files and says where the robot differs from them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from kille.interfaces.terminal import FAILED, FINE, WRONG_USE, complain, console
from kille.memory import MemoryFileError
from kille.replay import play
from kille.sensors.sensor import SensorError
from kille.stories import Mismatch, Story, StoryError, read_stories

__all__ = ["replay"]


def replay(files: Sequence[Path], *, quiet: bool) -> int:
    """Plays the stories in these files; the exit code."""
    codes = [_replay_file(file, quiet=quiet) for file in files]
    return max(codes)


def _replay_file(file: Path, *, quiet: bool) -> int:
    try:
        stories = read_stories(file)
        mismatches = [_replay_story(story, quiet=quiet) for story in stories]
    except (StoryError, SensorError, MemoryFileError) as error:
        return complain(error, WRONG_USE)
    failed = [mismatch for mismatch in mismatches if mismatch is not None]
    for mismatch in failed:
        console().print(str(mismatch), markup=False)
    told = f"{len(stories)} {'story' if len(stories) == 1 else 'stories'}"
    result = f"{len(failed)} of {told} differ" if failed else f"{told} as written"
    console().print(f"{file}: {result}", markup=False)
    return FAILED if failed else FINE


def _replay_story(story: Story, *, quiet: bool) -> Mismatch | None:
    out = console()
    if quiet:
        return play(story)
    out.print(f"--- {story.title}", markup=False, style="bold")
    return play(story, echo=lambda line: out.print(line, markup=False))
