"""All properties, in the order in which they are checked: causes before effects."""

from __future__ import annotations

from ttr.testing.properties.agendas import DONE_ONCE
from ttr.testing.properties.determinism import CONFLUENT, DETERMINISTIC, REPLAYS
from ttr.testing.properties.event_uptake import NOTHING_DROPPED
from ttr.testing.properties.groundedness import AGREED_ONCE, SAID_FIRST
from ttr.testing.properties.pending_items import ANSWERED, EMPTIES
from ttr.testing.properties.property import Property
from ttr.testing.properties.questions_and_facts import (
    COMMITMENTS_STAY,
    DOWNDATES_ONCE,
    QUD_DISCIPLINE,
)
from ttr.testing.properties.soundness import (
    KEEPS_TYPE,
    NAMES_BOUND,
    NEVER_BREAKS,
    PURE,
    TERMINATES,
)
from ttr.testing.properties.speaker_rights import IN_TURN
from ttr.testing.properties.turn_taking import (
    EVENTS_ONCE,
    FRESH_ANSWERS,
    ROUND_TRIP,
    TAKES_TURNS,
)
from ttr.testing.properties.unused_rules import NO_DEAD_RULE

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
    SAID_FIRST,
    AGREED_ONCE,
    DONE_ONCE,
    IN_TURN,
    FRESH_ANSWERS,
    TAKES_TURNS,
    ROUND_TRIP,
    EVENTS_ONCE,
    REPLAYS,
    ANSWERED,
    EMPTIES,
    NOTHING_DROPPED,
    NO_DEAD_RULE,
)
"""Every property, P1 to P27.

>>> from ttr.testing import ALL
>>> print(*ALL[:3], sep="; ")
P2 pure rules; P1 type preservation; P4 termination
"""

OF_GAMES = (TAKES_TURNS, DONE_ONCE, IN_TURN, EMPTIES, ANSWERED, NOTHING_DROPPED)
"""Properties of games only: they may not hold from states drawn at random."""

OF_ONE_RULE = (PURE, KEEPS_TYPE, TERMINATES, NAMES_BOUND, NEVER_BREAKS, DETERMINISTIC)
"""Properties that a single rule may have."""
