"""The perception node: it looks at the frames of the sensor when it is asked to."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

import numpy as np

from kille.bus import Bundle, Bus, BusError, serve
from kille.nodes.look_messages import bundle_of, frame_bundle, mask_in
from kille.nodes.topics import FRAMES, LOOKS
from kille.perception.look import SCANS, Sighting, look
from kille.perception.segment import region_of
from kille.scene import Frame, Mask
from kille.sensors.bus_sensor import Feed, Stream
from kille.sensors.sensor import SensorError
from ttr.aliases import former_names

__getattr__ = former_names(__name__, {"Seeing": "PerceptionNode"})

_KEPT = 4
"""How many frames of earlier looks are kept."""


class PerceptionNode:
    """Answers requests for looks.

    A request may say how many `scans` to take, 0 for a frame alone; that only frames
    `after` a moment count; and what is `pointed` at: a mask in the frame of an earlier
    look, with its time.
    """

    def __init__(self, bus: Bus, feed: Feed = FRAMES, patience: float = 5.0) -> None:
        self._frames = Stream(bus, feed, f"/{feed.colour.name.lstrip('/')}", patience)
        self._earlier: OrderedDict[float, Frame] = OrderedDict()
        self._serving = serve(bus, LOOKS, self._answer)

    def close(self) -> None:
        """Look no more."""
        self._serving.close()
        self._frames.close()

    def _answer(self, request: Mapping[str, Any]) -> Bundle:
        try:
            return self._look(request)
        except SensorError as error:
            raise BusError(str(error)) from error
        except (KeyError, TypeError, ValueError) as error:
            raise BusError(f"this is no request for a look: {error}") from error

    def _look(self, request: Mapping[str, Any]) -> Bundle:
        scans = int(request.get("scans", SCANS))
        frames = _After(self._frames, int(request.get("after", 0)))
        if scans == 0:
            return frame_bundle(frames.frame())
        pointed = request.get("pointed")
        found = look(
            frames, scans, None if pointed is None else self._pointed_region(pointed)
        )
        self._remember(found.frame)
        return bundle_of(found)

    def _pointed_region(self, at: Mapping[str, Any]) -> Sighting | Mask:
        """What is pointed at, in its frame, or in the next if that is gone."""
        mask = mask_in(at["runs"], at["shape"])
        earlier = self._earlier.get(float(at["time"]))
        if earlier is None or not np.any(mask):
            return mask
        self._remember(earlier)
        return earlier, region_of(earlier, mask)

    def _remember(self, frame: Frame) -> None:
        """Keep the frames that may be pointed into; pointing may last for long."""
        self._earlier[frame.time] = frame
        self._earlier.move_to_end(frame.time)
        while len(self._earlier) > _KEPT:
            self._earlier.popitem(last=False)


class _After:
    """The frames of a stream that were taken after a moment."""

    def __init__(self, frames: Stream, stamp: int) -> None:
        self._frames, self._stamp = frames, stamp

    @property
    def name(self) -> str:
        return self._frames.name

    def frame(self) -> Frame:
        return self._frames.frame_after(self._stamp)

    def close(self) -> None:
        self._frames.close()
