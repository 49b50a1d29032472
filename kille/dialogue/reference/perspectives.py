"""Whose perspective talk about places is taken in: the viewer's or the landmark's.

A perspective is a direction that is forward, in the robot's own axes: `away` is its
own, and that of whoever looks where the robot looks. A landmark that faces some way has
one of its own, which the talk may have settled on.

Source: Dobnik, Howes and Kelleher 2015 (aligned in the talk, game by game).
"""

from __future__ import annotations

from ttr import Record

AWAY = "away"
"""Forward for the viewer.

>>> from kille.dialogue.reference import AWAY, front_of
>>> from kille.dialogue.state import initial
>>> front_of(initial(), "o1") == AWAY
True
"""

OPEN, VIEWER, LANDMARK = "", "viewer", "landmark"
"""What the talk has settled on: nothing yet, the viewer's frame, the landmark's.

>>> from kille.dialogue.reference import LANDMARK, OPEN, VIEWER
>>> from kille.dialogue.state import initial
>>> [OPEN, VIEWER, LANDMARK].index(initial().shared.frame)
0
"""


def known_front(s: Record, y: str) -> str | None:
    """Which way a thing faces, if the tutor has said so.

    >>> from kille.dialogue.state import initial
    >>> known_front(initial(), "o1") is None
    True
    """
    return next((str(it.front) for it in s.shared.turned if it.x == y), None)


def front_of(s: Record, y: str) -> str:
    """The direction that is forward when things are placed beside this landmark.

    >>> from kille.dialogue.state import initial
    >>> front_of(initial(), "o1")
    'away'
    """
    if s.shared.frame != LANDMARK:
        return AWAY
    return known_front(s, y) or AWAY
