"""Every story of tests/dialogues is a test: the robot says what is written there.

Those in the folder captures need real ones, and are skipped without.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from kille.dialogue.meanings import named
from kille.replay import play
from ttr.dialogues.stories import Story, read_stories

FOLDER = Path(__file__).parent / "dialogues"


def stories(folder: Path) -> list[object]:
    """The stories in a folder, each as a test by its file and title."""
    return [
        pytest.param(story, id=f"{file.stem}: {story.title}")
        for file in sorted(folder.glob("*.dlg"))
        for story in read_stories(file)
    ]


@pytest.mark.parametrize("story", stories(FOLDER))
def test_synthetic(story: Story) -> None:
    mismatch = play(story)
    assert mismatch is None, f"\n{mismatch}"


@pytest.mark.parametrize("story", stories(FOLDER / "captures"))
def test_captures(story: Story, data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("KILLE_DATA", str(data.resolve()))
    mismatch = play(story)
    assert mismatch is None, f"\n{mismatch}"


def test_the_stories_show_every_game() -> None:
    """Each kind of move that belongs to a game is judged of some state."""
    judged = {
        line.text.rpartition("latest : ")[2].split(",")[0].split("]")[0]
        for file in FOLDER.glob("*.dlg")
        for story in read_stories(file)
        for line in story.lines
        if line.mark == "="
    }
    wanted = {"Learned", "AssertName", "HedgeName", "AskRelation", "LearnedRelation"}
    assert all(named(name).fields for name in wanted)
    assert wanted <= judged
