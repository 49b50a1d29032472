"""Grammars that were read before, kept in the user's cache.

Lark takes over a quarter of the time from the start of a process to its first answer to
read a tutor's grammar. What it comes to is kept as JSON, a file for each text; where it
is there, Lark is not even imported. A file counts only if it was made of the same text
by the same reader.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from kille.dialogue import grammars
from kille.dialogue.grammars import (
    GrammarSource,
    Production,
    Symbol,
    is_expression,
    read_grammar,
)
from kille.dialogue.user_cache import digest, recall


def recall_grammar(text: str, starts: Sequence[str]) -> GrammarSource:
    """What `read_grammar` gives, from the cache if it is there; if not, it is kept."""
    try:
        key = (_reader(), text, *starts)
    except (OSError, ValueError):  # there is no code to read, as in an archive
        return read_grammar(text, starts)
    return recall("grammars", key, lambda: read_grammar(text, starts), _encode, _decode)


@cache
def _reader() -> str:
    """What tells this reader from others: Python, its code, what names Lark's version.

    Lark is looked for and not imported, which takes longer than all else here.
    """
    lark = find_spec("lark")
    assert lark is not None
    files = (grammars.__file__, __file__, lark.origin or "")
    return digest(sys.version, *(Path(file).read_text("utf-8") for file in files))


def _encode(found: GrammarSource) -> bytes:
    made = [(it.name, it.symbols, it.made, it.only_child) for it in found.productions]
    beginnings = {
        name: None if (signs := found.beginnings(name)) is None else sorted(signs)
        for name, pattern in found.terminals.items()
        if is_expression(pattern)
    }
    kept = made, dict(found.terminals), list(found.ignored), beginnings
    return json.dumps(kept, separators=(",", ":")).encode("utf-8", "surrogatepass")


def _decode(body: bytes) -> GrammarSource:
    made, terminals, ignored, begins = json.loads(body)
    symbols: dict[tuple[Any, ...], Symbol] = {}
    productions = [
        Production(
            name,
            tuple([symbols.setdefault(key := tuple(it), Symbol(*key)) for it in row]),
            alias,
            only_child,
        )
        for name, row, alias, only_child in made
    ]
    beginnings = {
        name: None if signs is None else frozenset(signs)
        for name, signs in begins.items()
    }
    return GrammarSource(productions, terminals, ignored, beginnings)
