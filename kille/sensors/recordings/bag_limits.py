"""Limits for rosbags, which believes what a bag says of the sizes in it.

rosbags opens files by their paths, decompresses chunks, and reads databases by apsw.
This module replaces each of the three by a form that refuses anything larger than
`ttr.safety.limits.MESSAGE` with an `OSError`.
"""

from __future__ import annotations

import bz2
import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, Protocol

import apsw
from lz4.frame import LZ4FrameDecompressor
from rosbags.rosbag1 import reader as rosbag1
from rosbags.rosbag2 import storage_mcap as mcap

from ttr.safety.inputs import open_file
from ttr.safety.limits import BAG_UNPACKED, MESSAGE, SETTINGS

zstd: Any = mcap.zstd  # type: ignore[attr-defined]
"""Python's own, or what there is of it for older Pythons."""

_PIECE = 1 << 20


class BagPath(type(Path())):  # type: ignore[misc]
    """A path whose file is read by pieces that are not too large."""

    def open(self, mode: str = "r", *args: Any, **kwargs: Any) -> IO[Any]:
        """The file, opened to be read."""
        if "b" in mode:
            return _Pieces(open_file(self))  # type: ignore[arg-type]
        SETTINGS.check(self.stat().st_size)
        return io.TextIOWrapper(open_file(self), encoding="utf-8")


class _Pieces(io.BufferedReader):
    """A file that refuses to read too much at once."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is not None:
            MESSAGE.check(size)
        return super().read(size)


class _Decompressor(Protocol):
    """What decompresses, up to a number of bytes."""

    def decompress(self, data: bytes, /, *, max_length: int) -> bytes: ...


def _decompress(kind: Callable[[], _Decompressor], data: bytes) -> bytes:
    """What is compressed in these bytes; `OSError` if it is too much."""
    most = MESSAGE.maximum
    found = kind().decompress(data, max_length=most + 1)
    if len(found) > most:
        raise MESSAGE.too_much()
    return found


@contextmanager
def limit_databases() -> Iterator[None]:
    """Limit apsw's databases, too, while a bag is opened or read."""
    rosbag1.decompressors["bz2"] = lambda data: _decompress(bz2.BZ2Decompressor, data)
    rosbag1.decompressors["lz4"] = lambda data: _decompress(LZ4FrameDecompressor, data)
    mcap.DECOMPRESSORS["lz4"] = lambda data, _: _decompress(LZ4FrameDecompressor, data)
    mcap.DECOMPRESSORS["zstd"] = lambda data, _: _decompress(
        zstd.ZstdDecompressor, data
    )
    apsw.connection_hooks.append(_limit)
    try:
        yield
    finally:
        apsw.connection_hooks.remove(_limit)


def _limit(database: apsw.Connection) -> None:
    """Let nothing in the database run, and refuse values that are too large."""
    database.limit(apsw.SQLITE_LIMIT_LENGTH, MESSAGE.maximum)
    database.config(apsw.SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0)
    database.config(apsw.SQLITE_DBCONFIG_ENABLE_VIEW, 0)


def check_unpacked(folder: Path) -> None:
    """Refuses a bag of compressed files that would fill the disk when unpacked."""
    for file in sorted(folder.glob("*.zstd")):
        count, most = 0, BAG_UNPACKED.maximum
        with open_file(file) as packed, zstd.open(packed, "rb") as opened:
            while piece := opened.read(_PIECE):
                count += len(piece)
                if count > most:
                    raise BAG_UNPACKED.too_much()
