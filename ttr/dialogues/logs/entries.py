"""The lines of a log: a dialogue has a header, then an entry for each turn.

Each line is a JSON object. Values are written in the notation; every name in them is
declared in the line where it is first used, or before.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ttr.errors import TTRError
from ttr.escapes import json_text

FORMAT, VERSION = "ttr", 1


class LogError(TTRError):
    r"""A log that cannot be written, read or replayed: where, and why.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr.dialogues.logs import read_logs
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "a.jsonl")
    ...     _ = file.write_text("hello\n")
    ...     read_logs(file)
    Traceback (most recent call last):
        ...
    ttr.dialogues.logs.entries.LogError: .../a.jsonl:1: this is no JSON
    """


class EntryError(Exception):
    """What is wrong with a line; the reader adds the place."""


@dataclass(frozen=True)
class Header:
    """How a dialogue begins: the game that is played, and the state at the start.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(theory.games["notes"], ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> log.header.start
    '{heard = []}'
    """

    game: str
    title: str
    start: str
    declares: tuple[str, ...]
    objects: tuple[str, ...]

    def text(self) -> str:
        """The line of the log."""
        begun = {"log": FORMAT, "version": VERSION}
        return json_text({**begun, **vars(self)})


@dataclass(frozen=True)
class Entry:
    """A turn: what happened, what was said, which rules ran, the state after it.

    `line` is the turn's line in a story. `event` is what the game was given, a value, a
    list of values with probabilities, or None. `said` has for each own move its type
    and its words, `rules` for each rule its name, event, bindings and changes. `judged`
    are the facts that the model gained, and `names` how many names it has given out;
    `whole` is false if the turn has changed the model by more than facts.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr import Theory
    >>> from ttr.dialogues.logs import read_logs, write_log
    >>> from ttr.testing import play
    >>> theory = Theory.parse('''
    ...     basic Ind
    ...     object ann : Ind
    ...     Board := [heard : list(Ind)]
    ...     rule note(s : Board, e : Ind) := [heard = [e] + s.heard : list(Ind)]
    ...     game notes({heard = []} : Board) := note
    ... ''')
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_log(Path(folder, "a.jsonl"), [play(theory.games["notes"], ["ann"])])
    ...     [log] = read_logs(Path(folder, "a.jsonl"))
    >>> entry = log.entries[0]
    >>> entry.turn, entry.line, entry.state
    (1, 'U> ann', '{heard = [ann]}')
    """

    turn: int
    line: str
    event: str | list[list[Any]] | None
    said: tuple[tuple[str, str], ...]
    rules: tuple[Mapping[str, Any], ...]
    state: str
    judged: tuple[tuple[str, str, float, float], ...]
    names: int
    whole: bool
    declares: tuple[str, ...]
    objects: tuple[str, ...]

    def text(self) -> str:
        """The line of the log."""
        return json_text(vars(self))


# --- reading -------------------------------------------------------------------------


def read_header(facts: object) -> Header | None:
    """The header in a line, or None if it holds none; raises `EntryError`."""
    if not isinstance(facts, dict) or "log" not in facts:
        return None
    if facts["log"] != FORMAT:
        raise EntryError(f"a log of another kind: {json.dumps(facts['log'])}")
    if facts.get("version") != VERSION:
        raise EntryError(
            f"a log of version {json.dumps(facts.get('version'))}, but {VERSION} is "
            "read here"
        )
    return Header(
        _text(facts, "game"),
        _text(facts, "title"),
        _text(facts, "start"),
        _texts(facts, "declares"),
        _texts(facts, "objects"),
    )


def read_entry(facts: object) -> Entry:
    """The turn in a line; raises `EntryError`."""
    if not isinstance(facts, dict):
        raise EntryError("no turn of a log")
    return Entry(
        _field(facts, "turn", int),
        _text(facts, "line"),
        _read_event(facts),
        tuple(
            (_element(one, 0, str), _element(one, 1, str))
            for one in _list(facts, "said")
        ),
        tuple(_read_rule(one) for one in _list(facts, "rules")),
        _text(facts, "state"),
        tuple(map(_read_fact, _list(facts, "judged"))),
        _field(facts, "names", int),
        _field(facts, "whole", bool),
        _texts(facts, "declares"),
        _texts(facts, "objects"),
    )


def _field(facts: dict[str, Any], key: str, kind: type) -> Any:
    if key not in facts:
        raise EntryError(f"no turn of a log: {key} is missing")
    if type(facts[key]) is not kind:
        raise EntryError(
            f"{key} should be {_kind_name(kind)}, found {json.dumps(facts[key])}"
        )
    return facts[key]


def _kind_name(kind: type) -> str:
    names = {int: "a whole number", str: "a text", bool: "true or false"}
    return names.get(kind, "a list" if kind is list else "an object")


def _text(facts: dict[str, Any], key: str) -> str:
    text: str = _field(facts, key, str)
    return text


def _list(facts: dict[str, Any], key: str) -> list[Any]:
    found: list[Any] = _field(facts, key, list)
    return found


def _texts(facts: dict[str, Any], key: str) -> tuple[str, ...]:
    found = _list(facts, key)
    if not all(isinstance(one, str) for one in found):
        raise EntryError(f"{key} should be a list of texts")
    return tuple(found)


def _element(one: object, index: int, *kinds: type) -> Any:
    """An element of a list inside a turn."""
    if isinstance(one, list) and index < len(one) and type(one[index]) in kinds:
        return one[index]
    raise EntryError(f"no turn of a log: {json.dumps(one)} is not expected in it")


def _read_event(facts: dict[str, Any]) -> str | list[list[Any]] | None:
    event = facts.get("event")
    if event is None or isinstance(event, str):
        return event
    if not isinstance(event, list):
        raise EntryError(f"event should be a text or a list, found {json.dumps(event)}")
    return [[_element(one, 0, str), _element(one, 1, float, int)] for one in event]


def _read_rule(one: object) -> Mapping[str, Any]:
    if not isinstance(one, dict):
        raise EntryError(f"no turn of a log: {json.dumps(one)} is no rule")
    return {
        "rule": _text(one, "rule"),
        "event": _text(one, "event"),
        "with": _field(one, "with", dict),
        "changes": list(_texts(one, "changes")),
    }


def _read_fact(one: object) -> tuple[str, str, float, float]:
    lo, hi = _element(one, 2, float, int), _element(one, 3, float, int)
    return _element(one, 0, str), _element(one, 1, str), lo, hi
