"""Every story that names its game is a test: what happens is what is written there."""

from __future__ import annotations

from pathlib import Path

import pytest

from ttr.dialogues.stories import Story, play, read_stories

ROOT = Path(__file__).parent.parent
FOLDERS = (ROOT / "tests" / "games", ROOT / "examples")
STORIES = [
    pytest.param(story, id=f"{file.stem}: {story.title}")
    for folder in FOLDERS
    for file in sorted(folder.rglob("*.dlg"))
    if "studies" not in file.parts  # what tutors of studies say is no game
    for story in read_stories(file)
]


@pytest.mark.parametrize("story", STORIES)
def test_a_story_is_as_written(story: Story) -> None:
    mismatch = play(story).mismatch
    assert mismatch is None, f"\n{mismatch}"
