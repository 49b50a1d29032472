"""The table as it is arranged by hand: its plan, its catalogue, or its recording."""

from __future__ import annotations

from math import hypot
from typing import Any

from kille.agent.agent import Agent
from kille.sensors.sensor import PlannedStage, Seekable, Sensor, SensorError, Stage

Json = dict[str, Any]

_STEP = 0.1
"""Metres between the spots at which a thing is tried."""

_DIGITS = 4


def table_report(sensor: Sensor) -> Json:
    """What the page can do about the scene.

    `things` are the names of all that can be shown; `plan` is the table from above, in
    metres, where that is known; `recording` is its length and where it is, in seconds.
    """
    return {
        "things": list(sensor.things()) if isinstance(sensor, Stage) else [],
        "plan": _plan_report(sensor) if isinstance(sensor, PlannedStage) else None,
        "recording": _recording_report(sensor),
    }


def _plan_report(sensor: PlannedStage) -> Json:
    plan = sensor.plan()
    return {
        "table": list(plan.table),
        "placed": [
            {
                "name": it.name,
                "right": round(it.spot.right, _DIGITS),
                "away": round(it.spot.away, _DIGITS),
                "turn": round(it.spot.turn, 1) % 360,
                "outline": [[round(c, _DIGITS) for c in at] for at in it.outline],
            }
            for it in plan.placed
        ],
    }


def _recording_report(sensor: Sensor) -> Json | None:
    if not isinstance(sensor, Seekable):
        return None
    return {"length": round(sensor.length, 2), "at": round(sensor.position, 2)}


def add_thing(robot: Agent, name: str) -> str:
    """Put a thing where there is room for it, as near to the table's middle as can be.

    Raises SensorError where there is none.
    """
    sensor = robot.gaze.sensor
    if not isinstance(sensor, PlannedStage):
        return robot.do(f"show {name}")
    left, near, right, far = sensor.plan().table
    across = range(round((right - left) / _STEP) + 1)
    away = range(round((far - near) / _STEP) + 1)
    spots = [(left + i * _STEP, near + j * _STEP) for i in across for j in away]
    for x, y in sorted(spots, key=lambda it: hypot(*it)):
        try:
            return robot.do(f"place {name} at {x:.3f} {y:.3f}")
        except SensorError:
            continue
    raise SensorError(f"there is no room for the {name}: take something away first")
