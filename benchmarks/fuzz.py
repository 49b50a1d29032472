"""Does any input, however hostile, make a reader fail, or take memory or minutes?

    .venv/bin/python benchmarks/fuzz.py                  1,000 inputs for each reader
    .venv/bin/python benchmarks/fuzz.py --count 100000   as many as before a release
    .venv/bin/python benchmarks/fuzz.py picture npz --seed 3

Each reader starts from inputs that are fine, and is given altered ones: bytes are
flipped, cut out, doubled and put in, numbers made huge, brackets deep; of archives and
pictures, also the inside, with checksums that fit. A reader may read an input or refuse
it by the error that the commands tell in one line. A failure is any other error, more
than 10 seconds for an input, or a process of more than 500 MB. The input is then kept
in a folder, and the exit code is 1.

A reader runs in a process of its own, with a limit on its memory, and is started anew
where it was lost. The same seed gives the same inputs.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import json
import multiprocessing
import os
import random
import resource
import signal
import struct
import sys
import tempfile
import time
import traceback
import zipfile
import zlib
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NoReturn

ROOT = Path(__file__).resolve().parent.parent

SECONDS = 10.0
"""How long an input may take, by the clock of the process."""

MEGABYTES = 500
"""How much memory the process of a reader may have had at any time."""

KEPT = 5
"""Of how many failures of a kind the input is kept."""


@dataclass
class Reader:
    """What reads: inputs that are fine, how one is altered, and how it is read.

    `refusals` are the errors that a command tells in one line.
    """

    seeds: Sequence[bytes]
    read: Callable[[bytes], object]
    refusals: tuple[type[Exception], ...]
    alter: Callable[[random.Random, bytes], bytes] | None = None


# --- altering ------------------------------------------------------------------------

NUMBERS = (0, 1, 127, 128, 255, 256, 32767, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1)
TEXTS = (
    b"",
    b"\0",
    b"\xff",
    b"\xef\xbb\xbf",
    b"\xed\xa0\x80",
    b"\n",
    b"\r",
    b"\x1b[2J",
    "‮".encode(),
    "é²λ".encode(),
    b"9" * 6000,
    b"-1",
    b"1e999",
    b"nan",
    b"inf",
    b"[" * 2000,
    b"{" * 2000,
    b"(" * 2000,
    b"]" * 2000,
    b'{"a":' * 2000,
    b"a." * 2000,
    b"a=" * 500,
    b"'" * 100,
    b'"' * 101,
    b"x" * 100_000,
    b"\\" * 999,
    b"true",
    b"null",
    b"{}",
    b"[]",
    b"/dev/zero",
    b"../" * 50,
)


def alter_bytes(chance: random.Random, data: bytes, others: Sequence[bytes]) -> bytes:
    """The input with a few things about it changed."""
    data = bytearray(data)
    for _ in range(chance.choice((1, 1, 1, 2, 3, 8))):
        place = chance.randrange(len(data) + 1)
        length = chance.choice((1, 2, 4, 8, chance.randrange(1, 200)))
        match chance.randrange(9):
            case 0 if data:
                data[place % len(data)] ^= 1 << chance.randrange(8)
            case 1:
                del data[place : place + length]
            case 2:
                data[place:place] = data[place : place + length]
            case 3:
                data[place:place] = chance.choice(TEXTS)
            case 4:
                form = chance.choice("<>") + chance.choice("BHIQ")
                number = chance.choice(NUMBERS)
                with suppress(struct.error):
                    packed = struct.pack(form, number)
                    data[place : place + len(packed)] = packed
            case 5:
                other = chance.choice(others)
                start = chance.randrange(len(other) + 1)
                data[place : place + length] = other[start : start + length]
            case 6:
                del data[place:]
            case 7:
                data[place : place + length] = chance.choice(TEXTS)
            case 8:
                piece = bytes(data[place : place + length])
                data[place:place] = piece * chance.choice((2, 10, 300))
    return bytes(data[:2_000_000])


def altered_zip(chance: random.Random, data: bytes) -> bytes:
    """A zip whose files, sizes and names are altered, its checksums fitting."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            files = {it: archive.read(it) for it in archive.namelist()}
    except Exception:
        return data
    name = chance.choice([*files] or ["a.npy"])
    match chance.randrange(5):
        case 0:
            files[name] = alter_bytes(
                chance, files.get(name, b""), list(files.values())
            )
        case 1:
            files[name] = files.get(name, b"")[:128] + bytes(
                chance.choice((1, 10**3, 10**6, 3 * 10**7))
            )
        case 2:
            files[name] = data
        case 3:
            files.pop(name, None)
        case 4:
            files[chance.choice(("../a.npy", "/etc/a.npy", "a.npy", ""))] = b"\x93NUMPY"
    way = chance.choice((0, 8, 8, 12, 14))
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", way) as archive:
        for it, content in files.items():
            archive.writestr(it or "a", content)
    whole = bytearray(made.getvalue())
    if chance.random() < 0.3:  # its list says something else of the sizes
        place = whole.rfind(b"PK\x01\x02")
        at = place + chance.choice((8, 10, 20, 24, 28, 42))
        whole[at : at + 4] = struct.pack("<I", chance.choice(NUMBERS))
    return bytes(whole)


