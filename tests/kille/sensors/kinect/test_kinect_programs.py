"""Programs that use a Kinect over USB: a fake libusb, an emulated device behind it."""

from __future__ import annotations

import importlib
import operator
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import pytest

from kille.sensors.kinect import libusb
from kinect_emulator.building import compiler, library
from kinect_emulator.faults import Faults
from kinect_emulator.kinect import Kinect
from kinect_emulator.running import environment, finished, patient
from kinect_emulator.server import Server

pytestmark = pytest.mark.slow

LONG = 120.0
"""Seconds that a program may take on a busy machine, where it needs two or so."""

USING = """
from kille.sensors.kinect import process_driver
process_driver._FAREWELL = 60.0  # a busy machine has no part in what is tested
from kille.sensors.sources import open_sensor
sensor = open_sensor("kinect")
for _ in range(3):
    sensor.frame()
print("seen", flush=True)
"""


PID = """
print(sensor._driver._process.pid, flush=True)
"""


def alive(process: int) -> bool:
    """Whether there is such a process, and it has not ended."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"


def until(happened: Callable[[], object]) -> None:
    """Wait for it."""
    deadline = time.monotonic() + LONG
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.01)


class Plugged(NamedTuple):
    """A Kinect, the server it is plugged into, and what a program needs to find it."""

    kinect: Kinect
    server: Server
    variables: Mapping[str, str]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if compiler() is None:
        pytest.skip("no C compiler for the fake libusb: apt-get install gcc")
    return library(tmp_path_factory.mktemp("libusb"))


@pytest.fixture
def plugged(built: Path, tmp_path: Path) -> Iterator[Plugged]:
    kinect = Kinect()
    path = tmp_path / "socket"
    with patient(kinect, path=path).running() as server:
        yield Plugged(kinect, server, environment(built, path))


def started(code: str, plugged: Plugged) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", code],
        env=dict(plugged.variables),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def at_rest(kinect: Kinect) -> bool:
    """Whether the program has switched the camera off."""
    return kinect.camera.modes() == ()


def test_a_program_that_forgets_to_close_ends_cleanly(plugged: Plugged) -> None:
    ran = finished(started(USING, plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "seen\n", "")
    assert at_rest(plugged.kinect)


def test_a_program_that_fails_ends_cleanly(plugged: Plugged) -> None:
    ran = finished(started(USING + "1 / 0", plugged), LONG)
    assert ran.status == 1
    assert ran.err.splitlines()[-1] == "ZeroDivisionError: division by zero"
    assert at_rest(plugged.kinect)


def test_ctrl_c_while_it_looks_ends_cleanly(plugged: Plugged) -> None:
    process = started(USING + PID + "while True: sensor.frame()", plugged)
    assert process.stdout is not None
    assert process.stdout.readline() == "seen\n"
    reader = int(process.stdout.readline())
    process.send_signal(signal.SIGINT)
    ran = finished(process, LONG)
    # Nothing is said of anything that did not stop.
    assert ran.err.splitlines()[-1] == "KeyboardInterrupt"
    assert ran.err.count("Traceback") == 1
    assert at_rest(plugged.kinect)
    assert not alive(reader)


SERVED = """
import time
from kille.sensors.kinect import isochronous_transfers
isochronous_transfers.PATIENCE = 60.0
from kille.sensors.kinect.packets import Assembler
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.kinect.usb import UsbBus
sensor = KinectSensor("kinect", UsbBus())
sensor.frame()
feed = Assembler.feed
def interrupted(self, batch):
    Assembler.feed = feed
    raise KeyboardInterrupt
Assembler.feed = interrupted
try:
    for _ in range(50):
        sensor.frame()
        time.sleep(0.05)  # slower than the frames come
except KeyboardInterrupt:
    print("interrupted")
sensor.frame()
sensor.close()
print(len(isochronous_transfers._UNDER_WAY))
"""


def test_ctrl_c_while_libusb_is_served_is_not_lost(plugged: Plugged) -> None:
    ran = finished(started(SERVED, plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "interrupted\n0\n", "")
    assert at_rest(plugged.kinect)


@pytest.mark.parametrize("moment", ["Popen.wait", "ProcessDriver._end"])
def test_ctrl_c_while_it_closes_leaves_it_to_the_next(
    plugged: Plugged, moment: str
) -> None:
    code = f"""
from subprocess import Popen
from kille.sensors.kinect.process_driver import ProcessDriver
owner, name = {moment.split(".")[0]}, {moment.split(".")[1]!r}
done = getattr(owner, name)
def interrupted(self, *given, **named):
    setattr(owner, name, done)
    raise KeyboardInterrupt
setattr(owner, name, interrupted)
try:
    sensor.close()
except KeyboardInterrupt:
    print("interrupted")
