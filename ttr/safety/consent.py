"""Consent: which files the user lets another file use.

A file that the user names may run Python and import theories in its own folder or
below. For anything else it needs the user's consent: to a folder with `--allow`, or to
Python by naming it themselves.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from shlex import quote

from ttr.errors import TTRError


class NotAllowedError(TTRError):
    """A file names something to which the user has not consented."""


def is_below(path: str | os.PathLike[str], folder: str | os.PathLike[str]) -> bool:
    """Does a path lead to something in a folder or below it, whatever links it takes?

    >>> is_below("games/door.ttr", "games"), is_below("games/../door.ttr", "games")
    (True, False)
    """
    return _real_path(path).is_relative_to(_real_path(folder))


def _real_path(path: str | os.PathLike[str]) -> Path:
    try:
        return Path(os.path.realpath(path))
    except ValueError:  # no text with a zero in it is a path
        raise NotAllowedError(f"{str(path)!r} is no path of a file") from None


def check_called(path: str | os.PathLike[str], suffix: str, named: str = "") -> None:
    """Raises `NotAllowedError` unless a file, and what a link leads to, has this
    suffix.

    An error message shows lines of the file. So no file is read as a theory or a story
    that is not called one: it could be a secret. `named` is how a file names this one.
    """
    real, told = _real_path(path), named or path
    if Path(path).suffix != suffix:
        raise NotAllowedError(
            f"{told} is not used: expected a file called NAME{suffix}"
        )
    if real.suffix != suffix:
        raise NotAllowedError(
            f"{told} is not used: it leads to a file not called NAME{suffix}"
        )
    if os.path.exists(real) and not (os.path.isfile(real) or os.path.isdir(real)):
        raise NotAllowedError(f"{told} is not used: it is no regular file")


@dataclass(frozen=True)
class Consent:
    """What the user lets files use.

    They may use files in `folders` and below; Python only if `python` is true, and of
    modules that lie elsewhere only `modules`, which the user has named.

    >>> consent = Consent.of(["games"])
    >>> consent.check("games/door.ttr")
    >>> consent.check("/etc/passwd")
    Traceback (most recent call last):
    ttr...NotAllowedError: /etc/passwd lies in another folder: allow it with ...
    """

    folders: tuple[Path, ...] = ()
    python: bool = True
    modules: frozenset[str] = frozenset()

    @classmethod
    def of(
        cls, allow: Iterable[str | os.PathLike[str]] = (), *, python: bool = True
    ) -> Consent:
        """The consent of a user who allows these folders; raises `TTRError`."""
        if isinstance(allow, str | os.PathLike):
            raise TTRError("allow takes a list of folders", hint=f"[{str(allow)!r}]")
        return cls(python=python).with_folders(*allow)

    def with_folders(self, *folders: str | os.PathLike[str]) -> Consent:
        """The same with more folders."""
        new = [it for it in map(_real_path, folders) if it not in self.folders]
        return replace(self, folders=(*self.folders, *dict.fromkeys(new)))

    def with_python(self, python: str, folder: Path) -> Consent:
        """The same, for a user who names a Python file in a folder, or a module."""
        if python.endswith(".py"):
            return self.with_folders((folder / python).parent)
        return replace(self, modules=self.modules | {python})

    def check(self, path: str | os.PathLike[str], named: str = "") -> None:
        """Raises `NotAllowedError` for a file that may not be used.

        `named` is how a file names it.
        """
        if not self.folders:
            raise NotAllowedError(f"{named or path}: no other file may be used here")
        if not any(is_below(path, folder) for folder in self.folders):
            folder = _folder_of_path(path)
            raise NotAllowedError(
                f"{named or path} lies in another folder: allow it with --allow "
                f"{quote(folder)}, in Python with allow=[{folder!r}]"
            )

    def check_python(self, python: str, folder: Path) -> None:
        """Raises `NotAllowedError` for Python that may not be run.

        It is a file, relative to a folder, or a module, which is looked for in all
        folders that may be used.
        """
        if not self.python:
            raise NotAllowedError(f"{python} is Python, which may not be run here")
        if python.endswith(".py"):
            self.check(folder / python, python)
        elif python not in self.modules and self.folder_of(python) is None:
            raise NotAllowedError(
                f"there is no module {python} in this folder: write a file there that "
                "imports what is needed, and name that"
            )

    def folder_of(self, module: str) -> Path | None:
        """The first folder in which a module with this dotted name lies."""
        path = Path(*module.split("."))
        for folder in self.folders:
            for file in (folder / f"{path}.py", folder / path / "__init__.py"):
                if os.path.isfile(file) and is_below(file, folder):
                    return folder
        return None


def _folder_of_path(path: str | os.PathLike[str]) -> str:
    """The folder of a path, as the user would write it from here."""
    folder = _real_path(path).parent
    near = os.path.relpath(folder)
    return near if near.count("..") < len(folder.parts) - 1 else str(folder)


OWN_FOLDER = Consent()
"""The consent of a user who named a file and said nothing else."""
