"""The fake `libusb-1.0.so.0`, compiled where it is wanted."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

_SOURCES = Path(__file__).with_name("libusb")
NAME = "libusb-1.0.so.0"
FLAGS = ("-std=gnu11", "-Wall", "-Wextra", "-O2", "-fPIC", "-shared")


def compiler() -> str | None:
    """The C compiler of this machine, if it has one."""
    return shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")


def library(folder: Path, name: str = NAME) -> Path:
    """The library, built in that folder; RuntimeError if there is no compiler.

    Programs load it if the folder is in LD_LIBRARY_PATH and find the emulator by
    KINECT_EMULATOR, the path of its socket. Under another name it can be loaded beside
    the real one.
    """
    found = compiler()
    if found is None:
        raise RuntimeError("no C compiler; install one, such as gcc")
    target = folder / name
    sources = sorted(str(source) for source in _SOURCES.glob("*.c"))
    command = [found, *FLAGS, f"-Wl,-soname,{name}", "-o", str(target), *sources]
    subprocess.run([*command, "-lpthread"], check=True, capture_output=True)
    return target
