"""What every bus can do: messages go from whoever sends to whoever listens."""

from __future__ import annotations

import logging
from collections.abc import Callable
from threading import Lock, RLock
from typing import Generic, Protocol, TypeVar

from kille.bus.messages import BusError, Message, Topic

_logger = logging.getLogger("kille.bus")

M = TypeVar("M", bound=Message)
Sent = TypeVar("Sent", bound=Message, contravariant=True)


class Subscription(Protocol):
    """Listening to a topic, until it is closed.

    >>> from kille.bus import LocalBus, Text, Topic
    >>> bus = LocalBus()
    >>> listening: Subscription = bus.subscribe(Topic("words", Text), print)
    >>> listening.trouble
    ''
    >>> listening.close()
    >>> bus.close()
    """

    @property
    def trouble(self) -> str:
        """Why the latest message could not be read, in a line; empty if it could."""
        ...

    def close(self) -> None:
        """Listen no more, once what is being taken has been taken.

        A second call does nothing.
        """
        ...


class Publisher(Protocol[Sent]):
    """A way to send messages under a topic.

    >>> from kille.bus import LocalBus, Text, Topic
    >>> bus = LocalBus()
    >>> speaking: Publisher[Text] = bus.publisher(Topic("words", Text))
    >>> speaking.publish(Text("Hello."))
    >>> speaking.listeners
    0
    >>> bus.close()
    """

    @property
    def listeners(self) -> int:
        """The number of subscriptions at present."""
        ...

    def publish(self, message: Sent) -> None:
        """Send a message to all who listen; it does not wait for them."""
        ...

    def close(self) -> None:
        """Send no more; a second call does nothing."""
        ...


class Bus(Protocol):
    """Carries messages between parts of the robot, on one machine or several.

    Messages of one publisher under a topic arrive in order. A subscription takes its
    messages one at a time, in a thread of its own: it may take long, and may send
    messages itself. An error in it is logged, and it goes on with the next message.
    BusError if a topic is used with two kinds of messages.

    >>> from kille.bus import LocalBus, Text, Topic
    >>> bus: Bus = LocalBus()
    >>> words = Topic("words", Text)
    >>> listening = bus.subscribe(words, print)
    >>> bus.publisher(words).listeners
    1
    >>> bus.close()
    """

    def publisher(self, topic: Topic[M]) -> Publisher[M]:
        """A way to send messages under this topic."""
        ...

    def subscribe(self, topic: Topic[M], take: Callable[[M], None]) -> Subscription:
        """Give `take` each message under this topic, from now on."""
        ...

    def close(self) -> None:
        """Send and take nothing more; a second call does nothing."""
        ...


class TopicKinds:
    """The kind of messages of each topic, which its first use decides."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._kinds: dict[str, type] = {}

    def settle(self, name: str, kind: type) -> None:
        """BusError if the topic of this full name has another kind already."""
        with self._lock:
            known = self._kinds.setdefault(name, kind)
        if known is not kind:
            told = f"/{name.lstrip('/')} carries {known.__name__}, not {kind.__name__}"
            raise BusError(told)


class SerialReceiver(Generic[M]):
    """Takes messages one at a time, from whatever thread they come.

    It logs errors, and raises none.
    """

    def __init__(self, topic: Topic[M], take: Callable[[M], None]) -> None:
        self._topic, self._take = topic, take
        self._alone, self._open = RLock(), True

    def __call__(self, message: M) -> None:
        """Take a message, unless it is closed."""
        with self._alone:
            if not self._open:
                return
            try:
                self._take(message)
            except Exception:
                _logger.exception("taking /%s", self._topic.name)

    def close(self) -> None:
        """Take no more, once what is being taken has been taken."""
        with self._alone:
            self._open = False
