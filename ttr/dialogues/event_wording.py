"""Events and moves in words: as the game has them, or else in the notation."""

from __future__ import annotations

from ttr.dialogues.settings import Setting
from ttr.display.abbreviations import abbreviator
from ttr.errors import UpdateError, describe_error
from ttr.judging.judgements import Judgement
from ttr.types.objects import Object
from ttr.types.printing import notation
from ttr.updates import NBest


def wording(move: Judgement, setting: Setting) -> str:
    """A move of the system in the words of the game, else its type in the notation.

    What the theory defines stands by its name. Raises `UpdateError` where the game
    finds no words.

    >>> from ttr import Theory
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     pred greet(Ind)
    ...     Greet := [e : greet(ann)]
    ...     Board := [agenda : list(RecType)]
    ...     rule drop(s : [agenda = [Greet] : list(RecType)], e : Greet) :=
    ...         [agenda = [] : list(RecType)]
    ...     game talk({agenda = [Greet]} : Board, acts on agenda) := drop
    ... ''')
    >>> talk = Setting.of(theory.games["talk"], theory)
    >>> turn = talk.game.take(talk.game.begin())
    >>> wording(turn.said[0], talk)
    'Greet'
    """
    say = setting.game.say
    if say is None:
        return _abbreviate(move.type, setting)
    try:
        return " ".join(say(move).split())
    except Exception as error:
        fault = describe_error(error)
        raise UpdateError(
            f"the game {setting.game.name} found no words for {move}: {fault}"
        ) from error


def line_of_event(event: object, setting: Setting) -> str:
    """The line of a story that makes an event happen, in the notation.

    It is read so whether or not the game hears words.
    """
    hears = setting.game.hear is not None
    match event:
        case None:
            return "U>"
        case NBest():
            parts = [f"{_abbreviate(one, setting)} {p!r}" for one, p in event]
            return ("@ perhaps " if hears else "U~ ") + " | ".join(parts)
    return ("@ event " if hears else "U> ") + _abbreviate(event, setting)


def _abbreviate(value: Object, setting: Setting) -> str:
    return notation(abbreviator(setting.theory, 0)(value))
