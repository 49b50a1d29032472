"""`kille demo`: the scripted lesson, its judgements, its scores and a picture sheet."""

from __future__ import annotations

import os
import time
from pathlib import Path

from rich.console import Console
from rich.table import Table

from kille.agent.agent import Agent
from kille.agent.attention import NumberedLook
from kille.demo import DemoAnswer, DemoStep, demonstration
from kille.interfaces.formatting import claims, format_account
from kille.interfaces.terminal import FINE, complain, console
from kille.perception.picture_sheet import picture_sheet, write_picture

Row = tuple[str, NumberedLook]


def demo(seed: int, picture: Path) -> int:
    """Play the demonstration, print it, and write the sheet; returns the exit code."""
    folder = picture.absolute().parent
    if picture.is_dir() or not folder.is_dir() or not os.access(folder, os.W_OK):
        return complain(
            f"the picture cannot be written to {picture}: name a file in a folder that "
            "is there and may be written, with --out"
        )
    out, started = console(), time.monotonic()
    answers: list[DemoAnswer] = []
    rows: list[Row] = []
    with Agent(sensor=f"synthetic:empty?seed={seed}") as robot:
        for event in demonstration(robot):
            _print_event(out, event)
            if event.answer is not None:
                answers.append(event.answer)
            if event.answer is not None and event.view is not None:
                rows.append((event.answer.word, event.view))
    out.print()
    out.print(_table(answers))
    right = sum(answer.right for answer in answers)
    took = time.monotonic() - started
    out.print(f"\n{right} of {len(answers)} answers right, in {took:.0f} s.")
    return _write_sheet(out, picture, rows)


def _print_event(out: Console, event: DemoStep) -> None:
    if event.world:
        out.print(f"\n@ {event.world}", style="dim", markup=False)
    if event.turn is None:
        return
    if event.turn.text:
        out.print(f"U> {event.turn.text}", style="bold", markup=False)
    for said in event.turn.said:
        out.print(f"S> {said.text}", style="bold cyan", markup=False)
    for line in format_account(claims(event.turn)):
        out.print(line, style="dim", markup=False)


def _table(answers: list[DemoAnswer]) -> Table:
    table = Table(title="What it answered", title_justify="left", box=None)
    table.add_column("word")
    table.add_column("answers right", justify="right")
    table.add_column("margin to the runner-up", justify="right")
    for word in dict.fromkeys(answer.word for answer in answers):
        own = [answer for answer in answers if answer.word == word]
        right = sum(answer.right for answer in own)
        margin = sum(answer.margin for answer in own) / len(own)
        table.add_row(word, f"{right} of {len(own)}", f"{margin:+.2f}")
    return table


def _write_sheet(out: Console, path: Path, rows: list[Row]) -> int:
    shown = [
        (word, view.look, view.focus) for word, view in rows if view.focus is not None
    ]
    try:
        write_picture(path, picture_sheet(shown))
    except OSError as error:
        return complain(f"the picture cannot be written to {path}: {error.strerror}")
    out.print(f"What it saw: {path.resolve()}", markup=False)
    return FINE