def altered_png(chance: random.Random, data: bytes) -> bytes:
    """A PNG picture whose parts are altered, their checksums fitting."""
    parts, place = [], 8
    while place + 12 <= len(data):
        (length,) = struct.unpack_from(">I", data, place)
        kind = data[place + 4 : place + 8]
        parts.append([kind, data[place + 8 : place + 8 + length]])
        place += 12 + length
    if not parts or data[:4] != b"\x89PNG":
        return data
    part = chance.choice([parts[0], parts[0], *parts])
    if part[0] == b"IHDR" and chance.random() < 0.5:
        sides = (1, 7, 640, 3000, 7000, 30_000, 65_535, 2**31 - 1)
        size = struct.pack(">II", chance.choice(sides), chance.choice(sides))
        about = bytes(chance.choice(((8, 2), (8, 0), (16, 0), (16, 6), (1, 3))))
        part[1] = size + about + bytes(3)
    else:
        part[1] = alter_bytes(chance, part[1], [it[1] for it in parts])
    made = data[:8]
    for kind, content in parts:
        body = kind + content
        made += struct.pack(">I", len(content)) + body
        made += struct.pack(">I", zlib.crc32(body))
    return made


def altered_package(chance: random.Random, data: bytes) -> bytes:
    """An exported memory with altered lists and lessons, the checksums fitting."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        files = {it: archive.read(it) for it in archive.namelist()}
    name = chance.choice([it for it in files if it != "memory.json"])
    if name.endswith(".npz"):
        files[name] = altered_zip(chance, files[name])
    elif name.endswith(".png"):
        files[name] = altered_png(chance, files[name])
    else:
        files[name] = alter_bytes(chance, files[name], list(files.values()))
    lines = []
    for line in files["lessons.jsonl"].splitlines():
        with suppress(Exception):
            told = json.loads(line)
            for it in told["files"]:
                inner = files.get(f"lessons/{told['lesson']}/{it}", b"")
                told["files"][it] = hashlib.sha256(inner).hexdigest()
            line = json.dumps(told).encode()
        lines.append(line)
    files["lessons.jsonl"] = b"".join(it + b"\n" for it in lines)
    manifest = json.loads(files["memory.json"])
    for it in manifest["files"]:
        manifest["files"][it] = hashlib.sha256(files.get(it, b"")).hexdigest()
    files["memory.json"] = json.dumps(manifest).encode()
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", chance.choice((0, 8))) as archive:
        for it, content in files.items():
            archive.writestr(it, content)
    return made.getvalue()


def inputs(chance: random.Random, reader: Reader) -> Iterator[bytes]:
    """Inputs without end: those that are fine first, then altered ones."""
    yield from reader.seeds
    while True:
        data = chance.choice(reader.seeds)
        if reader.alter is not None and chance.random() < 0.6:
            for _ in range(chance.choice((1, 1, 2))):
                data = reader.alter(chance, data)
        if reader.alter is None or chance.random() < 0.5:
            data = alter_bytes(chance, data, reader.seeds)
        yield data


# --- readers -------------------------------------------------------------------------


def _file(folder: Path, name: str, read: Callable[[Path], object]) -> Any:
    """Reads what is put into a file of this name."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)

    def reading(data: bytes) -> object:
        path.write_bytes(data)
        return read(path)

    return reading


