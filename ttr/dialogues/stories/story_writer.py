"""Writing what was played as a story, which plays again as it was."""

from __future__ import annotations

from collections.abc import Iterable

from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.dialogues.settings import Setting
from ttr.dialogues.stories.story_reader import line_of
from ttr.types.objects import Record
from ttr.types.printing import notation


def story_text(dialogue: Dialogue) -> str:
    """The text of a story in which this was played.

    The story says where it starts unless the game that it names does.

    >>> from ttr import Theory
    >>> from ttr.dialogues.dialogue import Dialogue
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     pred greet(Ind)
    ...     Board := [said : list(RecType)]
    ...     Greet := [x : Ind, e : greet(x)]
    ...     rule hear(s : Board, e : Greet) := [said = [Greet] : list(RecType)]
    ...     game talk({said = []} : Board) := hear
    ... ''')
    >>> talk = Setting.of(theory.games["talk"], theory, "talk.ttr talk")
    >>> dialogue = Dialogue(talk.game, title="a greeting", place=talk)
    >>> print(story_text(dialogue.then(theory.Greet).then(None)))
    --- a greeting
    @ game talk.ttr talk
    U> Greet
    U>
    <BLANKLINE>
    """
    setting, start = dialogue.setting, dialogue.start.state
    is_named = setting.reference and start == setting.game.start
    return format_story(
        dialogue.title,
        dialogue.in_words().trials,
        setting,
        start=None if is_named else start,
    )


def format_story(
    title: str,
    trials: Iterable[Trial],
    setting: Setting,
    *,
    start: Record | None = None,
) -> str:
    """The text of a story of trials in words, from a start if one is given.

    >>> from ttr import Theory
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> notes = Setting.of(theory.games["notes"], theory, "notes.ttr notes")
    >>> trials = [it.in_words(notes) for it in play(notes.game, ["ann"]).trials]
    >>> print(format_story("one name", trials, notes))
    --- one name
    @ game notes.ttr notes
    U> ann
    """
    lines = [f"--- {line_of(' '.join(title.split()))}"]
    if setting.reference:
        lines.append(f"@ game {setting.reference}")
    if start is not None:
        lines.append(f"@ start {notation(start)}")
    for one in trials:
        lines += turn_lines(one.line, one.said)
    return "\n".join([*lines, ""])


def turn_lines(line: str, said: Iterable[str]) -> list[str]:
    """The lines of a turn; a move without words is none of them."""
    return [line_of(line), *(line_of(f"S> {words}") for words in said if words)]
