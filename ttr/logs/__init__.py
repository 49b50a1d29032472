"""Logs of dialogues: every turn in a line of JSON, to be read, replayed, gone on with.

`LogFile` writes one, `read_logs` reads it, `replay` plays its events again and says
where anything differs, `continued` takes the dialogue up, `story_of` makes a story.
"""

from ttr.logs.entries import Entry, Header, LogError
from ttr.logs.reading import Log, UnreadableLog, read_logs
from ttr.logs.replaying import (
    Divergence,
    Replayed,
    continued,
    replay,
    run_after,
    story_of,
)
from ttr.logs.writing import LogFile

__all__ = [
    "Divergence",
    "Entry",
    "Header",
    "Log",
    "LogError",
    "LogFile",
    "Replayed",
    "UnreadableLog",
    "continued",
    "read_logs",
    "replay",
    "run_after",
    "story_of",
]
