"""Packages: named files in a folder or a zip, written all at once and checked when
read.

Whoever is killed while writing leaves the place as it was: a package is made beside it
and put there when it is whole and on disk. Only its user can read a new one.
"""

from __future__ import annotations

import os
import shutil
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

from kille.safety.archives import check_sizes, open_zip, read_member
from kille.safety.databases import printable_name
from kille.safety.private_files import FOLDER_MODE, open_private
from ttr.safety.inputs import read_bytes
from ttr.safety.limits import MEMBER, PACKAGE

ZIP = ".zip"
MANIFEST = "memory.json"
_FIRST_DAY = (1980, 1, 1, 0, 0, 0)  # of zips: the same content is the same bytes


class PackageError(Exception):
    """A package that cannot be written, is damaged, or is no package."""


@contextmanager
def report_damage(path: Path) -> Iterator[None]:
    """Turn any failure to read a package into one line."""
    try:
        yield
    except PackageError:
        raise
    except OSError as error:
        reason = error.strerror or error
        raise PackageError(f"{path} cannot be read ({reason})") from error
    except (
        RecursionError,
        ValueError,
        KeyError,
        TypeError,
        AttributeError,
        OverflowError,
        MemoryError,
    ) as error:
        raise PackageError(
            f"{path} is damaged, or is no exported memory ({_reason(error)}): nothing "
            "was changed; export it again, or take another copy"
        ) from error


class PackageReader(Protocol):
    """Reads the files of a package."""

    def read(self, name: str) -> bytes:
        """The content of a file. KeyError if the package has no file of this name."""


class PackageWriter(Protocol):
    """Writes the files of a package."""

    def write(self, name: str, content: bytes) -> None:
        """Add a file."""


@contextmanager
def open_to_read(path: Path) -> Iterator[PackageReader]:
    """Open the package at a path, be it a folder or a zip."""
    if path.is_dir():
        yield _FolderReader(path)
        return
    with open_zip(path) as opened:
        check_sizes(opened, PACKAGE)
        yield _ZipReader(opened)


@contextmanager
def open_to_write(path: Path) -> Iterator[PackageWriter]:
    """Write a package, which is at the path, and on disk, if all inside goes well.

    A zip takes the place of an older package of ours, and of nothing else; a folder
    must be new or empty. PackageError if it cannot be written.
    """
    target = Path(os.path.realpath(path))
    draft = target.parent / f".{target.name}.{os.getpid()}.part"
    try:
        with _report_write_failure(path):
            _check_free(path)
            with _draft(draft, zipped=path.suffix.lower() == ZIP) as writer:
                yield writer
            os.replace(draft, target)
            _sync_folder(target.parent)
    finally:
        if os.path.lexists(draft):
            _remove(draft)


@contextmanager
def _report_write_failure(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise PackageError(
            f"{path} cannot be written ({error.strerror}): name another place"
        ) from error


class _FolderReader:
    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def read(self, name: str) -> bytes:
        try:
            return read_bytes(self._folder / name, MEMBER)
        except (FileNotFoundError, NotADirectoryError):
            raise KeyError(f"{name} is missing") from None


class _ZipReader:
    def __init__(self, opened: zipfile.ZipFile) -> None:
        self._opened = opened

    def read(self, name: str) -> bytes:
        return read_member(self._opened, name, MEMBER)


class _FolderWriter:
    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(FOLDER_MODE, parents=True)

    def write(self, name: str, content: bytes) -> None:
        path = self._folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "xb", opener=open_private) as file:
            file.write(content)


class _ZipWriter:
    def __init__(self, opened: zipfile.ZipFile) -> None:
        self._opened = opened

    def write(self, name: str, content: bytes) -> None:
        """Write a member that is its user's alone, as `zipfile` has it unpacked."""
        self._opened.writestr(zipfile.ZipInfo(name, _FIRST_DAY), content)


@contextmanager
def _draft(draft: Path, *, zipped: bool) -> Iterator[PackageWriter]:
    if not zipped:
        yield _FolderWriter(draft)
        _sync_all()
        return
    draft.parent.mkdir(parents=True, exist_ok=True)
    with open(draft, "xb", opener=open_private) as file:
        with zipfile.ZipFile(file, "w") as opened:
            yield _ZipWriter(opened)
        file.flush()
        os.fsync(file.fileno())


def _check_free(path: Path) -> None:
    """Refuse to replace anything but an older package."""
    if not path.exists() or (path.is_dir() and not any(path.iterdir())):
        return
    if path.is_dir() or not _is_package(path):
        kind = "is a folder with something in it" if path.is_dir() else "is no export"
        raise PackageError(f"{path} {kind}: it was left alone, name another place")


def _is_package(path: Path) -> bool:
    try:
        with open_to_read(path) as package:
            package.read(MANIFEST)
    except (KeyError, ValueError):
        return False
    return True


def _sync_all() -> None:
    """Sync all files to disk at once: one by one takes minutes for many lessons."""
    if os.name == "posix":
        os.sync()


def _sync_folder(folder: Path) -> None:
    """Sync the names in a folder to disk too, where the system can do that."""
    if os.name != "posix":
        return
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink()


def _reason(error: Exception) -> str:
    return printable_name(" ".join(str(error.args[0] if error.args else error).split()))
