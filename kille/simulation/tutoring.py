"""The games of tutoring in a simulated world, with who plays them: to be tested.

ttr test kille.simulation.tutoring:game
"""

from __future__ import annotations

from kille.simulation.playing import simulated
from kille.simulation.tutors import tutoring
from kille.simulation.worlds import drawn
from ttr import Record
from ttr.testing import Roles

__all__ = ["game", "roles", "tutor", "words"]


def words(event: Record) -> str | None:
    """How the tutor worded an event; None for what was not said."""
    return str(event.text) if "text" in event else None


game = simulated(drawn(1))
"""The games, in front of a table with four things on it and four beside it."""

tutor = tutoring()
roles = Roles(
    qud="shared.qud",
    commitments="shared.commitments",
    latest="shared.latest",
    words=words,
    retracts=frozenset({"keep"}),
    moves=3,  # of what the robot knows: words for things, how they are, and where
)
