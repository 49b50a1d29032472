"""`ttr play`: plays stories with the games that they name, and compares."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from ttr.cli.command_line import WRONG_USE
from ttr.cli.consent_options import (
    add_consent,
    consent_of,
    named_game,
)
from ttr.cli.output import FAILED, FINE, Commands, complain, say, say_json
from ttr.errors import TTRError
from ttr.safety.consent import Consent, NotAllowedError
from ttr.safety.files import check_outputs, write_whole

if TYPE_CHECKING:
    from ttr.dialogues.dialogue import Trial
    from ttr.dialogues.logs import LogFile
    from ttr.dialogues.stories import Line, Outcome, Played, Setting, Story

    _Result = tuple[Outcome, Played | None]


def add(commands: Commands) -> None:
    """Declares the command."""
    play = commands.add_parser(
        "play",
        help="play dialogues, and say where they differ",
        description="Plays stories with the games that they name; exits with 1 if "
        "one differs.",
    )
    play.add_argument("files", nargs="+", type=Path, metavar="FILE.dlg")
    telling = play.add_mutually_exclusive_group()
    telling.add_argument("--quiet", action="store_true", help="only what differs")
    telling.add_argument("--trace", action="store_true", help="the rules, too")
    telling.add_argument("--json", action="store_true", help="report for machines")
    play.add_argument("--log", type=Path, metavar="FILE", help="keep a log (.jsonl)")
    play.add_argument("--html", type=Path, metavar="FILE", help="write a transcript")
    play.add_argument(
        "--junit", type=Path, metavar="FILE", help="write a report for CI (.xml)"
    )
    play.add_argument(
        "--game",
        metavar="GAME",
        help="play all with this game, FILE.ttr:NAME, FILE.py:NAME or MODULE:NAME, "
        "whatever they name",
    )
    add_consent(play)
    play.set_defaults(run=_play)


def _play(options: argparse.Namespace) -> int:
    from ttr.dialogues.logs import LogFile
    from ttr.dialogues.stories import Outcome

    outputs = (options.log, options.html, options.junit)
    try:
        check_outputs(options.files, outputs)
    except TTRError as error:
        return complain(str(error))
    consent, game = consent_of(options), None
    if options.game is not None:
        try:
            game = named_game(options.game, consent)
        except TTRError as error:
            return complain(str(error))
    plan: list[tuple[str, Story]] = []
    unread: list[Outcome] = []
    for file in options.files:
        try:
            plan += ((str(file), it) for it in _read_allowed(file, game, consent))
        except TTRError as error:
            complain(str(error))
            unread.append(Outcome(str(file), file.stem, error=error))
    try:
        with ExitStack() as closing:
            log = closing.enter_context(LogFile(options.log)) if options.log else None
            playing = _Playing(_echo_of(options), options.trace, log, consent, game)
            results = playing.all(plan)
        _write_reports(options, unread, results)
    except TTRError as error:
        return complain(str(error))
    _print_summaries(options, results)
    if unread:
        return WRONG_USE
    return FINE if all(one.as_written for one, _ in results) else FAILED


def _read_allowed(
    file: Path, game: Setting | None, consent: Consent
) -> Sequence[Story]:
    """The stories in a file; `NotAllowedError` if one names something without consent.

    If a game is given, it is played instead of those that the stories name.
    """
    from ttr.dialogues.stories import check_consent, read_stories

    stories = read_stories(file)
    for story in stories if game is None else ():
        check_consent(story, consent)
    return stories


def _echo_of(options: argparse.Namespace) -> Callable[[str], None]:
    return (lambda line: None) if options.quiet or options.json else say


@dataclass
class _Playing:
    """Stories being played one after the other."""

    echo: Callable[[str], None]
    trace: bool
    log: LogFile | None
    consent: Consent
    game: Setting | None = None
    settings: dict[Line | None, Setting] = field(default_factory=dict)

    def all(self, plan: list[tuple[str, Story]]) -> list[_Result]:
        """The results of the stories, each with what was played of it."""
        return [self._one(file, story) for file, story in plan]

    def _one(self, file: str, story: Story) -> _Result:
        from ttr.dialogues.stories import Outcome, StoryError

        self.echo(f"--- {story.title}")
        start = perf_counter()
        try:
            played = self._play_story(story)
        except (StoryError, NotAllowedError) as error:
            seconds = perf_counter() - start
            return Outcome(file, story.title, seconds, error=error), None
        seconds = perf_counter() - start
        return Outcome(file, story.title, seconds, played.mismatch), played

    def _play_story(self, story: Story) -> Played:
        from ttr.dialogues.stories import opening, play

        setting = self._setting_of(story)
        if self.log is not None:
            self.log.begin(opening(story, setting), story.title)
        return play(story, setting, echo=self.echo, witness=self._witness)

    def _setting_of(self, story: Story) -> Setting:
        """The setting that the story names, found once for all stories that name it."""
        from ttr.dialogues.stories import setting_of

        if self.game is not None:
            return self.game
        if story.game not in self.settings:
            self.settings[story.game] = setting_of(story, self.consent)
        return self.settings[story.game]

    def _witness(self, one: Trial) -> None:
        if self.log is not None:
            self.log.write(one)
        for step in one.steps if self.trace else ():
            self.echo("\n".join(f"   {line}" for line in str(step).splitlines()))


# --- reports -------------------------------------------------------------------------


def _write_reports(
    options: argparse.Namespace, unread: list[Outcome], results: list[_Result]
) -> None:
    from ttr.dialogues.stories import junit
    from ttr.dialogues.transcripts import transcript

    if options.junit is not None:
        outcomes = [*unread, *(one for one, _ in results)]
        write_whole(options.junit, f"{junit(outcomes)}\n")
    if options.html is not None:
        shown = [one.dialogue for _, one in results if one is not None]
        title = ", ".join(file.name for file in options.files)
        write_whole(options.html, transcript(title, shown))


def _print_summaries(options: argparse.Namespace, results: list[_Result]) -> None:
    """Prints what differs, and a summary of each file."""
    from ttr.dialogues.stories import facts, summary

    if options.json:
        about = [facts(one) for one, _ in results]
        say_json(about)
        return
    files: dict[str, list[Outcome]] = {}
    for one, _ in results:
        files.setdefault(one.file, []).append(one)
    for file, outcomes in files.items():
        for one in outcomes:
            if not one.as_written:
                say(str(one))
        say(summary(file, outcomes))
