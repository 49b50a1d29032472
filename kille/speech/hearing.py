"""A process that listens: what is said is recognised while the robot's program goes on.

Recognising takes the interpreter for a tenth of a second and more, and what a new word
makes expected takes seconds. So a second process has the recogniser, and is sent the
sound as it comes. Both talk over its standard input and output, which have no name;
when the robot's process ends, however it does, the other one ends, too.

Sound is 16 kHz, 16 bits, little-endian, one channel, and of one of three kinds: of a
microphone that is `OPEN`, in which utterances are parted where nobody speaks; of one
that is `HELD`, all of which is one utterance, up to its `END`.
"""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from threading import Condition, Thread
from typing import IO, NamedTuple

from kille.speech.expectations import SpokenWord
from kille.speech.listening import KnownWord, Listener
from kille.speech.recognition import Hypothesis
from kille.speech.sound import RATE, SoundError
from kille.speech.utterances import LONGEST, ONSET, UtteranceFinder, with_margins

OPEN, HELD, END, WORDS, ANEW = b"O", b"H", b"E", b"W", b"N"
"""Sound of an open or a held microphone, and the last of the latter; which words are
known; another microphone begins."""

WAITING = 10.0
"""Seconds of sound that may wait to be heard; what comes when they do is dropped."""

_MOST_WAITING = int(2 * RATE * WAITING)
_MOST_HELD = int(2 * RATE * LONGEST)

_HEADER = struct.Struct("!cI")

_FAREWELL = 3.0
"""Seconds in which the process ends that has nothing to listen to any more."""

_BEGIN = (
    "import sys; sys.path[:] = sys.argv[1:]; "
    "from kille.speech.hearing import listen_to_pipe; listen_to_pipe()"
)
"""Imports what this process would import, and nothing of the folder it is run in."""


class Message(NamedTuple):
    """What the process is sent: sound of some kind, or words as JSON."""

    kind: bytes
    content: bytes = b""


class Heard(NamedTuple):
    """What the process tells.

    `what` is "ready" when it begins to listen, "began" when somebody has begun to speak
    into an open microphone, "heard" at the end of an utterance, and "failed" if it can
    not go on, with a `text` that says why.
    """

    what: str
    perhaps: tuple[Hypothesis, ...] = ()
    held: bool = False
    text: str = ""

    def to_line(self) -> str:
        """The same as a line of JSON.

        >>> heard = Heard("heard", (Hypothesis("Hello.", 0.9),), held=True)
        >>> Heard.from_line(heard.to_line()) == heard
        True
        """
        return json.dumps(self._asdict()) + "\n"

    @classmethod
    def from_line(cls, line: str | bytes) -> Heard:
        """What such a line tells."""
        told = json.loads(line)
        perhaps = tuple(Hypothesis(text, p) for text, p in told.pop("perhaps"))
        return cls(perhaps=perhaps, **told)


class Hearing:
    """What is heard in the sound of one microphone after another.

    `listener` recognises utterances; what is heard is told.
    """

    def __init__(
        self, listener: Listener, tell: Callable[[Heard], object] = lambda _: None
    ) -> None:
        self._listener, self._tell = listener, tell
        self._held, self._is_full = bytearray(), False
        self._begin_anew()

    def take(self, message: Message) -> None:
        """Take in a message, and tell what is heard by then."""
        match message.kind:
            case b"O":
                self._take_open(message.content)
            case b"H":
                self._take_held(message.content)
            case b"E":
                self._take_held(message.content)
                self._hear_held()
                self._is_full = False
            case b"W":
                words = json.loads(message.content)
                self._listener.expect(KnownWord(*it) for it in words)
            case b"N":
                self._begin_anew()

    def _begin_anew(self) -> None:
        self._utterances = UtteranceFinder()
        self._onsets = UtteranceFinder(ONSET)
        self._held.clear()
        self._is_full = False

    def _take_open(self, sound: bytes) -> None:
        before = self._onsets.in_speech
        for _ in self._onsets.feed(sound):
            pass
        if self._onsets.in_speech and not before:
            self._tell(Heard("began"))
        for utterance in self._utterances.feed(sound):
            self._hear(utterance, held=False)

    def _take_held(self, sound: bytes) -> None:
        """Add to the utterance; one that is too long ends, and the rest is dropped."""
        if self._is_full:
            return
        self._held += sound[: _MOST_HELD - len(self._held)]
        if len(self._held) >= _MOST_HELD:
            self._hear_held()
            self._is_full = True

    def _hear_held(self) -> None:
        if self._held:
            self._hear(with_margins(bytes(self._held)), held=True)
            self._held.clear()

    def _hear(self, utterance: bytes, held: bool) -> None:
        self._tell(Heard("heard", self._listener.hear(utterance), held))


