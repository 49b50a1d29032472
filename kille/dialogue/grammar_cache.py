"""Grammars that were read before, kept in the user's cache.

Lark takes over a quarter of the time from the start of a process to its first answer to
read a tutor's grammar. What it comes to is kept as JSON, a file for each text; where it
is there, Lark is not even imported. A file counts only if it is whole, and was made of
the same text by the same reader. Whatever is wrong with it, the grammar is read anew,
and where nothing can be written, nothing is kept.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from platformdirs import user_cache_dir

from kille.dialogue import grammars
from kille.dialogue.grammars import GrammarSource, Production, Symbol, read_grammar
from ttr import TTRError
from ttr.safety.files import write_whole

MOST = 30
"""How many grammars are kept: those that were written last."""


def recall_grammar(text: str, starts: Sequence[str]) -> GrammarSource:
    """What `read_grammar` gives, from the cache if it is there; if not, it is kept."""
    try:
        path = cache_folder() / f"{_digest(_reader(), text, *starts)}.json"
    except (OSError, ValueError):  # there is no code to read, as in an archive
        return read_grammar(text, starts)
    try:
        digest, _, body = path.read_text("utf-8").partition("\n")
        if digest == _digest(body):
            return _from_json(json.loads(body))
    except (OSError, ValueError, TypeError):  # not there, or not as it was written
        pass
    found = read_grammar(text, starts)
    with suppress(OSError, TTRError):
        _keep(found, path)
    return found


def cache_folder() -> Path:
    """The folder with the grammars that are kept."""
    return Path(user_cache_dir("kille", appauthor=False)) / "grammars"


@cache
def _reader() -> str:
    """What tells this reader from others: its code, and what names Lark's version.

    Lark is looked for and not imported, which takes longer than all else here.
    """
    lark = find_spec("lark")
    assert lark is not None
    files = (grammars.__file__, __file__, lark.origin or "")
    return _digest(*(Path(file).read_text("utf-8") for file in files))


def _digest(*texts: str) -> str:
    return sha256("\0".join(texts).encode("utf-8", "surrogatepass")).hexdigest()


def _keep(found: GrammarSource, path: Path) -> None:
    body = json.dumps(_as_json(found), separators=(",", ":"))
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, f"{_digest(body)}\n{body}")
    kept = sorted(path.parent.glob("*.json"), key=lambda it: it.stat().st_mtime)
    for old in kept[:-MOST]:
        old.unlink()


def _as_json(found: GrammarSource) -> Any:
    made = [(it.name, it.symbols, it.made, it.only_child) for it in found.productions]
    return made, dict(found.terminals), list(found.ignored)


def _from_json(kept: Any) -> GrammarSource:
    made, terminals, ignored = kept
    productions = [
        Production(name, tuple(Symbol(*it) for it in symbols), alias, only_child)
        for name, symbols, alias, only_child in made
    ]
    return GrammarSource(productions, terminals, ignored)
