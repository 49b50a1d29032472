"""A progress bar for a study on a terminal, with the time left."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, TaskID, TextColumn, TimeRemainingColumn

from kille.interfaces.terminal import console, transient_bar
from kille.lab.running_studies import Progress

PACE_SECONDS = 300
"""The time left is estimated from the pace over this many seconds."""


@contextmanager
def bar() -> Iterator[Callable[[Progress], None]]:
    """On a terminal, show a bar with the progress and the time left."""
    shown = transient_bar(
        console(stderr=True),
        BarColumn(bar_width=24),
        TextColumn(
            "{task.completed:,.0f} of {task.total:,.0f}{task.description}",
            markup=False,
        ),
        TimeRemainingColumn(),
        TextColumn("left"),
        speed_estimate_period=PACE_SECONDS,
        refresh_per_second=4,
    )
    with shown:
        tasks: list[TaskID] = []

        def show_progress(it: Progress) -> None:
            if not tasks:  # what was over before says nothing of the time left
                tasks.append(shown.add_task("", total=it.planned, completed=it.over))
            broken = f", {it.broken:,} broke" if it.broken else ""
            shown.update(tasks[0], completed=it.over, description=broken)

        yield show_progress
