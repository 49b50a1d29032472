"""Programs that nobody here wrote, on an emulated Kinect."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from kinect_emulator.building import compiler
from kinect_emulator.building import library as built
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import Ran, patient, run
from kinect_emulator.server import Server


@pytest.fixture(scope="session")
def libusb(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The fake libusb, or a skip that says why there is none."""
    if compiler() is None:
        pytest.skip("no C compiler for the fake libusb: apt-get install gcc")
    return built(tmp_path_factory.mktemp("libusb"))


@pytest.fixture(scope="session")
def program() -> Callable[[str], str]:
    """Finds a program of Debian's libfreenect, or skips and says what to install."""

    def find(name: str) -> str:
        found = shutil.which(name)
        if found is None:
            pytest.skip(f"no {name}: apt-get install libfreenect-bin")
        return found

    return find


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Callable[..., Server]]:
    """Plugs Kinects into a bus that other programs reach, until the test ends."""
    with ExitStack() as stack:

        def start(*kinects: Kinect, speed: float = 1.0) -> Server:
            server = patient(*kinects, path=tmp_path / "socket", speed=speed)
            return stack.enter_context(server.running())

        yield start


@pytest.fixture
def ran(
    libusb: Path,
    program: Callable[[str], str],
    serve: Callable[..., Server],
    tmp_path: Path,
) -> Callable[..., Ran]:
    """Runs a program on one emulated Kinect, in `tmp_path`, until it ends.

    It gets a Ctrl-C at the line of its output that is `enough`.
    """

    def start(
        kinect: Kinect,
        name: str,
        *arguments: str,
        enough: Callable[[str], bool] = lambda line: False,
    ) -> Ran:
        command = [program(name), *arguments]
        return run(command, libusb, serve(kinect), tmp_path, enough)

    return start
