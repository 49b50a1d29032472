"""A sensor whose frames come over a bus: colour, depth and calibration."""

from __future__ import annotations

import time
from collections import deque
from dataclasses import dataclass
from threading import Condition
from typing import NamedTuple

import numpy as np

from kille.bus import Bus, Camera, Image, Subscription, Topic
from kille.scene import Colour, Depth, Frame, Intrinsics
from kille.sensors.pictures import clean_depth
from kille.sensors.sensor import SensorError

COLOUR = "camera/rgb/image_color"
DEPTH = "camera/depth_registered/image"
CAMERA = "camera/rgb/camera_info"
"""The topics of usual camera drivers."""

_TOGETHER = 16_000_000
"""Nanoseconds between two pictures of one moment, at most: half a frame."""

_KEPT = 8
"""So many pictures wait for those that belong to them."""

_WAITING = 5

_ANY_TIME = -1
"""A moment before all others: drivers without a clock stamp their pictures with 0."""


@dataclass(frozen=True)
class Feed:
    """The topics that frames come by; there need not be any depth.

    Depth must be registered to colour.
    """

    colour: Topic[Image]
    camera: Topic[Camera]
    depth: Topic[Image] | None = None

    @classmethod
    def of_topics(cls, colour: str, camera: str, depth: str = "") -> Feed:
        """The feed of these topics.

        >>> Feed.of_topics("a/image", "a/camera_info").depth is None
        True
        """
        return cls(
            Topic(colour, Image, _WAITING),
            Topic(camera, Camera, _WAITING, latched=True),
            Topic(depth, Image, _WAITING) if depth else None,
        )


class _Pair(NamedTuple):
    """Two pictures of one moment, or colour alone."""

    colour: Image
    depth: Image | None


class Stream:
    """A sensor whose frames come over a bus.

    `frame` gives a picture that comes after the call; earlier ones do not count. It
    waits at most `patience` seconds.
    """

    def __init__(self, bus: Bus, feed: Feed, name: str, patience: float = 5.0) -> None:
        self._name, self._feed, self._patience = name, feed, patience
        self._changed = Condition()
        self._colours: deque[Image] = deque(maxlen=_KEPT)
        self._depths: deque[Image] = deque(maxlen=_KEPT)
        self._camera: Camera | None = None
        self._came = 0
        self._latest: _Pair | None = None
        self._open: list[Subscription] = [
            bus.subscribe(feed.camera, self._take_calibration),
            bus.subscribe(feed.colour, self._take_colour),
        ]
        if feed.depth is not None:
            self._open.append(bus.subscribe(feed.depth, self._take_depth))

    @property
    def name(self) -> str:
        """The source as a user writes it."""
        return self._name

    def frame(self) -> Frame:
        """The next frame; SensorError if none comes, or none that can be used."""
        return self.frame_after(_ANY_TIME)

    def frame_after(self, stamp: int) -> Frame:
        """The next frame that was taken after that moment, in nanoseconds."""
        end = time.monotonic() + self._patience
        with self._changed:
            came = self._came
            self._changed.wait_for(
                lambda: self._came > came and self._is_after(stamp),
                timeout=end - time.monotonic(),
            )
            if self._latest is None or self._came == came or not self._is_after(stamp):
                raise SensorError(self._silence())
            pair = self._latest
            if pair.depth is not None:
                self._changed.wait_for(
                    lambda: self._camera is not None, timeout=end - time.monotonic()
                )
            return self._make_frame(pair, self._camera)

    def close(self) -> None:
        """Listen no more; a second call does nothing."""
        while self._open:
            self._open.pop().close()

    # --- what comes ------------------------------------------------------------------

    def _take_calibration(self, camera: Camera) -> None:
        with self._changed:
            self._camera = camera
            self._changed.notify_all()

    def _take_colour(self, image: Image) -> None:
        with self._changed:
            self._colours.append(image)
            self._pair()

    def _take_depth(self, image: Image) -> None:
        with self._changed:
            self._depths.append(image)
            self._pair()

    def _pair(self) -> None:
        """Find the latest picture in colour that has its depth."""
        for colour in reversed(self._colours):
            pair = self._pair_of(colour)
            if pair is not None:
                break
        else:
            return
        while self._colours and self._colours[0].stamp <= pair.colour.stamp:
            self._colours.popleft()
        while self._depths and pair.depth and self._depths[0].stamp <= pair.depth.stamp:
            self._depths.popleft()
        self._latest = pair
        self._came += 1
        self._changed.notify_all()

    def _pair_of(self, colour: Image) -> _Pair | None:
        if self._feed.depth is None:
            return _Pair(colour, None)
        near = min(
            self._depths, key=lambda it: abs(it.stamp - colour.stamp), default=None
        )
        if near is None or abs(near.stamp - colour.stamp) > _TOGETHER:
            return None
        return _Pair(colour, near)

    def _is_after(self, stamp: int) -> bool:
        return self._latest is not None and self._latest.colour.stamp > stamp

    # --- what is made of it ----------------------------------------------------------

    def _silence(self) -> str:
        """Why there is no frame."""
        trouble = next((it.trouble for it in self._open if it.trouble), "")
        if trouble:
            return f"{self._name}: {trouble}"
        colour, depth = self._feed.colour.name, self._feed.depth
        if depth is None or not self._colours:
            return (
                f"{self._name}: no picture came on {colour} within "
                f"{self._patience:g} s: is its camera running?"
            )
        missing = (
            f"depth on {depth.name} is not of the same moments as colour"
            if self._depths
            else f"colour comes, but no depth on {depth.name}"
        )
        return f"{self._name}: {missing}"

    def _make_frame(self, pair: _Pair, camera: Camera | None) -> Frame:
        colour = self._in_colour(pair.colour)
        seconds = pair.colour.stamp / 1e9
        if pair.depth is None:
            return Frame(colour, None, None, seconds, {})
        if camera is None:
            raise SensorError(
                f"{self._name}: there is depth but nothing on {self._feed.camera.name}:"
                " without the camera's calibration, nobody knows where things are"
            )
        depth = _metres(pair.depth)
        if depth.shape != colour.shape[:2]:
            raise SensorError(
                f"{self._name}: depth is {_size(depth.shape)} but colour is "
                f"{_size(colour.shape)}; depth must be registered to colour"
            )
        lens = Intrinsics(camera.fx, camera.fy, camera.cx, camera.cy)
        return Frame(colour, depth, lens, seconds, {})

    def _in_colour(self, image: Image) -> Colour:
        if image.pixels.dtype == np.uint8 and image.pixels.ndim == 3:
            return image.pixels
        raise SensorError(
            f"{self._name}: {self._feed.colour.name} has no colour; name the topic of "
            "the picture in colour"
        )


def _metres(image: Image) -> Depth:
    """Depth in metres, NaN for no reading; as integers it is in millimetres."""
    depth = image.pixels.astype(np.float32, copy=False)
    return clean_depth(
        depth / np.float32(1000) if image.pixels.dtype == np.uint16 else depth
    )


def _size(shape: tuple[int, ...]) -> str:
    return f"{shape[1]}x{shape[0]}"
