"""A look: some consecutive frames, and the things that stay in view throughout.

Features are extracted when they are first asked for, so that a look takes no longer
than its segmentation; a thread goes on to the later frames while those of the first are
compared. While a camera's frames come there is nothing else to do: a
thread then segments the first of them, and measures the traits of the things in them,
the nearest first. In a still picture traits, too, are measured when they are asked for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cache, partial
from typing import NamedTuple, overload

import cv2
import numpy as np

from kille.perception.cues import measure_cues
from kille.perception.features import features_of
from kille.perception.pointing import region_at
from kille.perception.segment import SegmentedFrame, overlap, region_of, segment
from kille.scene import Box, Features, Frame, Look, Mask, Percept, Region, Traits
from kille.sensors.sensor import Sensor

SCANS = 10
"""How many consecutive frames the paper's robot looks at."""

Sighting = tuple[Frame, Region]

_SAME = 0.3  # overlap of a region with itself one frame later
_LASTING = 0.5  # of the frames a thing must be in, or it is a flicker
_HIDDEN = 0.5  # overlap with the pointed region: the same thing
_DOUBTED = 3  # frames that are taken apart in any case
_NOISE = 0.01  # metres at one metre: depth that differs by less is the same
_STILL = 0.9  # of the pixels: enough to be sure that a thing is where it was
_STRAY = 16  # pixels a thing may move in the picture between two frames


class Scans(Sequence[Features]):
    """The features of one thing in each frame, extracted when first asked for.

    In order they are extracted by a thread, the next while one is made use of.
    """

    def __init__(self, sightings: Sequence[Sighting]) -> None:
        self.sightings = tuple(sightings)
        self._begun: tuple[Future[Features], ...] = ()
        # No cycle of references, so that a look is freed as soon as it is dropped.
        self._extract_features = cache(partial(_extract_features, self.sightings))

    def begin(self) -> None:
        """Have a thread extract all scans, in order, if that has not begun."""
        if self._begun:
            return
        worker = ThreadPoolExecutor(1, "kille-scans")
        numbers = range(len(self))
        self._begun = tuple(worker.submit(self._extract_features, i) for i in numbers)
        worker.shutdown(wait=False)

    def __len__(self) -> int:
        return len(self.sightings)

    def __iter__(self) -> Iterator[Features]:
        self.begin()
        return (scan.result() for scan in self._begun)

    @overload
    def __getitem__(self, index: int) -> Features: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Features, ...]: ...

    def __getitem__(self, index: int | slice) -> Features | tuple[Features, ...]:
        if isinstance(index, slice):
            return tuple(self[i] for i in range(*index.indices(len(self))))
        if self._begun:
            return self._begun[index].result()
        return self._extract_features(range(len(self))[index])


def _extract_features(sightings: Sequence[Sighting], index: int) -> Features:
    return features_of(*sightings[index])


def look(
    sensor: Sensor,
    scans: int = SCANS,
    pointed: Sighting | Mask | tuple[int, int] | None = None,
) -> Look:
    """Look at the scene for so many frames.

    The percepts are the things that stay in view, nearest first. What the tutor points
    at comes before all others: a region of an earlier frame, the pixels of a mask
    (H, W), or whatever is at a pixel (u, v). A still picture is scanned once.
    ValueError for less than one scan; SensorError as the sensor raises it.
    """
    if scans < 1:
        raise ValueError(f"a look takes at least one scan, not {scans}")
    captured = _capture(sensor, scans)
    frames = captured.frames
    scenes = cache(captured.scene)
    first = scenes(0)
    tracks = [_track(region, frames, scenes) for region in first.regions]
    lasting = [track for track in tracks if len(track) >= _LASTING * len(frames)]
    focus = _focus(frames, pointed)
    others = [track for track in lasting if not _same_thing(focus, track)]
    percepts = tuple(_percept(track, captured.traits) for track in [*focus, *others])
    return Look(frames[0], percepts, first.up)


def _percept(
    track: Sequence[Sighting], traits: Mapping[Region, Future[Traits]]
) -> Percept:
    """The percept of a thing from its sightings, the first of which is measured."""
    frame, region = track[0]
    begun = traits.get(region)
    measure = partial(measure_cues, frame, region) if begun is None else begun.result
    return Percept(region, Scans(track), measure, frame)


class _Captured(NamedTuple):
    """The frames of a look, and what a thread makes out in the first ones."""

    frames: Sequence[Frame]
    scenes: Mapping[Frame, Future[SegmentedFrame]]
    traits: Mapping[Region, Future[Traits]]

    def scene(self, number: int) -> SegmentedFrame:
        """The scene in this frame, segmented here if the thread does not do it."""
        begun = self.scenes.get(self.frames[number])
        return segment(self.frames[number]) if begun is None else begun.result()


