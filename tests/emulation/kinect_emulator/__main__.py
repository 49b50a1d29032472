"""Run a program as if a Kinect were plugged in.

    python -m kinect_emulator [--source NAME] [--speed N] -- PROGRAM ARGUMENT...

The program gets the fake libusb by LD_LIBRARY_PATH. `--source` is a sensor as `kille`
names it, such as `synthetic:desk?seed=7` or the path of a recording; without it the
Kinect shows test patterns.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from kinect_emulator.building import library
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import environment, patient
from kinect_emulator.sources import plugged


def main(arguments: list[str]) -> int:
    """Run the program; its exit status."""
    parser = argparse.ArgumentParser(prog="python -m kinect_emulator")
    parser.add_argument("--source", help="the sensor whose frames the Kinect sees")
    parser.add_argument("--speed", type=float, default=1.0, help="of its clock")
    parser.add_argument("command", nargs="+", help="the program and its arguments")
    given = parser.parse_args(arguments)
    kinect = plugged(given.source) if given.source else Kinect()
    with tempfile.TemporaryDirectory(prefix="kinect-") as name:
        folder = Path(name)
        fake = library(folder)
        server = patient(kinect, path=folder / "socket", speed=given.speed)
        with server.running():
            done = subprocess.run(given.command, env=environment(fake, server.path))
    return done.returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
