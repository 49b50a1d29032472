"""How long a frame of the synthetic Kinect takes, on one thread.

python benchmarks/synthetic.py [--json] [--frames N]
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable
from functools import partial

import cv2

from kille.sensors.synthetic import catalogue, open_synthetic
from kille.sensors.synthetic.posed_camera import SimulatedCamera
from kille.sensors.synthetic.render import render_scene
from kille.sensors.synthetic.room import room

SCENES = ("empty", "desk", "all")


def median_ms(work: Callable[[], object], times: int) -> float:
    """The median time of a piece of work, in milliseconds, after one run to warm up."""
    work()
    taken = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        taken.append(1000 * (time.perf_counter() - start))
    return statistics.median(taken)


def once_ms(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return 1000 * (time.perf_counter() - start)


def measure_frames(frames: int) -> dict[str, float]:
    """Every number of the table, name -> milliseconds.

    A faulty frame of a changed scene is the sum of its drawing and its degrading.
    """
    result = {
        "ten models, read once": once_ms(
            lambda: [catalogue.toy_model(name) for name in catalogue.TOY_NAMES]
        ),
        "the room, painted once": once_ms(lambda: room(SimulatedCamera())),
    }
    for scene in SCENES:
        clean = open_synthetic(f"synthetic:{scene}?faults=none")
        faulty = open_synthetic(f"synthetic:{scene}")
        drawn = median_ms(partial(render_scene, clean.camera, clean.bodies), frames)
        still = median_ms(faulty.frame, frames)
        result[f"{scene}: clean frame, scene changed"] = drawn
        result[f"{scene}: clean frame, scene as before"] = median_ms(
            clean.frame, frames
        )
        result[f"{scene}: faulty frame, scene as before"] = still
        result[f"{scene}: faulty frame, scene changed"] = drawn + still
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--frames", type=int, default=40, help="frames a number")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    result = measure_frames(options.frames)
    if options.json:
        print(json.dumps(result, indent=2))
        return
    width = max(map(len, result))
    for name, milliseconds in result.items():
        print(f"{name:{width}}  {milliseconds:8.2f} ms")


if __name__ == "__main__":
    main()
