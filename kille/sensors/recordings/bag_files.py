"""Bags as files: which paths are bags, and their messages, by topic and time.

Any bag that rosbags reads, whatever its name; also one that was cut short.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple

from kille.sensors.recordings.ros_images import OtherFormatError
from kille.sensors.sensor import SensorError
from ttr.safety.inputs import open_file
from ttr.safety.limits import FRAMES

if TYPE_CHECKING:
    from rosbags.highlevel import AnyReader
    from rosbags.interfaces import Connection
    from rosbags.typesys.store import Typestore

NOT_INSTALLED = "ROS bags need rosbags: pip install 'kille[record]'"

DESCRIPTION = "metadata.yaml"
_SUFFIXES = {
    b"#ROSBAG V": ".bag",
    b"\x89MCAP0\r\n": ".mcap",
    b"SQLite format 3\x00": ".db3",
}


def ros_suffix(path: Path) -> str | None:
    """What the name of a file of this content should end in, if it is of ROS."""
    with open_file(path) as file:
        start = file.read(16)
    found = (end for head, end in _SUFFIXES.items() if start.startswith(head))
    return next(found, None)


def ros_files(folder: Path) -> list[Path]:
    """The files of ROS 2 in a folder; of others, which may be many, none is opened."""
    named = [it for it in sorted(folder.iterdir()) if it.suffix in (".mcap", ".db3")]
    return [it for it in named if it.is_file() and ros_suffix(it) is not None]


def is_bag(path: Path) -> bool:
    """Whether it is a bag: a file, or a folder with its description or one file."""
    if path.is_file():
        return ros_suffix(path) is not None
    described = path / DESCRIPTION
    if described.is_file():
        with open_file(described) as file:
            return b"rosbag2_bagfile_information" in file.read(65536)
    return len(ros_files(path)) == 1


class Stamp(NamedTuple):
    """When a message was made, in seconds, and its place in the bag: its nanoseconds
    there, and how many messages of the topic with the same nanoseconds come before."""

    time: float
    kept: int
    nth: int


@dataclass(frozen=True, eq=False)
class Bag:
    """An open bag and its topics, of which each has a connection for each publisher."""

    name: str
    reader: AnyReader
    store: Typestore
    topics: Mapping[str, Sequence[Connection]]
    remark: str

    def message(self, topic: str, stamp: Stamp) -> Any:
        """The message of that stamp; SensorError if it cannot be read."""
        found = self.raw(topic, start=stamp.kept, stop=stamp.kept + 1)
        with explain_errors(self.name):
            for number, (_, data) in enumerate(found):
                if number == stamp.nth:
                    return self.decode(topic, data)
        raise SensorError(f"{self.name}: a message of {topic} is lost")

    def first(self, topic: str) -> Any:
        """The topic's first message, or None."""
        with explain_errors(self.name):
            return next((self.decode(topic, it) for _, it in self.raw(topic)), None)

    def raw(self, topic: str, **between: int) -> Iterator[tuple[int, bytes]]:
        """The topic's messages as they are kept, with the bag's nanoseconds."""
        for _, kept, data in self.reader.messages(self.topics[topic], **between):
            yield kept, bytes(data)

    def decode(self, topic: str, data: bytes) -> Any:
        """A message with its fields, as ROS defines them, whatever the bag says."""
        if self.reader.is2:
            return self.store.deserialize_cdr(data, self.kind(topic))
        return self.store.deserialize_ros1(data, self.kind(topic))

    def kind(self, topic: str) -> str:
        """The type of the topic's messages."""
        return self.topics[topic][0].msgtype

    def stamps(self, topic: str) -> list[Stamp]:
        """When the topic's messages were made, in order of that.

        For messages whose heads do not say, it is when they were recorded.
        """
        row: list[tuple[int, int]] = []
        with explain_errors(self.name):
            for kept, data in self.raw(topic):
                FRAMES.check(len(row))
                row.append((kept, self._time_made(data)))
        said = any(made for _, made in row)
        counts: dict[int, int] = {}
        stamps = []
        for kept, made in row:
            counts[kept] = nth = counts.get(kept, -1) + 1
            stamps.append(Stamp((made if said else kept) / 1e9, kept, nth))
        return sorted(stamps)

    def _time_made(self, data: bytes) -> int:
        """The nanoseconds in a message's head, which is the first of its fields."""
        # ROS 1 has a number of the message before them, ROS 2 what says the byte order.
        big = self.reader.is2 and not data[1] & 1
        seconds, rest = struct.unpack_from(">II" if big else "<II", data, 4)
        return int(seconds * 1_000_000_000 + rest)


