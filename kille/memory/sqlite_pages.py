"""Read the rows of an SQLite file page by page, however damaged the file is.

Nothing of the database is executed: pages are bytes, and rows are what lies in the
leaves of a table's tree. Where a tree is broken, all leaves that no tree leads to are
looked at. See https://www.sqlite.org/fileformat2.html, sections 1.3 to 2.1.
"""

from __future__ import annotations

import struct
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from mmap import mmap
from typing import TypeAlias

from kille.safety.databases import LARGEST_VALUE

Content: TypeAlias = bytes | mmap
Value: TypeAlias = int | float | str | bytes | None

MAGIC = b"SQLite format 3\0"
_LEAF, _INTERIOR = 0x0D, 0x05
_HEAD_BYTES = 100
"""Of the file, before the tree of the first page."""
_SIZES = tuple(2**it for it in range(9, 17))


class BrokenPageError(Exception):
    """A page, a cell or a record that SQLite did not write so."""


@dataclass(frozen=True)
class SqliteRow:
    """A row of a table: its rowid, and its values as they are stored.

    The value of the rowid's own column is None.
    """

    key: int
    values: tuple[Value, ...]


@dataclass(frozen=True)
class SqliteRows:
    """The rows found in a file."""

    tables: Mapping[str, Sequence[SqliteRow]]
    """The rows of each table that the schema leads to."""
    strays: Sequence[SqliteRow]
    """Rows on leaves that no tree reaches, if a tree is broken."""
    unreadable: int
    """How many rows and pages could not be read."""


def rows_in(content: Content) -> SqliteRows:
    """All rows that can be read from the bytes of a file.

    A file whose beginning is lost is read with each size of pages that there is; the
    one that gives most rows is taken.
    """
    size = page_size(content)
    sizes = _SIZES if size is None else (size,)
    return max((_File(content, it).rows() for it in sizes), key=_count)


def page_size(content: Content) -> int | None:
    """The page size given in the file's header; None if the header is lost."""
    if content[: len(MAGIC)] != MAGIC or len(content) < _HEAD_BYTES:
        return None
    size = int.from_bytes(content[16:18], "big")
    size = 65536 if size == 1 else size
    return size if size in _SIZES else None


def _count(found: SqliteRows) -> int:
    return len(found.strays) + sum(map(len, found.tables.values()))


