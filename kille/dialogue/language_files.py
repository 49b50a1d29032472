"""The files of a language: those of the package, or some of one's own in a folder.

A language is known by its name, `en`. With a folder before it, `mine/en`, its files are
taken from that folder as far as they are there, and the others from the package.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path, PurePath
from typing import Any

from kille.dialogue.user_cache import recall
from ttr.safety.inputs import parse_toml, read_text
from ttr.safety.limits import SETTINGS

FILES = ("tutor.{}.lark", "lexicon.{}.toml")
"""The files of a language: its grammar, and its lexicon."""

WORDS = "words.{}.toml"
"""The file of a language that says of which words the robot asks before it learns them.

A language may do without.
"""

ISLANDS = "islands.{}.lark"
"""The file of a language with what is understood in the middle of a sentence.

It extends the grammar of the language.
"""

STRATEGIES = "strategies.toml"
"""The file of what the robot decides by, which is the same for all languages."""


def language_in(folder: PurePath | str, language: str) -> str:
    """The language whose files may be in a folder.

    >>> language_in("mine", "en")
    'mine/en'
    """
    return PurePath(folder, language).as_posix()


def plain(language: str) -> str:
    """The name of a language without the folder.

    >>> plain("mine/en"), plain("sv")
    ('en', 'sv')
    """
    return PurePath(language).name


def source(file: str, language: str) -> str:
    """The text of a file of a language, or of the `STRATEGIES` beside its `FILES`.

    Raises `OSError` if it cannot be read.

    >>> source("tutor.{}.lark", "nowhere/en") == source("tutor.{}.lark", "en")
    True
    """
    name = file.format(plain(language))
    own = Path(language).parent / name
    if own.parent != Path() and own.is_file():
        return read_text(own, SETTINGS)
    return files("kille.grammars").joinpath(name).read_text(encoding="utf-8")


def read_table(file: str, language: str) -> Mapping[str, Any]:
    """The table in a TOML file of a language; `ValueError` for what is none.

    Raises `OSError` if the file cannot be read.
    """
    text = source(file, language)
    key = sys.version, text
    return recall("tables", key, lambda: parse_toml(text), _encode, json.loads)


def _encode(table: Mapping[str, Any]) -> bytes:
    return json.dumps(table, separators=(",", ":")).encode("utf-8", "surrogatepass")


def last_change(file: str, language: str) -> int:
    """When a file of one's own was changed last, in nanoseconds; 0 for the package's.

    Whatever is made of a file is cached by this time, so that an edit takes effect.
    """
    if "/" not in language:
        return 0
    try:
        return (Path(language).parent / file.format(plain(language))).stat().st_mtime_ns
    except OSError:
        return 0
