"""Writing what was played as a story, which plays again as it was."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ttr.dialogues.settings import Setting
from ttr.dialogues.stories.story_reader import line_of
from ttr.display.abbreviations import folding
from ttr.errors import UpdateError
from ttr.judging.judgements import Judgement
from ttr.types.printing import notation
from ttr.types.syntax import Object, Record
from ttr.updates import NBest, Turn

__all__ = ["Moment", "moment", "turn_lines", "worded", "written"]


@dataclass(frozen=True)
class Moment:
    """A turn as a story has it: the line that led to it, and what the system said."""

    line: str
    turn: Turn
    said: tuple[str, ...]


def moment(turn: Turn, setting: Setting, line: str = "") -> Moment:
    """The moment of a turn; without a line, the event is written in the notation."""
    said = tuple(worded(move, setting) for move in turn.said)
    return Moment(line or _line(turn.event, setting), turn, said)


def worded(move: Judgement, setting: Setting) -> str:
    """A move of the system in the words of the game, else its type in the notation.

    What is defined in the theory stands by its name. Raises `UpdateError` where the
    game finds no words.
    """
    say = setting.game.say
    if say is None:
        return _folded(move.type, setting)
    try:
        return " ".join(say(move).split())
    except Exception as error:
        fault = f"{type(error).__name__}: {error}"
        raise UpdateError(
            f"the game {setting.game.name} found no words for {move}: {fault}"
        ) from error


def written(
    title: str,
    moments: Iterable[Moment],
    setting: Setting,
    *,
    start: Record | None = None,
) -> str:
    """The text of a story in which this was played, from a start if one is given.

    >>> from ttr.dialogues.settings import Setting
    >>> from ttr.theories.theory import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     pred greet(Ind)
    ...     Board := [said : list(RecType)]
    ...     Greet := [x : Ind, e : greet(x)]
    ...     rule hear(s : Board, e : Greet) := [said = [Greet] : list(RecType)]
    ...     game talk({said = []} : Board) := hear
    ... ''')
    >>> talk = Setting.of(theory.games["talk"], theory, "talk.ttr talk")
    >>> turns = talk.game.play([theory.Greet, None])
    >>> print(written("a greeting", [moment(turn, talk) for turn in turns], talk))
    --- a greeting
    @ game talk.ttr talk
    U> Greet
    U>
    <BLANKLINE>
    """
    lines = [f"--- {line_of(' '.join(title.split()))}"]
    if setting.reference:
        lines.append(f"@ game {setting.reference}")
    if start is not None:
        lines.append(f"@ start {notation(start)}")
    for one in moments:
        lines += turn_lines(one.line, one.said)
    return "\n".join([*lines, ""])


def turn_lines(line: str, said: Iterable[str]) -> list[str]:
    """The lines of a turn; a move without words is none of them."""
    return [line_of(line), *(line_of(f"S> {words}") for words in said if words)]


def _line(event: object, setting: Setting) -> str:
    """The line that makes an event happen, whether or not the game hears words."""
    hears = setting.game.hear is not None
    match event:
        case None:
            return "U>"
        case NBest():
            parts = [f"{_folded(one, setting)} {p!r}" for one, p in event]
            return ("@ perhaps " if hears else "U~ ") + " | ".join(parts)
    return ("@ event " if hears else "U> ") + _folded(event, setting)


def _folded(value: Object, setting: Setting) -> str:
    return notation(folding(setting.theory, 0)(value))
