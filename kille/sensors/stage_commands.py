"""Changes of the scene, written as a person types them: `place book left of car`."""

from __future__ import annotations

import math
import re

from kille.sensors.sensor import (
    At,
    Beside,
    Seekable,
    Sensor,
    SensorError,
    Stage,
)

RELATIONS = {
    "to the left of": "left of",
    "on the left of": "left of",
    "left of": "left of",
    "to the right of": "right of",
    "on the right of": "right of",
    "right of": "right of",
    "in front of": "in front of",
    "behind": "behind",
    "next to": "near",
    "close to": "near",
    "near": "near",
}
"""The phrases for a spot beside a landmark, and what each comes to."""

_SPOT = re.compile(r"(.+?) at (\S+?),? +(\S+?)(?: +turned +(\S+))?")
_BESIDE = re.compile(rf"(.+?) ({'|'.join(RELATIONS)}) (.+)", re.IGNORECASE)
_HELP = (
    "`show cup`, `place book left of car`, `place book at 0.10 -0.05`, "
    "`place book at 0.10 -0.05 turned 45` or `remove cup`"
)


def perform(sensor: Sensor, command: str) -> None:
    """Change the sensor's scene as the command says.

    Commands: `show NAME`, `remove NAME`, `place NAME at RIGHT AWAY [turned DEGREES]` in
    metres from the table's middle, `place NAME RELATION LANDMARK`; in a recording
    `seek SECONDS`, counted from its first frame.
    Raises SensorError when the sensor is no stage, and for a command that is not
    understood; the scene is then as it was.
    """
    verb, _, rest = " ".join(command.split()).partition(" ")
    if verb.lower() == "seek":
        _seek(sensor, rest)
        return
    if not isinstance(sensor, Stage):
        raise SensorError(
            f"{sensor.name} cannot be rearranged: use `synthetic` or a folder of "
            "sorted pictures"
        )
    if verb.lower() not in ("show", "place", "remove"):
        raise SensorError(f"unknown command `{command.strip()}`: write {_HELP}")
    if not rest:
        raise SensorError(f"`{command.strip()}` names no object: write {_HELP}")
    match verb.lower():
        case "show":
            sensor.show(rest)
        case "remove":
            sensor.remove(rest)
        case _:
            name, spot = _placement(rest)
            sensor.place(name, spot)


def _seek(sensor: Sensor, seconds: str) -> None:
    if not isinstance(sensor, Seekable):
        raise SensorError(f"{sensor.name} is no recording in which one can `seek`")
    try:
        moment = float(seconds)
    except ValueError:
        moment = math.nan
    if not 0 <= moment <= sensor.length:
        raise SensorError(
            f"`seek {seconds[:40]}`: write seconds from 0 to {sensor.length:.2f}"
        )
    sensor.seek(moment)


def _placement(text: str) -> tuple[str, At | Beside]:
    """What is to be placed, and where."""
    if found := _SPOT.fullmatch(text):
        name, right, away, turn = found.groups()
        return name, At(_number(right), _number(away), _number(turn or "0"))
    if found := _BESIDE.fullmatch(text):
        name, relation, landmark = found.groups()
        return name, Beside(relation.lower(), landmark)
    raise SensorError(f"`place {text}` does not say where: write {_HELP}")


def _number(text: str) -> float:
    """A finite number, or an error that shows what stands in its place."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise SensorError(
            f"`{text}` is not a number: write metres right and away, then degrees, "
            "such as `place book at 0.10 -0.05 turned 45`"
        )
    return number
