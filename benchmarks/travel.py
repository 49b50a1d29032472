"""How long a turn of the travel agency takes: the stories in `examples/travel`."""

from __future__ import annotations

import time
from pathlib import Path

from ttr.dialogues.stories import read_stories, setting

STORIES = Path(__file__).resolve().parent.parent / "examples" / "travel" / "travel.dlg"


def turns() -> list[float]:
    """The seconds of each turn of the stories: reading, updating, wording.

    After every rule the state is checked.
    """
    game = setting("travel.py:game", STORIES.parent).game
    times: list[float] = []
    for story in read_stories(STORIES):
        so_far = game.begin()
        for line in story.lines:
            if line.mark != "U>":
                continue
            start = time.perf_counter()
            heard = game.hear(line.text) if line.text else None
            turn = game.take(so_far, heard)
            for said in turn.said:
                game.say(said)
            times.append(time.perf_counter() - start)
            so_far = turn.run
    return times
