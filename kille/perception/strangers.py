"""How many strangers to reckon with among the things that the robot is asked about.

Whether things will be asked about that nobody taught is not in the lessons: a tutor who
shows only what was taught, and one who shows as much that is new, may have taught the
same. But a tutor who tells what a thing is after the robot has answered tells whether
it was known. With s strangers among the latest n things told, the share of strangers
among things of which that is not told yet is

    π = min(1/2, (s + a) / (n + 2 a)),   a = 1/2,   n ≤ 12

since what was told long ago says little of what is asked today, and who is told what a
stranger is knows it from then on: so half is the most. Before anything was told it is a
half, too. The strength of "none of these words" is multiplied by π / (1 - π).

Source: the prior is that of Jeffreys 1946, "An invariant form for the prior probability
in estimation problems"; another share than the one learned with, Saerens, Latinne &
Decaestecker 2002, "Adjusting the outputs of a classifier to new a priori
probabilities".
"""

from __future__ import annotations

import math
from collections.abc import Sequence

LATEST = 12
"""Of how many things it counts whether they were known."""

_PRIOR = 0.5  # a


def share_of_strangers(known: Sequence[bool]) -> float:
    """π; `known` is of each thing told whether it was known, the latest last.

    >>> share_of_strangers([]), share_of_strangers([False, False, True])
    (0.5, 0.5)
    >>> share_of_strangers([True])
    0.25
    """
    latest = known[-LATEST:]
    strange = len(latest) - sum(latest)
    return min(0.5, (strange + _PRIOR) / (len(latest) + 2 * _PRIOR))


def log_odds_of_strangers(known: Sequence[bool]) -> float:
    """The logarithm of π / (1 - π).

    >>> log_odds_of_strangers([])
    0.0
    """
    share = share_of_strangers(known)
    return math.log(share / (1 - share))
