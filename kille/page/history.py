"""What is kept of earlier turns: their pictures, and what happened in them."""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Iterator
from typing import NamedTuple

from kille.agent.exchanges import Event
from kille.page.live_picture import encode_jpeg
from kille.scene import Colour

PICTURES = 200
"""The latest turns of which pictures are kept: some megabytes."""

EVENTS = 10_000
"""The latest events that are kept, for the story of the dialogue."""


GLIMPSE = "@ glimpse"
"""A look that is no turn, as a line of a story."""


class KeptEvent(NamedTuple):
    """An event, and the number of exchanges that there were before it."""

    event: Event
    turns: int


class History:
    """The pictures of the latest turns and the events of all, both bounded.

    A turn is known by the number of its first exchange. It is written by one thread;
    any may ask for a picture.
    """

    def __init__(self, pictures: int = PICTURES) -> None:
        self._most = pictures
        self._pictures: OrderedDict[int, bytes] = OrderedDict()
        self._colour: Colour | None = None
        self._jpeg = b""
        self._events: deque[KeptEvent] = deque(maxlen=EVENTS)

    def keep_picture(self, turn: int, colour: Colour) -> None:
        """Keep what the robot has seen in a turn; the same frame is kept once."""
        if colour is not self._colour:
            self._colour, self._jpeg = colour, encode_jpeg(colour)
        self._pictures[turn] = self._jpeg
        while len(self._pictures) > self._most:
            self._pictures.popitem(last=False)

    def picture(self, turn: int) -> bytes | None:
        """What was seen in a turn, as a JPEG; None if it is not kept any more."""
        return self._pictures.get(turn)

    def keep_event(self, event: Event, turns: int) -> None:
        """Keep an event that happened after so many exchanges; of glimpses in a row,
        the last."""
        if self._events and event.line == self._events[-1].event.line == GLIMPSE:
            self._events.pop()
        self._events.append(KeptEvent(event, turns))

    def events(self, first: int, last: int) -> Iterator[Event]:
        """The events of the exchanges from one number to before another."""
        return (it.event for it in self._events if first <= it.turns < last)
