"""Whether ROS is there, and its master."""

from __future__ import annotations

from collections.abc import Iterator

from kille.interfaces.doctor.finding import Finding, failed

_PATIENCE = 1.0
"""Seconds for a master that is on another machine."""


def ros() -> Iterator[Finding]:
    """What `kille ros` and sensors of ROS need."""
    from kille.bus import BusError
    from kille.ros.bus import reach_master
    from kille.ros.modules import REMEDY, place_of

    for module in ("rospy", "sensor_msgs"):
        if place_of(module) is None:
            yield Finding("ROS 1", False, False, f"{module} is not installed", REMEDY)
            return
    yield Finding("ROS 1", True, False, f"rospy in {place_of('rospy')}")
    try:
        address = reach_master(_PATIENCE)
    except BusError as error:
        yield failed("ROS master", False, error)
    else:
        yield Finding("ROS master", True, False, f"answers at {address}")