class _File:
    """The pages of a file, and which of them have been read."""

    def __init__(self, content: Content, size: int) -> None:
        self._content, self._size = content, size
        self._known = page_size(content) is not None
        reserved = content[20] if self._known and content[20] <= 32 else 0
        self._usable = size - reserved
        self._pages = len(content) // size
        self._seen: set[int] = set()
        self._unreadable = 0

    def rows(self) -> SqliteRows:
        schema = list(self._tree(1)) if self._known else []
        tables = defaultdict[str, list[SqliteRow]](list)
        for row in schema:
            match row.values:
                case ("table", str(name), _, int(root), *_):
                    tables[name] += self._tree(root)
        strays: list[SqliteRow] = []
        if self._unreadable or not self._known:
            rest = set(range(1, self._pages + 1)) - self._seen - set(self._free())
            strays = [row for it in sorted(rest) for row in self._stray_leaf(it)]
        return SqliteRows(tables, strays, self._unreadable)

    def _tree(self, root: int) -> Iterator[SqliteRow]:
        """The rows of the tree with this root, as far as they can be reached."""
        waiting = [root]
        while waiting:
            number = waiting.pop()
            try:
                if number in self._seen:
                    raise BrokenPageError
                page, start = self._page(number), self._start(number)
                if page[start] == _INTERIOR:
                    waiting += reversed(self._children(page, start))
                elif page[start] != _LEAF:
                    raise BrokenPageError
            except BrokenPageError:
                self._unreadable += 1
                continue
            self._seen.add(number)
            if page[start] == _LEAF:
                yield from self._leaf(page, start)

    def _stray_leaf(self, number: int) -> Iterator[SqliteRow]:
        page, start = self._page(number), self._start(number)
        if page[start] == _LEAF:
            yield from self._leaf(page, start)

    def _leaf(self, page: bytes, start: int) -> Iterator[SqliteRow]:
        for place in self._cells(page, start, start + 8):
            try:
                yield self._row(page, place)
            except BrokenPageError:
                self._unreadable += 1

    def _page(self, number: int) -> bytes:
        if not 1 <= number <= self._pages:
            raise BrokenPageError
        return self._content[(number - 1) * self._size : number * self._size]

    def _start(self, number: int) -> int:
        return _HEAD_BYTES if number == 1 else 0

    def _cells(self, page: bytes, start: int, first: int) -> Iterator[int]:
        count = int.from_bytes(page[start + 3 : start + 5], "big")
        for at in range(first, min(first + 2 * count, self._usable - 1), 2):
            yield int.from_bytes(page[at : at + 2], "big")

    def _children(self, page: bytes, start: int) -> list[int]:
        places = list(self._cells(page, start, start + 12))
        if not all(start + 12 <= it <= self._usable - 4 for it in places):
            raise BrokenPageError
        places.append(start + 8)
        return [int.from_bytes(page[it : it + 4], "big") for it in places]

    def _row(self, page: bytes, place: int) -> SqliteRow:
        """The row whose cell begins at this place of a leaf."""
        length, at = _varint(page, place)
        key, at = _varint(page, at)
        if length > min(LARGEST_VALUE, len(self._content)):
            raise BrokenPageError
        inside = self._bytes_inside(length)
        if at + inside > self._usable:
            raise BrokenPageError
        payload = page[at : at + inside]
        if inside < length:
            following = int.from_bytes(page[at + inside : at + inside + 4], "big")
            payload += self._overflow(following, length - inside)
        return SqliteRow(key - 2**64 if key >= 2**63 else key, _record(payload))

    def _bytes_inside(self, length: int) -> int:
        """How many bytes of a payload of this length are in the leaf itself."""
        if length <= self._usable - 35:
            return length
        least = (self._usable - 12) * 32 // 255 - 23
        inside = least + (length - least) % (self._usable - 4)
        return inside if inside <= self._usable - 35 else least

    def _overflow(self, number: int, length: int) -> bytes:
        pages: list[bytes] = []
        seen: set[int] = set()
        while length > 0:
            if number in seen:
                raise BrokenPageError
            seen.add(number)
            page = self._page(number)
            part = page[4 : min(self._usable, 4 + length)]
            pages.append(part)
            length -= len(part)
            number = int.from_bytes(page[:4], "big")
        return b"".join(pages)

    def _free(self) -> Iterator[int]:
        """The free pages of SQLite: their former rows are deleted."""
        if not self._known:
            return
        seen: set[int] = set()
        trunk = int.from_bytes(self._content[32:36], "big")
        while 1 <= trunk <= self._pages and trunk not in seen:
            seen.add(trunk)
            yield trunk
            page = self._page(trunk)
            count = min(int.from_bytes(page[4:8], "big"), self._usable // 4 - 2)
            yield from struct.unpack(f">{count}I", page[8 : 8 + 4 * count])
            trunk = int.from_bytes(page[:4], "big")


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """The number of one to nine bytes at a place, and the place after it."""
    value = 0
    for count, byte in enumerate(data[at : at + 9], 1):
        if count == 9:
            return value << 8 | byte, at + 9
        value = value << 7 | byte & 0x7F
        if byte < 0x80:
            return value, at + count
    raise BrokenPageError


def _record(payload: bytes) -> tuple[Value, ...]:
    """The values of a record; text that is not UTF-8 stays bytes."""
    end, at = _varint(payload, 0)
    kinds: list[int] = []
    while at < end:
        kind, at = _varint(payload, at)
        kinds.append(kind)
    if at != end or end + sum(map(_width, kinds)) != len(payload):
        raise BrokenPageError
    values: list[Value] = []
    for kind in kinds:
        values.append(_value(kind, payload[at : at + _width(kind)]))
        at += _width(kind)
    return tuple(values)


_WIDTHS = (0, 1, 2, 3, 4, 6, 8, 8, 0, 0)
"""Bytes of null, six integers, a float, and the constants 0 and 1."""


def _width(kind: int) -> int:
    if kind >= 12:
        return (kind - 12) // 2
    if kind >= len(_WIDTHS):
        raise BrokenPageError
    return _WIDTHS[kind]


def _value(kind: int, data: bytes) -> Value:
    match kind:
        case 0:
            return None
        case 7:
            (number,) = struct.unpack(">d", data)
            return float(number)
        case 8 | 9:
            return kind - 8
        case _ if kind < 7:
            return int.from_bytes(data, "big", signed=True)
        case _ if kind % 2 == 0:
            return data
    try:
        return data.decode()
    except UnicodeDecodeError:
        return data