sensor.frame()
"""
    ran = finished(started(USING + code, plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "seen\ninterrupted\n", "")
    assert at_rest(plugged.kinect)


@pytest.mark.parametrize("sign", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
def test_a_program_that_is_killed_leaves_no_process_and_a_camera_at_rest(
    plugged: Plugged, sign: signal.Signals
) -> None:
    process = started(USING + PID + "while True: sensor.frame()", plugged)
    assert process.stdout is not None
    process.stdout.readline()
    reader = int(process.stdout.readline())
    process.send_signal(sign)
    finished(process, LONG)
    until(lambda: not alive(reader))
    assert at_rest(plugged.kinect)


def test_a_copy_of_the_program_does_not_keep_the_other_process(
    plugged: Plugged,
) -> None:
    """It has the socket, too, by which the end of the program would be seen."""
    code = """
import os, time
copy = os.fork()
if not copy:
    os.close(1)
    os.close(2)
    time.sleep(600)
print(copy, flush=True)
while True: sensor.frame()
"""
    process = started(USING + PID + code, plugged)
    assert process.stdout is not None
    process.stdout.readline()
    reader, copy = (int(process.stdout.readline()) for _ in range(2))
    process.kill()
    finished(process, LONG)
    try:
        until(lambda: not alive(reader))
        assert alive(copy)
        assert at_rest(plugged.kinect)
    finally:
        os.kill(copy, signal.SIGKILL)


def test_a_copy_of_the_program_that_ends_takes_nothing_from_it(
    plugged: Plugged,
) -> None:
    code = """
import os, sys
reader = sensor._driver._process.pid
copy = os.fork()
if not copy:
    sys.exit()
os.waitpid(copy, 0)
sensor.frame()
print(sensor._driver._process.pid == reader)
"""
    ran = finished(started(USING + code, plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "seen\nTrue\n", "")
    assert at_rest(plugged.kinect)


def test_what_came_is_not_told_when_the_other_process_has_ended(
    plugged: Plugged,
) -> None:
    code = """
import os, signal
os.kill(sensor._driver._process.pid, signal.SIGKILL)
print(len(sensor.counts))
sensor.frame()
print(len(sensor.counts))
"""
    ran = finished(started(USING + code, plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "seen\n0\n2\n", "")


def test_frames_go_on_if_the_other_process_is_killed(plugged: Plugged) -> None:
    code = """
import os, signal
before = sensor._driver._process.pid
os.kill(before, signal.SIGKILL)
for _ in range(3):
    sensor.frame()
print(sensor._driver._process.pid != before)
"""
    ran = finished(started(USING + code, plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "seen\nTrue\n", "")
    assert at_rest(plugged.kinect)


def test_another_process_that_hangs_is_killed_and_said_so(plugged: Plugged) -> None:
    code = """
import os, signal
from kille.sensors.kinect import process_driver
process_driver._FAREWELL = 0.2
reader = sensor._driver._process.pid
os.kill(reader, signal.SIGSTOP)
sensor.close()
"""
    ran = finished(started(USING + code, plugged), LONG)
    assert (ran.status, ran.out) == (0, "seen\n")
    assert ran.err == (
        "kinect: the process that reads it did not stop in time and was killed\n"
    )


def test_transfers_that_never_end_are_said_and_left(plugged: Plugged) -> None:
    process = started(USING + "input()\nsensor.close(); print('closed')", plugged)
    assert process.stdout is not None
    process.stdout.readline()
    plugged.kinect.faults = Faults(endless=True)
    # Until all are where they never end, and none is on its way back.
    until(lambda: plugged.server.host.waiting() == [6, 6])
    out, err = process.communicate("\n", LONG)
    assert out == "closed\n"
    assert [line.split(";")[0] for line in err.splitlines()] == [
        f"kinect: 6 of 6 USB transfers of endpoint {endpoint} never ended"
        for endpoint in ("0x81", "0x82")
    ]
    assert at_rest(plugged.kinect)


def test_nothing_of_the_folder_it_is_run_in_is_imported(
    plugged: Plugged, tmp_path: Path
) -> None:
    (tmp_path / "numpy.py").write_text("raise SystemExit('numpy of the folder')")
    (tmp_path / "seen.py").write_text(USING)
    program = tmp_path / "elsewhere"
    program.mkdir()
    (program / "seen.py").write_text(USING)
    ran = subprocess.run(
        [sys.executable, str(program / "seen.py")],
        cwd=tmp_path,
        env=dict(plugged.variables),
        capture_output=True,
        text=True,
        timeout=LONG,
        check=False,
    )
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "seen\n", "")


def test_one_that_is_opened_again_by_a_frame_is_closed_too(plugged: Plugged) -> None:
    ran = finished(started(USING + "sensor.close(); sensor.frame()", plugged), LONG)
    assert (ran.status, ran.out, ran.err) == (0, "seen\n", "")
    assert at_rest(plugged.kinect)


def test_after_ctrl_z_it_goes_on(plugged: Plugged) -> None:
    code = """
