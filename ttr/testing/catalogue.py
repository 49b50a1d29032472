"""The properties, by name: those that say most about what went wrong come first."""

from __future__ import annotations

from ttr.testing.dead import NO_DEAD_RULE
from ttr.testing.discourse import COMMITMENTS_STAY, DOWNDATES_ONCE, QUD_DISCIPLINE
from ttr.testing.properties import Property
from ttr.testing.repeating import CONFLUENT, DETERMINISTIC, REPLAYS
from ttr.testing.soundness import (
    KEEPS_TYPE,
    NAMES_BOUND,
    NEVER_BREAKS,
    PURE,
    TERMINATES,
)
from ttr.testing.turns import EVENTS_ONCE, FRESH_ANSWERS, ROUND_TRIP, TAKES_TURNS

__all__ = ["ALL", "OF_ONE_RULE"]

ALL: tuple[Property, ...] = (
    PURE,
    KEEPS_TYPE,
    TERMINATES,
    NAMES_BOUND,
    NEVER_BREAKS,
    DETERMINISTIC,
    CONFLUENT,
    QUD_DISCIPLINE,
    DOWNDATES_ONCE,
    COMMITMENTS_STAY,
    FRESH_ANSWERS,
    TAKES_TURNS,
    ROUND_TRIP,
    EVENTS_ONCE,
    REPLAYS,
    NO_DEAD_RULE,
)
"""Every property, P1 to P20."""

OF_ONE_RULE = (PURE, KEEPS_TYPE, TERMINATES, NAMES_BOUND, NEVER_BREAKS, DETERMINISTIC)
"""What can be asked of a rule by itself."""
