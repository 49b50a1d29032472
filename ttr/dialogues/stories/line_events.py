"""What the lines of a story stand for: values and events."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from ttr.dialogues.settings import Setting, StoryError
from ttr.dialogues.stories.story_reader import Line
from ttr.errors import NotationError, TTRError, UpdateError, describe_error, suggestion
from ttr.types.objects import Object
from ttr.types.syntax import TypeNode
from ttr.updates import NBest, Run, nbest

_Read = Callable[[Line, str, int], object]
"""Reads a part of a line, which begins at an index of its text, as an event."""

VERBS = ("game", "start", "event", "perhaps")
"""The words that may stand after `@`."""


def value_of_text(
    setting: Setting, now: Run, line: Line, text: str, begin: int
) -> Object:
    """The value of a part of a line, which begins at this index of the line's text.

    Raises `StoryError` with the place of the mistake.
    """
    begin += len(text) - len(text.lstrip())
    try:
        return setting.value(text.strip(), now.model, line.file)
    except NotationError as error:
        span = error.span
        if span is None or span.source != line.file:
            raise line.wrong(error.message) from error
        told = StoryError(
            f"{line.place}: {error.message}",
            span=line.span(begin + span.column - 1, span.length),
            hint=error.hint,
        )
        raise told from error
    except TTRError as error:
        raise line.wrong(error.message) from error


def type_of_text(
    setting: Setting, now: Run, line: Line, text: str, begin: int
) -> TypeNode:
    """The type of a part of a line; raises `StoryError` for another value."""
    T = value_of_text(setting, now, line, text, begin)
    if isinstance(T, TypeNode):
        return T
    raise line.wrong(f"expected a type, found {text.strip()}")


def event_of_line(setting: Setting, now: Run, line: Line) -> object:
    """The event that a line stands for, in words if the game hears them, or None."""
    hear = setting.game.hear
    in_notation: _Read = partial(value_of_text, setting, now)
    if line.mark == "@":
        return _event_of_statement(line, in_notation)
    if not line.text:
        return None
    read = in_notation if hear is None else partial(_understand, hear)
    if line.mark == "U>":
        return read(line, line.text, 0)
    return _alternative_events(line, 0, read)


def _event_of_statement(line: Line, read: _Read) -> object:
    verb, _, text = line.text.partition(" ")
    begin = len(verb) + 1
    match verb:
        case "event":
            return read(line, text, begin)
        case "perhaps":
            return _alternative_events(line, begin, read)
        case "start":
            raise line.wrong("a story says where it starts before anything else")
    hint = suggestion(verb, VERBS) or f"there are {', '.join(VERBS)}"
    raise line.wrong(f"there is no `@ {verb}`: {hint}")


def _understand(
    hear: Callable[[str], object], line: Line, text: str, begin: int
) -> object:
    """The event that a game understands words as; None if it does not."""
    try:
        return hear(text)
    except TTRError as error:
        raise line.wrong(error.message) from error
    except Exception as error:
        fault = describe_error(error)
        raise line.wrong(f"what the game hears by failed: {fault}") from error


def _alternative_events(line: Line, begin: int, read: _Read) -> NBest | None:
    """The alternatives of a line with their probabilities, as one uncertain event.

    Alternatives that the game does not understand are left out.
    """
    found = alternatives(line, begin)
    pairs = [(read(line, it.text, it.begin), it.p) for it in found]
    understood = [(one, p) for one, p in pairs if one is not None]
    if pairs and not understood:
        return None
    try:
        return nbest(*understood)
    except UpdateError as error:
        span = line.span(begin, len(line.text) - begin)
        raise StoryError(f"{line.place}: {error.message}", span=span) from error


class Alternative(NamedTuple):
    """What was perhaps said or done, with its probability and place in the line.

    >>> Alternative("This is a cup.", p=0.7, begin=4)
    Alternative(text='This is a cup.', p=0.7, begin=4)
    """

    text: str
    p: float
    begin: int


def alternatives(line: Line, begin: int = 0) -> tuple[Alternative, ...]:
    """The alternatives in a line: texts, each followed by its probability.

    Raises `StoryError` for one without a probability.

    >>> from ttr.dialogues.stories import Line
    >>> heard = Line("a.dlg", 3, "U?", "a cup 0.7 | a cap 0.2")
    >>> [(it.text, it.p) for it in alternatives(heard)]
    [('a cup', 0.7), ('a cap', 0.2)]
    """
    parts = re.finditer(r"(?:(?!\s\|\s).)+", line.text[begin:])
    return tuple(_read_alternative(line, begin + it.start(), it[0]) for it in parts)


def _read_alternative(line: Line, begin: int, text: str) -> Alternative:
    found = re.fullmatch(r"[\s|]*(\S.*?)\s+(\d*\.?\d+)\s*", text)
    if found is None:
        told = "an alternative ends with its probability, as in `Greet 0.6`"
        span = line.span(begin, len(text))
        raise StoryError(f"{line.place}: {told}", span=span)
    return Alternative(found[1], float(found[2]), begin + found.start(1))
