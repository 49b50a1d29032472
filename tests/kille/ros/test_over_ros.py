"""The bus over a real ROS master: the suite of every bus, nodes, and ROS's tools."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from kille.bus import BusError

Process = subprocess.Popen[bytes]
Run = Callable[..., Process]

HERE = Path(__file__).resolve().parent

WITHIN = 60.0
"""Seconds in which a tool of ROS does what it is asked, on the slowest machine."""

PATIENT = f"_patience:={2 * WITHIN:g}"
"""Nodes wait for one that is being started anew."""

RECORDING = ("rosbag", "record", "--limit=45")
"""Three seconds of each topic, from whenever its first message comes."""

pytestmark = [pytest.mark.slow, pytest.mark.ros, pytest.mark.usefixtures("master")]


def test_the_bus_over_ros_keeps_to_what_every_bus_keeps_to() -> None:
    arguments = ("-q", "-p", "no:cacheprovider", "-W", "ignore", "test_bus.py")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *arguments],
        cwd=HERE,
        env={**os.environ, "KILLE_TEST_BUS": "ros"},
        text=True,
        capture_output=True,
        timeout=5 * WITHIN,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert " passed" in done.stdout
    assert "skipped" not in done.stdout


# --- the nodes -----------------------------------------------------------------------

COLOUR = "/camera/rgb/image_color"
DEPTH = "/camera/depth_registered/image"
CAMERA = "/camera/rgb/camera_info"
SCENE = "synthetic:empty?seed=7"


class Nodes:
    """The nodes as processes, and a tutor who types to them."""

    def __init__(self, kille: Run, folder: Path) -> None:
        self._kille, self._folder = kille, folder
        self._running: dict[str, Process] = {}
        for part in ("sensor", "perception", "dialogue"):
            self.start(part)
        self._tutor = subprocess.Popen(
            [sys.executable, "-m", "kille.interfaces.cli", "ros", "talk", PATIENT],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            bufsize=1,
        )

    def start(self, part: str) -> None:
        options = {
            "sensor": ("--sensor", SCENE, "--rate", "15"),
            "perception": (PATIENT,),
            "dialogue": ("--memory", str(self._folder / "memory.db"), PATIENT),
        }
        self._running[part] = self._kille(part, *options[part])

    def kill(self, part: str) -> None:
        """As a crash or a cut of power does."""
        self._running[part].kill()
        self._running[part].wait()

    def crash(self, part: str) -> None:
        """Kill a part in the middle of a turn, and start it anew."""
        time.sleep(0.2)
        self.kill(part)
        self.start(part)

    def says(self, text: str, meanwhile: Callable[[], None] = lambda: None) -> str:
        """What is said to that, and to a greeting by which one knows that it is all."""
        stream, told = self._tutor, list[str]()
        assert stream.stdin is not None
        assert stream.stdout is not None
        stream.stdin.write(f"{text}\nHello.\n")
        meanwhile()
        for line in stream.stdout:
            if line == "S> Hello.\n":
                break
            told.append(line)
        return "".join(it for it in told if not it.startswith("U> ")).strip()

    def close(self) -> None:
        assert self._tutor.stdin is not None
        assert self._tutor.stdout is not None
        self._tutor.stdin.close()
        self._tutor.wait(WITHIN)
        self._tutor.stdout.close()


@pytest.fixture
def nodes(kille: Run, tmp_path: Path) -> Iterator[Nodes]:
    started = Nodes(kille, tmp_path)
    yield started
    started.close()


def test_any_of_three_processes_may_be_killed_and_the_dialogue_goes_on(
    nodes: Nodes,
) -> None:
    assert nodes.says("What is this?") == "S> I see nothing on the table."
    assert "cup" in nodes.says("@ things")
    nodes.says("@ show cup")
    assert nodes.says("This is a cup.") == "S> OK, I learned a cup."
    answer = nodes.says("What is this?", lambda: nodes.crash("dialogue"))
    assert answer == "S> This is a cup."
    nodes.says("@ show book", lambda: nodes.crash("perception"))
    assert nodes.says("This is a book.") == "S> OK, I learned a book."
    nodes.kill("sensor")
    nodes.start("sensor")
    assert nodes.says("What is this?") == "S> I see nothing on the table."
    nodes.says("@ show cup")
    assert nodes.says("What is this?") == "S> This is a cup."


# --- the tools of ROS ----------------------------------------------------------------


def tool(*words: str) -> str:
    """What a tool of ROS prints."""
    done = subprocess.run(
        words, text=True, capture_output=True, timeout=WITHIN, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_the_tools_of_ros_see_hear_and_replay_the_robot(
    run: Run, kille: Run, tmp_path: Path, eventually: Callable[..., Any]
) -> None:
    robot = kille("all", "--sensor", "synthetic:desk?seed=7", "--rate", "15")
    log, bag = tmp_path / "all.log", str(tmp_path / "one.bag")
    eventually(lambda: "is running" in log.read_text("utf-8"))
    assert tool("rostopic", "type", COLOUR) == "sensor_msgs/Image\n"
    hearing = run("heard", "rostopic", "echo", "-n1", "/kille/system_output")
    recorder = run("record", *RECORDING, "-O", bag, COLOUR, DEPTH, CAMERA)
    # Greeted again and again: who listens may be told only after the first answer.
    said = ("/kille/user_input", "std_msgs/String", "Hello.")
    greeting = run("greet", "rostopic", "pub", "-r", "1", *said)
    hearing.wait(WITHIN)
    assert 'data: "Hello."' in (tmp_path / "heard.log").read_text("utf-8")
    greeting.terminate()
    recorder.wait(WITHIN)
    robot.terminate()
    assert robot.wait(WITHIN) == 0
    assert "Traceback" not in log.read_text("utf-8")
    assert DEPTH in tool("rosbag", "info", bag)
    run("play", "rosbag", "play", "-l", "-q", bag)
    eventually(lambda: {COLOUR, DEPTH, CAMERA} <= set(tool("rostopic", "list").split()))
    camera = f"ros:{COLOUR}?patience={WITHIN:g}"
    seen = typed("What do you see?\n", "talk", "--sensor", camera)
    assert seen.returncode == 0, seen.stderr
    assert seen.stdout.startswith("3 things are in view:")


def typed(text: str, *words: str) -> subprocess.CompletedProcess[str]:
    """What comes of a command into which this is typed."""
    return subprocess.run(
        [sys.executable, "-m", "kille.interfaces.cli", *words],
        input=text,
        text=True,
        capture_output=True,
        timeout=WITHIN,
        check=False,
    )


# --- what goes wrong -----------------------------------------------------------------


def test_a_picture_that_cannot_be_read_is_told(
    run: Run, eventually: Callable[..., Any]
) -> None:
    yuv = "{encoding: yuv422, height: 2, width: 2}"
    sent = ("/odd/image", "sensor_msgs/Image", yuv)
    run("odd", "rostopic", "pub", "-r", "20", *sent)
    eventually(lambda: "/odd/image" in tool("rostopic", "list"))
    talk = ("talk", "--sensor", "ros:/odd/image?patience=2")
    told = "/odd/image: a picture is encoded as yuv422, which is not read"
    # On a busy machine none may come in the two seconds.
    eventually(lambda: told in typed("What is this?\n", *talk).stderr)


@pytest.mark.parametrize(
    ("words", "master_uri", "because"),
    [
        (
            ["sensor"],
            "http://127.0.0.1:9",
            "no ROS master at http://127.0.0.1:9: start",
        ),
        (
            ["talk"],
            "127.0.0.1:9",
            "ROS_MASTER_URI is `127.0.0.1:9`, which is no address",
        ),
        (["sensor", "--sensor", "nonesuch"], "", "nonesuch: there is no such folder"),
        (["dialogue", "--lang", "de"], "", "it is one of en, sv"),
        (["sensor", "--sensor", "ros:/nothing"], "", "nobody sends /nothing"),
        (
            ["sensor", "_rate:=-3"],
            "",
            "the parameter rate is `-3`; it is a number above",
        ),
    ],
)
def test_what_a_node_cannot_do_is_one_line(
    monkeypatch: pytest.MonkeyPatch, words: list[str], master_uri: str, because: str
) -> None:
    if master_uri:
        monkeypatch.setenv("ROS_MASTER_URI", master_uri)
    done = typed("", "ros", *words)
    assert done.returncode == 2
    assert because in done.stderr
    (line,) = done.stderr.splitlines()
    assert line.startswith("kille: ")


@pytest.fixture(params=[b"", b"HTTP/1.0 404 Not Found\r\n\r\n", b"SSH-2.0\r\n"])
def no_master(request: pytest.FixtureRequest) -> Iterator[str]:
    """The address of a server that is none, and may say nothing at all."""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def answer() -> None:
            with suppress(OSError):
                while True:
                    asked.append(server.accept()[0])
                    asked[-1].sendall(request.param)

        asked = list[socket.socket]()
        Thread(target=answer, daemon=True).start()
        yield f"http://127.0.0.1:{server.getsockname()[1]}"
        server.shutdown(socket.SHUT_RDWR)
    for it in asked:
        it.close()


def test_who_is_no_master_is_not_waited_for(no_master: str) -> None:
    from kille.ros.bus import reach_master

    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("ROS_MASTER_URI", no_master)
        with pytest.raises(BusError, match=f"no ROS master at {no_master}: start"):
            reach_master(0.5)


def test_roslaunch_starts_the_nodes_that_are_wanted(
    kille: Run, eventually: Callable[..., Any]
) -> None:
    elsewhere = ("with_perception:=false", "with_dialogue:=false")
    kille("launch", "sensor:=synthetic:empty", "rate:=5", *elsewhere)
    eventually(lambda: "/kille_sensor" in tool("rosnode", "list"))
    assert tool("rosparam", "get", "/kille_sensor/rate") == "5.0\n"
    assert "/kille_dialogue" not in tool("rosnode", "list")
