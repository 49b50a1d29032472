"""A dialogue that is written as a story while it is held, and plays again exactly.

Before each event stands when it happened, in seconds since the dialogue began:

    --- 2026-11-23 15:24:18
    @ sensor synthetic:desk?seed=7
    @ strategy assisted paper
    @ time 2026-11-23T15:24:18.000+00:00
    @ time 3.204
    U> What is this?
    S> I do not know what this is. Please tell me.
"""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime
from pathlib import Path

from kille.agent.exchanges import Event
from kille.safety.private_files import open_private
from ttr.dialogues.stories.story_writer import turn_lines
from ttr.safety.closing import Closing


class StoryLog(Closing):
    """A story that is written event by event; it is its own context manager.

    What has happened is in the file before anything else happens. Only its user can
    read a new file. Raises OSError where it cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file = open(path, "w", encoding="utf-8", opener=open_private)  # noqa: SIM115
        self._began: datetime | None = None

    def begin(
        self,
        sensor: str,
        began: datetime,
        strategy: Iterable[str] = (),
        memory: str = "",
    ) -> None:
        """Write what the robot looks through, by which strategy, with which memory."""
        self._began = began
        self._write(head_lines(sensor, began, strategy, memory))

    def __call__(self, event: Event) -> None:
        """Write an event and what the robot said to it."""
        assert self._began is not None, "an event before the beginning"
        self._write(event_lines(event, self._began))

    def _write(self, lines: Iterable[str]) -> None:
        self._file.write("".join(f"{line}\n" for line in lines))
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def head_lines(
    sensor: str, began: datetime, strategy: Iterable[str] = (), memory: str = ""
) -> list[str]:
    """The lines with which a story begins: its title, and who takes part."""
    return [
        f"--- {began:%Y-%m-%d %H:%M:%S}",
        f"@ sensor {_absolute(sensor)}",
        *(f"@ strategy {' '.join(them)}" for them in [tuple(strategy)] if them),
        *(f"@ memory {it}" for it in [memory] if it),
        f"@ time {began.isoformat(timespec='milliseconds')}",
    ]


def event_lines(event: Event, began: datetime) -> list[str]:
    """An event of a dialogue that began then, and what the robot said to it."""
    seconds = (event.time - began).total_seconds()
    line = " ".join(event.line.splitlines())
    return [f"@ time {seconds:.3f}", *turn_lines(line, event.said)]


def _absolute(sensor: str) -> str:
    """A sensor that is a file or folder, by a path that is right from any folder."""
    return str(Path(sensor).resolve()) if Path(sensor).exists() else sensor
