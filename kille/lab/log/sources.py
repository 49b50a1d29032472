"""What a study was made of: its text, and every file that it names, by their digests.

Dialogues that were played with another learner or grammar are another study's, even
where its own text is the same.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Any

from kille.lab.study import Study
from ttr.safety.inputs import open_file

STUDY = "the study"
PLACES = {"file", "folder"}
"""The settings that are paths, whatever they look like."""
LARGE = 10_000_000
"""A folder of more bytes is known by its files' names and sizes alone."""
HUGE = 500_000_000
"""A file of more bytes is known by its size alone."""
_PIECE = 1 << 20


def sources(study: Study) -> dict[str, str]:
    """The digests of the study's text and of what it names, by their names.

    >>> list(sources(Study("", {}, {}, {}, (), (), source="title = 'A'")))
    ['the study']
    """
    names = sorted(set(_paths(study)))
    paths = map(study.path, names)
    found = {it: _digest(it) for it in paths if _is_part(it, study)}
    named = {os.path.relpath(it, study.folder): found[it] for it in found}
    return {STUDY: _hash([study.source.encode()]), **named}


def changed_sources(
    before: Mapping[str, str], now: Mapping[str, str]
) -> tuple[str, ...]:
    """The names of what has changed, the study itself first.

    >>> before, now = {"the study": "1", "a.py": "2"}, {"the study": "1", "a.py": "3"}
    >>> changed_sources(before, now)
    ('a.py',)
    """
    names = dict.fromkeys([*before, *now])
    return tuple(name for name in names if before.get(name) != now.get(name))


def _paths(study: Study) -> Iterator[str]:
    """All texts of a study that may be paths; of `FILE:NAME`, the file."""
    parts = (*study.theories.values(), *study.tutors.values(), *study.scenes.values())
    for text in _texts([vars(part) for part in (*parts, *study.phases)]):
        yield text
        yield text.rpartition(":")[0] or text


def _is_part(path: Path, study: Study) -> bool:
    """Whether a path exists, and the study is not inside of it."""
    try:
        return path.exists() and path.resolve() not in _enclosing_folders(study)
    except (OSError, ValueError):  # a sentence is no path
        return False


def _enclosing_folders(study: Study) -> tuple[Path, ...]:
    folder = study.folder.resolve()
    return folder, *folder.parents


def _texts(value: Any) -> Iterator[str]:
    match value:
        case Path():
            yield str(value)
        case str() if "." in value or "/" in value:
            yield value
        case Mapping():
            yield from (str(value[key]) for key in PLACES & value.keys())
            yield from _texts(value.values())
        case str() | bytes():
            return
        case Iterable():
            for it in value:
                yield from _texts(it)


def _digest(path: Path) -> str:
    if path.is_file():
        return _hash(_pieces(path))
    files = sorted(it for it in path.rglob("*") if it.is_file() and _is_source(it))
    sizes = [it.stat().st_size for it in files]
    names = [str(it.relative_to(path)) for it in files]
    parts = [
        f"{name} {size}\n".encode() for name, size in zip(names, sizes, strict=True)
    ]
    if sum(sizes) <= LARGE:
        return _hash(chain(parts, *map(_pieces, files)))
    return _hash(parts)


def _pieces(path: Path) -> Iterator[bytes]:
    """The contents of a file in pieces; of a very large one, only its size."""
    with open_file(path) as file:
        size = file.seek(0, os.SEEK_END)
        if size > HUGE:
            yield f"{size}".encode()
            return
        file.seek(0)
        while piece := file.read(_PIECE):
            yield piece


def _is_source(path: Path) -> bool:
    return "__pycache__" not in path.parts


def _hash(parts: Iterable[bytes]) -> str:
    found = hashlib.sha256()
    for part in parts:
        found.update(part)
    return found.hexdigest()
