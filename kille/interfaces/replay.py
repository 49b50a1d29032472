"""`kille replay`: play dialogue files and report where the robot differs from them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from time import perf_counter

from rich.console import Console

from kille.agent.story_replay import Echo, play
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain,
    console,
    labelled_bar,
    print_json,
)
from kille.memory import MemoryFileError
from kille.sensors.sensor import SensorError
from ttr import TTRError
from ttr.dialogues.stories import Outcome, Story, facts, junit, read_stories, summary
from ttr.safety.files import check_outputs, write_whole

Plan = Sequence[tuple[Path, Sequence[Story]]]
Report = Callable[[Plan], Iterator[Outcome]]
"""How stories are played, and what is printed about them meanwhile."""


def replay(files: Sequence[Path], report: Report, report_file: Path | None) -> int:
    """Play the stories in these files; returns the exit code.

    With a report file, what became of them is also written for CI, as JUnit does.
    """
    try:
        check_outputs(files, [report_file])
        plan = [(file, read_stories(file)) for file in files]
        outcomes = list(report(plan))
        if report_file is not None:
            write_whole(report_file, f"{junit(outcomes)}\n")
    except (TTRError, SensorError, MemoryFileError) as error:
        return complain(error)
    return FINE if all(outcome.as_written for outcome in outcomes) else FAILED


def _outcome(file: Path, story: Story, echo: Echo = lambda line: None) -> Outcome:
    start = perf_counter()
    mismatch = play(story, echo=echo)
    return Outcome(str(file), story.title, perf_counter() - start, mismatch)


def in_full(plan: Plan) -> Iterator[Outcome]:
    """Prints each line as it is played."""
    out = console()

    def told(file: Path, story: Story) -> Outcome:
        out.print(f"--- {story.title}", markup=False, style="bold")
        return _outcome(file, story, lambda line: out.print(line, markup=False))

    for file, stories in plan:
        yield from _summed_up(out, file, [told(file, story) for story in stories])


def in_brief(plan: Plan) -> Iterator[Outcome]:
    """Prints what differs, and a line for each file; a bar on a terminal meanwhile."""
    out = console()
    for file, stories in plan:
        with labelled_bar(out) as bar:
            played = bar.track(stories, description=str(file))
            outcomes = [_outcome(file, story) for story in played]
        yield from _summed_up(out, file, outcomes)


def as_json(plan: Plan) -> Iterator[Outcome]:
    """Prints a list of objects, one for each story, for machines."""
    outcomes = [_outcome(file, story) for file, stories in plan for story in stories]
    print_json([facts(outcome) for outcome in outcomes])
    yield from outcomes


def _summed_up(
    out: Console, file: Path, outcomes: Sequence[Outcome]
) -> Sequence[Outcome]:
    for outcome in outcomes:
        if not outcome.as_written:
            out.print(str(outcome), markup=False)
    out.print(summary(str(file), outcomes), markup=False)
    return outcomes
