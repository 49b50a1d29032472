"""No command can be reached by others while it works, but those of ROS and DDS."""

from __future__ import annotations

import argparse
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from shutil import copytree, rmtree
from tempfile import mkdtemp
from typing import NamedTuple

import cv2
import numpy as np
import pytest

import listening
from kille.interfaces import cli as kille
from listening import MACHINE, NETWORK, USER, Listening, reach_of, sockets_of, tree
from ttr.cli import main as ttr

pytestmark = [
    pytest.mark.skipif(
        not Path("/proc/net/tcp").exists(), reason="only Linux lists sockets in /proc"
    ),
    pytest.mark.slow,
]

ROOT = Path(__file__).resolve().parents[3]
IMPORTABLE = Path(listening.__file__).parent
PROGRAMS = {"kille": kille, "ttr": ttr}
SENSOR = "--sensor", "synthetic:empty"
GLANCE = 0.05
"""Seconds between two looks at a program and all that it started."""
LIMIT = 120
"""Seconds after which a program that was interrupted is killed."""

STUDY = """
title = "Who listens?"
seeds = 2
theories.driven.mode = "driven"
tutors.Ann.kind = "scripted"
tutors.Ann.file = "one.dlg"
scenes.table.kind = "drawn"
phases = [{ do = "teach", what = "nouns" }]
"""
OWN_TYPES = """
theories.own.meanings.It = "[x : Ind, look : Look, d : shown(x, look)]"
"""
FILES = {
    "study.toml": STUDY + OWN_TYPES,
    "plain.toml": STUDY,
    "own.py": "def fail():\n    raise ValueError\n",
    "one.dlg": "--- one\n@ place 2 7 3\n@ point 2\nU> This is a cup.\n",
    "kille.dlg": "--- one\nU> Hello.\nS> Hello.\n",
    "fracas.xml": '<fracas-problems><comment class="section"> 1 Q </comment>'
    '<problem id="001" fracas_answer="yes"><p idx="1">Every vet sings.</p>'
    "<q>Is that so?</q><h>Every vet sings.</h><a>yes</a></problem>"
    "</fracas-problems>",
}
PLAYING = "experiment", "run", "study.toml", "--workers", "2"
FETCH = str(ROOT / "examples" / "fetch.ttr")
DOOR = str(ROOT / "tests" / "games" / "door.dlg")


class Case(NamedTuple):
    """A command, what is typed, and the output after which it is interrupted."""

    words: tuple[str, ...]
    typed: str = ""
    until: str = ""
    codes: Sequence[int] = (0,)


KILLE = [
    Case(("demo",), until="learned", codes=(130,)),
    Case(("talk", *SENSOR), "@ show cup\nThis is a cup.\n"),
    Case(("replay", "kille.dlg")),
    Case(("record", "recording", *SENSOR, "--frames", "1")),
    Case(("convert", "recording", "converted", "--to", "tum")),
    Case(("memory", "list")),
    Case(("memory", "show", "cup")),
    Case(("memory", "export", "exported.zip")),
    Case(("memory", "import", "exported.zip")),
    Case(("memory", "check")),
    Case(("memory", "forget", "cup", "--yes")),
    Case(("evaluate", "objects", "pictures", "--protocol", "even-odd")),
    Case(("evaluate", "relations", "--method", "own.py:fail"), codes=(1,)),
    Case(("experiment", "check", "plain.toml")),
    Case(PLAYING),
    Case(("experiment", "show", "study.results")),
    Case(("experiment", "replay", "study.results", "driven/Ann/table/1")),
    Case(("init", "mine")),
    Case(("doctor",), codes=(0, 1)),
]
SERVING = [
    (("serve", "--port", "0", *SENSOR), MACHINE),
    (("serve", "--port", "0", "--host", "0.0.0.0", *SENSOR), NETWORK),
]
LONGER = [
    Case(("experiment", "replay", "study.results", "--workers", "2")),
    Case(("experiment", "resume", "study.results", "--workers", "2")),
    Case(("experiment", "report", "study.results")),
    Case(("experiment", "compare", "study.results", "copy")),
]
TTR = [
    Case(("check", FETCH)),
    Case(("play", DOOR, "--log", "log.jsonl")),
    Case(("replay", "log.jsonl")),
    Case(("test", FETCH, "--examples", "2")),
    Case(("show", FETCH, "Fetch")),
    Case(("repl",), "x : Ind\n"),
    Case(("editor", "vscode", "ttr.vsix")),
    Case(("lsp",)),
    Case(("fracas", "fracas.xml")),
]


