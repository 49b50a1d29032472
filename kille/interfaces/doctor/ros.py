"""Check whether ROS and its master are there."""

from __future__ import annotations

from collections.abc import Iterator

from kille.interfaces.doctor.findings import DoctorFinding, failed_part

_PATIENCE = 1.0
"""Seconds to wait for a master, which may be on another machine."""


def ros() -> Iterator[DoctorFinding]:
    """The requirements of `kille ros` and of ROS sensors."""
    from kille.bus import BusError
    from kille.ros.bus import reach_master
    from kille.ros.system_modules import REMEDY, place_of

    for module in ("rospy", "sensor_msgs"):
        if place_of(module) is None:
            yield DoctorFinding(
                "ROS 1", False, False, f"{module} is not installed", REMEDY
            )
            return
    yield DoctorFinding("ROS 1", True, False, f"rospy in {place_of('rospy')}")
    try:
        address = reach_master(_PATIENCE)
    except BusError as error:
        yield failed_part("ROS master", False, error)
    else:
        yield DoctorFinding("ROS master", True, False, f"answers at {address}")
