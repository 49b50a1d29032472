"""`kille replay`: plays dialogue files and says where the robot differs from them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from rich.console import Console
from rich.progress import track

from kille.interfaces.terminal import FAILED, FINE, complain, console
from kille.memory import MemoryFileError
from kille.replay import play
from kille.sensors.sensor import SensorError
from kille.stories import Mismatch, Story, StoryError, read_stories

__all__ = ["Outcome", "as_json", "in_brief", "in_full", "replay"]


@dataclass(frozen=True)
class Outcome:
    """What became of a story; `difference` is None where the robot said just that."""

    file: str
    title: str
    difference: Mismatch | None


Plan = Sequence[tuple[Path, Sequence[Story]]]
Report = Callable[[Plan], Iterator[Outcome]]
"""How stories are played, and what is printed about them meanwhile."""


def replay(files: Sequence[Path], report: Report) -> int:
    """Plays the stories in these files; the exit code."""
    try:
        plan = [(file, read_stories(file)) for file in files]
        outcomes = list(report(plan))
    except (StoryError, SensorError, MemoryFileError) as error:
        return complain(error)
    return FAILED if any(outcome.difference for outcome in outcomes) else FINE


def in_full(plan: Plan) -> Iterator[Outcome]:
    """Prints each line as it is played."""
    out = console()

    def told(file: Path, story: Story) -> Outcome:
        out.print(f"--- {story.title}", markup=False, style="bold")
        mismatch = play(story, echo=lambda line: out.print(line, markup=False))
        return Outcome(str(file), story.title, mismatch)

    for file, stories in plan:
        yield from _summed_up(out, file, [told(file, story) for story in stories])


def in_brief(plan: Plan) -> Iterator[Outcome]:
    """Prints what differs, and a line for each file; a bar on a terminal meanwhile."""
    out = console()
    for file, stories in plan:
        played = track(
            stories,
            description=str(file),
            console=out,
            transient=True,
            disable=not out.is_terminal,
        )
        outcomes = [Outcome(str(file), story.title, play(story)) for story in played]
        yield from _summed_up(out, file, outcomes)


def as_json(plan: Plan) -> Iterator[Outcome]:
    """Prints a list of objects, one for each story, for machines."""
    outcomes = [
        Outcome(str(file), story.title, play(story))
        for file, stories in plan
        for story in stories
    ]
    console().print_json(json.dumps([asdict(outcome) for outcome in outcomes]))
    yield from outcomes


def _summed_up(
    out: Console, file: Path, outcomes: Sequence[Outcome]
) -> Sequence[Outcome]:
    failed = [outcome for outcome in outcomes if outcome.difference]
    for outcome in failed:
        out.print(str(outcome.difference), markup=False)
    told = f"{len(outcomes)} {'story' if len(outcomes) == 1 else 'stories'}"
    result = f"{len(failed)} of {told} differ" if failed else f"{told} as written"
    out.print(f"{file}: {result}", markup=False)
    return outcomes