def open_bag_file(name: str, path: Path) -> Bag:
    """The bag at this path; SensorError if it cannot be read, or rosbags is missing."""
    remark = ""
    try:
        from rosbags.highlevel import AnyReader, AnyReaderError
        from rosbags.typesys import Stores, get_typestore

        from kille.sensors.recordings.bag_limits import (
            BagPath,
            check_unpacked,
            limit_databases,
        )
    except ImportError as error:
        raise SensorError(f"{name}: {NOT_INSTALLED}") from error
    usual = get_typestore(Stores.ROS2_HUMBLE)
    held = _file(path)
    with explain_errors(name), _path_with_suffix(held) as linked, limit_databases():
        suited = BagPath(linked)
        if suited.is_dir():
            check_unpacked(suited)
        reader = AnyReader([suited], default_typestore=usual)
        try:
            reader.open()
        except AnyReaderError as error:
            if not any(words in str(error) for words in _CUT_SHORT):
                raise
            reader = _open_cut_bag(suited, usual)
            remark = "cut short: its end is missing; what is whole of it is played"
    try:
        topics = _topics_of(name, reader)
    except SensorError:
        reader.close()
        raise
    store = usual if reader.is2 else get_typestore(Stores.ROS1_NOETIC)
    return Bag(name, reader, store, topics, remark)


def _topics_of(name: str, reader: AnyReader) -> dict[str, list[Connection]]:
    """The connections of each topic, those of the first one's type.

    SensorError where the file is damaged, so that a topic has lost its name.
    """
    if not all(isinstance(it.topic, str) for it in reader.connections):
        raise SensorError(f"{name}: this bag is damaged: a topic in it has no name")
    topics: dict[str, list[Connection]] = {}
    for it in sorted(reader.connections, key=lambda it: (it.topic, it.id)):
        alike = topics.setdefault(it.topic, [])
        if not alike or alike[0].msgtype == it.msgtype:
            alike.append(it)
    return topics


_CUT_SHORT = (
    "not indexed",
    "index looks damaged",
    "end magic is invalid",
    "database disk image is malformed",
)
"""What rosbags says of bags whose end is missing."""


def _open_cut_bag(path: Path, usual: Typestore) -> AnyReader:
    """A reader of a bag that was cut short."""
    from rosbags.highlevel import AnyReader
    from rosbags.rosbag2 import Reader

    from kille.sensors.recordings.cut_bags import (
        CutDatabase,
        UnindexedBag,
        UnindexedMcap,
    )

    held = ros_files(path) if path.is_dir() else [path]
    if len(held) != 1:
        raise OtherFormatError("a bag of several files is cut short: name one of them")
    (path,) = held
    reader = AnyReader([path], default_typestore=usual)
    if reader.is2:
        whole = Reader(path)
        cut = CutDatabase if path.suffix == ".db3" else UnindexedMcap
        whole.storage = cut(path)
        reader.readers = [whole]
    else:
        reader.readers = [UnindexedBag(path)]
    reader.open()
    return reader


def _file(path: Path) -> Path:
    """The folder of a bag; where its description is missing, the one file in it."""
    if not path.is_dir() or (path / DESCRIPTION).is_file():
        return path
    (held,) = ros_files(path)
    return held


@contextmanager
def _path_with_suffix(path: Path) -> Iterator[Path]:
    """The path, or another to the same that ends as rosbags wants its files to end."""
    suffix = None if path.is_dir() else ros_suffix(path)
    if suffix is None or path.suffix == suffix:
        yield path
        return
    with TemporaryDirectory() as folder:
        link = Path(folder, f"bag{suffix}")
        link.symlink_to(path.resolve())
        yield link


@contextmanager
def explain_errors(name: str) -> Iterator[None]:
    """Raise whatever goes wrong inside as a SensorError, one line about the bag."""
    try:
        yield
    except SensorError:
        raise
    except OSError as error:
        raise SensorError(f"{name}: cannot be read ({error.strerror})") from error
    except OtherFormatError as error:
        raise SensorError(f"{name}: {error}") from error
    except Exception as error:
        # A damaged bag makes rosbags fail in many ways, with no class in common.
        said = " ".join(str(error).split()) or type(error).__name__
        raise SensorError(f"{name}: this bag cannot be read: {said}") from error