def _texts(pattern: str, most: int = 40_000) -> list[bytes]:
    found = [it.read_bytes() for it in sorted(ROOT.glob(pattern))]
    return [it for it in found if len(it) < most]


def _theory(folder: Path) -> Reader:
    from ttr.errors import TTRError
    from ttr.theories.theory import theory_of_file

    seeds = [*_texts("tests/theories/*.ttr"), *_texts("examples/**/*.ttr")]
    return Reader(seeds, _file(folder, "a.ttr", theory_of_file), (TTRError,))


def _stories(folder: Path) -> Reader:
    from ttr.dialogues.stories import StoryError, read_stories

    seeds = [*_texts("tests/**/*.dlg"), *_texts("examples/**/*.dlg")]
    return Reader(seeds, _file(folder, "a.dlg", read_stories), (StoryError,))


def _log(folder: Path) -> Reader:
    from ttr.cli.main import main
    from ttr.dialogues.logs import read_logs
    from ttr.errors import TTRError

    log = folder / "made.jsonl"
    with open(os.devnull, "w") as nothing:
        stdout, sys.stdout = sys.stdout, nothing
        try:
            main(["play", str(ROOT / "tests/games/door.dlg"), "--log", str(log)])
        finally:
            sys.stdout = stdout

    def read(path: Path) -> None:
        for it in read_logs(path):
            it.declared  # noqa: B018

    return Reader([log.read_bytes()], _file(folder, "a.jsonl", read), (TTRError,))


def _typed_lines(folder: Path) -> Reader:
    from ttr.cli.session.sessions import Session
    from ttr.cli.session.terminal import _talk_through_pipe
    from ttr.safety.limits import InputLimitError

    def read(data: bytes) -> None:
        stdin, stdout = sys.stdin, sys.stdout
        sys.stdin = io.StringIO(data.decode("utf-8", "replace"))
        sys.stdout = io.StringIO()
        try:
            _talk_through_pipe(Session(), sys.stdout.write)
        finally:
            sys.stdin, sys.stdout = stdin, stdout

    return Reader(_texts("tests/theories/*.ttr", 3000), read, (InputLimitError,))


def _fracas(folder: Path) -> Reader:
    from ttr.semantics.fragment.fracas import UnreadableError, problems

    seed = (
        b'<?xml version="1.0"?><!DOCTYPE a SYSTEM "a.dtd"><fracas-problems>'
        b'<problem id="1" fracas_answer="yes"><p idx="1">Every vet sings.</p>'
        b"<q>Is it?</q><h>A vet sings.</h></problem></fracas-problems>"
    )
    laughs = b'<!DOCTYPE a [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><a>&b;</a>'
    return Reader([seed, laughs], _file(folder, "a.xml", problems), (UnreadableError,))


def _study(folder: Path) -> Reader:
    from kille.lab.errors import StudyError
    from kille.lab.study_files.file import read

    seeds = [*_texts("examples/**/*.toml"), *_texts("tests/**/*.toml")]
    seeds += _texts("docs/**/*.toml")
    return Reader(seeds, _file(folder, "a.toml", read), (StudyError,))


def _lexicon(folder: Path) -> Reader:
    from kille.dialogue import lexicon
    from kille.lab.study import Theory
    from kille.lab.study_files.languages import _lexicon_problems

    def read(path: Path) -> object:
        lexicon._lexicon.cache_clear()
        theory = Theory("a", language="en", grammar=path.parent)
        return list(_lexicon_problems(theory, path))

    seeds = _texts("grammars/lexicon.en.toml")
    return Reader(seeds, _file(folder, "own/lexicon.en.toml", read), ())


