"""A ROS master of one's own, buses to be tested, and nodes that do not outlive it."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

import pytest

from kille.bus import Bus, BusError, LocalBus, Topic
from kille.ros.system_modules import ros

WAIT = 60.0
"""Seconds in which things happen, on the slowest machine."""


def ros_is_here() -> bool:
    try:
        ros("rospy")
        ros("sensor_msgs.msg")
    except BusError:
        return False
    return shutil.which("roscore") is not None


@pytest.fixture(scope="session")
def master(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a master; the environment names it, and keeps its logs apart."""
    if not ros_is_here():
        pytest.skip("ROS 1 is not here: `make oracles` installs it on Debian")
    home = tmp_path_factory.mktemp("ros")
    port = free_port()
    uri = f"http://127.0.0.1:{port}"
    changed = {
        "ROS_MASTER_URI": uri,
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(home),
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
        "KILLE_MEMORY": str(home / "memory.db"),
    }
    with pytest.MonkeyPatch.context() as environment:
        for name, value in changed.items():
            environment.setenv(name, value)
        core = started("roscore", "-p", str(port), log=home / "roscore.log")
        try:
            until(lambda: answers(port))
            yield uri
        finally:
            ended(core)


def free_port() -> int:
    """A port that no connection is given by chance: those are from 32768 on."""
    for port in range(20_000 + os.getpid() % 10_000, 32_768):
        with socket.socket() as free, suppress(OSError):
            free.bind(("127.0.0.1", port))
            return port
    raise AssertionError("no port is free")


def answers(port: int) -> bool:
    try:
        socket.create_connection(("127.0.0.1", port), 1).close()
    except OSError:
        return False
    return True


def started(*command: str, log: Path) -> subprocess.Popen[bytes]:
    """A process in a group of its own, whose words go into a file."""
    with log.open("ab") as words:
        return subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=words,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )


def ended(*processes: subprocess.Popen[bytes]) -> None:
    """Ends processes with all that they have started."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        for process in processes:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, number)
        for process in processes:
            with suppress(subprocess.TimeoutExpired):
                process.wait(30)


def until(happened: Callable[[], Any], within: float = WAIT) -> Any:
    """What comes when it has happened."""
    end = time.monotonic() + within
    while time.monotonic() < end:
        found = happened()
        if found:
            return found
        time.sleep(0.02)
    raise AssertionError("it did not happen in time")


Run = Callable[..., subprocess.Popen[bytes]]


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    """Starts programs, whose words go into `NAME.log`; ends them with the test."""
    running = []

    def start(name: str, *command: str) -> subprocess.Popen[bytes]:
        running.append(started(*command, log=tmp_path / f"{name}.log"))
        return running[-1]

    try:
        yield start
    finally:
        ended(*running)


@pytest.fixture
def kille(master: str, run: Run) -> Run:
    """Starts a node of the robot."""

    def start(part: str, *options: str) -> subprocess.Popen[bytes]:
        command = (sys.executable, "-m", "kille.interfaces.cli", "ros", part)
        return run(part, *command, *options)

    return start


@pytest.fixture
def bus() -> Iterator[Bus]:
    """The bus within a process; in a process that is for that, another."""
    found = BUSES[os.environ.get("KILLE_TEST_BUS", "local")]()
    yield found
    found.close()


def over_ros() -> Bus:
    """Only for a process that does nothing else: ROS warns in threads of its own."""
    from kille.ros.bus import anonymous, open_ros

    return open_ros(anonymous("tests"))


def over_dds() -> Bus:
    from kille.ros2.bus import open_ros2

    return open_ros2("tests")


BUSES: dict[str, Callable[[], Bus]] = {
    "local": LocalBus,
    "ros": over_ros,
    "ros2": over_dds,
}


class Heard:
    """What comes under a topic."""

    def __init__(self, bus: Bus, topic: Topic[Any]) -> None:
        self.queue: SimpleQueue[Any] = SimpleQueue()
        self.listening = bus.subscribe(topic, self.queue.put)

    def next(self, within: float = WAIT) -> Any:
        return self.queue.get(timeout=within)

    def nothing(self, within: float = 0.3) -> bool:
        try:
            self.queue.get(timeout=within)
        except Empty:
            return True
        return False


@pytest.fixture
def heard() -> type[Heard]:
    return Heard


@pytest.fixture
def eventually() -> Callable[..., Any]:
    return until
