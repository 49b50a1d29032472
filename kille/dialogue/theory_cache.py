"""Theories that were read before, kept in the user's cache.

To read the packaged theory takes a fifth of the time from the start of a process to its
first answer. It is kept as a pickle, by which no code can be run: only values that
theories are made of are read from it.
"""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Iterator
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any

import ttr
from kille.dialogue.user_cache import recall
from ttr import Theory

_MODULES = ("ttr.types.", "ttr.signature.")
"""Where the classes of the values are that theories are made of."""

_OTHERS = (("ttr.theories.theory", "Theory"), ("ttr.errors", "Span"))


def recall_theory(text: str, source: str) -> Theory:
    """What `Theory.parse` gives for a text, from the cache if it is there.

    Only for a text without imports and rules in Python.
    """
    parse = partial(Theory.parse, text, source)
    try:
        key = (_reader(), source, text)
    except OSError:  # there is no code to look at, as in an archive
        return parse()
    return recall("theories", key, parse, _encode, _decode)


def _reader() -> str:
    """What tells this reader of theories from others: Python, and the files of `ttr`.

    Like Python itself, which keeps what it has compiled, it looks at when a file was
    changed and how long it is.
    """
    files = sorted(_python_files(Path(ttr.__file__).parent))
    return "\n".join((sys.version, *files))


def _python_files(folder: Path | str) -> Iterator[str]:
    """The Python files in a folder: path, length and last change of each."""
    with os.scandir(folder) as entries:
        for it in entries:
            if it.is_dir():
                yield from _python_files(it.path)
            elif it.name.endswith(".py"):
                about = it.stat()
                yield f"{it.path} {about.st_size} {about.st_mtime_ns}"


def _encode(theory: Theory) -> bytes:
    try:
        return pickle.dumps(theory, protocol=5)
    except pickle.PicklingError as error:
        raise TypeError(f"it cannot be kept: {error}") from error


def _decode(body: bytes) -> Theory:
    try:
        found = _TheoryReader(BytesIO(body)).load()
    except pickle.UnpicklingError as error:
        raise ValueError(f"what was kept is no theory: {error}") from error
    if not isinstance(found, Theory):
        raise TypeError(f"a theory was kept, found {found!r}")
    return found


class _TheoryReader(pickle.Unpickler):
    """Reads values that theories are made of, and nothing else.

    What their modules have imported is not theirs: it could lead anywhere.
    """

    def find_class(self, module: str, name: str) -> Any:
        if not module.startswith(_MODULES) and (module, name) not in _OTHERS:
            raise pickle.UnpicklingError(f"{module}.{name} is no part of a theory")
        found = super().find_class(module, name)
        if not isinstance(found, type) or found.__module__ != module:
            raise pickle.UnpicklingError(f"{module}.{name} is no class of its own")
        return found
