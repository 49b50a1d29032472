"""The one reader of inputs: files and pipes that somebody else may have written.

Only regular files and pipes are read, only up to a limit (`ttr.safety.limits`), and no
pipe is waited for without end. Whatever is refused raises an `OSError` whose `strerror`
says why, as a missing file does.
"""

from __future__ import annotations

import errno
import io
import json
import os
import re
import stat
import sys
import tomllib
from collections.abc import Callable, Iterator
from selectors import EVENT_READ, DefaultSelector
from time import monotonic
from typing import Any, BinaryIO, TextIO

from ttr.escapes import terminal_line
from ttr.safety.limits import LINE, PIPE, SILENCE, Limit

DEPTH = 200
"""How deep lists and tables may nest."""

_PIECE = 1 << 20
"""How many bytes are read at a time."""


class _NoFile(OSError):
    """Something at a path that cannot be read as a file."""

    def __init__(self, why: str) -> None:
        super().__init__(errno.EINVAL, why)


def read_bytes(path: str | os.PathLike[str], limit: Limit) -> bytes:
    """All bytes of a regular file, or of a pipe that ends in time; raises `OSError`.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from ttr.safety.limits import THEORY
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "a.ttr")
    ...     _ = file.write_bytes(b"basic Ind")
    ...     read_bytes(file, THEORY)
    b'basic Ind'
    """
    opened, mode = _open(path)
    with os.fdopen(opened, "rb", buffering=0) as file:
        if stat.S_ISFIFO(mode):
            return _join_pieces(_pipe_pieces(opened), limit)
        limit.check(os.fstat(opened).st_size)
        # A file may grow, or say that it is empty, as those of the system do.
        return _join_pieces(iter(lambda: file.read(_PIECE) or b"", b""), limit)


def read_text(
    path: str | os.PathLike[str], limit: Limit, errors: str = "strict"
) -> str:
    """All of a text in UTF-8, its lines ended by a line feed.

    Raises `OSError`, or `UnicodeDecodeError` unless another way is given with `errors`.
    """
    text = read_bytes(path, limit).decode("utf-8-sig", errors)
    return text.replace("\r\n", "\n").replace("\r", "\n")


def open_file(path: str | os.PathLike[str]) -> BinaryIO:
    """A regular file, opened to be read piece by piece; raises `OSError`."""
    opened, mode = _open(path)
    if not stat.S_ISREG(mode):
        os.close(opened)
        raise _NoFile("it is a pipe, and must be a file")
    return os.fdopen(opened, "rb")


def read_line(stream: TextIO, limit: Limit = LINE) -> str:
    """The next line of a stream, with its end; empty at the end of the stream.

    Raises `OSError` for a line that is too long.

    >>> read_line(io.StringIO("a b\\nc"))
    'a b\\n'
    """
    line = stream.readline(limit.maximum + 1)
    if len(line) > limit.maximum:
        raise limit.too_much()
    return line


def ask_line(prompt: str, limit: Limit = LINE) -> str:
    """The line that somebody types after a prompt, or that comes through a pipe.

    As `input` does, it raises `EOFError` at the end; a line that is too long is an
    `OSError`, and is read no further.
    """
    if sys.stdin is None:
        raise EOFError
    if sys.stdin.isatty():
        return input(terminal_line(prompt))
    sys.stdout.write(terminal_line(prompt))
    sys.stdout.flush()
    line = read_line(sys.stdin, limit)
    if not line:
        raise EOFError
    return line.removesuffix("\n")


def read_lines(stream: BinaryIO, limit: Limit = LINE) -> Iterator[bytes]:
    """The lines of an open file, with their ends; `OSError` for one too long."""
    most = limit.maximum
    while line := stream.readline(most + 1):
        if len(line) > most:
            raise limit.too_much()
        yield line


def _open(path: str | os.PathLike[str]) -> tuple[int, int]:
    """A file descriptor and its mode; a pipe is opened even if nobody writes to it."""
    flags = os.O_RDONLY
    for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY"):
        flags |= getattr(os, name, 0)
    try:
        opened = os.open(path, flags)
    except ValueError:
        raise _NoFile("that is no path of a file") from None
    try:
        mode = os.fstat(opened).st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if not stat.S_ISREG(mode) and not stat.S_ISFIFO(mode):
            raise _NoFile("it is a device, and must be a file")
    except BaseException:
        os.close(opened)
        raise
    return opened, mode


def _pipe_pieces(opened: int) -> Iterator[bytes]:
    """The pieces that come through a pipe; `OSError` where it is silent too long."""
    end = monotonic() + PIPE.maximum
    with DefaultSelector() as waiting:
        waiting.register(opened, EVENT_READ)
        while True:
            patience = end - monotonic()
            if patience <= 0:
                raise _NoFile(
                    f"it is a pipe that does not end within {PIPE.maximum} seconds"
                )
            if not waiting.select(min(SILENCE.maximum, patience)):
                raise _NoFile(
                    "it is a pipe into which nothing is written for "
                    f"{SILENCE.maximum} seconds"
                )
            try:
                piece = os.read(opened, _PIECE)
            except BlockingIOError:  # it was read by somebody else meanwhile
                continue
            if not piece:
                return
            yield piece


def _join_pieces(pieces: Iterator[bytes], limit: Limit) -> bytes:
    whole, most = io.BytesIO(), limit.maximum
    for piece in pieces:
        if whole.tell() + len(piece) > most:
            raise limit.too_much()
        whole.write(piece)
    return whole.getvalue()


# --- texts of data -------------------------------------------------------------------


def parse_json(
    text: str | bytes, parse_constant: Callable[[str], Any] | None = None
) -> Any:
    """The value of a JSON text; `ValueError` for whatever is wrong with it.

    >>> parse_json('{"a": [1]}')
    {'a': [1]}
    >>> parse_json("[" * 100_000)
    Traceback (most recent call last):
    ValueError: lists and tables lie deeper in one another than 200
    """
    return _parse(lambda: json.loads(text, parse_constant=parse_constant))


def parse_toml(text: str) -> dict[str, Any]:
    """The table of a TOML text; `ValueError` for whatever is wrong with it."""
    if _LONG_KEY.search(text):  # for which tomllib takes minutes
        raise _too_deep()
    found: dict[str, Any] = _parse(lambda: tomllib.loads(text))
    return found


_PART = r"""(?: [\w-]++ | "[^"\n]*+" | '[^'\n]*+' ) [ \t]*+"""
_LONG_KEY = re.compile(rf"(?<![\w-])(?: {_PART} \. [ \t]*+ ){{{DEPTH}}}", re.VERBOSE)
"""A key of too many parts, `a.b.c`."""


def _parse(parse: Callable[[], Any]) -> Any:
    try:
        found = parse()
    except RecursionError:
        raise _too_deep() from None
    _check_depth(found)
    return found


def _check_depth(found: Any) -> None:
    """Refuses data that nests too deep for whatever walks through it later."""
    level = [found] if isinstance(found, dict | list) else []
    for _ in range(DEPTH):
        level = [
            inner
            for one in level
            for inner in (one.values() if isinstance(one, dict) else one)
            if isinstance(inner, dict | list)
        ]
    if level:
        raise _too_deep()


def _too_deep() -> ValueError:
    return ValueError(f"lists and tables lie deeper in one another than {DEPTH}")
