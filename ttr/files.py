"""Files that are there in full, or as they were before."""

from __future__ import annotations

import os
from pathlib import Path

from ttr.errors import TTRError

__all__ = ["write_whole"]


def write_whole(path: Path, text: str) -> None:
    """Writes a text file, by way of a draft beside it that then takes its place.

    Raises `TTRError` where it cannot be written; what was there is there still.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_whole(Path(folder, "a.txt"), "whole")
    ...     print(*(file.name for file in Path(folder).iterdir()))
    a.txt
    """
    draft = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        draft.write_text(text, encoding="utf-8")
        draft.replace(path)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise TTRError(f"{path} cannot be written: {error.strerror}") from None
