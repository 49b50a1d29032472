"""The ten things of the simulated table, each as it is seen once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, partial

from kille.perception.cues import measure_cues
from kille.perception.features import features_of
from kille.perception.segment import segment
from kille.scene import Features, Frame, Percept, Region, Traits
from kille.sensors.sensor import Stage
from kille.sensors.sources import open_sensor


@dataclass(frozen=True, eq=False)
class SimulatedThing:
    """One of the ten things as seen once; equal to itself alone."""

    name: str
    frame: Frame
    region: Region
    scan: Features

    def percept(self) -> Percept:
        """It, without anything worked out before."""
        measure = partial(measure_cues, self.frame, self.region)
        scan = features_of(self.frame, self.region)
        return Percept(self.region, (scan,), measure, self.frame)


@cache
def simulated_things() -> tuple[SimulatedThing, ...]:
    """All ten of them."""
    stage = open_sensor("synthetic:empty?seed=3")
    assert isinstance(stage, Stage)
    seen = []
    for name in stage.things():
        stage.show(name)
        frame = stage.frame()
        region = segment(frame).regions[0]
        seen.append(SimulatedThing(name, frame, region, features_of(frame, region)))
    return tuple(seen)


@cache
def traits_of(thing: SimulatedThing) -> Traits:
    """What each cue says of it."""
    return measure_cues(thing.frame, thing.region)
