"""`kille experiment show`: list a folder of results, or show one of its dialogues."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby
from pathlib import Path
from shlex import join
from typing import Any, TypeAlias

from kille.interfaces.experiment.checking import MISTAKES
from kille.interfaces.grids import print_table, results_console
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    complain_all,
    console,
    hang_text,
    print_json,
)
from kille.lab import log
from kille.lab.dialogues import Answer, Turn
from kille.lab.log.outcomes import Broken, Finished, Outcome
from kille.lab.results import Table
from kille.lab.worlds.worlds import World

SHOWN = 10
"""The most broken dialogues that are listed."""

Report: TypeAlias = Callable[[Outcome], None]
"""How a dialogue is printed."""


def show(folder: Path, name: str | None, report: Report) -> int:
    """Print a dialogue, or list those there are; returns the exit code."""
    try:
        if name is None:
            _show_all(folder)
            return FINE
        found = log.find_outcome(folder, name)
    except MISTAKES as error:
        return complain_all(error)
    report(found)
    return FAILED if isinstance(found, Broken) else FINE


# --- the study -----------------------------------------------------------------------


def _show_all(folder: Path) -> None:
    about = log.about(folder)
    out = results_console()
    rows = tuple(_count_by_theory(folder))
    over = sum(row[1] for row in rows)
    heads = "theory", "dialogues", "broken", "turns", "answers", "seconds each"
    note = f"{over:,} of {about.planned:,} dialogues are over"
    print_table(out, Table(about.title, heads, rows, note))
    broken = log.broken_runs(folder)
    for it in broken[:SHOWN]:
        out.print(hang_text(f"{it.run}  ", f"broken: {it.reason}"), markup=False)
    if more := len(broken) - len(broken[:SHOWN]):
        out.print(f"and {more:,} more that broke: runs.csv has them", markup=False)
    first = next(log.outcomes(folder), None)
    if first is not None:
        words = ["kille", "experiment", "show", str(folder), str(first.run)]
        out.print(f"see one: {join(words)}", markup=False)


def _count_by_theory(folder: Path) -> Iterator[tuple[Any, ...]]:
    """The number of dialogues of each theory, by what happened in them."""
    found: dict[str, list[Outcome]] = {}
    for it in log.outcomes(folder):
        found.setdefault(it.run.theory, []).append(it)
    for theory, some in found.items():
        played = [it.played for it in some if isinstance(it, Finished)]
        yield (
            theory,
            len(some),
            len(some) - len(played),
            sum(len(it.turns) for it in played),
            sum(len(it.answers) for it in played),
            round(sum(it.seconds for it in some) / len(some), 3),
        )


# --- a dialogue ----------------------------------------------------------------------


def as_json(it: Outcome) -> None:
    """Print the dialogue as an object, for machines."""
    shown: dict[str, Any] = {"run": str(it.run), "seconds": it.seconds}
    match it:
        case Broken(_, reason, trace, _):
            shown |= {"broken": reason, "trace": trace}
        case Finished(_, played, _):
            shown |= {
                "lessons": played.lessons,
                "facts": dict(played.facts),
                "turns": [turn._asdict() for turn in played.turns],
                "answers": [answer._asdict() for answer in played.answers],
            }
    print_json(shown)


def as_text(it: Outcome) -> None:
    """Print the dialogue phase by phase, and mark the answers that were tested."""
    out = console()
    if isinstance(it, Broken):
        out.print(f"{it.run} broke: {it.reason}\n\n{it.trace.rstrip()}", markup=False)
        return
    played = it.played
    head = f"{it.run}: {len(played.turns):,} turns, {played.lessons:,} lessons kept"
    out.print(head, markup=False)
    answers: dict[int, list[Answer]] = {}
    for answer in played.answers:
        answers.setdefault(answer.turn, []).append(answer)
    for phase, turns in groupby(played.turns, key=lambda turn: turn.phase):
        out.print(f"\n{phase}", markup=False)
        for turn in turns:
            for line in _lines(turn, answers.get(turn.number, ())):
                out.print(line, markup=False)


def _lines(turn: Turn, answers: Sequence[Answer]) -> Iterator[str]:
    number = f"{turn.number:>5}  "
    yield hang_text(f"{number}{turn.tutor:<8} ", _describe_input(turn))
    blank = " " * len(number)
    for line in turn.answer.splitlines():
        yield hang_text(f"{blank}{'robot':<8} ", line)
    for answer in answers:
        yield hang_text(f"{blank}{'':<8} ", _describe_judgement(answer))


def _describe_input(turn: Turn) -> str:
    """What the tutor said or did; of a simulated look, only the things in view."""
    world = World.from_name(turn.given)
    if world is None and turn.given:
        return turn.given if turn.words else f"({turn.act}: {turn.given})"
    if world is None:
        return f"({turn.act})"
    things = (
        f"{'*' * (number == world.focus)}{world.thing(number)}"
        for number in world.in_view
    )
    return f"({turn.act}: {'; '.join(things) or 'nothing'})"


def _describe_judgement(it: Answer) -> str:
    said = it.said or "nothing"
    degree = "" if math.isnan(it.degree) else f", {it.degree:.2f}"
    verdict = "right" if it.is_right else f"not right, it is {it.right}"
    return f"→ {said} ({it.way}{degree}): {verdict}"