def listen_to_pipe() -> None:
    """Hear what comes from the standard input until it ends; then end this process."""
    out = sys.stdout

    def tell(heard: Heard) -> None:
        out.write(heard.to_line())
        out.flush()

    try:
        _hear_messages(sys.stdin.buffer, tell)
    except BrokenPipeError:
        pass  # nobody is there to be told
    except SoundError as error:
        tell(Heard("failed", text=str(error)))
    except Exception as error:
        tell(Heard("failed", text=f"what listens has failed: {error!r}"))
    finally:
        os._exit(0)  # Python would take seconds to forget the network of words


def _hear_messages(pipe: IO[bytes], tell: Callable[[Heard], object]) -> None:
    """Hear all messages; it is ready when it has the words that come first."""
    hearing, ready = Hearing(Listener(), tell), False
    for message in _messages(pipe):
        hearing.take(message)
        if message.kind == WORDS and not ready:
            ready = True
            tell(Heard("ready"))


def _messages(pipe: IO[bytes]) -> Iterator[Message]:
    while len(header := pipe.read(_HEADER.size)) == _HEADER.size:
        kind, size = _HEADER.unpack(header)
        yield Message(kind, pipe.read(size))


class HearingProcess:
    """The process that listens, and what waits to be sent to it.

    What it tells is given to `tell` in a thread. Nothing here waits for it.
    """

    def __init__(self, tell: Callable[[Heard], object]) -> None:
        self._tell = tell
        self._changed = Condition()
        self._waiting: deque[Message] = deque()
        self._waits, self._closed = 0, False
        self._is_cut = False
        self._words: tuple[KnownWord, ...] | None = None
        self._sent: tuple[KnownWord, ...] | None = None
        self._process = subprocess.Popen(
            [sys.executable, "-c", _BEGIN, *sys.path],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
            # A Ctrl-C in the terminal is for the process that began it alone.
            start_new_session=True,
        )
        self._threads = [
            Thread(target=it, name="kille-hearing", daemon=True)
            for it in (self._send, self._receive)
        ]
        for thread in self._threads:
            thread.start()

    @property
    def is_alive(self) -> bool:
        """Whether it still listens."""
        return not self._closed and self._process.poll() is None

    def expect(self, words: Iterable[SpokenWord]) -> None:
        """Have it expect what may be said with these words from now on."""
        with self._changed:
            self._words = tuple(map(KnownWord.of, words))
            self._changed.notify()

    def take(self, message: Message) -> bool:
        """Send it sound, in no time; whether it was taken, and not dropped.

        What is held and has lost a piece is not heard: half of it may be another
        sentence. Its end is sent all the same, so that the next one begins anew.
        """
        with self._changed:
            if message.kind == ANEW:
                self._waiting.clear()
                self._waits, self._is_cut = 0, False
            fits = self._waits + len(message.content) <= _MOST_WAITING
            if message.kind in (HELD, END):
                self._is_cut = self._is_cut or not fits
            if message.kind == END and self._is_cut:
                self._is_cut = fits = False
                message = Message(ANEW)
            if fits or message.kind == ANEW:
                self._enqueue(message)
        return fits

    def _enqueue(self, message: Message) -> None:
        """Have a message wait; to begin anew twice is to do it once."""
        if message.kind == ANEW and self._waiting and self._waiting[-1].kind == ANEW:
            return
        self._waiting.append(message)
        self._waits += len(message.content) + 1
        self._changed.notify()

    def close(self) -> None:
        """End it."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._threads[0].join(_FAREWELL)
        try:
            self._process.wait(_FAREWELL)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        for thread in self._threads:
            thread.join(_FAREWELL)
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                with suppress(OSError):
                    pipe.close()

    def _next(self) -> Message | None:
        """What is to be sent next, when there is something; None at the end."""
        with self._changed:
            while True:
                if self._closed:
                    return None
                if self._words is not None and self._words != self._sent:
                    self._sent = self._words
                    return Message(WORDS, json.dumps(self._words).encode())
                if self._waiting:
                    message = self._waiting.popleft()
                    self._waits -= len(message.content) + 1
                    return message
                self._changed.wait()

    def _send(self) -> None:
        pipe = self._process.stdin
        assert pipe is not None
        try:
            while (message := self._next()) is not None:
                pipe.write(_HEADER.pack(message.kind, len(message.content)))
                pipe.write(message.content)
                pipe.flush()
            pipe.close()
        except OSError:
            pass  # it has ended, which the other thread notices

    def _receive(self) -> None:
        pipe = self._process.stdout
        assert pipe is not None
        failed = False
        for line in pipe:
            heard = Heard.from_line(line)
            failed = failed or heard.what == "failed"
            self._tell(heard)
        if not self._closed and not failed:
            self._tell(Heard("failed", text="what listens has ended"))
