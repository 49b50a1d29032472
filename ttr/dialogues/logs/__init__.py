"""Logs of dialogues: every turn is a line of JSON, to be read, replayed and continued.

`LogFile` writes a log turn by turn, `write_log` that of whole dialogues; `read_logs`
reads it, `replay` plays its events again and says where anything differs,
`continue_log` takes the dialogue up, and `story_of` makes a story of it.
"""

from typing import TYPE_CHECKING

from ttr.aliases import former_names
from ttr.dialogues.logs.entries import Entry, Header, LogError
from ttr.dialogues.logs.log_reader import Log, UnreadableLogError, read_logs
from ttr.dialogues.logs.log_writer import LogFile, write_log
from ttr.dialogues.logs.replay import (
    Divergence,
    Replayed,
    continue_log,
    replay,
    run_after,
    story_of,
)

__all__ = [
    "Divergence",
    "Entry",
    "Header",
    "Log",
    "LogError",
    "LogFile",
    "Replayed",
    "UnreadableLogError",
    "continue_log",
    "read_logs",
    "replay",
    "run_after",
    "story_of",
    "write_log",
]

if not TYPE_CHECKING:
    __getattr__ = former_names(__name__)
