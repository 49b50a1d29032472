"""Colour and depth captures on disk: which files belong together and what they mean.

A capture folder holds `NAME_color.png`, `NAME_depth.png` (16 bits, 0 = no reading),
where it is labelled `NAME_label.png`, and one description in JSON with `intrinsics`
(fx, fy, cx, cy in pixels) and `depth_units_per_metre`. In `scene.json` the description
has `frames`: the captures follow each other in time, at the seconds that `times` has by
name, or else thirty a second. Any other description is of separate scenes, each a still
of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import count, pairwise
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from kille.scene import Frame, Intrinsics, Mask
from kille.sensors.pictures import read_colour, read_depth, read_labels
from kille.sensors.sensor import SensorError
from ttr.safety.inputs import parse_json, read_text
from ttr.safety.limits import TABLE

DESCRIPTIONS = ("scene.json", "index.json", "boxes.json")
_COLOUR = "_color.png"

RATE = 30.0
"""Frames a second, where a recording does not say when its frames were taken."""


@dataclass(frozen=True)
class Geometry:
    """How a camera measures: its pinhole model and the unit of its depth pictures."""

    intrinsics: Intrinsics
    units_per_metre: float


@dataclass(frozen=True, eq=False)
class Shot:
    """One moment of a recording: its files, and what the numbers in them stand for."""

    name: str
    colour: Path
    depth: Path | None = None
    labels: Path | None = None
    geometry: Geometry | None = None
    things: Mapping[int, str] = field(default_factory=dict)
    time: float = 0.0

    def read(self) -> Frame:
        """The frame; SensorError if a file is missing, damaged or misfits."""
        colour = read_colour(self.colour)
        if self.depth is None or self.geometry is None:
            return Frame(colour, None, None, self.time, {})
        depth = read_depth(self.depth, self.geometry.units_per_metre)
        _same_size(self.depth, depth.shape, self.colour, colour.shape)
        outlines = self._outlines(colour.shape)
        return Frame(colour, depth, self.geometry.intrinsics, self.time, outlines)

    def _outlines(self, shape: tuple[int, ...]) -> dict[str, Mask]:
        if self.labels is None:
            return {}
        labels = read_labels(self.labels)
        _same_size(self.labels, labels.shape, self.colour, shape)
        masks = {name: labels == label for label, name in self.things.items()}
        return {name: mask for name, mask in masks.items() if np.any(mask)}


def description_of(folder: Path) -> Path | None:
    """The file that describes the captures in this folder, if there is one."""
    if not any(folder.glob(f"*{_COLOUR}")):
        return None
    present = (folder / name for name in DESCRIPTIONS)
    return next((path for path in present if path.is_file()), None)


def is_sequence(description: Path) -> bool:
    """Whether the captures follow each other in time; SensorError if it is broken."""
    return "frames" in _load(description)


def read_sequence(description: Path) -> tuple[Shot, ...]:
    """The captures of one scene in order of time; SensorError if it is broken."""
    content = _load(description)
    geometry = _geometry(description, content)
    frames = _required_entry(description, content, "frames", dict)
    names = sorted(frames)
    times = _times(description, content, names)
    shots = (_shot(description, name, geometry, frames[name]) for name in names)
    return tuple(replace(shot, time=times[shot.name]) for shot in shots)


def _times(
    description: Path, content: Mapping[str, Any], names: Iterable[str]
) -> Mapping[str, float]:
    """When each was taken, in seconds; evenly, if the description does not say."""
    if "times" not in content:
        return {name: number / RATE for number, name in enumerate(names)}
    told = content["times"]
    try:
        times = {name: float(told[name]) for name in names}
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise SensorError(
            f"{description}: `times` needs the seconds of each of `frames` by name"
        ) from error
    row = list(times.values())
    if not all(map(isfinite, row)) or any(a >= b for a, b in pairwise(row)):
        raise SensorError(f"{description}: `times` must rise from frame to frame")
    return times


def read_scenes(description: Path) -> tuple[Shot, ...]:
    """The separate scenes in order of name; SensorError if the file is broken."""
    content = _load(description)
    geometry = _geometry(description, content)
    scenes = content.get("scenes", {})
    if not isinstance(scenes, dict) or not all(
        isinstance(it, dict) for it in scenes.values()
    ):
        raise SensorError(f"{description}: `scenes` is an object of objects by name")
    names = sorted(
        path.name.removesuffix(_COLOUR)
        for path in description.parent.glob(f"*{_COLOUR}")
    )
    return tuple(
        _shot(description, name, geometry, scenes.get(name, {}).get("objects", []))
        for name in names
    )


def _shot(
    description: Path, name: str, geometry: Geometry, objects: Iterable[Any]
) -> Shot:
    folder = description.parent
    labels = folder / f"{name}_label.png"
    try:
        things = {int(it["label"]): _spoken_name(it) for it in objects}
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise SensorError(
            f"{description}: each object of {name} needs a whole number as `label`"
        ) from error
    return Shot(
        name=name,
        colour=folder / f"{name}{_COLOUR}",
        depth=folder / f"{name}_depth.png",
        labels=labels if labels.is_file() else None,
        geometry=geometry,
        things=_distinct_names(things),
    )


def _spoken_name(thing: Mapping[str, Any]) -> str:
    """`006_mustard_bottle` as people say it; a thing without a name by its number."""
    words = str(thing.get("name", f"object_{thing['label']}")).split("_")
    return " ".join(words[1:] if words[0].isdigit() and len(words) > 1 else words)


def _distinct_names(things: Mapping[int, str]) -> dict[int, str]:
    """The same names, the second thing of a name numbered, so that none is lost."""
    taken = set(things.values())
    first: set[str] = set()
    distinct = {}
    for label, name in things.items():
        numbered = (f"{name} {number}" for number in count(2))
        own = next(it for it in numbered if it not in taken) if name in first else name
        first.add(own)
        taken.add(own)
        distinct[label] = own
    return distinct


def _geometry(description: Path, content: Mapping[str, Any]) -> Geometry:
    lens = _required_entry(description, content, "intrinsics", dict)
    units = _required_entry(description, content, "depth_units_per_metre", (int, float))
    try:
        units = float(units)
        pinhole = Intrinsics(*(float(lens[key]) for key in ("fx", "fy", "cx", "cy")))
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise SensorError(
            f"{description}: `intrinsics` needs the numbers fx, fy, cx and cy"
        ) from error
    numbers = (pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy, units)
    if min(pinhole.fx, pinhole.fy, units) <= 0 or not all(map(isfinite, numbers)):
        raise SensorError(
            f"{description}: fx, fy and depth_units_per_metre must be above 0, "
            "cx and cy finite"
        )
    return Geometry(pinhole, units)


def _load(description: Path) -> Mapping[str, Any]:
    try:
        content = parse_json(read_text(description, TABLE))
    except OSError as error:
        raise SensorError(
            f"{description}: cannot be read ({error.strerror})"
        ) from error
    except ValueError as error:
        raise SensorError(f"{description}: is not JSON ({error})") from error
    if not isinstance(content, dict):
        raise SensorError(f"{description}: expected an object {{…}} at the top")
    return content


def _required_entry(
    description: Path,
    content: Mapping[str, Any],
    key: str,
    kind: type | tuple[type, ...],
) -> Any:
    value = content.get(key)
    if isinstance(value, kind) and value:
        return value
    found = "is missing" if key not in content else "is not what it should be"
    raise SensorError(
        f"{description}: `{key}` {found}; it is needed to read the captures"
    )


def _same_size(
    other: Path,
    other_shape: tuple[int, ...],
    colour: Path,
    colour_shape: tuple[int, ...],
) -> None:
    if other_shape == colour_shape[:2]:
        return
    raise SensorError(
        f"{other}: is {_size(other_shape)} but {colour.name} is {_size(colour_shape)}; "
        "depth and labels must be registered to colour"
    )


def _size(shape: tuple[int, ...]) -> str:
    return f"{shape[1]}x{shape[0]}"
