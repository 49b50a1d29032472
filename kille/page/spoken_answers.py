"""The robot's voice: its answers as sound, for the browsers that want to hear them.

A thread has a program speak each sentence. Only the newest turn is spoken: whoever says
the next thing does not wait until all has been said.
"""

from __future__ import annotations

import shutil
import struct
from collections.abc import Callable
from contextlib import ExitStack
from threading import Condition, Thread
from typing import Protocol

from kille.page.feed import Event, Feed
from kille.speech.sound import Sound, SoundError, write_wav
from kille.speech.synthesis import SYNTHESISERS, synthesise

_FAREWELL = 5.0
"""Seconds in which a sentence is ended that is being spoken."""


class Ear(Protocol):
    """A browser that may want to hear the robot."""

    def wants_voice(self) -> bool:
        """Whether it does."""

    def play(self, sound: bytes) -> None:
        """Take a message of sound, from any thread."""


def voice_program(language: str) -> str:
    """The program that speaks a language here: espeak, else flite; or nothing."""
    for name, (command, *_) in SYNTHESISERS.items():
        if shutil.which(command) and (language == "en" or name == "espeak"):
            return name
    return ""


class SpokenAnswers:
    """The answers in a feed, spoken for whoever wants to hear them.

    A message is the number of the turn's event in four bytes, and a WAV file for each
    line of what the robot says, one after another.
    """

    def __init__(
        self,
        feed: Feed,
        language: str = "en",
        tell: Callable[[str], object] = lambda _: None,
        speak: Callable[[str, str, str], Sound] = synthesise,
    ) -> None:
        self.program = voice_program(language)
        self._feed, self._language, self._tell = feed, language, tell
        self._speak = speak
        self._changed, self._woken, self._closed = Condition(), False, False
        self._ears: list[Ear] = []
        self._last = feed.last
        self._trouble, self._uttered = "", 0
        self._events = ExitStack()
        self._events.enter_context(feed.listener(self._wake))
        self._thread = Thread(target=self._go_on, name="kille-voice", daemon=True)
        if self.program:
            self._thread.start()

    def add(self, ear: Ear) -> None:
        """Speak for this one, too, whenever it wants that."""
        with self._changed:
            self._ears.append(ear)

    def remove(self, ear: Ear) -> None:
        """Speak for it no more."""
        with self._changed:
            self._ears.remove(ear)

    def is_first_told_of(self, turn: int) -> bool:
        """Whether nobody has told yet how much was uttered in the turn of this number,
        or a later one: of several browsers that play it the first one counts."""
        with self._changed:
            is_first, self._uttered = turn > self._uttered, max(turn, self._uttered)
            return is_first

    def close(self) -> None:
        """Say no more."""
        self._events.close()
        with self._changed:
            self._closed = True
            self._changed.notify()
        if self._thread.is_alive():
            self._thread.join(_FAREWELL)

    def _wake(self) -> None:
        with self._changed:
            self._woken = True
            self._changed.notify()

    def _listeners(self) -> list[Ear]:
        with self._changed:
            return [it for it in self._ears if it.wants_voice()]

    def _go_on(self) -> None:
        while True:
            with self._changed:
                while not self._woken and not self._closed:
                    self._changed.wait()
                self._woken = False
                if self._closed:
                    return
            turn = self._newest_turn()
            if turn is not None:
                self._say(turn)

    def _newest_turn(self) -> Event | None:
        """The last turn since the feed was read in which the robot said something."""
        events = self._feed.after(self._last)
        self._last = events[-1]["id"] if events else self._last
        said = [it for it in events if it["type"] == "turn" and it["said"]]
        return said[-1] if said else None

    def _say(self, turn: Event) -> None:
        number = struct.pack(">I", turn["id"] % 2**32)
        for line in str(turn["said"]).split("\n"):
            ears = self._listeners()
            if not ears or self._closed or self._is_over(turn["id"]):
                return
            try:
                sound = self._speak(line, self.program, self._language)
            except SoundError as error:
                self._complain(str(error))
                return
            for ear in ears:
                ear.play(number + write_wav(sound))
        self._complain("")

    def _is_over(self, number: int) -> bool:
        """Whether something else was said since the turn of this number."""
        return any(it["type"] == "heard" for it in self._feed.after(number))

    def _complain(self, trouble: str) -> None:
        if trouble and trouble != self._trouble:
            self._tell(trouble)
        self._trouble = trouble