def _grammar(folder: Path) -> Reader:
    from kille.dialogue.grammars import GrammarError
    from kille.dialogue.language_files import source
    from kille.dialogue.parsing import Grammar

    def read(path: Path) -> None:
        Grammar(source("tutor.{}.lark", f"{path.parent}/en"), "start").parse("a cup")

    small = b'start: (_A | b)+ "c"?\nb: _A~1..3 -> d\n_A: /a+/i\n%ignore /[ ]+/\n'
    return Reader(
        [small, *_texts("grammars/tutor.en.lark")],
        _file(folder, "own/tutor.en.lark", read),
        (GrammarError, OSError, UnicodeDecodeError),
    )


def _pictures() -> dict[str, bytes]:
    import cv2
    import numpy as np

    chance = np.random.default_rng(0)
    small = chance.integers(0, 255, (12, 16, 3), np.uint8)
    colour = cv2.resize(small, (64, 48))
    kinds = ("png", "jpg", "bmp", "tif", "webp", "ppm", "gif")
    found = {it: cv2.imencode(f".{it}", colour)[1].tobytes() for it in kinds}
    progressive = [cv2.IMWRITE_JPEG_PROGRESSIVE, 1]
    found["progressive"] = cv2.imencode(".jpg", colour, progressive)[1].tobytes()
    depth = chance.integers(0, 4000, (48, 64)).astype(np.uint16)
    return found | {"depth": cv2.imencode(".png", depth)[1].tobytes()}


def _picture(folder: Path) -> Reader:
    from kille.sensors.pictures import read_colour, read_depth, read_labels
    from kille.sensors.sensor import SensorError

    def read(path: Path) -> None:
        refused = None
        for one in (read_colour, lambda it: read_depth(it, 1000.0), read_labels):
            try:
                one(path)
            except SensorError as error:
                refused = error
        if refused is not None:
            raise refused

    seeds = list(_pictures().values())
    return Reader(seeds, _file(folder, "a.png", read), (SensorError,), altered_png)


def _recording(path: Path) -> None:
    from kille.sensors.recordings import open_recording

    sensor = open_recording(str(path))
    try:
        for _ in range(3):
            sensor.frame()
    finally:
        sensor.close()


def _frames() -> list[Any]:
    import numpy as np

    from kille.scene import Frame, Intrinsics

    chance = np.random.default_rng(0)
    lens = Intrinsics(50.0, 50.0, 16.0, 12.0)
    return [
        Frame(
            chance.integers(0, 255, (24, 32, 3), np.uint8),
            chance.random((24, 32)).astype(np.float32),
            lens,
            number / 30,
            {},
        )
        for number in range(3)
    ]


def _npz(folder: Path) -> Reader:
    import numpy as np

    from kille.sensors.recordings.npz import write_npz
    from kille.sensors.sensor import SensorError

    made = folder / "made.npz"
    write_npz(made, _frames())
    with np.load(made) as held:
        packed = io.BytesIO()
        np.savez_compressed(packed, **held)
    seeds = [made.read_bytes(), packed.getvalue()]
    read = _file(folder, "a.npz", _recording)
    return Reader(seeds, read, (SensorError,), altered_zip)


def _bag(suffix: str) -> Callable[[Path], Reader]:
    def made(folder: Path) -> Reader:
        from kille.sensors.recordings import bag_writing
        from kille.sensors.sensor import SensorError

        path = folder / f"made{suffix}"
        write = {".bag": bag_writing.write_bag, ".mcap": bag_writing.write_mcap}
        write[suffix](path, _frames())
        read = _file(folder, f"a{suffix}", _recording)
        return Reader([path.read_bytes()], read, (SensorError,))

    return made


