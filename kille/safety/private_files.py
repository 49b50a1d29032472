"""Files that only their user can read, since they hold what people said and taught."""

from __future__ import annotations

import os
from pathlib import Path

FILE_MODE, FOLDER_MODE = 0o600, 0o700


def open_private(path: str, flags: int) -> int:
    """Open a file like `os.open`; a new file is readable by its user only.

    It is the `opener` of Python's `open`. A file that is there already keeps its
    permissions.

    >>> import stat, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with open(Path(folder, "diary"), "xb", opener=open_private) as file:
    ...         print(stat.filemode(os.fstat(file.fileno()).st_mode))
    -rw-------
    """
    opened = os.open(path, flags, FILE_MODE)
    if flags & os.O_EXCL and hasattr(os, "fchmod"):
        os.fchmod(opened, FILE_MODE)  # whatever the umask took away
    return opened


def create_private_file(path: Path) -> None:
    """Create an empty private file, unless something is there. Raises OSError."""
    try:
        with open(path, "xb", opener=open_private):
            pass
    except FileExistsError:
        return
