"""Speech as input of a conversation: utterances, and what the robot answers."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from kille.agent.agent import Agent
from kille.dialogue.state import words
from kille.interfaces.terminal import complain, console
from kille.speech.expectations import LANGUAGES
from kille.speech.listening import Listener
from kille.speech.recognition import Hypothesis
from kille.speech.sound import SoundError
from kille.speech.synthesis import Stop, never
from kille.speech.utterances import (
    from_file,
    from_microphone,
    from_pipe,
    listening_while_speaking,
)

DEVICE, ALWAYS, PIPE = "device", "always", "-"
"""Where speech comes from, if not from a file: the microphone after Enter, the
microphone all the time, raw samples on the standard input."""

_SILENCE = 10.0
"""Seconds within which a person who has pressed Enter begins to speak."""


@dataclass(frozen=True)
class SpeechHypotheses:
    """The hypotheses about an utterance, the most probable first; none for a noise."""

    perhaps: tuple[Hypothesis, ...]

    @property
    def text(self) -> str:
        """How the utterance is shown."""
        return self.perhaps[0].text if self.perhaps else "…"


class SpeechInput:
    """Speech input for a conversation; `SoundError` says in one line why there is none.

    It listens for what the robot knows: each word that the robot learns is expected
    from the next utterance on.
    """

    def __init__(
        self, source: str, language: str = "en", interruptible: bool = False
    ) -> None:
        if interruptible and source != ALWAYS:
            raise SoundError("--barge-in needs an open microphone: --hear always")
        self._interruptible, self._spoken_over = interruptible, b""
        if language not in LANGUAGES:
            raise SoundError(
                f"only English can be heard: type, and leave out --hear {source}"
            )
        self._source = source
        is_file = source not in (DEVICE, ALWAYS, PIPE)
        self._waiting = from_file(Path(source)) if is_file else None
        self._listener = Listener(language)

    @contextmanager
    def watch_for_voice(self) -> Iterator[Stop]:
        """Listen while the robot speaks: whether somebody speaks over it.

        What they say is the next utterance. It is for people with headphones, as the
        robot would hear itself, and for a microphone that is open all the time.
        """
        if not self._interruptible:
            yield never
            return
        with listening_while_speaking() as spoken_over:
            yield spoken_over
            if spoken_over():
                self._spoken_over = spoken_over.utterance()

    def lines(self, robot: Agent) -> Iterator[SpeechHypotheses | str]:
        """The tutor's utterances, one by one, and as text what they type."""
        if self._source == DEVICE:
            yield from self._after_enter(robot)
            return
        for sound in self._sounds():
            yield self._recognise(robot, sound)

    def _sounds(self) -> Iterator[bytes]:
        while self._source == ALWAYS:
            begun, self._spoken_over = self._spoken_over, b""
            yield begun or from_microphone()
        waiting = self._waiting or from_pipe(sys.stdin.buffer)
        first = next(waiting, None)
        if first is None:
            name = "the standard input" if self._source == PIPE else self._source
            raise SoundError(f"nobody speaks in {name}: is it the right sound?")
        yield first
        yield from waiting

    def _after_enter(self, robot: Agent) -> Iterator[SpeechHypotheses | str]:
        """What is typed or spoken; without a microphone, what is typed."""
        while True:
            try:
                typed = input("U> (Enter to speak, or type) ").strip()
                yield typed or self._recognise(robot, from_microphone(_SILENCE))
            except EOFError:
                console().print("")
                return
            except SoundError as error:
                complain(error)

    def _recognise(self, robot: Agent, sound: bytes) -> SpeechHypotheses:
        """Recognise a sound by the words that the robot knows at present."""
        self._listener.expect(words(robot.state))
        return SpeechHypotheses(self._listener.hear(sound))