def _database(folder: Path) -> Reader:
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    from kille.sensors.sensor import SensorError

    kinds = get_typestore(Stores.ROS2_HUMBLE)
    image = kinds.types["sensor_msgs/msg/Image"]
    header = kinds.types["std_msgs/msg/Header"]
    stamp = kinds.types["builtin_interfaces/msg/Time"]
    import numpy as np

    with Writer(
        folder / "made", version=9, storage_plugin=StoragePlugin.SQLITE3
    ) as bag:
        topic = bag.add_connection("/rgb", image.__msgtype__, typestore=kinds)
        for number in range(3):
            pixels = np.zeros(24 * 32 * 3, np.uint8)
            head = header(stamp(number, 0), "camera")
            message = image(head, 24, 32, "rgb8", 0, 96, pixels)
            data = kinds.serialize_cdr(message, image.__msgtype__)
            bag.write(topic, number * 10**9, data)
    [path] = (folder / "made").glob("*.db3")
    read = _file(folder, "a.db3", _recording)
    return Reader([path.read_bytes()], read, (SensorError,))


def _in_folder(
    kind: str, files: Sequence[str], write: Callable[[Path, list[Any]], object]
) -> Callable[[Path], Reader]:
    """A recording that is a folder: one of its files is altered at a time."""

    def made(folder: Path) -> Reader:
        from kille.sensors.sensor import SensorError

        whole = folder / kind
        write(whole, _frames())
        names = [
            str(it.relative_to(whole))
            for pattern in files
            for it in sorted(whole.glob(pattern))
        ]
        kept = {name: (whole / name).read_bytes() for name in names}
        # A seed is the number of the file that is altered, and what is in it.
        seeds = [bytes([i]) + kept[name] for i, name in enumerate(names)]

        def read(data: bytes) -> None:
            name = names[data[0] % len(names)] if data else names[0]
            (whole / name).write_bytes(data[1:])
            try:
                _recording(whole)
            finally:
                (whole / name).write_bytes(kept[name])

        return Reader(seeds, read, (SensorError,))

    return made


def _write_captures(folder: Path, frames: list[Any]) -> None:
    from kille.sensors.recordings.capture_folders import write_captures

    write_captures(folder, frames)


def _write_tum(folder: Path, frames: list[Any]) -> None:
    from kille.sensors.recordings.tum import write_tum

    write_tum(folder, frames)


def _write_fakenect(folder: Path, frames: list[Any]) -> None:
    import numpy as np

    from kille.sensors.kinect.calibration import IDENTITY
    from kille.sensors.recordings.fakenect import DEVICE, HEADS, HEIGHT, INDEX, WIDTH

    folder.mkdir()
    lines = []
    for number in range(2):
        colour = np.full((HEIGHT, WIDTH, 3), 90, np.uint8)
        depth = np.full((HEIGHT, WIDTH), 700, "<u2")
        for kind, pixels in (("r", colour), ("d", depth)):
            name = f"{kind}-{number}.000000-{number}.p{'pg'[kind == 'd']}m"
            (folder / name).write_bytes(HEADS[kind] + pixels.tobytes())
            lines.append(f"{name}\n")
    (folder / INDEX).write_text("".join(lines))
    (folder / DEVICE).write_text(IDENTITY.to_json())


def _package(folder: Path) -> Reader:
    from kille import Agent
    from kille.memory import Memory
    from kille.memory.exporting import export
    from kille.memory.importing import open_package
    from kille.memory.packages import PackageError

    file, made = folder / "memory.db", folder / "made.zip"
    with Agent("synthetic:empty?seed=7&faults=none", file) as robot:
        for thing in ("cup", "book"):
            robot.do(f"show {thing}")
            robot.hear(f"This is a {thing}.")
    with Memory.open_to_read(file) as memory:
        export(memory, made)

    def read(path: Path) -> None:
        with open_package(path) as package:
            for _ in package.lessons():
                pass

    read_it = _file(folder, "a.zip", read)
    return Reader([made.read_bytes()], read_it, (PackageError,), altered_package)


def _bundle(folder: Path) -> Reader:
    import numpy as np

    from kille.bus.messages import Bundle, BusError
    from kille.bus.packing import pack, unpack

    seed = pack(Bundle({"id": "7", "a": [1, {"b": None}]}, {"up": np.arange(30)}))
    return Reader([seed], unpack, (BusError,), altered_zip)


