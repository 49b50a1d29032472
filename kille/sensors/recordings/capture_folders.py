"""Writing capture folders: a colour, a depth and a label picture for each frame."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from kille.scene import Frame, Mask
from kille.sensors.pictures import depth_picture, write_colour, write_picture
from kille.sensors.sensor import SensorError

UNITS_PER_METRE = 5000
"""Of the depth that is written: exact for whole millimetres, up to 13.1 m."""


def write_captures(folder: Path, frames: Iterable[Frame]) -> None:
    """Write a recording, with its outlines as labels, into this new folder.

    Depth is rounded to 0.2 mm. OSError if it cannot be written; SensorError if it has
    no depth.
    """
    folder.mkdir()
    things: dict[str, list[Mapping[str, Any]]] = {}
    times: dict[str, float] = {}
    lens = None
    for number, frame in enumerate(frames):
        if frame.depth is None or frame.intrinsics is None:
            raise SensorError(
                "captures have depth, and this recording has none; convert it to TUM, "
                "a bag or npz"
            )
        name, lens = f"{number:06}", frame.intrinsics
        write_colour(folder / f"{name}_color.png", frame.colour)
        units = depth_picture(frame.depth, UNITS_PER_METRE)
        write_picture(folder / f"{name}_depth.png", units)
        times[name] = frame.time
        things[name] = _write_labels(folder / f"{name}_label.png", frame.outlines)
    assert lens is not None, "a recording has frames"
    described = {
        "intrinsics": {"fx": lens.fx, "fy": lens.fy, "cx": lens.cx, "cy": lens.cy},
        "depth_units_per_metre": UNITS_PER_METRE,
        "times": times,
        "frames": things,
    }
    (folder / "scene.json").write_text(json.dumps(described, indent=1) + "\n")


def _write_labels(path: Path, outlines: Mapping[str, Mask]) -> list[Mapping[str, Any]]:
    """Write the outlines as whole numbers, if there are any; what each number names."""
    if not outlines:
        return []
    labels = np.zeros(next(iter(outlines.values())).shape, np.uint16)
    for number, mask in enumerate(outlines.values(), start=1):
        labels[mask] = number
    write_picture(path, labels)
    return [
        {"label": number, "name": name} for number, name in enumerate(outlines, start=1)
    ]
