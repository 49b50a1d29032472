"""The emulated bus for other programs, and the program that starts them on it."""

from __future__ import annotations

import os
import signal
import socket
import struct
import subprocess
import sys
from pathlib import Path

import pytest

import kinect_emulator
from kinect_emulator.building import compiler
from kinect_emulator.host import Host
from kinect_emulator.server import Server

LONG = 120.0


def test_a_server_that_fails_lets_its_clients_go(tmp_path: Path) -> None:
    server = Server(Host(), tmp_path / "socket")
    with socket.socket(socket.AF_UNIX) as client:
        client.settimeout(LONG)
        client.connect(str(server.path))
        unknown = 99
        client.sendall(struct.pack("<2Q", 0, 1))
        client.sendall(struct.pack("<Ii4II", unknown, 0, 0, 0, 0, 0, 0))
        with pytest.raises(ValueError, match="99 is not a valid Ask"):
            server.serve()
        assert client.recv(1) == b""
    assert not server.path.exists()


def test_nobody_but_the_user_may_open_the_socket(tmp_path: Path) -> None:
    server = Server(Host(), tmp_path / "socket")
    assert server.path.stat().st_mode & 0o777 == 0o600
    server.stop()
    server.serve()


def on_a_kinect(*arguments: str) -> subprocess.Popen[str]:
    """`python -m kinect_emulator`, started."""
    if compiler() is None:
        pytest.skip("no C compiler for the fake libusb: apt-get install gcc")
    home = str(Path(kinect_emulator.__file__).parent.parent)
    return subprocess.Popen(
        [sys.executable, "-m", "kinect_emulator", *arguments],
        env={**os.environ, "PYTHONPATH": home},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


LOOKING = """
import sys
from kille.sensors.sources import open_sensor
sensor = open_sensor("kinect")
print(sensor.frame().colour.shape, flush=True)
sys.exit(3)
"""


@pytest.mark.slow
def test_a_program_sees_what_a_sensor_shows() -> None:
    source = ("--source", "synthetic:empty")
    with on_a_kinect(*source, "--", sys.executable, "-c", LOOKING) as process:
        assert process.communicate(timeout=LONG) == ("(480, 640, 3)\n", "")
    assert process.returncode == 3


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--", "no-such-program"), "no-such-program"),
        (("--source", "no-such-sensor", "--", "true"), "no-such-sensor"),
    ],
    ids=["program", "sensor"],
)
def test_what_is_not_there_is_a_line(arguments: tuple[str, ...], told: str) -> None:
    with on_a_kinect(*arguments) as process:
        out, err = process.communicate(timeout=LONG)
    assert (process.returncode, out) == (2, "")
    assert err.splitlines()[-1].startswith("python -m kinect_emulator: error: ")
    assert told in err
    assert "Traceback" not in err


def test_ctrl_c_ends_the_program_and_its_kinect() -> None:
    waiting = "print('here', flush=True); import time; time.sleep(1_000)"
    with on_a_kinect("--", sys.executable, "-c", waiting) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "here\n"
        # As from a terminal: to the program and to who started it.
        os.killpg(process.pid, signal.SIGINT)
        _, err = process.communicate(timeout=LONG)
    assert process.returncode == 130
    assert err.count("Traceback") == 1, "the program's own"
