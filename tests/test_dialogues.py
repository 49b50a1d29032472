"""Every story of tests/dialogues is a test: the robot says what is written there.

Those in the folder captures need real ones, and are skipped without.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Hashable
from pathlib import Path
from typing import Any

import pytest

from kille.agent.agent import Agent
from kille.agent.story_replay import play
from kille.dialogue.meanings import record_type
from kille.interfaces.formatting import short_account
from kille.perception.look import SCANS, look
from kille.scene import Look
from kille.sensors.sensor import Sensor
from kille.sensors.synthetic import Synthetic
from ttr.dialogues.stories import Story, read_stories

FOLDER = Path(__file__).parent / "dialogues"

LONG = 14
"""Lines of a story that is not played when one room is tested."""


def stories(folder: Path) -> list[object]:
    """The stories in a folder, each as a test by its file and title.

    Those that begin alike are next to each other, so that they share their looks.
    """
    found = [
        (story, file) for file in folder.glob("*.dlg") for story in read_stories(file)
    ]
    return [
        pytest.param(
            story,
            id=f"{file.stem}: {story.title}",
            marks=[pytest.mark.slow] if len(story.lines) > LONG else [],
        )
        for story, file in sorted(found, key=lambda it: (happenings(it[0]), it[1].name))
    ]


def happenings(story: Story) -> list[str]:
    """What is done in a story, and that something is said, in order."""
    return [
        line.text if line.mark == "@" else line.mark
        for line in story.lines
        if line.mark in ("@", "U>", "U~")
    ]


# --- looks that stories share --------------------------------------------------------

_LOOKS: OrderedDict[Hashable, Look] = OrderedDict()
_MOST_LOOKS = 12  # up to 60 MB each
_EARLY = 60  # frames; after so many, hardly any two stories are still alike
_FEW = 4
"""Fewer scans than a robot makes by itself, on which what it says seldom hangs."""
_NEAR_A_THRESHOLD = {"explanations_that_teach", "frames.en", "uncertainty"}
"""The files with stories in which it does."""


@pytest.fixture(autouse=True)
def _shared_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lets stories that begin alike see alike, which costs most of their time.

    The n-th frame of a seed and a sequence of changes is always the same.
    """
    monkeypatch.setattr("kille.agent.attention.look", shared_look)


def shared_look(sensor: Sensor, scans: int, pointed: Any = None) -> Look:
    if not isinstance(sensor, Synthetic) or sensor._meshes or sensor._frames >= _EARLY:
        return look(sensor, scans, pointed)
    if pointed is not None:
        return look(sensor, scans, pointed)
    things = tuple((name, body.pose) for name, body in sensor.bodies.items())
    key = sensor._address, things, sensor._frames, scans
    if key in _LOOKS:
        sensor._frames += scans
    else:
        _LOOKS[key] = look(sensor, scans)
    _LOOKS.move_to_end(key)
    if len(_LOOKS) > _MOST_LOOKS:
        _LOOKS.popitem(last=False)
    return _LOOKS[key]


# --- stories -------------------------------------------------------------------------


@pytest.mark.parametrize("story", stories(FOLDER))
def test_synthetic(story: Story) -> None:
    robots: list[Agent] = []
    scans = SCANS if Path(story.lines[0].file).stem in _NEAR_A_THRESHOLD else _FEW

    def make(*given: Any, **named: Any) -> Agent:
        robots.append(Agent(*given, scans=scans, **named))
        return robots[-1]

    mismatch = play(story, make=make)
    assert mismatch is None, f"\n{mismatch}"
    [robot] = robots
    for turn in robot.exchanges:
        account = list(short_account(turn))
        assert len(account) <= 10, "`kille talk --trace` tells a turn in ten lines"
        assert all(len(it) <= 100 and "\n" not in it for it in account)


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
    assert all(record_type(name).fields for name in wanted)
    assert wanted <= judged