class Seen(NamedTuple):
    """What was seen of a program and all that it started."""

    code: int
    out: str
    listening: set[Listening]
    """Where they could be reached, whenever one looked, and at the end."""
    bound: list[str]
    """All addresses that Python gave to sockets, however short they had them."""
    processes: int
    """How many processes with Python there were."""


Watch = Callable[..., Seen]


@pytest.fixture
def watch(tmp_path: Path) -> Watch:
    """Runs a program, and looks all the time whether it listens."""

    def run(
        *command: str, typed: str = "", enough: Callable[[Seen], bool] | None = None
    ) -> Seen:
        told, out, words = (tmp_path / it for it in ("told", "out", "in"))
        told.unlink(missing_ok=True)
        told.touch()
        words.write_text(typed)
        path = os.pathsep.join(map(str, (IMPORTABLE / "watched", IMPORTABLE)))
        with words.open() as given, out.open("w") as written:
            program = subprocess.Popen(
                command,
                cwd=tmp_path,
                env=os.environ | {"PYTHONPATH": path, "WATCHED": str(told)},
                stdin=given,
                stdout=written,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        found: set[Listening] = set()
        while program.poll() is None:
            found |= sockets_of(tree(program.pid))
            if enough and enough(seen(told, out, found)):
                program.send_signal(signal.SIGINT)
                program.wait(LIMIT)
            time.sleep(GLANCE)
        return seen(told, out, found, program.returncode)

    return run


def seen(told: Path, out: Path, found: set[Listening], code: int = 0) -> Seen:
    lines = [json.loads(line) for line in told.read_text().splitlines()]
    last = {Listening(*it) for _, what, it in lines if what == "listened"}
    bound = [it for _, what, it in lines if what == "bound"]
    processes = len({process for process, *_ in lines})
    return Seen(code, out.read_text(), found | last, bound, processes)


@pytest.mark.parametrize(
    ("program", "cases"),
    [
        ("kille", KILLE),
        ("ttr", TTR),
        pytest.param("kille", [*KILLE, *LONGER], marks=pytest.mark.deep),
    ],
)
def test_nobody_can_reach_a_command_while_it_works(
    watch: Watch, tmp_path: Path, program: str, cases: Sequence[Case]
) -> None:
    prepare(tmp_path)
    reached: dict[str, object] = {}
    for it in cases:
        words = [sys.executable, "-m", PROGRAMS[program].__name__, *it.words]
        until = it.until
        enough = (lambda now, until=until: until in now.out) if until else None
        found = watch(*words, typed=it.typed, enough=enough)
        assert found.code in it.codes, (it.words, found.out)
        if found.listening or found.bound:
            reached[" ".join(it.words)] = found.listening, found.bound
        if it.words == PLAYING:
            # One that leads, one that forks, and two that play.
            assert found.processes >= 4
            copytree(tmp_path / "study.results", tmp_path / "copy")
    assert reached == {}


def prepare(folder: Path) -> None:
    """Writes what the commands read."""
    for name, text in FILES.items():
        (folder / name).write_text(text)
    chance = np.random.default_rng(1)
    for name in ("cup/0", "cup/1", "book/0", "book/1"):
        path = folder / "pictures" / f"{name}.png"
        path.parent.mkdir(parents=True, exist_ok=True)
        noise = chance.integers(0, 256, (60, 60, 3), dtype=np.uint8)
        assert cv2.imwrite(str(path), noise)


def test_every_command_is_watched_but_those_of_ros() -> None:
    serving = [Case(words) for words, _ in SERVING]
    watched = {"kille": [*KILLE, *LONGER, *serving], "ttr": TTR}
    for name, program in PROGRAMS.items():
        for words in commands(program._parser()):
            known = any(it.words[: len(words)] == words for it in watched[name])
            assert known or words[0] == "ros", words


def commands(parser: argparse.ArgumentParser) -> Iterator[tuple[str, ...]]:
    """The words of every command below this one."""
    below = [
        (name, inner)
        for action in parser._actions
        if isinstance(action, argparse._SubParsersAction)
        for name, inner in action.choices.items()
    ]
    for name, inner in below:
        for words in commands(inner):
            yield name, *words
    if not below:
        yield ()


def test_nodes_on_dds_can_be_reached_by_the_network(watch: Watch) -> None:
    pytest.importorskip("cyclonedds", reason="kille[ros2] is not installed")
    found = watch(
        *(sys.executable, "-m", kille.__name__, "ros", "talk", "--over", "ros2"),
        enough=lambda now: bool(now.listening),
    )
    assert {it.kind for it in found.listening} <= {"udp", "udp6"}
    assert {it.reach for it in found.listening} == {NETWORK}


@pytest.mark.parametrize(("words", "reach"), SERVING)
def test_the_page_can_be_reached_where_it_was_asked_to(
    watch: Watch, words: Sequence[str], reach: str
) -> None:
    pytest.importorskip("uvicorn", reason="kille[page] is not installed")
    found = watch(
        *(sys.executable, "-m", kille.__name__, *words),
        enough=lambda now: "The page is ready" in now.out,
    )
    assert found.code == 0, found.out
    assert {(it.kind, it.reach) for it in found.listening} == {("tcp", reach)}
    assert len(found.bound) == 1


# --- whether one would see it --------------------------------------------------------

PARENT = """
import subprocess, sys
subprocess.Popen([sys.executable, *sys.argv[1:]], stdin=subprocess.PIPE).wait()
"""
CHILD = """
import socket, sys
given = socket.socket(*map(int, sys.argv[1:3]))
given.bind(eval(sys.argv[3]))
if given.type == socket.SOCK_STREAM:
    given.listen()
sys.stdin.read()
"""


@pytest.mark.parametrize(
    ("family", "kind", "address", "reach"),
    [
        (socket.AF_INET, socket.SOCK_STREAM, ("0.0.0.0", 0), NETWORK),
        (socket.AF_INET, socket.SOCK_STREAM, ("127.0.0.1", 0), MACHINE),
        (socket.AF_INET6, socket.SOCK_STREAM, ("::", 0), NETWORK),
        (socket.AF_INET, socket.SOCK_DGRAM, ("0.0.0.0", 0), NETWORK),
        (socket.AF_UNIX, socket.SOCK_STREAM, "\0kille-test", MACHINE),
        (socket.AF_UNIX, socket.SOCK_STREAM, "FOLDER/named", USER),
        (socket.AF_UNIX, socket.SOCK_DGRAM, "FOLDER/named", USER),
    ],
)
def test_a_child_that_can_be_reached_is_seen(
    watch: Watch, tmp_path: Path, family: int, kind: int, address: object, reach: str
) -> None:
    tmp_path.chmod(0o700)
    if isinstance(address, str):
        address = address.replace("FOLDER", str(tmp_path))
    given = str(int(family)), str(int(kind)), repr(address)
    found = watch(
        *(sys.executable, "-c", PARENT, "-c", CHILD, *given),
        enough=lambda now: bool(now.listening),
    )
    (only,) = found.listening
    assert only.reach == reach
    assert found.bound == [str(address)]
    assert found.processes == 2


def test_a_pair_of_sockets_and_a_connection_out_can_be_reached_by_nobody() -> None:
    before = sockets_of([os.getpid()])
    with socket.create_server(("127.0.0.1", 0)) as server:
        there = sockets_of([os.getpid()]) - before
        with socket.create_connection(server.getsockname()):
            assert sockets_of([os.getpid()]) - before == there
    one, other = socket.socketpair()
    with one, other:
        assert sockets_of([os.getpid()]) == before


def test_who_may_open_a_named_socket_is_told_by_its_mode_and_folders(
    tmp_path: Path,
) -> None:
    folder = Path(mkdtemp(dir="/tmp"))
    path = folder / "named"
    with socket.socket(socket.AF_UNIX) as named:
        named.bind(str(path))
    found = []
    for of_folder, of_socket in ((0o755, 0o666), (0o755, 0o600), (0o700, 0o666)):
        folder.chmod(of_folder)
        path.chmod(of_socket)
        found.append(reach_of(str(path)))
    assert found == [MACHINE, USER, USER]
    rmtree(folder)
