"""How long a frame is under way over ROS, from one process to another.

    python benchmarks/ros.py [--json]

A process sends colour and depth of 640x480, thirty times a second, over a ROS master
of its own; this one takes them. The time is from before a message is made until it has
been read. Without ROS there is nothing to measure.
"""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from statistics import median, quantiles
from tempfile import TemporaryDirectory

import numpy as np
from _measuring import Result, arguments, report

from kille.bus import Bus, BusError, Image, Topic
from kille.ros.bus import open_ros
from kille.ros.system_modules import ros
from kille.sensors.bus_sensor import COLOUR, DEPTH

SECONDS = 8
RATE = 30
WARMING = 30
"""So many frames are not counted."""

LIMIT = 3.0
"""Milliseconds that the median may be."""

TOPICS = {
    "colour": Topic(COLOUR, Image, waiting=5),
    "depth": Topic(DEPTH, Image, waiting=5),
}


def send() -> None:
    """Send frames for some seconds."""
    bus = open_ros("sender")
    chance = np.random.default_rng(0)
    pixels = {
        "colour": chance.integers(0, 255, (480, 640, 3), np.uint8),
        "depth": chance.random((480, 640), np.float32),
    }
    publishers = {name: bus.publisher(topic) for name, topic in TOPICS.items()}
    while not all(it.listeners for it in publishers.values()):
        time.sleep(0.01)
    due = time.monotonic()
    for _ in range(SECONDS * RATE):
        for name, publisher in publishers.items():
            publisher.publish(Image(pixels[name], time.time_ns()))
        due += 1 / RATE
        time.sleep(max(0.0, due - time.monotonic()))
    time.sleep(0.5)
    bus.close()


def frame_times(bus: Bus) -> dict[str, list[float]]:
    """The milliseconds that each frame took."""
    times: dict[str, list[float]] = {name: [] for name in TOPICS}
    for name, topic in TOPICS.items():
        took = times[name].append
        bus.subscribe(topic, lambda it, took=took: took(since(it)))  # type: ignore[misc]
    subprocess.run([sys.executable, __file__, "send"], check=True)
    return times


def since(image: Image) -> float:
    return (time.time_ns() - image.stamp) / 1e6


@contextmanager
def master() -> Iterator[None]:
    """A ROS master of one's own, for as long as it is needed."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with TemporaryDirectory() as home:
        uri = f"http://127.0.0.1:{port}"
        os.environ |= {"ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1", "ROS_HOME": home}
        core = subprocess.Popen(
            ["roscore", "-p", str(port)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            until_it_answers(port)
            yield
        finally:
            os.killpg(core.pid, signal.SIGTERM)
            core.wait(10)


def until_it_answers(port: int) -> None:
    for _ in range(200):
        try:
            socket.create_connection(("127.0.0.1", port), 1).close()
        except OSError:
            time.sleep(0.1)
        else:
            return


def measure_bus() -> Iterator[Result]:
    with master():
        bus = open_ros("receiver")
        for name, times in frame_times(bus).items():
            counted = times[WARMING:]
            for of, found, limits in (
                ("min", min(counted), ()),
                ("median", median(counted), (("median", LIMIT, median(counted)),)),
                ("p95", quantiles(counted, n=20)[-1], ()),
            ):
                yield Result("ros", f"{name}, {of}", {1: found}, limits)
            share = len(times) / (SECONDS * RATE)
            lost = (("lost", 0.0, 1 - share),)
            yield Result("ros", f"{name}, lost", {1: 1 - share}, lost)
        bus.close()


def main() -> None:
    if sys.argv[1:] == ["send"]:
        send()
        return
    options = arguments(__doc__).parse_args()
    try:
        ros("rospy")
    except BusError as error:
        print(f"not measured: {error}")
        return
    report(measure_bus(), options)


if __name__ == "__main__":
    main()