def _mesh(folder: Path) -> Reader:
    from kille.sensors.sensor import SensorError
    from kille.sensors.synthetic.obj_files import load_scan

    (folder / "a.png").write_bytes(_pictures()["png"])
    (folder / "a.mtl").write_text("newmtl a\nmap_Kd a.png\n")
    seed = (
        b"mtllib a.mtl\nv 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nvt 0 0\nvt 1 0\nvt 0 1\n"
        b"f 1/1 2/2 3/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf -1/-1 -2/-2 -3/-3\n"
    )

    def read(path: Path) -> object:
        load_scan.cache_clear()
        return load_scan(path)

    return Reader([seed], _file(folder, "a.obj", read), (SensorError,))


def _sound(folder: Path) -> Reader:
    import wave

    from kille.speech.sound import RATE, SoundError, read_wav

    seeds = []
    for rate, channels, width in ((16_000, 1, 2), (8_000, 2, 1), (44_100, 2, 3)):
        made = io.BytesIO()
        with wave.open(made, "wb") as file:
            file.setparams((channels, width, rate, 0, "NONE", ""))
            file.writeframes(bytes(range(240)) * 10)
        seeds.append(made.getvalue())

    def read(path: Path) -> object:
        return read_wav(path).at(RATE)

    return Reader(seeds, _file(folder, "a.wav", read), (SoundError,))


def _judgements(folder: Path) -> Reader:
    from kille.lab.results import ExperimentError
    from kille.lab.scenes.published_judgements import read

    head = b"preposition,dx_right,dy_up,rating_1_9\n"
    seed = head + b"left,-1,0,9\nabove,0,2,8.5\n" * 20
    reading = _file(folder, "logan_sadler.csv", lambda path: read(path.parent))
    return Reader([seed], reading, (ExperimentError,))


READERS: dict[str, Callable[[Path], Reader]] = {
    "theory": _theory,
    "stories": _stories,
    "log": _log,
    "typed": _typed_lines,
    "fracas": _fracas,
    "study": _study,
    "lexicon": _lexicon,
    "grammar": _grammar,
    "picture": _picture,
    "npz": _npz,
    "bag": _bag(".bag"),
    "mcap": _bag(".mcap"),
    "database": _database,
    "captures": _in_folder("captures", ("*.json", "*.png"), _write_captures),
    "fakenect": _in_folder("fakenect", ("*.txt", "*.json"), _write_fakenect),
    "tum": _in_folder("tum", ("*.txt", "rgb/*.png", "depth/*.png"), _write_tum),
    "package": _package,
    "bundle": _bundle,
    "mesh": _mesh,
    "sound": _sound,
    "judged": _judgements,
}


# --- trying --------------------------------------------------------------------------


class _TooLong(BaseException):
    """An input takes too long."""


def _ring(number: int, frame: object) -> NoReturn:
    raise _TooLong


def _megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


@dataclass
class Tried:
    """What came of a reader's inputs."""

    count: int = 0
    refused: int = 0
    slowest: float = 0.0
    megabytes: float = 0.0
    failures: Counter[str] = field(default_factory=Counter)


def _work(name: str, seed: int, first: int, count: int, told: Connection) -> None:
    """Gives a reader the inputs from the first on, and tells what comes of each."""
    limit = 4_000_000_000
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    signal.signal(signal.SIGALRM, _ring)
    with tempfile.TemporaryDirectory() as folder:
        reader = READERS[name](Path(folder))
        # What libraries say of damage to nobody is not looked at.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        for number, data in enumerate(inputs(random.Random(f"{name} {seed}"), reader)):
            if number < first:
                continue
            if number >= count:
                break
            told.send(("begun", number, data))
            told.send(_outcome(reader, data))
        told.send(("done", count, b""))