import signal
from kille.sensors.kinect import sensor as sensors
def patient_for(seconds):
    sensors.PATIENCE = sensors._SILENCE = seconds
patient_for(1.0)
# After it went on it may take as long as a busy machine needs.
signal.signal(signal.SIGCONT, lambda *_: patient_for(60.0))
while True:
    sensor.frame()
    print("frame", flush=True)
"""
    process = started(USING + code, plugged)
    assert process.stdout is not None
    for _ in range(3):
        process.stdout.readline()
    process.send_signal(signal.SIGSTOP)
    time.sleep(1.5)
    process.send_signal(signal.SIGCONT)
    # More than could have waited while it was stopped.
    came = [process.stdout.readline() for _ in range(20)]
    process.send_signal(signal.SIGINT)
    ran = finished(process, LONG)
    assert came == 20 * ["frame\n"], ran.err


def kille(plugged: Plugged, *arguments: str, typed: str = "") -> tuple[int, str, str]:
    ran = subprocess.run(
        [sys.executable, "-m", "kille.interfaces.cli", *arguments],
        env={**plugged.variables, "COLUMNS": "300"},
        input=typed,
        capture_output=True,
        text=True,
        timeout=LONG,
        check=False,
    )
    return ran.returncode, ran.stdout, ran.stderr


def test_one_talks_to_it_about_what_it_sees(plugged: Plugged, tmp_path: Path) -> None:
    memory = str(tmp_path / "memory.db")
    status, out, err = kille(
        plugged, "talk", "--sensor", "kinect", "--memory", memory, typed="Hello.\n"
    )
    assert (status, err) == (0, "")
    assert out
    assert at_rest(plugged.kinect)


def test_the_doctor_finds_it(plugged: Plugged) -> None:
    assert "ok  Kinect 1414" in kille(plugged, "doctor")[1]
    plugged.kinect.faults = Faults(forbidden=True)
    told = kille(plugged, "doctor")[1]
    assert "no  Kinect 1414" in told
    assert "sudo tee /etc/udev/rules.d/51-kinect.rules" in told


def test_a_kernel_driver_gets_a_busy_kinect_back(plugged: Plugged) -> None:
    plugged.kinect.faults = Faults(driven=True, busy=True)
    host = plugged.server.host
    camera = next(it for it in host.devices.values() if it.part.product == 0x02AE)
    camera.driven = True
    ran = finished(started(USING, plugged), LONG)
    assert ran.err.splitlines()[-1].endswith(
        "another program has it; close that program"
    )
    assert camera.driven


def test_libusb_that_does_not_start_is_told_of(plugged: Plugged) -> None:
    lost = plugged._replace(variables={**plugged.variables, "KINECT_EMULATOR": "/no"})
    ran = finished(started(USING, lost), LONG)
    assert "kinect: libusb is there but does not start" in ran.err.splitlines()[-1]


def test_without_libusb_one_is_told_how_to_get_it(
    plugged: Plugged, tmp_path: Path
) -> None:
    # As on a system where libusb is not found under any name, by any process.
    (tmp_path / "sitecustomize.py").write_text(
        "import ctypes, ctypes.util; ctypes.util.find_library = lambda name: None\n"
        "load = ctypes.CDLL.__init__\n"
        "def init(self, name, *given, **named):\n"
        "    if 'usb' in str(name): raise OSError(name)\n"
        "    load(self, name, *given, **named)\n"
        "ctypes.CDLL.__init__ = init\n"
    )
    lost = {**plugged.variables, "PYTHONPATH": str(tmp_path)}
    ran = finished(started(USING, plugged._replace(variables=lost)), LONG)
    assert "there is no libusb to talk to it; pip install 'kille[usb]'" in ran.err


@pytest.mark.parametrize("name", libusb.PINNED)
def test_pyusb_still_has_what_is_private_to_it(name: str) -> None:
    """Attributes that instances get are seen in the source of their classes."""
    module = importlib.import_module("usb.backend.libusb1")
    owner, _, attribute = name.partition(".")
    found = operator.attrgetter(owner)(module)
    names = found.__init__.__code__.co_names if attribute else (attribute,)
    assert attribute in names


def test_pyusbs_structures_have_the_fields_that_are_used() -> None:
    module = importlib.import_module("usb.backend.libusb1")
    fields = dict(module._libusb_transfer._fields_)
    assert {"status", "num_iso_packets", "iso_packet_desc"} <= set(fields)
    packet = [name for name, _ in module._libusb_iso_packet_descriptor._fields_]
    assert packet == ["length", "actual_length", "status"]
