"""Write files in full or not at all, and say why a file cannot be read or written."""

from __future__ import annotations

import os
from collections.abc import Iterable
from errno import EISDIR, ELOOP
from pathlib import Path

from ttr.errors import TTRError


def why_unread(path: object, error: OSError | UnicodeDecodeError) -> str:
    """Why a text file could not be read, as a sentence.

    >>> why_unread("a.ttr", FileNotFoundError())
    'there is no file a.ttr'
    """
    match error:
        case FileNotFoundError():
            return f"there is no file {path}"
        case IsADirectoryError():
            return f"{path} is a folder, not a file"
        case UnicodeDecodeError():
            return f"{path} is no text: it must be UTF-8"
    return f"{path} cannot be read: {_reason(error)}"


def why_unwritten(path: object, error: OSError) -> str:
    """Why a file could not be written, as a sentence."""
    return f"{path} cannot be written: {_reason(error)}"


def _reason(error: OSError) -> str:
    why = error.strerror or "it cannot be opened"
    return why[:1].lower() + why[1:]


def write_whole(path: Path, content: str | bytes) -> None:
    """Writes a file: first a draft beside it, which then takes its place.

    A text is written as UTF-8. A link is kept, and its target written; a device is
    written to directly. Raises `TTRError` where the file cannot be written; then the
    old file is still there.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_whole(Path(folder, "a.txt"), "whole")
    ...     print(*(file.name for file in Path(folder).iterdir()))
    a.txt
    """
    data = content if isinstance(content, bytes) else content.encode("utf-8", "replace")
    try:
        target = Path(os.path.realpath(path))
        if target.is_symlink():  # only links that lead round in a circle are left
            raise OSError(ELOOP, os.strerror(ELOOP))
        if target.is_dir():
            raise IsADirectoryError(EISDIR, "is a folder")
        if target.exists() and not target.is_file():
            target.write_bytes(data)
        else:
            _write_by_draft(target, data)
    except OSError as error:
        raise TTRError(why_unwritten(path, error)) from None


def _write_by_draft(target: Path, data: bytes) -> None:
    draft = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        draft.write_bytes(data)
        draft.replace(target)
    except BaseException:
        draft.unlink(missing_ok=True)
        raise


def check_outputs(inputs: Iterable[Path], outputs: Iterable[Path | None]) -> None:
    """Refuses to overwrite an input, or to write two outputs into one file.

    >>> check_outputs([Path("a.dlg")], [Path("a.html"), None])
    >>> check_outputs([Path("a.dlg")], [Path("./a.dlg")])
    Traceback (most recent call last):
    ttr.errors.TTRError: a.dlg would be written over: name another file
    """
    taken = set(map(os.path.realpath, inputs))
    for path in filter(None, outputs):
        place = os.path.realpath(path)
        if place in taken and not _is_special(path):
            raise TTRError(f"{path} would be written over: name another file")
        taken.add(place)


def _is_special(path: Path) -> bool:
    """Is it a device or the like, which loses nothing when it is written to?"""
    return path.exists() and not path.is_file()
