"""`kille replay`: play dialogue files and report where the robot differs from them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any

from rich.console import Console

from kille.agent.agent import Agent
from kille.agent.story_replay import Echo, Make, play, story_language
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain,
    complain_all,
    console,
    labelled_bar,
    print_json,
)
from kille.lab.errors import StudyError
from kille.memory import MemoryFileError
from kille.sensors.sensor import SensorError
from ttr import TTRError
from ttr.dialogues.stories import Outcome, Story, facts, junit, read_stories, summary
from ttr.safety.files import check_outputs, write_whole

Plan = Sequence[tuple[Path, Sequence[Story]]]
Report = Callable[[Plan, Make], Iterator[Outcome]]
"""How stories are played, and what is printed about them meanwhile."""


def replay(
    files: Sequence[Path],
    report: Report,
    report_file: Path | None,
    robots: Callable[[str], Make] = lambda language: Agent,
) -> int:
    """Play the stories in these files, each to a robot of its own; the exit code.

    `robots` gives what makes the robots that speak a language.
    With a report file, what became of them is also written for CI, as JUnit does.
    """
    try:
        check_outputs(files, [report_file])
        plan = [(file, read_stories(file)) for file in files]
        outcomes = list(report(plan, _maker(plan, robots)))
        if report_file is not None:
            write_whole(report_file, f"{junit(outcomes)}\n")
    except (TTRError, StudyError) as error:
        return complain_all(error)
    except (SensorError, MemoryFileError) as error:
        return complain(error)
    return FINE if all(outcome.as_written for outcome in outcomes) else FAILED


def _maker(plan: Plan, robots: Callable[[str], Make]) -> Make:
    """A function that makes robots, tried for all languages of the stories."""
    stories = [story for _, stories in plan for story in stories]
    makes = {it: robots(it) for it in dict.fromkeys(map(story_language, stories))}

    def make(*seeing: Any, language: str, **settings: Any) -> Agent:
        return makes[language](*seeing, language=language, **settings)

    return make


def _outcome(
    file: Path, story: Story, make: Make, echo: Echo = lambda line: None
) -> Outcome:
    start = perf_counter()
    mismatch = play(story, echo=echo, make=make)
    return Outcome(str(file), story.title, perf_counter() - start, mismatch)


def in_full(plan: Plan, make: Make) -> Iterator[Outcome]:
    """Prints each line as it is played."""
    out = console()

    def play_aloud(file: Path, story: Story) -> Outcome:
        out.print(f"--- {story.title}", markup=False, style="bold")
        return _outcome(file, story, make, lambda line: out.print(line, markup=False))

    for file, stories in plan:
        yield from _with_summary(
            out, file, [play_aloud(file, story) for story in stories]
        )


def in_brief(plan: Plan, make: Make) -> Iterator[Outcome]:
    """Prints what differs, and a line for each file; a bar on a terminal meanwhile."""
    out = console()
    for file, stories in plan:
        with labelled_bar(out) as bar:
            played = bar.track(stories, description=str(file))
            outcomes = [_outcome(file, story, make) for story in played]
        yield from _with_summary(out, file, outcomes)


def as_json(plan: Plan, make: Make) -> Iterator[Outcome]:
    """Prints a list of objects, one for each story, for machines."""
    outcomes = [
        _outcome(file, story, make) for file, stories in plan for story in stories
    ]
    print_json([facts(outcome) for outcome in outcomes])
    yield from outcomes


def _with_summary(
    out: Console, file: Path, outcomes: Sequence[Outcome]
) -> Sequence[Outcome]:
    for outcome in outcomes:
        if not outcome.as_written:
            out.print(str(outcome), markup=False)
    out.print(summary(str(file), outcomes), markup=False)
    return outcomes
