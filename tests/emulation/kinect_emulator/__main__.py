"""Run a program as if a Kinect were plugged in.

    python -m kinect_emulator [--source NAME] [--speed N] -- PROGRAM ARGUMENT...

The program gets the fake libusb by LD_LIBRARY_PATH. `--source` is a sensor as `kille`
names it, such as `synthetic:desk?seed=7` or the path of a recording; without it the
Kinect shows test patterns.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from kille.sensors.sensor import SensorError
from kinect_emulator.building import library
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import environment, patient
from kinect_emulator.sources import plugged


def main(arguments: list[str]) -> int:
    """Run the program; its exit status, as a shell tells it."""
    parser = argparse.ArgumentParser(prog="python -m kinect_emulator")
    parser.add_argument("--source", help="the sensor whose frames the Kinect sees")
    parser.add_argument("--speed", type=float, default=1.0, help="of its clock")
    parser.add_argument("command", nargs="+", help="the program and its arguments")
    given = parser.parse_args(arguments)
    if shutil.which(given.command[0]) is None:
        parser.error(f"there is no program {given.command[0]}")
    with tempfile.TemporaryDirectory(prefix="kinect-") as name:
        folder = Path(name)
        try:
            kinect = plugged(given.source) if given.source else Kinect()
            fake = library(folder)
        except (SensorError, RuntimeError) as error:
            parser.error(str(error))
        server = patient(kinect, path=folder / "socket", speed=given.speed)
        with server.running():
            status = ended(given.command, environment(fake, server.path))
    return status if status >= 0 else 128 - status


def ended(command: list[str], variables: dict[str, str]) -> int:
    """How the program ended, which a Ctrl-C reaches as well."""
    with subprocess.Popen(command, env=variables) as program:
        try:
            return program.wait()
        except KeyboardInterrupt:
            return program.wait()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
