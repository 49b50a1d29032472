"""ROS bags that were cut short: read them from the start, as far as they are whole.

A bag ends with an index. A recorder that was killed has not written it, but the
messages before it are there, in chunks that say their own size. The index of a database
is spread over it, and its messages are read in the order of their pages.
"""

from __future__ import annotations

import struct
from collections import Counter, defaultdict
from collections.abc import Collection, Generator, Iterator
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import BinaryIO, NamedTuple

import apsw
from rosbags.interfaces import (
    Connection,
    ConnectionExtRosbag1,
    ConnectionExtRosbag2,
    MessageDefinition,
    MessageDefinitionFormat,
)
from rosbags.rosbag1 import Reader, ReaderError
from rosbags.rosbag1.reader import (
    Chunk,
    Header,
    IndexData,
    RecordType,
    decompressors,
    normalize,
    read_bytes,
    read_uint32,
)
from rosbags.rosbag2.storage_mcap import McapReader
from rosbags.rosbag2.storage_sqlite3 import Sqlite3Reader
from rosbags.typesys.msg import normalize_msgtype

_NO_RECORD = (ReaderError, ValueError, struct.error, OSError, EOFError)
"""The errors of reading on where a file was cut or overwritten."""


class UnindexedBag(Reader):
    """A ROS 1 bag whose index is made anew, of all chunks that are whole."""

    def open(self) -> None:
        """Read all of the file once; ReaderError if not even its head is there."""
        size = self.path.stat().st_size
        self.bio = bio = self.path.open("rb")
        try:
            bio.readline()
            Header.read(bio, RecordType.BAGHEADER)
            bio.seek(bio.tell() + read_uint32(bio) + 4)
            self._index_all(bio, size)
        except BaseException:
            self.close()
            raise

    def _index_all(self, bio: BinaryIO, size: int) -> None:
        indexes: dict[int, list[IndexData]] = defaultdict(list)
        connections: dict[int, Connection] = {}
        while bio.tell() < size:
            place = bio.tell()
            try:
                header, start, length = _record(bio)
                if start + length > size:
                    break
                if header.get_uint8("op") == RecordType.CHUNK:
                    kind = header.get_string("compression")
                    chunk = Chunk(length, start, decompressors[kind])
                    content = chunk.decompressor(read_bytes(bio, length))
                    self._index_chunk(place, content, indexes, connections)
                    self.chunks[place] = chunk
            except (*_NO_RECORD, KeyError):
                break
            bio.seek(start + length)
        self.indexes = {number: sorted(indexes[number]) for number in connections}
        self.connections = [
            it._replace(msgcount=len(self.indexes[number]))
            for number, it in connections.items()
        ]

    def _index_chunk(
        self,
        place: int,
        content: bytes,
        indexes: dict[int, list[IndexData]],
        connections: dict[int, Connection],
    ) -> None:
        chunk = BytesIO(content)
        while (offset := chunk.tell()) < len(content):
            header, start, length = _record(chunk)
            number = header.get_uint32("conn")
            if header.get_uint8("op") == RecordType.MSGDATA:
                row = IndexData(header.get_time("time"), place, offset)
                indexes[number].append(row)
            else:
                chunk.seek(start - 4)
                connections[number] = self._connection(header, Header.read(chunk))
            chunk.seek(start + length)

    def _connection(self, header: Header, about: Header) -> Connection:
        told = MessageDefinition(
            MessageDefinitionFormat.MSG, about.get_string("message_definition")
        )
        return Connection(
            header.get_uint32("conn"),
            normalize(header.get_string("topic")),
            normalize_msgtype(about.get_string("type")),
            told,
            about.get_string("md5sum"),
            0,
            ConnectionExtRosbag1(None, None),
            self,
        )


def _record(file: BinaryIO) -> tuple[Header, int, int]:
    """The next record's header, where its data begins, and how long that is."""
    header = Header.read(file)
    length = read_uint32(file)
    return header, file.tell(), length


_MCAP_MAGIC = 8
_DATA_END, _FOOTER = 0x0F, 0x02


