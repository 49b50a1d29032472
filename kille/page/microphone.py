"""Whose microphone is heard, and what comes of it.

One browser has the microphone at a time; the others are told who. Its sound goes to a
process that listens, which is begun when a microphone is asked for the first time, and
what is heard becomes a request like any other.

A message of sound is binary: what kind of sound it is (`OPEN`, `HELD` or `END` of
`kille.speech.hearing`), its number in four bytes, and at most a fifth of a second of
samples.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from importlib.util import find_spec
from threading import Lock
from typing import Protocol

from kille.page.browser_requests import BrowserRequest, RequestError, spoken_request
from kille.page.feed import Event, Feed
from kille.page.robot_thread import BusyError
from kille.speech.expectations import LANGUAGES, SpokenWord
from kille.speech.hearing import (
    ANEW,
    END,
    HELD,
    OPEN,
    Heard,
    HearingProcess,
    Message,
)
from kille.speech.sound import RATE

_HEADER = struct.Struct(">cI")

_LONGEST_PIECE = 2 * RATE // 5
"""Bytes of sound in one message, at most: a fifth of a second."""


class Holder(Protocol):
    """A browser that can have the microphone."""

    number: int
    name: str

    def tell(self, event: Event) -> None:
        """Tell this browser alone, from any thread."""


class Listening(Protocol):
    """What listens, as `HearingProcess` does."""

    @property
    def is_alive(self) -> bool:
        """Whether it still listens."""

    def expect(self, words: Iterable[SpokenWord]) -> None:
        """Expect what may be said with these words."""

    def take(self, message: Message) -> bool:
        """Take sound; whether it was not dropped."""

    def close(self) -> None:
        """End."""


def why_deaf(language: str) -> str:
    """Why no microphone can be heard in a language: "language", "pocketsphinx", or
    nothing."""
    if language not in LANGUAGES:
        return "language"
    return "" if find_spec("pocketsphinx") is not None else "pocketsphinx"


class Microphone:
    """The one microphone that is heard.

    `ask` has a request done, `words` are those of the robot, `tell` is told
    when what listens fails, and `begin` begins that. Who has the
    microphone is an event of the feed, `microphone`.
    """

    def __init__(
        self,
        feed: Feed,
        ask: Callable[[BrowserRequest], None],
        words: Callable[[], Iterable[SpokenWord]],
        language: str = "en",
        tell: Callable[[str], object] = lambda _: None,
        begin: Callable[[Callable[[Heard], object]], Listening] = HearingProcess,
    ) -> None:
        self._feed, self._ask, self._words = feed, ask, words
        self._tell, self._begin = tell, begin
        self.why_deaf = why_deaf(language)
        self._language = language
        self._lock = Lock()
        self._holder: Holder | None = None
        self._listening: Listening | None = None
        self._ready, self._is_losing = False, False
        self._next = self._count = 0
        self._events = ExitStack()
        self._events.enter_context(feed.listener(self._expect_words))

    def lend(self, holder: Holder, take_over: bool = False) -> None:
        """Hear this browser from now on, if no other has the microphone, or it is taken
        over; else this browser is told who has it. RequestError if none can be heard.
        """
        if self.why_deaf:
            raise RequestError(f"the robot cannot hear: {self.why_deaf}")
        with self._lock:
            other = self._holder
            if other is None or other is holder or take_over:
                self._holder, self._next, self._is_losing = holder, 0, False
                self._listen_anew()
                ready, other = self._ready, None
        if other is not None:
            holder.tell({"type": "taken", "who": other.name})
            return
        self._expect_words()
        self._publish(holder)
        if ready:
            holder.tell({"type": "listening"})

    def _listen_anew(self) -> None:
        if self._listening is not None and not self._listening.is_alive:
            self._listening.close()
            self._listening = None
        if self._listening is None:
            self._ready = False
            self._listening = self._begin(self._hear)
        self._listening.take(Message(ANEW))

    def give_back(self, holder: Holder) -> None:
        """Hear this browser no more, if it was heard."""
        with self._lock:
            if self._holder is not holder:
                return
            self._holder = None
            if self._listening is not None:
                self._listening.take(Message(ANEW))
        self._publish(None)

    def take(self, holder: Holder, message: bytes) -> None:
        """Take a message of sound. RequestError if it is none.

        The browser is told when sound begins to be lost, on its way or because too much
        waits to be heard. What comes from one that has lost the microphone is dropped.
        """
        if len(message) < _HEADER.size or message[:1] not in (OPEN, HELD, END):
            raise RequestError("a binary message is sound of the microphone")
        kind, number = _HEADER.unpack_from(message)
        sound = message[_HEADER.size :]
        if len(sound) > _LONGEST_PIECE or len(sound) % 2:
            raise RequestError(
                f"a message of sound has at most {_LONGEST_PIECE} bytes, "
                "two for a sample"
            )
        with self._lock:
            if self._holder is not holder or self._listening is None:
                return
            is_whole = number == self._next
            self._next = (number + 1) % 2**32
            is_whole = self._listening.take(Message(kind, sound)) and is_whole
            begins_to_lose = not is_whole and not self._is_losing
            self._is_losing = not is_whole
        if begins_to_lose:
            holder.tell({"type": "sound-lost"})

    def _expect_words(self) -> None:
        """Have what listens expect the words that the robot knows now."""
        with self._lock:
            listening = self._listening if self._holder is not None else None
        if listening is not None:
            listening.expect(self._words())

    def close(self) -> None:
        """End what listens."""
        self._events.close()
        with self._lock:
            listening, self._listening = self._listening, None
            self._holder = None
        if listening is not None:
            listening.close()

    def _publish(self, holder: Holder | None) -> None:
        event: Event = {"type": "microphone", "browser": 0, "who": ""}
        if holder is not None:
            event |= {"browser": holder.number, "who": holder.name}
        self._feed.publish(event)

    def _hear(self, heard: Heard) -> None:
        """Take what is told by what listens, in a thread of that."""
        with self._lock:
            holder = self._holder
            if heard.what == "ready":
                self._ready = True
            self._count += 1
            ref = f"spoken-{self._count}"
        match heard.what:
            case "ready":
                self._tell_holder(holder, {"type": "listening"})
            case "began":
                self._tell_holder(holder, {"type": "began"})
            case "heard" if heard.perhaps or heard.held:
                try:
                    self._ask(spoken_request(ref, heard.perhaps, self._language))
                except BusyError as error:
                    refused = {"type": "refused", "ref": ref, "text": str(error)}
                    self._tell_holder(holder, refused)
            case "heard":
                # A noise is not answered aloud: it may be the robot's own voice.
                self._tell_holder(holder, {"type": "unheard"})
            case "failed":
                self._tell(heard.text)
                refused = {"type": "refused", "ref": "", "text": heard.text}
                self._tell_holder(holder, refused)
                if holder is not None:
                    self.give_back(holder)

    @staticmethod
    def _tell_holder(holder: Holder | None, event: Event) -> None:
        if holder is not None:
            holder.tell(event)
