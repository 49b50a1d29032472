"""Opening a story: which game is played, and where it starts."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from shlex import quote

from ttr.dialogues.settings import (
    Setting,
    StoryError,
    check_named,
    python_in,
    setting,
)
from ttr.dialogues.stories.line_events import value_of_text
from ttr.dialogues.stories.story_reader import Line, Story
from ttr.errors import TTRError, suggestion
from ttr.safety.consent import OWN_FOLDER, Consent, NotAllowedError
from ttr.theories.loading import ReadText, read_theory_text
from ttr.types.objects import Record


def setting_of(
    story: Story, consent: Consent = OWN_FOLDER, read: ReadText = read_theory_text
) -> Setting:
    r"""The setting that a story names; raises `StoryError` and `NotAllowedError`.

    Python that it names runs if it lies in the story's folder or below, or where there
    is consent. `read` reads the text of a theory that it names.

    >>> import tempfile
    >>> from ttr.dialogues.stories import read_stories
    >>> text = '''
    ...     basic Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... '''
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "notes.ttr").write_text(text)
    ...     file = Path(folder, "a.dlg")
    ...     _ = file.write_text("--- nothing happens\n@ game notes.ttr notes\nU>\n")
    ...     setting_of(read_stories(file)[0]).reference
    'notes.ttr notes'
    """
    check_consent(story, consent)
    if story.game is None:
        first = story.lines[0]
        verb = first.text.partition(" ")[0] if first.mark == "@" else ""
        near = suggestion(verb, ("game",)) or "begin the file with " + (
            "`@ game FILE.ttr NAME`"
        )
        raise first.wrong(f"the story names no game: {near}")
    try:
        allowed = _consent_beside(story.game, consent)
        return setting(*_reference_of(story.game), allowed, read)
    except StoryError as error:
        raise story.game.wrong(error.message) from error


def check_consent(story: Story, consent: Consent) -> None:
    """Raises `NotAllowedError` where a story names something without consent.

    >>> from ttr.dialogues.stories import Line
    >>> story = Story("a talk", (), Line("a.dlg", 1, "@", "game ../games.py:door"))
    >>> check_consent(story, OWN_FOLDER)
    Traceback (most recent call last):
        ...
    ttr.safety.consent.NotAllowedError: a.dlg:1: ../games.py lies in another folder:
    allow it with --allow ..., or name the game yourself, --game ../games.py:door
    """
    if story.game is None:
        return
    try:
        check_named(*_reference_of(story.game), _consent_beside(story.game, consent))
    except NotAllowedError as error:
        reference, _ = _reference_of(story.game)
        or_else = f", or name the game yourself, --game {quote(reference)}"
        told = error.message + or_else * bool(consent.python and python_in(reference))
        raise NotAllowedError(f"{story.game.place}: {told}") from error
    except StoryError as error:
        raise story.game.wrong(error.message) from error


def _reference_of(line: Line) -> tuple[str, Path]:
    """The reference to a game in a line, and the folder it is relative to."""
    return line.text.partition(" ")[2].strip(), Path(line.file).parent


def _consent_beside(line: Line, consent: Consent) -> Consent:
    """The consent, extended to the folder of the story."""
    return consent.with_folders(Path(line.file).parent)


def opening(story: Story, setting: Setting) -> Setting:
    """The setting with the start of the story, if the story says one.

    Raises `StoryError` for a start that is no state of the game.

    >>> from ttr import Theory
    >>> from ttr.dialogues.stories import Line
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory)
    >>> story = Story("later", (Line("a.dlg", 1, "@", "start {heard = [ann]}"),))
    >>> print(opening(story, notes).game.start)
    {heard = [ann]}
    """
    first = story.lines[0]
    if not _says_start(first):
        return setting
    verb, _, text = first.text.partition(" ")
    start = value_of_text(setting, setting.game.begin(), first, text, len(verb) + 1)
    if not isinstance(start, Record):
        raise first.wrong(f"a story starts in a record, found {text or 'nothing'}")
    try:
        return replace(setting, game=replace(setting.game, start=start))
    except TTRError as error:
        raise first.wrong(error.message) from error


def turns_of(story: Story) -> tuple[Line, ...]:
    """The lines of a story without the one that says where it starts."""
    return story.lines[1:] if _says_start(story.lines[0]) else story.lines


def _says_start(line: Line) -> bool:
    return line.mark == "@" and line.text.partition(" ")[0] == "start"