class UnindexedMcap(McapReader):
    """An MCAP file without its summary, as far as its records are whole."""

    def open(self) -> None:
        """Find where the last whole record ends; ReaderError if there is none."""
        size = self.path.stat().st_size
        self.bio = bio = self.path.open("rb")
        try:
            bio.seek(_MCAP_MAGIC)
            ends = _ends(bio, size)
            self.data_start = ends[0] if ends else size
            self.data_end = ends[-1] if ends else size
            self.meta_scan()
        except BaseException:
            self.close()
            raise
        assert self.statistics is not None
        counts = self.statistics.channel_message_counts
        self.connections = [
            it._replace(msgcount=counts.get(it.id, 0)) for it in self.connections
        ]

    def messages(
        self,
        connections: Collection[Connection],
        start: int | None = None,
        stop: int | None = None,
    ) -> Generator[tuple[Connection, int, bytes], None, None]:
        """The messages in the order in which they lie in the file."""
        return self.messages_scan(connections, start, stop)


def _ends(bio: BinaryIO, size: int) -> list[int]:
    """Where each whole record ends, before that which says that there are no more."""
    ends: list[int] = []
    while len(head := bio.read(9)) == 9 and head[0] not in (_DATA_END, _FOOTER):
        (length,) = struct.unpack("<Q", head[1:])
        if bio.tell() + length > size:
            break
        ends.append(bio.seek(bio.tell() + length))
    return ends


class _Row(NamedTuple):
    """A message in a database: when it was kept, its topic, its number."""

    kept: int
    topic: int
    number: int


class CutDatabase(Sqlite3Reader):
    """A ROS 2 database without its end, as far as its messages are whole."""

    _rows: tuple[_Row, ...] = ()

    def open(self) -> None:
        """Read all of the file once; apsw.Error if not even its topics are there."""
        place = f"{Path(str(self.path)).absolute().as_uri()}?immutable=1"
        flags = apsw.SQLITE_OPEN_READONLY | apsw.SQLITE_OPEN_URI
        self.dbconn = database = apsw.Connection(place, flags=flags)
        try:
            # Without this, a file that is shorter than it says is not read at all.
            database.execute("PRAGMA writable_schema = ON")
            self._rows = tuple(sorted(_rows(database)))
            self.connections = self._topics(database)
        except BaseException:
            self.close()
            raise

    def messages(
        self,
        connections: Collection[Connection],
        start: int | None = None,
        stop: int | None = None,
    ) -> Generator[tuple[Connection, int, bytes], None, None]:
        """The messages in order of time."""
        assert self.dbconn is not None
        wanted = {it.id: it for it in connections}
        for row in self._rows:
            early = start is not None and row.kept < start
            late = stop is not None and row.kept >= stop
            if early or late or row.topic not in wanted:
                continue
            query = "SELECT data FROM messages WHERE id = ?"
            ((data,),) = self.dbconn.execute(query, (row.number,))
            yield wanted[row.topic], row.kept, data

    def _topics(self, database: apsw.Connection) -> list[Connection]:
        counts = Counter(it.topic for it in self._rows)
        definitions = _definitions(database)
        topics = database.execute("SELECT id, name, type FROM topics ORDER BY id")
        return [
            Connection(
                number,
                topic,
                kind,
                definitions.get(kind, _UNDEFINED),
                "",
                counts[number],
                ConnectionExtRosbag2("cdr", []),
                self,
            )
            for number, topic, kind in topics
        ]


def _rows(database: apsw.Connection) -> Iterator[_Row]:
    """The messages before the first that is not whole."""
    query = "SELECT timestamp, topic_id, id, data FROM messages NOT INDEXED ORDER BY id"
    with suppress(apsw.CorruptError, apsw.IOError):
        for kept, topic, number, _ in database.execute(query):
            yield _Row(kept, topic, number)


_UNDEFINED = MessageDefinition(MessageDefinitionFormat.NONE, "")
_LANGUAGES = {
    "ros2msg": MessageDefinitionFormat.MSG,
    "ros2idl": MessageDefinitionFormat.IDL,
}


def _definitions(database: apsw.Connection) -> dict[str, MessageDefinition]:
    """What the types of messages are; nothing, where the database is too old to say."""
    query = (
        "SELECT topic_type, encoding, encoded_message_definition "
        "FROM message_definitions"
    )
    with suppress(apsw.SQLError):
        return {
            kind: MessageDefinition(_LANGUAGES[language], text)
            for kind, language, text in database.execute(query)
            if language in _LANGUAGES
        }
    return {}
