"""Looks as bundles: what was seen and measured, for other programs to read.

The facts say which things there are: `up`, `things` with a `box` and a `place` each,
`lens`, `time` and the `stamp` of the frame. The arrays are the frame, `colour` and
`depth`; of thing 1 its `mask1` within its box, its traits `trait1_NAME`, and the
features of its scans one after the other, `descriptors1`, `pixels1` and `points1`; the
facts of a thing say how many of these are of which scan.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, groupby, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kille.bus import Bundle
from kille.scene import (
    Box,
    Features,
    Frame,
    Intrinsics,
    Look,
    Mask,
    Percept,
    Point,
    Region,
    Traits,
)

Arrays = Mapping[str, NDArray[Any]]
Facts = Mapping[str, Any]

_FEATURES = ("descriptors", "pixels", "points")


def bundle_of(look: Look) -> Bundle:
    """The look, with everything measured that may be needed of it."""
    frame = frame_bundle(look.frame)
    numbered = list(enumerate(look.percepts, start=1))
    facts = {
        **frame.facts,
        "up": list(look.up),
        "things": [_facts_of(percept) for _, percept in numbered],
    }
    measured = [it for number, x in numbered for it in _arrays_of(number, x)]
    return Bundle(facts, {**frame.arrays, **dict(measured)})


def frame_bundle(frame: Frame) -> Bundle:
    """A frame by itself; what a simulation knows of it is left out."""
    lens = frame.intrinsics
    facts = {
        "time": frame.time,
        "lens": None if lens is None else [lens.fx, lens.fy, lens.cx, lens.cy],
    }
    arrays = {"colour": frame.colour}
    if frame.depth is None:
        return Bundle(facts, arrays)
    return Bundle(facts, {**arrays, "depth": frame.depth})


def frame_in(bundle: Bundle) -> Frame:
    """The frame in a bundle."""
    arrays, lens = bundle.arrays, bundle.facts["lens"]
    return Frame(
        arrays["colour"],
        arrays.get("depth"),
        None if lens is None else Intrinsics(*lens),
        bundle.facts["time"],
        {},
    )


def look_in(bundle: Bundle) -> Look:
    """The look in a bundle."""
    frame = frame_in(bundle)
    things = enumerate(bundle.facts["things"], start=1)
    percepts = tuple(_percept(n, told, bundle.arrays, frame) for n, told in things)
    right, down, forward = bundle.facts["up"]
    return Look(frame, percepts, (right, down, forward))


# --- pixels of a thing in a question -------------------------------------------------


def runs_of(mask: Mask) -> list[int]:
    """The mask row by row as lengths of runs, outside, inside, outside …

    >>> runs_of(np.array([[False, True], [True, False]]))
    [1, 2, 1]
    """
    pixels = mask.ravel().tolist()
    runs = [len(list(run)) for _, run in groupby(pixels)]
    return [0, *runs] if pixels and pixels[0] else runs


def mask_in(runs: Sequence[int], shape: Sequence[int]) -> Mask:
    """The mask that these runs are of; ValueError if they do not fill it.

    >>> mask_in([1, 2, 1], (2, 2))
    array([[False,  True],
           [ True, False]])
    """
    inside = np.arange(len(runs)) % 2 == 1
    return np.repeat(inside, runs).reshape(*shape)


# --- a thing -------------------------------------------------------------------------


def _facts_of(x: Percept) -> Facts:
    place = x.region.place
    return {
        "box": [int(edge) for edge in x.region.box],
        "place": None if place is None else [float(metres) for metres in place],
        "scans": [len(scan.descriptors) for scan in x.scans],
        "traits": list(x.traits),
    }


def _arrays_of(number: int, x: Percept) -> Iterator[tuple[str, NDArray[Any]]]:
    left, top, right, bottom = x.region.box
    yield f"mask{number}", x.region.mask[top:bottom, left:right]
    for kind in _FEATURES:
        parts = [getattr(scan, kind) for scan in x.scans]
        yield f"{kind}{number}", np.concatenate(parts)
    for name, vector in x.traits.items():
        yield f"trait{number}_{name}", vector


def _percept(number: int, told: Facts, arrays: Arrays, frame: Frame) -> Percept:
    box = Box(*told["box"])
    mask = np.zeros(frame.colour.shape[:2], np.bool_)
    mask[box.top : box.bottom, box.left : box.right] = arrays[f"mask{number}"]
    place = None if told["place"] is None else Point(*told["place"])
    borders = pairwise(accumulate(told["scans"], initial=0))
    parts = [arrays[f"{kind}{number}"] for kind in _FEATURES]
    scans = [Features(*(part[a:b] for part in parts)) for a, b in borders]
    traits: Traits = {name: arrays[f"trait{number}_{name}"] for name in told["traits"]}
    return Percept(Region(mask, box, place), scans, lambda: traits, frame)
