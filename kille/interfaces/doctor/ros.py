"""Whether ROS is there, and its master."""

from __future__ import annotations

from collections.abc import Iterator

from kille.bus import BusError
from kille.interfaces.doctor.finding import Finding
from kille.ros.bus import reach_master
from kille.ros.finding import REMEDY, place_of

__all__ = ["ros"]

_PATIENCE = 0.2


def ros() -> Iterator[Finding]:
    """What `kille ros` and sensors of ROS need."""
    for module in ("rospy", "sensor_msgs"):
        if place_of(module) is None:
            yield Finding("ROS 1", False, False, f"{module} is not installed", REMEDY)
            return
    yield Finding("ROS 1", True, False, f"rospy in {place_of('rospy')}")
    try:
        yield Finding(
            "ROS master", True, False, f"answers at {reach_master(_PATIENCE)}"
        )
    except BusError as error:
        state, _, remedy = str(error).partition(": ")
        yield Finding("ROS master", False, False, state, remedy)
