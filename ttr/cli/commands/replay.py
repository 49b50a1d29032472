"""`ttr replay`: plays the dialogues of a log again, and says where they differ."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ttr.cli.consent_options import (
    add_consent,
    consent_of,
    named_game,
)
from ttr.cli.output import FAILED, FINE, Commands, complain, say
from ttr.errors import TTRError
from ttr.safety.consent import NotAllowedError
from ttr.safety.files import check_outputs, write_whole

if TYPE_CHECKING:
    from ttr.dialogues.logs import Log, Replayed
    from ttr.dialogues.stories import Setting


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
    replay.add_argument(
        "--game",
        metavar="GAME",
        help="play it with this game, FILE.ttr:NAME, FILE.py:NAME or MODULE:NAME, "
        "whatever the log names",
    )
    add_consent(replay, log="the log")
    replay.set_defaults(run=_replay)


def _turn(text: str) -> int:
    if text.isdecimal():
        return int(text)
    raise argparse.ArgumentTypeError(f"expected the number of a turn, found {text}")


def _replay(options: argparse.Namespace) -> int:
    from ttr.dialogues.logs import UnreadableLogError, read_logs

    try:
        check_outputs([options.file], [options.story, options.html])
    except TTRError as error:
        return complain(str(error))
    try:
        logs = read_logs(options.file)
        played = [_replay_log(log, options) for log in logs]
    except (UnreadableLogError, NotAllowedError) as error:
        return complain(str(error))
    except TTRError as error:
        say(str(error))
        return FAILED
    try:
        _write_outputs(options, played)
    except TTRError as error:
        return complain(str(error))
    return max(_print_result(log, again, options.turn) for log, _, again in played)


def _replay_log(log: Log, options: argparse.Namespace) -> tuple[Log, Setting, Replayed]:
    from ttr.dialogues.logs import LogError, replay
    from ttr.dialogues.stories import StoryError

    place = f"{log.file}:{log.number}"
    try:
        found = _setting_of_log(log, options, place)
    except StoryError as error:
        raise LogError(f"{place}: {error.message}") from error
    turn = min(options.turn, len(log.entries))
    return log, found, replay(log, found, from_=turn)


def _setting_of_log(log: Log, options: argparse.Namespace, place: str) -> Setting:
    """The game that the user names, or else the log; raises `NotAllowedError`.

    A log runs nothing by itself: Python that it names needs the user's consent.
    """
    from ttr.dialogues.logs import LogError
    from ttr.dialogues.stories import named_by_user, python_in, setting

    consent, reference = consent_of(options), log.header.game
    if options.game is not None:
        return named_game(options.game, consent)
    if not reference:
        raise LogError(f"{place}: the log names no game: name it with --game")
    folder, python = options.file.parent, python_in(reference)
    if python and not options.trust:
        raise NotAllowedError(
            f"{place}: the log names {reference}, {_refusal(options)}"
        )
    if python:
        where = (folder / python).resolve() if python.endswith(".py") else python
        say(f"{place}: running {where}, which the log names")
        consent = named_by_user(reference, folder, consent)
    try:
        return setting(reference, folder, consent)
    except NotAllowedError as error:
        raise NotAllowedError(f"{place}: {error.message}") from error


def _refusal(options: argparse.Namespace) -> str:
    """Why Python that a log names is not run, and how to run it."""
    if options.no_python:
        return "which is Python, and --no-python refuses it"
    return (
        "which is Python, and a log runs none by itself: name the game, as with --game "
        "FILE.py:NAME, or let it run what it names with --trust"
    )


def _print_result(log: Log, again: Replayed, start: int) -> int:
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


def _write_outputs(
    options: argparse.Namespace, played: list[tuple[Log, Setting, Replayed]]
) -> None:
    from ttr.dialogues.logs import story_of
    from ttr.dialogues.transcripts import transcript

    if options.story is not None:
        stories = [
            story_of(log, found, options.story.parent) for log, found, _ in played
        ]
        write_whole(options.story, "\n".join(stories))
    if options.html is not None:
        shown = [again.dialogue for _, _, again in played]
        write_whole(options.html, transcript(options.file.name, shown))
