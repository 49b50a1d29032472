"""`ttr replay`: plays the dialogues of a log again, and says where they differ."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ttr.commands.output import FAILED, FINE, Commands, complain, say
from ttr.errors import TTRError
from ttr.files import check_outputs, write_whole

if TYPE_CHECKING:
    from ttr.logs import Log, Replayed
    from ttr.stories import Setting

__all__ = ["add"]


def add(commands: Commands) -> None:
    """Declares the command."""
    replay = commands.add_parser(
        "replay",
        help="play a log again, and say where it differs",
        description="Plays the dialogues of a log again; exits with 1 if anything "
        "differs, or if the log is cut off.",
    )
    replay.add_argument("file", type=Path, metavar="FILE", help="a log (.jsonl)")
    replay.add_argument(
        "--from",
        dest="turn",
        type=_turn,
        default=0,
        metavar="N",
        help="from the state that is logged after turn N (0: the start)",
    )
    replay.add_argument(
        "--story", type=Path, metavar="FILE", help="write the log as stories (.dlg)"
    )
    replay.add_argument("--html", type=Path, metavar="FILE", help="write a transcript")
    replay.set_defaults(command=_replay)


def _turn(text: str) -> int:
    if text.isdecimal():
        return int(text)
    raise argparse.ArgumentTypeError(f"expected the number of a turn, found {text}")


def _replay(options: argparse.Namespace) -> int:
    from ttr.logs import UnreadableLog, read_logs

    try:
        check_outputs([options.file], [options.story, options.html])
    except TTRError as error:
        return complain(str(error))
    try:
        logs = read_logs(options.file)
        played = [_again(log, options) for log in logs]
    except UnreadableLog as error:
        return complain(str(error))
    except TTRError as error:
        say(str(error))
        return FAILED
    try:
        _write(options, played)
    except TTRError as error:
        return complain(str(error))
    return max(_report(log, again, options.turn) for log, _, again in played)


def _again(log: Log, options: argparse.Namespace) -> tuple[Log, Setting, Replayed]:
    from ttr.logs import LogError, replay
    from ttr.stories import StoryError, setting

    place = f"{log.file}:{log.number}"
    if not log.header.game:
        raise LogError(f"{place}: the log names no game: replay it from Python")
    try:
        found = setting(log.header.game, options.file.parent)
    except StoryError as error:
        raise LogError(f"{place}: {error.message}") from error
    turn = min(options.turn, len(log.entries))
    return log, found, replay(log, found, from_=turn)


def _report(log: Log, again: Replayed, start: int) -> int:
    count = len(log.entries)
    turns = f"{count} turn{'s' * (count != 1)}"
    name = f"{log.file}: {log.header.title or 'a dialogue'}"
    if log.cut:
        say(log.cut)
    if again.divergence is not None:
        say(str(again.divergence))
        say(f"{name}: differs")
        return FAILED
    after = f" after turn {start}" if start else ""
    same = "all the same" if start < count or not start else "none"
    say(f"{name}: {turns}, {same}{after}")
    return FAILED if log.cut else FINE


def _write(
    options: argparse.Namespace, played: list[tuple[Log, Setting, Replayed]]
) -> None:
    from ttr.logs import story_of
    from ttr.transcripts import Transcribed, transcript

    if options.story is not None:
        stories = [
            story_of(log, found, options.story.parent) for log, found, _ in played
        ]
        write_whole(options.story, "\n".join(stories))
    if options.html is not None:
        shown = [
            Transcribed(
                log.header.title or "a dialogue",
                found,
                again.start,
                again.moments,
                str(again.divergence or ""),
            )
            for log, found, again in played
        ]
        write_whole(options.html, transcript(options.file.name, shown))
