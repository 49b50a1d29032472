"""Events in the order in which they happened, for whoever comes or comes back."""

from __future__ import annotations

import secrets
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import dropwhile
from threading import Lock
from typing import Any

Event = dict[str, Any]
"""An event as JSON; `id` is its number."""

KEPT = 2_000
"""How many events are kept: a long lesson. Who has been away for longer begins anew."""


class Feed:
    """The latest events of one run of the server, numbered from 1.

    Nothing is queued for a reader: each remembers the number of the last event that
    they had, and asks for those after it. Threads may publish and read at any time.

    >>> feed = Feed()
    >>> feed.publish({"type": "heard"}), feed.publish({"type": "turn"})
    (1, 2)
    >>> feed.after(1)
    [{'type': 'turn', 'id': 2}]
    """

    def __init__(self, kept: int = KEPT) -> None:
        self.run = secrets.token_urlsafe(9)
        self._events: deque[Event] = deque(maxlen=kept)
        self._last = 0
        self._lock = Lock()
        self._listeners: list[Callable[[], object]] = []

    @property
    def first(self) -> int:
        """The number of the earliest event that is kept."""
        with self._lock:
            return self._events[0]["id"] if self._events else self._last + 1

    @property
    def last(self) -> int:
        """The number of the latest event; 0 if there is none."""
        return self._last

    def publish(self, event: Event, outdates: Event | None = None) -> int:
        """Add an event and wake the readers; returns its number.

        If the latest event is like the one that it `outdates`, that is not kept.

        >>> feed = Feed()
        >>> for n in range(3):
        ...     number = feed.publish({"type": "glance", "n": n}, {"type": "glance"})
        >>> feed.after(0)
        [{'type': 'glance', 'n': 2, 'id': 3}]
        """
        with self._lock:
            latest = self._events[-1] if self._events else {}
            if outdates is not None and outdates.items() <= latest.items():
                self._events.pop()
            self._last += 1
            self._events.append({**event, "id": self._last})
            number, listeners = self._last, tuple(self._listeners)
        for wake in listeners:
            wake()
        return number

    def after(self, number: int) -> list[Event]:
        """The events after the one of this number, as far as they are kept."""
        with self._lock:
            if number >= self._last:
                return []
            return list(dropwhile(lambda it: it["id"] <= number, self._events))

    @contextmanager
    def listener(self, wake: Callable[[], object]) -> Iterator[None]:
        """Have `wake` called after each event, in the thread that publishes it."""
        with self._lock:
            self._listeners.append(wake)
        try:
            yield
        finally:
            with self._lock:
                self._listeners.remove(wake)
