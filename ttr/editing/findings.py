"""Checks files of theories and stories, and says where what is wrong with them.

`ttr check` prints it, and the language server shows it as one types. Nothing in a file
is run: a story is played only if its game is a theory's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Self

from ttr.dialogues.settings import StoryError, python_in
from ttr.dialogues.stories.junit_report import Outcome, summary
from ttr.dialogues.stories.story_opening import setting_of
from ttr.dialogues.stories.story_player import play
from ttr.dialogues.stories.story_reader import Line, Story, stories_of_text
from ttr.errors import MistakesError, Span, TooLargeError, TTRError
from ttr.escapes import terminal_line, terminal_text
from ttr.safety.consent import OWN_FOLDER, Consent
from ttr.safety.files import why_unread
from ttr.safety.inputs import read_text
from ttr.safety.limits import STORIES, THEORY
from ttr.theories.check_reports import Report
from ttr.theories.checking import check
from ttr.theories.loading import ReadText, UnreadableError
from ttr.theories.theory import theory_of_file

if TYPE_CHECKING:
    from ttr.dialogues.settings import Setting

Severity = Literal["error", "warning"]


@dataclass(frozen=True)
class Finding:
    """What is wrong at a place, in one line of text.

    `line` and `column` count from 1, and `length` is in characters.

    >>> print(Finding("a.ttr", "there is no dgo", line=3, hint="did you mean dog?"))
    a.ttr:3:1: error: there is no dgo
    a.ttr:3:1: note: did you mean dog?
    """

    file: str
    message: str
    line: int = 1
    column: int = 1
    length: int = 1
    severity: Severity = "error"
    hint: str = ""

    @classmethod
    def at(
        cls,
        file: str,
        message: str,
        span: Span | None,
        hint: str = "",
        severity: Severity = "error",
    ) -> Self:
        """What is wrong at a span; at the beginning of the file if there is none."""
        told, way_out = _on_one_line(message), _on_one_line(hint)
        if span is None:
            return cls(file, told, hint=way_out, severity=severity)
        return cls(
            *(span.source, told, span.line, span.column, span.length),
            severity=severity,
            hint=way_out,
        )

    def __str__(self) -> str:
        """As compilers print it, which editors understand."""
        place = terminal_line(f"{self.file}:{self.line}:{self.column}")
        told = f"{place}: {self.severity}: {self.message}"
        return f"{told}\n{place}: note: {self.hint}" if self.hint else told


def _on_one_line(text: str) -> str:
    return " ".join(terminal_text(text).split())


@dataclass(frozen=True)
class Checked:
    """What came of checking a file.

    `mistakes` are why nothing could be checked, `unreadable` says why the file could
    not be read. `files` are all that were read or looked for.
    """

    file: str
    report: Report | None = None
    outcomes: tuple[Outcome, ...] = ()
    mistakes: tuple[TTRError, ...] = ()
    unreadable: str = ""
    files: frozenset[Path] = field(default=frozenset(), compare=False)
    told: str = ""

    @property
    def holds(self) -> bool:
        """Is nothing wrong with the file? Warnings do not count."""
        if self.mistakes or self.unreadable:
            return False
        holds = self.report is None or self.report.holds
        return holds and all(one.as_written for one in self.outcomes)

    @property
    def is_beyond_limits(self) -> bool:
        """Could the file not be read, or not be worked through?"""
        return bool(self.unreadable) or any(
            isinstance(one, TooLargeError) for one in self.mistakes
        )

    @property
    def messages(self) -> tuple[str, ...]:
        """All that is wrong, as `ttr check` prints it."""
        mistakes = [f"error: {one}" for one in self.mistakes]
        differences = [str(one) for one in self.outcomes if not one.as_written]
        return (*mistakes, *(self.report.messages if self.report else ()), *differences)

    @property
    def summary(self) -> str:
        """One line on the file."""
        count = len(self.mistakes)
        if count:
            told = f"{count} mistake{'s' * (count != 1)}, nothing checked"
        elif self.report:
            told = self.report.summary
        elif self.outcomes:
            return summary(self.file, self.outcomes)
        else:
            told = self.told
        return f"{self.file}: {told}"

    @property
    def findings(self) -> tuple[Finding, ...]:
        """All that is wrong, each with its place."""
        return tuple(self._findings())

    def _findings(self) -> Iterator[Finding]:
        if self.unreadable:
            yield Finding.at(self.file, self.unreadable, None)
        for mistake in self.mistakes:
            yield _finding_of_error(self.file, mistake)
        for failure in self.report.failures if self.report else ():
            one = failure.check
            told = f"failed: {one.text}: expected {one.expected}, found {failure.found}"
            why = "; ".join(line.strip() for line in failure.why.strip().splitlines())
            yield Finding.at(self.file, f"{told}: {why}" if why else told, one.span)
        for fault in self.report.faults if self.report else ():
            yield Finding.at(
                self.file, fault.message, fault.span, fault.hint, fault.severity
            )
        for outcome in self.outcomes:
            if outcome.mismatch is not None:
                line = outcome.mismatch.line
                told = (
                    f"{outcome.title}: expected {outcome.mismatch.expected}, "
                    f"found {outcome.mismatch.found}"
                )
                yield Finding.at(self.file, told, line.span(0, len(line.text)))
            elif outcome.error is not None:
                yield _finding_of_error(self.file, outcome.error)


def _finding_of_error(file: str, error: TTRError) -> Finding:
    """A mistake in a theory or a story; the latter begins with its place."""
    message, line = error.message, 1
    if isinstance(error, StoryError):
        place, colon, rest = message.removeprefix(f"{file}:").partition(": ")
        if colon and place.isdecimal():
            line, message = int(place), rest
    if error.span is None:
        return Finding(file, _on_one_line(message), line, hint=_on_one_line(error.hint))
    return Finding.at(file, message, error.span, error.hint)


# --- checking ------------------------------------------------------------------------


def check_file(
    path: str | Path,
    consent: Consent = OWN_FOLDER,
    text_of: Callable[[Path], str | None] = lambda path: None,
) -> Checked:
    """Checks a theory (`.ttr`) or the stories of a `.dlg`.

    `text_of` may give the text of a file that an editor has not saved yet. Never raises
    an error for what stands in a file.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "a.ttr")
    ...     _ = file.write_text("basic A\\nB := [x : a]")
    ...     for found in check_file(file).findings:
    ...         print(found.line, found.column, found.message, found.hint)
    2 11 nothing is called a here did you mean A?
    """
    files: set[Path] = set()

    def read(one: Path) -> str:
        files.add(one)
        found = text_of(one)
        limit = STORIES if one.suffix == ".dlg" else THEORY
        if found is None:
            return read_text(one, limit)
        limit.check(len(found.encode("utf-8", "replace")))
        return found.replace("\r\n", "\n").replace("\r", "\n")

    is_story = Path(path).suffix == ".dlg"
    try:
        found = (_check_stories if is_story else _check_theory)(path, consent, read)
    except UnreadableError as error:
        if error.span is None:
            found = Checked(str(path), unreadable=error.message)
        else:
            found = Checked(str(path), mistakes=(error,))
    except MistakesError as error:
        found = Checked(str(path), mistakes=error.errors)
    except TTRError as error:
        found = Checked(str(path), mistakes=(error,))
    return replace(found, files=frozenset(files))


def _check_theory(path: str | Path, consent: Consent, read: ReadText) -> Checked:
    return Checked(str(path), check(theory_of_file(Path(path), consent, read)))


def _check_stories(path: str | Path, consent: Consent, read: ReadText) -> Checked:
    try:
        text = read(Path(path))
    except (OSError, UnicodeDecodeError) as error:
        return Checked(str(path), unreadable=why_unread(path, error))
    stories = stories_of_text(text, Path(path))
    settings: dict[Line, Setting | TTRError] = {}
    outcomes = [
        _play(story, story.game, settings, consent, read)
        for story in stories
        if story.game and not _python_in(story.game)
    ]
    count = f"{len(stories)} {'story' if len(stories) == 1 else 'stories'}"
    told = f"{count} read, none played: no theory has their game"
    return Checked(str(path), outcomes=tuple(outcomes), told=told)


def _python_in(line: Line) -> bool:
    """Does a line name a game in Python? One that names none is reported later."""
    try:
        return bool(python_in(line.text.partition(" ")[2].strip()))
    except StoryError:
        return False


def _play(
    story: Story,
    game: Line,
    settings: dict[Line, Setting | TTRError],
    consent: Consent,
    read: ReadText,
) -> Outcome:
    """What came of a story; each setting is made once for the stories that name it."""
    try:
        if game not in settings:
            try:
                settings[game] = setting_of(story, consent, read)
            except TTRError as error:
                settings[game] = error
        setting = settings[game]
        if isinstance(setting, TTRError):
            raise setting
        played = play(story, setting)
    except TTRError as error:
        return Outcome(game.file, story.title, error=error)
    return Outcome(game.file, story.title, mismatch=played.mismatch)
