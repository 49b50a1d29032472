"""How a recording is to be played: `PATH?speed=1&loop=no&start=3.5`."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, fields
from pathlib import Path

from kille.scene import Intrinsics
from kille.sensors.recordings.lenses import lens_from
from kille.sensors.recordings.name_suggestions import suggest_name
from kille.sensors.sensor import SensorError


@dataclass(frozen=True)
class Options:
    """What may follow the path of a recording.

    `speed` None gives each frame when it is asked for, 1 as fast as it was recorded.
    `start` in seconds. `intrinsics` and the topics are for recordings that do not say
    them, or have several.
    """

    speed: float | None = None
    loop: bool = True
    start: float = 0.0
    intrinsics: Intrinsics | None = None
    colour: str | None = None
    depth: str | None = None


KNOWN = tuple(field.name for field in fields(Options))


def split_options(name: str) -> tuple[Path, Options]:
    """The path in a source's name, and the options after its question mark.

    A path that exists is taken as it is, even with a question mark. SensorError for an
    option or value that is not understood.

    >>> path, options = split_options("tests/desk?speed=2&loop=no")
    >>> path.name, options.speed, options.loop, options.start
    ('desk', 2.0, False, 0.0)
    """
    whole = _expand_user(name)
    path, mark, query = name.rpartition("?")
    if not mark or whole.exists():
        return whole, Options()
    given = dict(_option(name, text) for text in query.split("&") if text)
    options = Options(
        speed=_speed(name, given["speed"]) if "speed" in given else None,
        loop=_whether(name, given.get("loop", "yes")),
        start=_start(name, given.get("start", "0")),
        intrinsics=_lens(name, given["intrinsics"]) if "intrinsics" in given else None,
        colour=given.get("colour"),
        depth=given.get("depth"),
    )
    return _expand_user(path), options


def _expand_user(name: str) -> Path:
    """The path, where `~` is the user's own folder, and `~nobody` is only a name."""
    return Path(os.path.expanduser(name))


def _option(name: str, text: str) -> tuple[str, str]:
    key, equals, value = text.partition("=")
    if key not in KNOWN:
        near = suggest_name(key, KNOWN) or f"; there are {', '.join(KNOWN)}"
        raise SensorError(f"{name}: there is no option {key}{near}")
    if not equals or not value:
        raise SensorError(f"{name}: option {key} has no value: write {key}=...")
    return key, value


def _speed(name: str, text: str) -> float:
    speed = _number(text)
    if speed <= 0 or not math.isfinite(speed):
        raise SensorError(
            f"{name}: speed={text}: a speed is a number above 0, 1 as it was recorded"
        )
    return speed


def _start(name: str, text: str) -> float:
    start = _number(text)
    if start < 0 or not math.isfinite(start):
        raise SensorError(
            f"{name}: start={text}: it starts at a number of seconds from 0"
        )
    return start


def _whether(name: str, text: str) -> bool:
    if text not in ("yes", "no"):
        raise SensorError(f"{name}: loop={text}: write loop=yes or loop=no")
    return text == "yes"


def _lens(name: str, text: str) -> Intrinsics:
    lens = lens_from([_number(part) for part in text.split(",")])
    if lens is None:
        raise SensorError(
            f"{name}: intrinsics={text}: write fx,fy,cx,cy in pixels, "
            "such as intrinsics=525,525,319.5,239.5"
        )
    return lens


def _number(text: str) -> float:
    """The number, or nan, which fits nowhere."""
    try:
        return float(text)
    except ValueError:
        return math.nan
