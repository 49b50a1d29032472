"""Our driver on the real USB stack, inside the virtual machine of real_kernel.py."""

from __future__ import annotations

import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from kille.sensors.kinect.registration import register_depth
from kille.sensors.kinect.sensor import KinectSensor
from kille.sensors.sources import open_sensor
from kinect_emulator import netpbm
from kinect_emulator.pictures import patterns

SECONDS, CAPTURES, LEFT = 10, 12, 4


def pumped(sensor: KinectSensor) -> str:
    """Whole frames put together while nobody asks for one."""
    sensor.capture()
    before = {name: it.frames for name, it in sensor.counts.items()}
    begun, spent = time.monotonic(), time.process_time()
    time.sleep(SECONDS)
    seconds = time.monotonic() - begun
    core = (time.process_time() - spent) / seconds
    told = (
        f"{(it.frames - before[name]) / seconds:.1f} frames/s of {name}, {it.lost} lost"
        for name, it in sensor.counts.items()
    )
    return f"{'; '.join(told)}; {core:.0%} of an emulated core"


def captured(sensor: KinectSensor) -> str:
    """Whether captures are what is shown, to the last bit of depth."""
    shown = [view.depth for view in patterns().views]
    depths = [sensor.capture().depth for _ in range(CAPTURES)]
    right = sum(any(np.array_equal(it, view) for view in shown) for it in depths)
    return f"{right} of {CAPTURES} captures as shown"


def same_as_regtest(sensor: KinectSensor) -> str:
    """Whether libfreenect registers as we do: on its own raw picture of one view."""
    theirs = {
        name: netpbm.depth(Path(f"registration_test_depth_{name}.pgm"))
        for name in ("registered", "raw")
    }
    views = [view.depth for view in patterns().views]
    ours = [register_depth(view, sensor.calibration) for view in views]
    raw = any(np.array_equal(theirs["raw"], view) for view in views)
    equal = any(np.array_equal(theirs["registered"], it) for it in ours)
    return f"raw equal: {raw}, registered equal: {equal}"


def replugged(sensor: KinectSensor) -> str:
    """Detach and attach the camera while it streams: how soon frames go on."""
    ports = subprocess.run(["usbip", "port"], capture_output=True, text=True).stdout
    port = re.findall(r"Port (\d+):", ports.split("/1-1.3")[0])[-1]
    subprocess.run(["usbip", "detach", "-p", port], check=True, capture_output=True)
    time.sleep(0.5)
    attach = ["usbip", "attach", "-r", "127.0.0.1", "-b", "1-1.3"]
    subprocess.run(attach, check=True)
    attached = time.monotonic()
    # What came before may still be given: no more than a few.
    for _ in range(LEFT + 1):
        sensor.capture()
    return f"frames go on {time.monotonic() - attached:.1f} s after plugging in again"


def main() -> None:
    """Print one line for each."""
    subprocess.run(["freenect-regtest"], check=True, capture_output=True)
    begun = time.monotonic()
    sensor = open_sensor("kinect")
    print(f"our driver: opened in {time.monotonic() - begun:.1f} s", flush=True)
    assert isinstance(sensor, KinectSensor)
    try:
        for part in (pumped, captured, same_as_regtest, replugged):
            print(f"our driver: {part(sensor)}", flush=True)
    finally:
        sensor.close()


if __name__ == "__main__":
    sys.exit(main())
