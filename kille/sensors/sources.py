"""Opening a sensor by its name, as users write it: `synthetic`, `kinect` or a path."""

from __future__ import annotations

import re

from kille.sensors.sensor import Sensor, SensorError


def open_sensor(name: str) -> Sensor:
    """The sensor of that name, opened.

    `synthetic` and `synthetic:SCENE?seed=7` are the simulated Kinect, `kinect` and
    `kinect:SERIAL` a real one, `ros:TOPIC` is a camera of ROS; anything else is the
    path of a recording, see `kille.sensors.recordings`. SensorError if there is no
    such source or it cannot be opened.
    """
    if not name.strip():
        raise SensorError(
            "no sensor named; give `synthetic`, `kinect` or the path of a recording"
        )
    match re.split(r"[:?]", name, maxsplit=1)[0]:
        case "synthetic":
            # Rendering is imported only by those who ask for it: starting stays quick.
            from kille.sensors.synthetic import open_synthetic

            return open_synthetic(name)
        case "ros":
            from kille.sensors.ros import open_ros_sensor

            return open_ros_sensor(name)
        case "kinect":
            from kille.sensors.kinect import open_kinect

            return open_kinect(name)
        case _:
            from kille.sensors.recordings import open_recording

            return open_recording(name)
