"""A bus within one process."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from threading import Condition, Lock, Thread, current_thread
from typing import Any, Generic, TypeVar

from kille.bus.interface import Publisher, SerialReceiver, Subscription, TopicKinds
from kille.bus.messages import Message, Topic

M = TypeVar("M", bound=Message)


class LocalBus:
    """Carries messages within this process, as they are.

    >>> from queue import Queue
    >>> from kille.bus.messages import Text
    >>> bus, words = LocalBus(), Topic("words", Text)
    >>> heard = Queue()
    >>> listening = bus.subscribe(words, heard.put)
    >>> bus.publisher(words).publish(Text("Hello."))
    >>> heard.get()
    Text(text='Hello.')
    >>> bus.close()
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._kinds = TopicKinds()
        self._listening: dict[str, tuple[_Listening[Any], ...]] = {}
        self._latest: dict[str, Any] = {}
        self._closed = False

    def publisher(self, topic: Topic[M]) -> Publisher[M]:
        """A way to send messages under this topic."""
        self._kinds.settle(_local_name(topic), topic.kind)
        return _Sending(self, topic)

    def subscribe(self, topic: Topic[M], take: Callable[[M], None]) -> Subscription:
        """Give `take` each message under this topic, from now on."""
        self._kinds.settle(_local_name(topic), topic.kind)
        listening = _Listening(self, topic, take)
        with self._lock:
            others = self._listening.get(_local_name(topic), ())
            self._listening[_local_name(topic)] = (*others, listening)
            if _local_name(topic) in self._latest:
                listening.put(self._latest[_local_name(topic)])
        return listening

    def close(self) -> None:
        """Send and take nothing more; a second call does nothing."""
        with self._lock:
            self._closed = True
            every = [it for some in self._listening.values() for it in some]
        for listening in every:
            listening.close()

    def _send(self, topic: Topic[M], message: M) -> None:
        with self._lock:
            if self._closed:
                return
            if topic.latched:
                self._latest[_local_name(topic)] = message
            for listening in self._listening.get(_local_name(topic), ()):
                listening.put(message)

    def _listeners(self, topic: Topic[Any]) -> int:
        with self._lock:
            return len(self._listening.get(_local_name(topic), ()))

    def _leave(self, topic: Topic[Any], leaving: _Listening[Any]) -> None:
        with self._lock:
            all_ = self._listening.get(_local_name(topic), ())
            left = tuple(it for it in all_ if it is not leaving)
            self._listening[_local_name(topic)] = left


class _Sending(Generic[M]):
    """A publisher, until it is closed."""

    def __init__(self, bus: LocalBus, topic: Topic[M]) -> None:
        self._bus, self._topic, self._open = bus, topic, True

    @property
    def listeners(self) -> int:
        """How many listen to it now."""
        return self._bus._listeners(self._topic)

    def publish(self, message: M) -> None:
        """Send a message to all who listen."""
        if self._open:
            self._bus._send(self._topic, message)

    def close(self) -> None:
        """Send no more."""
        self._open = False


class _Listening(Generic[M]):
    """A subscription: a thread that takes what waits."""

    def __init__(
        self, bus: LocalBus, topic: Topic[M], take: Callable[[M], None]
    ) -> None:
        self._bus, self._topic = bus, topic
        self._take = SerialReceiver(topic, take)
        self._waiting: deque[M] = deque(maxlen=topic.waiting)
        self._changed = Condition()
        self._open = True
        name = f"taking /{topic.name}"
        self._thread = Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    @property
    def trouble(self) -> str:
        """Nothing: within a process messages are neither written nor read."""
        return ""

    def put(self, message: M) -> None:
        with self._changed:
            self._waiting.append(message)
            self._changed.notify()

    def close(self) -> None:
        """Listen no more, once what is being taken has been taken."""
        with self._changed:
            self._open = False
            self._changed.notify()
        self._bus._leave(self._topic, self)
        if self._thread is not current_thread():
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._waiting or not self._open)
                if not self._open:
                    return
                message = self._waiting.popleft()
            self._take(message)


def _local_name(topic: Topic[Any]) -> str:
    """A process is one namespace."""
    return topic.name.removeprefix("/")
