"""The sensor of a dialogue node, whose looks the perception node takes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from kille.bus import Asking, Bundle, Bus, BusError
from kille.nodes.look_messages import frame_in, look_in, runs_of
from kille.nodes.topics import LOOKS, STAGE
from kille.perception.look import Sighting
from kille.scene import Frame, Look
from kille.sensors.sensor import At, Beside, SensorError
from ttr.aliases import former_names

__getattr__ = former_names(__name__, {"Eyes": "RemoteSensor"})

Seen = TypeVar("Seen", Frame, Look)


class RemoteSensor:
    """A sensor and a stage that takes looks, by asking other nodes.

    SensorError if they do not answer within `patience` seconds, or cannot do it.
    """

    def __init__(self, bus: Bus, patience: float = 10.0) -> None:
        self._looks = Asking(bus, LOOKS, patience)
        self._stage = Asking(bus, STAGE, patience)
        self._after = 0

    @property
    def name(self) -> str:
        """The source as people read it."""
        return "the bus"

    def frame(self) -> Frame:
        """The next frame."""
        return self._request({"scans": 0}, frame_in)

    def look(self, scans: int, pointed: Sighting | None) -> Look:
        """A look at the scene."""
        asked: dict[str, Any] = {"scans": scans}
        if pointed is not None:
            frame, region = pointed
            asked["pointed"] = {
                "time": frame.time,
                "shape": list(region.mask.shape),
                "runs": runs_of(region.mask),
            }
        return self._request(asked, look_in)

    def close(self) -> None:
        """Ask no more; a second call does nothing."""
        self._looks.close()
        self._stage.close()

    # --- the scene -------------------------------------------------------------------

    def things(self) -> tuple[str, ...]:
        """The names of all that can be shown."""
        return tuple(self._send_command("things")["things"])

    def show(self, name: str) -> None:
        """Show only this object, in a place and pose of its own."""
        self._change(f"show {name}")

    def place(self, name: str, spot: At | Beside) -> None:
        """Put the object there and leave the others where they are."""
        match spot:
            case At(right, away, turn):
                self._change(f"place {name} at {right} {away} turned {turn}")
            case Beside(relation, landmark):
                self._change(f"place {name} {relation} {landmark}")

    def remove(self, name: str) -> None:
        """Take the object away."""
        self._change(f"remove {name}")

    # --- asking ----------------------------------------------------------------------

    def _change(self, command: str) -> None:
        """Change the scene; from then on only frames that show it count."""
        self._after = int(self._send_command(command)["after"])

    def _send_command(self, command: str) -> Mapping[str, Any]:
        try:
            return self._stage.ask({"command": command})
        except BusError as error:
            raise SensorError(str(error)) from error

    def _request(
        self, asked: Mapping[str, Any], read: Callable[[Bundle], Seen]
    ) -> Seen:
        try:
            return read(self._looks.request({**asked, "after": self._after}))
        except BusError as error:
            raise SensorError(str(error)) from error
        except (KeyError, TypeError, ValueError) as error:
            name = LOOKS.answers.name
            raise SensorError(f"what came on {name} is no look: {error!r}") from error
