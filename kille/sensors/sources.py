"""Opening a sensor by its name, as users write it: `synthetic`, `kinect` or a path."""

from __future__ import annotations

import re

from kille.sensors.sensor import Sensor, SensorError


def open_sensor(name: str) -> Sensor:
    """The sensor of that name, opened.

    `synthetic` and `synthetic:SCENE?seed=7` are the simulated Kinect; anything else is
    the path of a recording, see `kille.sensors.recordings`. SensorError if there is no
    such source or it cannot be opened.
    """
    if not name.strip():
        raise SensorError(
            "no sensor named; give `synthetic` or the path of a recording"
        )
    match re.split(r"[:?]", name, maxsplit=1)[0]:
        case "synthetic":
            # Rendering is imported only by those who ask for it: starting stays quick.
            from kille.sensors.synthetic import open_synthetic

            return open_synthetic(name)
        case "kinect" | "ros" as kind:
            raise SensorError(
                f"{name}: the {_DRIVERS[kind]} is not part of this version yet; "
                "use `synthetic` or the path of a recording"
            )
        case _:
            from kille.sensors.recordings import open_recording

            return open_recording(name)


_DRIVERS = {"kinect": "Kinect driver", "ros": "ROS bridge"}
