"""Where the robot looks: its sensor, what the tutor points at, and numbered things."""

from __future__ import annotations

from dataclasses import dataclass, replace

from kille.perception.look import SCANS, look
from kille.perception.segment import nearness
from kille.scene import Frame, Look, Mask, Percept
from kille.sensors.sensor import Sensor, SensorError
from kille.sensors.sources import open_sensor
from kille.sensors.stage import perform

__all__ = ["Gaze", "View"]


@dataclass(frozen=True, eq=False)
class View:
    """A look whose things are numbered by nearness, from 1, and the one in focus.

    `focus` is the number of what the tutor points at, else of the nearest thing; None
    when nothing is in view.
    """

    look: Look
    focus: int | None


class Gaze:
    """A sensor to look through, and what the tutor last pointed at.

    Pointing holds until the tutor points elsewhere or the scene changes.
    """

    def __init__(self, sensor: str | Sensor, scans: int = SCANS) -> None:
        self.sensor = open_sensor(sensor) if isinstance(sensor, str) else sensor
        self._scans = scans
        self._pointed: Mask | tuple[int, int] | None = None

    def look(self) -> View:
        """Look at the scene as it is now. SensorError as the sensor raises it."""
        seen = look(self.sensor, self._scans, self._pointed)
        in_focus = seen.percepts[0] if seen.percepts else None
        order = sorted(seen.percepts, key=_nearness)
        if self._pointed is None:
            in_focus = order[0] if order else None
        focus = None if in_focus is None else order.index(in_focus) + 1
        return View(replace(seen, percepts=tuple(order)), focus)

    def point(self, target: str) -> None:
        """Point at a thing by its number, a pixel (`320 240`) or its outline's name.

        SensorError if there is nothing like it.
        """
        words = target.replace("#", " ").replace(",", " ").split()
        if all(word.isdecimal() for word in words) and len(words) in (1, 2):
            first, *second = map(int, words)
            self._pointed = (first, *second) if second else self._numbered(first)  # type: ignore[assignment]
            return
        self._pointed = _outline(self.sensor.frame(), target)

    def _numbered(self, number: int) -> Mask:
        """The pixels of the thing with this number, as it is now."""
        self._pointed = None
        things = self.look().look.percepts
        if not 1 <= number <= len(things):
            raise SensorError(
                f"there is no thing #{number} to point at: "
                + (f"there are {len(things)}" if things else "nothing is in view")
            )
        return things[number - 1].region.mask

    def change(self, command: str) -> None:
        """Change the scene, as `kille.sensors.stage.perform` does."""
        perform(self.sensor, command)
        self._pointed = None

    def turn_to(self, name: str) -> None:
        """Look through another sensor from now on; the old one stays if it fails."""
        sensor = open_sensor(name)
        self.sensor.close()
        self.sensor, self._pointed = sensor, None

    def close(self) -> None:
        """Let go of the sensor."""
        self.sensor.close()


def _nearness(percept: Percept) -> float:
    return nearness(percept.region)


def _outline(frame: Frame, name: str) -> Mask:
    """The outline that a labelled recording or a simulation has under this name."""
    wanted = name.strip().lower().replace(" ", "_").replace("-", "_")
    for known, mask in frame.outlines.items():
        if known.lower().replace(" ", "_").replace("-", "_") == wanted:
            return mask
    names = ", ".join(sorted(frame.outlines)) or "no named outlines"
    raise SensorError(
        f"`point {name}`: point by number, by pixel (`point 320 240`) or by the name "
        f"of an outline; here there are {names}"
    )
