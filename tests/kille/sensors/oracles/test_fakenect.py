"""Recordings go both ways between libfreenect's own recorder and player and ours."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from kille.sensors.recordings.raw_frames import raw_source
from kille.sensors.sources import open_sensor
from kinect_emulator import netpbm
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import After, Ran, run
from kinect_emulator.server import Server

pytestmark = pytest.mark.oracle


def test_we_play_what_fakenect_record_recorded(
    ran: Callable[..., Ran], tmp_path: Path
) -> None:
    kinect, folder = Kinect(), tmp_path / "theirs"
    done = ran(kinect, "fakenect-record", str(folder), enough=After("/d-", 12))
    assert "Caught signal" in done.out
    source = raw_source(open_sensor(f"{folder}?loop=no"))
    captures = [source.capture() for _ in range(8)]
    ticks = [capture.ticks_depth for capture in captures]
    assert len(set(ticks)) == 8
    for capture in captures:
        assert any(np.array_equal(capture.depth, it.depth) for it in kinect.show.views)
    written = [netpbm.depth(folder / it) for it in index(folder) if it[0] == "d"]
    assert all(any(np.array_equal(it.depth, w) for w in written) for it in captures)


def test_libfreenect_plays_what_kille_record_took_from_a_kinect(
    program: Callable[[str], str],
    libusb: Path,
    serve: Callable[..., Server],
    tmp_path: Path,
) -> None:
    player, recorder = program("fakenect"), program("fakenect-record")
    kinect, ours, theirs = Kinect(), tmp_path / "ours", tmp_path / "theirs"
    command = ["-m", "kille.interfaces.cli", "record", str(ours), "--sensor", "kinect"]
    done = run(
        [sys.executable, *command, "--frames", "6"], libusb, serve(kinect), tmp_path
    )
    assert done.status == 0, done.out + done.err
    subprocess.run(
        [player, ours, recorder, theirs], check=True, timeout=120, capture_output=True
    )
    came = [netpbm.depth(theirs / it) for it in index(theirs) if it[0] == "d"]
    shown = [view.depth for view in kinect.show.views]
    assert len(came) == 6
    assert all(any(np.array_equal(it, view) for view in shown) for it in came)
    assert any(name[0] == "a" for name in index(ours))


def index(folder: Path) -> list[str]:
    """The names of the files of a recording, in order."""
    lines = (folder / "INDEX.txt").read_text().splitlines()
    return [Path(line).name for line in lines]
