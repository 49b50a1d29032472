"""What a Kinect costs: unpacking, registration, a million bad packets, ten minutes.

The device is emulated; between it and the driver are pyusb and a fake libusb, and the
driver runs in a process of its own, as a program would. `--minutes 10` streams so long;
shares are of one core. On a busy machine they are larger: a quiet second is one of the
best tenth. Two threads that compute in Python are run beside the driver, too: once it
reads USB in a thread of their process, once in another process, as the robot does.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
from _measuring import (
    Measure,
    Task,
    arguments,
    clock_of,
    limit_told,
    measure_task,
    table_lines,
)

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "emulation"))

import kille.sensors.kinect.capture as capturing  # noqa: E402
import kille.sensors.kinect.frame_decoding as developing  # noqa: E402
from kille.sensors.kinect import open_kinect  # noqa: E402
from kille.sensors.kinect.bayer import colour_of  # noqa: E402
from kille.sensors.kinect.calibration import Calibration  # noqa: E402
from kille.sensors.kinect.capture import KinectCapture, frame_of  # noqa: E402
from kille.sensors.kinect.isochronous_transfers import IsoStream  # noqa: E402
from kille.sensors.kinect.packets import Assembler  # noqa: E402
from kille.sensors.kinect.registration import register_depth  # noqa: E402
from kille.sensors.kinect.sensor import KinectSensor  # noqa: E402
from kille.sensors.kinect.streams import COLOUR, DEPTH_11, HEADER, Mode  # noqa: E402
from kille.sensors.kinect.transport import Batch  # noqa: E402
from kille.sensors.kinect.unpacking import unpack_11  # noqa: E402
from kille.sensors.kinect.usb import UsbBus  # noqa: E402
from kille.sensors.sensor import SensorError  # noqa: E402

PACKETS = 1_000_000
PATIENCE = 16_000
"""Microframes that the emulated bus waits for a driver that a busy machine holds up."""

BUSY_THREADS = 2
SMALL = Mode("small", 0x82, 20, 0x70, 5 * 8 + 3, (), ())
Row = tuple[str, float, float]
"""What a limit is of, the limit, and what was found."""


# --- one frame -----------------------------------------------------------------------


def scene() -> np.ndarray:
    """Raw depth of a slope with boxes before it, and holes."""
    rng = np.random.default_rng(0)
    raw = (600 + np.add.outer(np.arange(480) // 4, np.arange(640) // 3)).astype("u2")
    for _ in range(12):
        y, x = rng.integers(0, 420), rng.integers(0, 580)
        raw[y : y + 60, x : x + 60] = rng.integers(350, 1000)
    raw[rng.random(raw.shape) < 0.05] = 2047
    return raw


def unpack(_: int) -> Task:
    packed = np.random.default_rng(0).integers(0, 256, DEPTH_11.frame_size)
    packed = packed.astype(np.uint8)
    return lambda: unpack_11(packed)


def register(_: int) -> Task:
    raw, calibration = scene(), Calibration.typical()
    return lambda: register_depth(raw, calibration)


def make_frame(_: int) -> Task:
    mosaic = np.random.default_rng(0).integers(0, 256, (480, 640)).astype(np.uint8)
    capture = KinectCapture(0.0, colour_of(mosaic), scene(), 0, 0)
    calibration = Calibration.typical()
    return lambda: (colour_of(mosaic), frame_of(capture, calibration))


FRAME = {
    "unpack depth of 11 bits": Measure(unpack, (1,), {1: 1.5}),
    "register": Measure(register, (1,), {1: 3.0}),
    "colour, register, metres": Measure(make_frame, (1,)),
}


# --- bad packets ---------------------------------------------------------------------


def packets_of(
    mode: Mode, frames: int, rng: np.random.Generator
) -> tuple[np.ndarray, ...]:
    """Packets in rows, their lengths, and the frames that they carry."""
    data = rng.integers(0, 256, (frames, mode.packets * mode.body)).astype(np.uint8)
    count = frames * mode.packets
    rows = np.zeros((count, mode.packet_size), np.uint8)
    rows[:, HEADER:] = data.reshape(count, mode.body)
    places = np.arange(count) % mode.packets
    last = places == mode.packets - 1
    rows[:, 0], rows[:, 1] = b"RB"
    rows[:, 3] = mode.mark | np.where(last, 5, np.where(places == 0, 1, 2))
    rows[:, 5] = (rng.integers(256) + np.arange(count)) % 256
    ticks = np.arange(count) // mode.packets * 2_000_000 + rng.integers(1 << 31)
    rows[:, 8:HEADER] = ticks.astype("<u4").view(np.uint8).reshape(count, 4)
    lengths = np.where(last, HEADER + mode.last, mode.packet_size).astype(np.int32)
    return rows, lengths, data[:, : mode.frame_size]


def harm_order(count: int, rng: np.random.Generator) -> np.ndarray:
    """Which packets come, in which order: some lost, some twice, some out of place."""
    order = np.arange(count)
    for _ in range(rng.integers(0, 4)):
        at, run = rng.integers(len(order) + 1), rng.integers(1, 300)
        some = order[at : at + run]
        match rng.integers(4):
            case 0:
                order = np.delete(order, np.s_[at : at + run])
            case 1:
                order = np.insert(order, at, some)
            case 2:
                order[at : at + run] = some[::-1].copy()
            case 3:
                order = order[rng.random(len(order)) > 0.01]
    return order


def fuzz_stream(packets: int) -> Iterator[Row]:
    """Feed so many packets, most of them in trouble; count frames never sent."""
    rng = np.random.default_rng(0)
    fed = whole = wrong = raised = 0
    while fed < packets:
        mode = (SMALL, DEPTH_11, COLOUR)[rng.integers(3)]
        rows, lengths, frames = packets_of(mode, int(rng.integers(1, 12)), rng)
        order = harm_order(len(rows), rng)
        rows, lengths = rows[order], lengths[order]
        if len(rows):
            bad = rng.integers(0, len(rows), rng.integers(0, 6))
            rows[bad, rng.choice([0, 1, 3, 5, 8, 9, 10, 11], len(bad))] ^= np.uint8(
                1 << rng.integers(8)
            )
            cut = rng.integers(0, len(rows), rng.integers(0, 3))
            lengths[cut] = rng.integers(0, mode.packet_size + 1, len(cut))
        known = {frame.tobytes() for frame in frames}
        assembler, step = Assembler(mode), int(rng.integers(1, 200))
        for at in range(0, len(rows), step):
            try:
                batch = Batch(rows[at : at + step], lengths[at : at + step], 0.0)
                came = assembler.feed(batch)
            except Exception:
                raised += 1
                continue
            whole += len(came)
            wrong += sum(frame.data.tobytes() not in known for frame in came)
        fed += len(rows)
    yield f"exceptions in {fed:,} bad packets", 0, raised
    yield f"wrong ones of {whole:,} frames", 0, wrong


# --- streaming -----------------------------------------------------------------------


def client(seconds: float) -> None:
    """Look for so long and print what it took: run as a program of its own."""
    spent, asked = [0.0], [0.0]
    completed, submit = IsoStream.complete, IsoStream._submit

    def time_packet(self: IsoStream, slot: object, status: int) -> None:
        began = time.thread_time()
        completed(self, slot, status)
        spent[0] += time.thread_time() - began

    def count_submission(self: IsoStream, slot: object) -> bool:
        # A library's own time, which the fake one spends in asking the emulator.
        began = time.thread_time()
        done = submit(self, slot)
        spent[0] -= time.thread_time() - began
        return done

    def count_calls(function: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
        def counting(*given: object) -> np.ndarray:
            began = time.thread_time()
            found = function(*given)
            asked[0] += time.thread_time() - began
            return found

        return counting

    IsoStream.complete, IsoStream._submit = time_packet, count_submission
    developing.unpack_11 = count_calls(developing.unpack_11)
    capturing.register_depth = count_calls(capturing.register_depth)
    sensor = KinectSensor("kinect", UsbBus())
    sensor.frame()
    before = sensor.counts
    events = next(it for it in threading.enumerate() if it.name == "kinect events")
    clock = time.pthread_getcpuclockid(events.ident)
    marks = []
    frames, gaps, last = 0, [], time.monotonic()
    end = last + seconds
    while last < end:
        if frames % 30 == 0 and events.is_alive():
            thread = time.clock_gettime(clock)
            took = time.thread_time()
            marks.append((last, took, thread, spent[0], asked[0]))
        sensor.frame()
        frames, now = frames + 1, time.monotonic()
        gaps, last = [*gaps, (now - last, now)] if now - last > 0.5 else gaps, now
    took = last - end + seconds
    after = sensor.counts
    sensor.close()
    shares = 100 * np.diff(marks, axis=0) / np.diff(marks, axis=0)[:, :1]
    came = {mode: it.frames - before[mode].frames for mode, it in after.items()}
    print(
        json.dumps(
            {
                "seconds": took,
                "frames": frames,
                "came": came,
                "lost": sum(it.lost + it.strange for it in after.values()),
                "broken": sum(it.broken for it in after.values()),
                "taking": shares[:, 1].tolist(),
                "thread": shares[:, 2].tolist(),
                "pump": shares[:, 3].tolist(),
                "asked": shares[:, 4].tolist(),
                "gaps": gaps,
            }
        )
    )


def busy_client(seconds: float, apart: bool) -> None:
    """Look for so long while two threads compute: run as a program of its own."""

    def compute() -> None:
        while True:
            sum(it * it for it in range(1_000))

    sensor = open_kinect("kinect") if apart else KinectSensor("kinect", UsbBus())
    sensor.frame()
    for _ in range(BUSY_THREADS):
        threading.Thread(target=compute, daemon=True).start()
    before, first, last = sensor.counts, sensor.capture(), None
    seen, problem, begun = 0, "", time.monotonic()
    while time.monotonic() < begun + seconds and not problem:
        try:
            last, seen = sensor.capture(), seen + 1
        except SensorError as error:
            problem = str(error)
    after = sensor.counts
    # By the device's own clock, that no busy machine holds up.
    passed = ((last or first).ticks_depth - first.ticks_depth) % 2**32 / 60e6
    came = min(it.frames - before[mode].frames for mode, it in after.items())
    print(json.dumps({"sent": 30 * passed, "came": came, "seen": seen, "no": problem}))
    sensor.close()


def beside_busy_threads(seconds: float) -> Iterator[Row]:
    """How many frames are lost on a bus that does not wait."""
    from kinect_emulator.kinect import Kinect

    nothing = lambda server, kinect: None  # noqa: E731
    for how, most in (("process", 1.0), ("thread", 100.0)):
        asked = ["--busy", how, "--client", str(seconds)]
        found = look_through(Kinect(), seconds, nothing, asked, patience=0)
        sent = max(found["sent"], 1.0)
        lost = 100 * max(0.0, 1 - found["came"] / sent)
        beside = f"beside {BUSY_THREADS} busy threads, in a {how}"
        yield f"% of {sent:.0f} frames lost {beside}", most, lost
        yield (
            f"% of them not seen by the program {beside}",
            100.0,
            (100 * max(0.0, 1 - found["seen"] / sent)),
        )


def stream_frames(seconds: float) -> Iterator[Row]:
    """Let a program look at an emulated Kinect for so long."""
    from kinect_emulator.kinect import Kinect

    found = look_through(Kinect(), seconds, lambda server, kinect: None)
    took, waited = found["seconds"], found["waited"]
    for mode, frames in found["came"].items():
        late = abs(took - waited - frames / 30)
        yield f"{mode}: seconds of the bus less frames / 30", 0.2, late
    yield (
        "longest wait for a frame, s",
        2.0,
        max([0.0, *(gap for gap, _ in found["gaps"])]),
    )
    yield f"packets lost in {took:.0f} s", 0, found["lost"]
    yield "s that the bus waited for the driver", took, waited
    yield f"frames broken of {2 * found['frames']:,}", 0, found["broken"]
    pump, asked = np.array(found["pump"]), np.array(found["asked"])
    taking = np.array(found["taking"])
    for what, pick in (("a quiet", 10), ("the median", 50)):
        core = f"% of a core in {what} second"
        yield f"pump, {core}", 2.0, float(np.percentile(pump, pick))
        both = float(np.percentile(pump + asked, pick))
        yield f"with unpacking and registration, {core}", 6.0, both
        whole = float(np.percentile(pump + taking, pick))
        yield f"with colour, metres and pairing, too, {core}", 10.0, whole


def measure_recovery() -> Iterator[Row]:
    """Pull the plug for a second and see how long it takes after that."""
    from kinect_emulator.kinect import Kinect

    back = []

    def replug(server: object, kinect: Kinect) -> None:
        time.sleep(3.0)
        server.unplug(kinect)
        time.sleep(1.0)
        server.plug(kinect)
        back.append(time.monotonic())

    found = look_through(Kinect(), 7.0, replug)
    yield (
        "recovery from an unplug, s",
        2.0,
        max(at for _, at in found["gaps"]) - back[0],
    )


def look_through(
    kinect: object,
    seconds: float,
    meanwhile: object,
    asked: Sequence[str] = (),
    patience: int = PATIENCE,
) -> dict:
    """What a client tells; `meanwhile` is done to the server and the Kinect."""
    from kinect_emulator.building import library
    from kinect_emulator.host import Host
    from kinect_emulator.running import environment
    from kinect_emulator.server import Server

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "socket"
        variables = environment(library(Path(folder)), path)
        threads = {"OMP_NUM_THREADS": "1", "OPENCV_FOR_THREADS_NUM": "1"}
        with Server(Host(kinect, patience=patience), path).running() as server:
            program = subprocess.Popen(
                [sys.executable, __file__, *(asked or ("--client", str(seconds)))],
                env={**os.environ, **variables, **threads},
                stdout=subprocess.PIPE,
                text=True,
            )
            meanwhile(server, kinect)
            out, _ = program.communicate(timeout=seconds + 60)
    return {**json.loads(out), "waited": server.host.waited / 8_000}


def rows(options: argparse.Namespace) -> Iterator[Row]:
    yield from fuzz_stream(options.packets)
    yield from stream_frames(60 * options.minutes)
    yield from measure_recovery()
    yield from beside_busy_threads(20.0)


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--packets", type=int, default=PACKETS, help="bad ones, fed")
    parser.add_argument("--minutes", type=float, default=0.5, help="of streaming")
    parser.add_argument("--client", type=float, help=argparse.SUPPRESS)
    parser.add_argument("--busy", choices=("process", "thread"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.busy:
        busy_client(options.client, options.busy == "process")
        return
    if options.client is not None:
        client(options.client)
        return
    clock = clock_of(options)
    found = [
        measure_task("one frame", task, it, getattr(time, clock))
        for task, it in FRAME.items()
    ]
    if options.json:
        limits = [
            {"of": what, "limit": most, "found": it, "holds": it <= most}
            for what, most, it in rows(options)
        ]
        facts = [one.facts() for one in found]
        print(json.dumps({"clock": clock, "results": facts, "limits": limits}))
        return
    print("\n".join(table_lines(found)))
    for row in rows(options):
        print(f"  {limit_told(row)}, {row[2]:.3g}", flush=True)


if __name__ == "__main__":
    main()
