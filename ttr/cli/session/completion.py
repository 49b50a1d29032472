"""Completion in a session: names, keywords, commands and files."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from ttr.cli.session.repl import COMMANDS
from ttr.cli.session.replies import ASKED
from ttr.cli.session.sessions import Session
from ttr.notation.syntax_errors import KEYWORDS
from ttr.types.objects import Record
from ttr.types.paths import subterms
from ttr.types.reserved_words import RESERVED
from ttr.types.syntax import RecordType


def completions(session: Session, before: str) -> list[str]:
    """The completions of the word at the end of a text, as whole words.

    >>> completions(Session(), ":la"), completions(Session(), "ba")
    (['latex'], ['basic'])
    """
    command = re.match(r":(\w*)$", before)
    if command:
        return _starting_with(command[1], COMMANDS)
    file = re.match(r":(?:load|save)\s+(.*)$", before)
    if file:
        return _files(file[1])
    word = re.search(r"(\.?)(\w*)$", before)
    assert word is not None
    path, start = word.groups()
    labels = {*_labels(session), *_names_before_signs(before[: word.start()])}
    if path:
        return _starting_with(start, labels)
    names = {*session.theory.names, *_names_before_signs(before[: word.start()])}
    return _starting_with(start, names | {*KEYWORDS, *RESERVED, *ASKED})


def _starting_with(start: str, words: Iterable[str]) -> list[str]:
    return sorted(word for word in words if word.startswith(start))


def _labels(session: Session) -> Iterator[str]:
    """The labels of all named types and records."""
    for value in subterms(session.theory.definitions.values()):
        if isinstance(value, RecordType | Record):
            yield from value


def _names_before_signs(text: str) -> list[str]:
    """The labels and variables in a text: the names before a colon or an equals."""
    return re.findall(r"(\w+)\s*(?::|=)", text)


def _files(start: str) -> list[str]:
    """The folders and theory files whose path begins so, from the last folder on."""
    folder, _, name = start.rpartition("/")
    place = Path(f"{folder}/" if "/" in start else ".").expanduser()
    try:
        inside = sorted(place.iterdir())
    except OSError:
        return []
    shown = (f"{one.name}/" if one.is_dir() else one.name for one in inside)
    known = (one for one in shown if one.endswith(("/", ".ttr")))
    return [one for one in known if one.startswith(name)]
