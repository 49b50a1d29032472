"""Things on the simulated table, shown one at a time: what the robot sees of them."""

from __future__ import annotations

from collections.abc import Sequence

from kille.lab.progress import Steps
from kille.lab.scenes.stills import Lesson
from kille.perception.look import SCANS, look
from kille.scene import Colour, Percept
from kille.sensors.sensor import At
from kille.sensors.sources import open_sensor
from kille.sensors.synthetic import Synthetic

LOOKING = 0.4
"""The share of the time that goes into seeing rather than into words."""

_MARGIN = 12


class OnTable:
    """A table on which one thing at a time is shown, each time in another pose.

    A pose is up to 5 cm off the middle each way, and turned by up to 25 degrees from
    the thing's front. All chance is the seed's.
    """

    def __init__(self, seed: int, *, specimen: int = 0, meshes: str = "") -> None:
        options = f"seed={seed}&specimen={specimen}" + f"&meshes={meshes}" * bool(
            meshes
        )
        sensor = open_sensor(f"synthetic:empty?{options}")
        assert isinstance(sensor, Synthetic)
        self._sensor = sensor

    def look_at(self, thing: str, *, turn: float = 0.0, scans: int = SCANS) -> Percept:
        """What is seen of the thing, turned further by so many degrees.

        The nearest thing in view is meant; where none was made out, the picture.
        """
        self._sensor.show(thing)
        if turn:
            pose = self._sensor.bodies[thing].pose
            self._sensor.place(thing, At(pose.right, pose.away, pose.turn + turn))
        seen = look(self._sensor, scans)
        if seen.percepts:
            return seen.percepts[0]
        outline = self._sensor.frame().outlines[thing]
        return look(self._sensor, scans, pointed=outline).percepts[0]


def cut_out(percept: Percept) -> Colour | None:
    """The part of the picture around a thing, None where there is no picture."""
    if percept.frame is None:
        return None
    box, colour = percept.region.box, percept.frame.colour
    top, left = max(0, box.top - _MARGIN), max(0, box.left - _MARGIN)
    return colour[top : box.bottom + _MARGIN, left : box.right + _MARGIN]


def show_each(
    table: OnTable,
    things: Sequence[str],
    steps: Steps,
    doing: str,
    *,
    turn: float = 0,
    scans: int = SCANS,
) -> list[Lesson]:
    """Each of the things in turn, with its name; `steps` is told of each."""
    seen = []
    for thing in things:
        seen.append((table.look_at(thing, turn=turn, scans=scans), thing))
        steps(doing)
    return seen