def _capture(sensor: Sensor, scans: int) -> _Captured:
    """Take so many frames, without repetitions of a still picture."""
    first, *second = (sensor.frame() for _ in range(min(scans, 2)))
    if not second or second[0].colour is first.colour:
        others = (sensor.frame() for _ in range(scans - 2))
        return _Captured(_distinct([first, *second, *others]), {}, {})
    worker = ThreadPoolExecutor(1, "kille-look")
    try:
        return _capture_with(worker, sensor, [first, *second], scans)
    except BaseException:
        worker.shutdown(wait=False, cancel_futures=True)
        raise
    finally:
        worker.shutdown(wait=False)


def _capture_with(
    worker: ThreadPoolExecutor, sensor: Sensor, frames: list[Frame], scans: int
) -> _Captured:
    """Take the frames that are missing; the worker goes on when they have come."""
    first = frames[0]
    scenes = {frame: worker.submit(segment, frame) for frame in frames}
    traits: dict[Region, Future[Traits]] = {}

    def begin_traits() -> None:
        for region in scenes[first].result().regions:
            traits[region] = worker.submit(measure_cues, first, region)

    for number in range(len(frames), scans):
        frames.append(frame := sensor.frame())
        if number < _DOUBTED:
            scenes[frame] = worker.submit(segment, frame)
        if not traits and scenes[first].done():
            begin_traits()
    if not traits:
        begin_traits()
    return _Captured(_distinct(frames), scenes, traits)


def _distinct(frames: Sequence[Frame]) -> list[Frame]:
    """The frames without repetitions of a still picture."""
    return list({id(frame.colour): frame for frame in reversed(frames)}.values())[::-1]


def _track(
    region: Region, frames: Sequence[Frame], scenes: Callable[[int], SegmentedFrame]
) -> list[Sighting]:
    """Follow a region through the later frames: its sightings, where it is found again.

    Later frames are taken apart if something has moved there; what stays where it is
    has not changed its outline either. The first few are, so that a flicker is found,
    and so are all where the region was not in most of these.
    """
    track = [(frames[0], region)]
    for number, frame in enumerate(frames[1:], start=1):
        before, last = track[-1]
        sure = number >= _DOUBTED and len(track) > _DOUBTED / 2
        if sure and _is_still(last, before, frame):
            track.append((frame, region_of(frame, last.mask)))
            continue
        found = scenes(number).regions
        again = max(found, key=lambda it: overlap(it, last), default=None)
        if again is not None and overlap(again, last) >= _SAME:
            track.append((frame, again))
    return track


def _is_still(region: Region, before: Frame, after: Frame) -> bool:
    """Is the depth under the region unchanged between two frames?"""
    left, top, right, bottom = region.box
    inside = region.mask[top:bottom, left:right]
    window = np.s_[top:bottom, left:right]
    if before.depth is None or after.depth is None:
        return False
    if not before.depth.shape == after.depth.shape == region.mask.shape:
        return False
    z, z2 = before.depth[window][inside], after.depth[window][inside]
    return bool(np.mean(np.abs(z - z2) < _NOISE * z**2) > _STILL)


def _focus(
    frames: Sequence[Frame], pointed: Sighting | Mask | tuple[int, int] | None
) -> list[list[Sighting]]:
    """The track of the thing that the tutor points at, or no track."""
    match pointed:
        case None:
            return []
        case (Frame() as earlier, Region() as region):
            return [_follow(region, [earlier, *frames])[1:]]
        case (int(u), int(v)):
            found = region_at(frames[0], (u, v))
        case mask:
            found = region_of(frames[0], mask) if mask.any() else None
    return [] if found is None else [_follow(found, frames)]


def _follow(region: Region, frames: Sequence[Frame]) -> list[Sighting]:
    """Follow a region from frame to frame by matching its picture."""
    track = [(frames[0], region)]
    for frame in frames[1:]:
        last_frame, last = track[-1]
        right, down = _motion(last_frame, frame, last.box)
        track.append((frame, region_of(frame, _shift_mask(last.mask, right, down))))
    return track


def _motion(before: Frame, after: Frame, box: Box) -> tuple[int, int]:
    """How many pixels right and down the content of the box has moved."""
    height, width = after.colour.shape[:2]
    left, top = max(0, box.left - _STRAY), max(0, box.top - _STRAY)
    right, bottom = min(width, box.right + _STRAY), min(height, box.bottom + _STRAY)
    pattern = before.colour[box.top : box.bottom, box.left : box.right]
    match = cv2.matchTemplate(
        cv2.cvtColor(after.colour[top:bottom, left:right], cv2.COLOR_RGB2GRAY),
        cv2.cvtColor(pattern, cv2.COLOR_RGB2GRAY),
        cv2.TM_SQDIFF,
    )
    _, _, (x, y), _ = cv2.minMaxLoc(match)
    return left + x - box.left, top + y - box.top


def _shift_mask(mask: Mask, right: int, down: int) -> Mask:
    by = np.array([[1, 0, right], [0, 1, down]], np.float32)
    moved = cv2.warpAffine(mask.astype(np.uint8), by, mask.shape[::-1], flags=0)
    return moved > 0


def _same_thing(focus: Sequence[Sequence[Sighting]], track: Sequence[Sighting]) -> bool:
    return any(overlap(it[0][1], track[0][1]) >= _HIDDEN for it in focus)