def _outcome(reader: Reader, data: bytes) -> tuple[str, float, float, str]:
    begun = time.process_time()
    signal.setitimer(signal.ITIMER_REAL, 3 * SECONDS)
    outcome = "read"
    try:
        reader.read(data)
    except reader.refusals as error:
        outcome = "refused"
        if not str(error).strip():
            outcome = "a refusal that says nothing"
    except _TooLong:
        outcome = f"no end after {3 * SECONDS:g} s"
    except Exception as error:
        where = traceback.extract_tb(error.__traceback__)[-1]
        place = f"{Path(where.filename).name}:{where.lineno}"
        outcome = f"{type(error).__name__} in {place}: {str(error)[:80]}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    return "ended", time.process_time() - begun, _megabytes(), outcome


def try_reader(name: str, seed: int, count: int, kept: Path) -> Tried:
    """What comes of so many inputs of a reader, over as many processes as it takes."""
    found = Tried()
    context = multiprocessing.get_context("fork")
    while found.count < count:
        begun = found.count
        ours, theirs = context.Pipe(duplex=False)
        work = (name, seed, found.count, count, theirs)
        process = context.Process(target=_work, args=work)
        process.start()
        theirs.close()
        _follow(found, ours, name, kept)
        process.kill()
        process.join()
        if begun == found.count:
            raise SystemExit(f"{name}: the reader does not even begin")
    return found


def _follow(found: Tried, ours: Connection, name: str, kept: Path) -> None:
    """Takes what a process tells, until it is done, lost, or has grown too large."""
    data: bytes | None = None
    while True:
        try:
            if not ours.poll(6 * SECONDS):
                raise EOFError
            what, *rest = ours.recv()
        except EOFError:
            if data is not None:
                found.count += 1
                _note(found, name, kept, data, "the process is lost or hangs")
            return
        if what == "done":
            return
        if what == "begun":
            data = rest[1]
            continue
        assert data is not None
        seconds, megabytes, outcome = rest
        found.count += 1
        found.slowest = max(found.slowest, seconds)
        found.megabytes = max(found.megabytes, megabytes)
        if outcome == "refused":
            found.refused += 1
        elif outcome != "read":
            _note(found, name, kept, data, outcome)
        if seconds > SECONDS:
            _note(found, name, kept, data, "it takes too long")
        if megabytes > MEGABYTES:
            _note(found, name, kept, data, "it takes too much memory")
            return


def _note(found: Tried, name: str, kept: Path, data: bytes, outcome: str) -> None:
    found.failures[outcome] += 1
    if found.failures[outcome] <= KEPT:
        kept.mkdir(parents=True, exist_ok=True)
        digest = hashlib.sha256(data).hexdigest()[:12]
        (kept / f"{name}-{digest}").write_bytes(data)


def _report(name: str, seed: int, count: int, kept: Path) -> bool:
    """Tries a reader, and prints a line for it; whether nothing was found."""
    found = try_reader(name, seed, count, kept)
    sys.stdout.write(
        f"{name:10} {found.count:7} inputs, {found.refused} refused; slowest "
        f"{found.slowest:.2f} s, {found.megabytes:.0f} MB; "
        f"{sum(found.failures.values())} failures\n"
    )
    for outcome, times in found.failures.most_common():
        sys.stdout.write(f"    {times} × {outcome}\n")
    sys.stdout.flush()
    return not found.failures and found.count > 0


def main() -> int:
    """Try the readers; 1 if anything was found."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("readers", nargs="*", metavar="READER", help=", ".join(READERS))
    parser.add_argument("--count", type=int, default=1000, help="for each (1000)")
    parser.add_argument("--seed", type=int, default=0, help="other inputs (0)")
    parser.add_argument("--kept", type=Path, default=Path("fuzz-found"))
    options = parser.parse_args()
    wrong = set(options.readers) - READERS.keys()
    if wrong:
        parser.error(f"there is no reader {', '.join(wrong)}")
    names = options.readers or list(READERS)
    fine = [_report(it, options.seed, options.count, options.kept) for it in names]
    return 0 if all(fine) else 1


if __name__ == "__main__":
    sys.exit(main())
