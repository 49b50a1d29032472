"""Zips and NumPy archives: nothing is unpacked before its size is known.

What is too large raises `OSError`, what is damaged `DamagedArchiveError`. Nothing is
ever written to disk, so that the names in an archive lead nowhere.
"""

from __future__ import annotations

import io
import math
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tokenize import TokenError
from typing import IO, Any, BinaryIO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ttr.safety.inputs import open_file
from ttr.safety.limits import ARRAYS, DIRECTORY, Limit

_SUFFIX = ".npy"
_WAYS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_DAMAGE = (
    ValueError,
    LookupError,
    ArithmeticError,
    RuntimeError,
    EOFError,
    MemoryError,
    TypeError,
    AttributeError,
    SyntaxError,
    TokenError,
    struct.error,
    zlib.error,
    zipfile.BadZipFile,
)
"""The errors that numpy and zipfile raise for invalid bytes of an archive."""


class DamagedArchiveError(ValueError):
    """An archive with invalid bytes."""


@contextmanager
def report_damage() -> Iterator[None]:
    """Turn any error from invalid bytes into `DamagedArchiveError`."""
    try:
        yield
    except (OSError, DamagedArchiveError):
        raise
    except _DAMAGE as error:
        said = " ".join(str(error).split())
        raise DamagedArchiveError(said[:80] or type(error).__name__) from error


class _Bounded(io.BufferedReader):
    """A file whose table of contents, which is read at once, is not too large."""

    limit: Limit | None = DIRECTORY

    def read(self, size: int | None = -1, /) -> bytes:
        if self.limit is not None and size is not None:
            self.limit.check(size)
        return super().read(size)


@contextmanager
def open_zip(source: Path | bytes) -> Iterator[zipfile.ZipFile]:
    """Open a zip from its file or its bytes; its table of contents has been read."""
    if isinstance(source, bytes):
        raw: BinaryIO = io.BytesIO(source)
    else:
        raw = open_file(source)
    with raw, _Bounded(raw) as file:  # type: ignore[arg-type]
        with report_damage():
            archive = zipfile.ZipFile(file)
        file.limit = None
        with archive:
            yield archive


def check_sizes(archive: zipfile.ZipFile, limit: Limit) -> None:
    """Refuse a zip whose files are too large together."""
    limit.check(sum(it.file_size for it in archive.infolist()))


def read_member(archive: zipfile.ZipFile, name: str, limit: Limit) -> bytes:
    """Read a file of a zip; `KeyError` if there is none of this name.

    A zip may say that less is in it than there is: no more is unpacked than it says.
    """
    entry = archive.getinfo(name)
    with _member(archive, entry, limit) as file, report_damage():
        return file.read(entry.file_size + 1)


@contextmanager
def _member(
    archive: zipfile.ZipFile, entry: zipfile.ZipInfo, limit: Limit
) -> Iterator[IO[bytes]]:
    limit.check(entry.file_size)
    if entry.compress_type not in _WAYS:
        raise DamagedArchiveError(f"{entry.filename} is compressed in an unknown way")
    with report_damage():
        file = archive.open(entry)
    with file:
        yield file


# --- arrays --------------------------------------------------------------------------


def read_arrays(data: bytes, limit: Limit = ARRAYS) -> dict[str, NDArray[Any]]:
    """The arrays in the bytes of an archive, by name.

    >>> file = io.BytesIO()
    >>> np.savez(file, up=np.arange(3))
    >>> read_arrays(file.getvalue())
    {'up': array([0, 1, 2])}
    """
    with open_zip(data) as archive:
        check_sizes(archive, limit)
        return {
            entry.filename.removesuffix(_SUFFIX): read_array(archive, entry, limit)
            for entry in archive.infolist()
            if entry.filename.endswith(_SUFFIX)
        }


def read_array(
    archive: zipfile.ZipFile, entry: zipfile.ZipInfo, limit: Limit = ARRAYS
) -> NDArray[Any]:
    """Read the array in a file of an archive, which must be as large as its header
    says.
    """
    with _member(archive, entry, limit) as file, report_damage():
        head = read_head(file)
        rest = entry.file_size - file.tell()
        if head.size != rest:
            raise DamagedArchiveError(
                f"{entry.filename} has {rest} bytes instead of {head.size}"
            )
        flat = np.frombuffer(bytearray(file.read(rest)), head.kind)
        file.read(1)  # at the end its checksum is compared
        return flat.reshape(head.shape, order="F" if head.by_columns else "C")


class Head(NamedTuple):
    """The header of an array."""

    shape: tuple[int, ...]
    by_columns: bool
    kind: np.dtype[Any]

    @property
    def size(self) -> int:
        """The number of bytes of its data."""
        return math.prod(self.shape) * self.kind.itemsize


def read_head(file: IO[bytes]) -> Head:
    """Read the header of an array, up to its first number.

    Raises `DamagedArchiveError` for an array of Python objects.
    """
    with report_damage():
        shape, by_columns, kind = _HEADS[np.lib.format.read_magic(file)](file)
        if kind.hasobject:
            raise DamagedArchiveError("it holds Python objects")
        if any(length < 0 for length in shape):
            raise DamagedArchiveError(f"the shape of an array cannot be {shape}")
        return Head(tuple(map(int, shape)), by_columns, kind)


_HEADS: Mapping[tuple[int, int], Callable[[IO[bytes]], tuple[Any, bool, Any]]] = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}
