"""Where speech comes from: a file, a pipe or a microphone; each utterance by itself.

Utterances are parted where nobody speaks, by pocketsphinx's detector of voices.
"""

from __future__ import annotations

import os
import select
import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import inf
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO

from kille.speech.sound import RATE, SoundError, read_wav

LONGEST = 15.0
"""Seconds of one utterance; what goes on for longer is noise, and is cut."""

_MOST = int(2 * RATE * LONGEST)

_WINDOW = 0.6
"""Seconds over which the voice must have fallen silent: longer than at a comma."""

ONSET = 0.3
"""Seconds of a voice that stop the robot: longer than a cough."""

_MARGIN = bytes(2 * RATE // 5)
"""The silence, of a fifth of a second, that is put before and after an utterance."""

_SILENT = bytes(2)
"""The least that the detector takes at the end."""

_RECORDER = ("arecord", "-q", "-t", "raw", "-f", "S16_LE", "-r", str(RATE), "-c", "1")


class UtteranceFinder:
    """Parts a sound that comes piece by piece into stretches of speech."""

    def __init__(self, window: float = _WINDOW) -> None:
        from pocketsphinx import Endpointer

        self._finder = Endpointer(window=window, sample_rate=RATE)
        self._rest, self._spoken = bytearray(), bytearray()

    @property
    def frame_bytes(self) -> int:
        """The bytes of sound that are judged at once."""
        return int(self._finder.frame_bytes)

    @property
    def in_speech(self) -> bool:
        """Whether somebody is speaking."""
        return bool(self._finder.in_speech)

    def feed(self, sound: bytes) -> Iterator[bytes]:
        """The utterances that end in this piece."""
        self._rest += sound
        size = self.frame_bytes
        while len(self._rest) >= size:
            frame = bytes(self._rest[:size])
            del self._rest[:size]
            self._spoken += self._finder.process(frame) or b""
            if not self.in_speech or len(self._spoken) >= _MOST:
                yield from self._take()

    def end(self) -> Iterator[bytes]:
        """The utterance that the end of the sound cuts short, if there is any."""
        whole = len(self._rest) // 2 * 2
        frame = bytes(self._rest[:whole]) or _SILENT
        self._rest.clear()
        self._spoken += self._finder.end_stream(frame) or b""
        yield from self._take()

    def _take(self) -> Iterator[bytes]:
        if self._spoken:
            found = with_margins(bytes(self._spoken))
            self._spoken.clear()
            yield found


def with_margins(sound: bytes) -> bytes:
    """A sound with a little silence before and after it, as recognisers like it."""
    return _MARGIN + sound + _MARGIN


def utterances(read: Callable[[int], bytes], patience: float = inf) -> Iterator[bytes]:
    """The stretches of speech in a sound that is read little by little.

    `read` gives so many bytes, or fewer at the end. It is over when nobody has spoken
    for `patience` seconds of it.
    """
    finder = UtteranceFinder()
    size, silent = finder.frame_bytes, 0
    while True:
        frame = read(size)
        silent = 0 if finder.in_speech else silent + len(frame)
        yield from finder.feed(frame)
        if len(frame) < size or silent > 2 * RATE * patience:
            yield from finder.end()
            return


def from_file(path: Path) -> Iterator[bytes]:
    """The utterances in a WAV file of any rate; `SoundError` if it is none."""
    return _utterances_in(read_wav(path).at(RATE).samples)


def from_pipe(pipe: IO[bytes], patience: float = inf) -> Iterator[bytes]:
    """The utterances in a stream of raw samples: 16 kHz, 16 bits, one channel.

    It is over when nobody has spoken for `patience` seconds.
    """
    return utterances(lambda size: _read_exactly(pipe, size), patience)


def from_microphone(patience: float = inf) -> bytes:
    """The next utterance in front of the microphone, by ALSA's recorder.

    It is empty if nobody has spoken for `patience` seconds. The microphone is opened
    for one utterance, so that the robot never hears itself. Raises `SoundError` where
    there is none, or nothing to record with.
    """
    _check_recorder()
    # Complaints go to a file: nobody reads them while it records, perhaps for hours.
    with TemporaryFile() as told:
        found, failed = _record_utterance(told, patience)
        told.seek(0)
        complaints = told.read().decode(errors="replace").split("\n")
    if failed:
        last = next(filter(None, reversed(complaints)), "there is no sound")
        raise SoundError(
            f"nothing can be recorded ({last}): "
            "connect a microphone, or let it hear a file, --hear FILE.wav"
        )
    return found


def _check_recorder() -> None:
    if shutil.which(_RECORDER[0]) is None:
        raise SoundError(
            "there is no program to record with: apt install alsa-utils, or let it "
            "hear a file, --hear FILE.wav"
        )


def _record_utterance(told: IO[bytes], patience: float) -> tuple[bytes, bool]:
    """An utterance, and whether the recorder ended before there was any."""
    with subprocess.Popen(_RECORDER, stdout=subprocess.PIPE, stderr=told) as recorder:
        assert recorder.stdout is not None
        try:
            found = next(from_pipe(recorder.stdout, patience), b"")
            return found, not found and not recorder.stdout.read(1)
        finally:
            recorder.terminate()


class SpokenOver:
    """Whether somebody speaks in a sound that is recorded while the robot speaks.

    `read_recorded` gives what has been recorded since it was last asked, `read` so many
    bytes, when they are there. It is asked again and again, as the `Stop` of a voice.
    """

    def __init__(
        self, read_recorded: Callable[[], bytes], read: Callable[[int], bytes]
    ) -> None:
        from pocketsphinx import Endpointer

        self._read_recorded, self._read = read_recorded, read
        self._finder = Endpointer(window=ONSET, sample_rate=RATE)
        self._heard, self._judged = bytearray(), 0

    def __call__(self) -> bool:
        """Whether somebody has begun to speak."""
        self._heard += self._read_recorded()
        size = self._finder.frame_bytes
        while not self._finder.in_speech and self._judged + size <= len(self._heard):
            frame = self._heard[self._judged : self._judged + size]
            self._finder.process(bytes(frame))
            self._judged += size
        return bool(self._finder.in_speech)

    def utterance(self) -> bytes:
        """What is said, from before it was noticed to its end."""
        begin = max(0, self._judged - 2 * RATE)
        pieces = _Pieces(bytes(self._heard[begin:]))

        def read(size: int) -> bytes:
            piece = pieces.read(size)
            return piece + self._read(size - len(piece)) if len(piece) < size else piece

        return next(utterances(read), b"")


@contextmanager
def listening_while_speaking() -> Iterator[SpokenOver]:
    """Record by ALSA's recorder, and tell whether somebody speaks.

    Raises `SoundError` where there is nothing to record with. What the loudspeaker says
    is recorded, too, unless it is in somebody's ear.
    """
    _check_recorder()
    with subprocess.Popen(
        _RECORDER, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    ) as recorder:
        assert recorder.stdout is not None
        pipe, end = recorder.stdout, recorder.stdout.fileno()

        def read_recorded() -> bytes:
            data = b""
            while select.select([end], [], [], 0.0)[0]:
                piece = os.read(end, 1 << 16)
                if not piece:
                    break
                data += piece
            return data

        try:
            yield SpokenOver(read_recorded, lambda size: _read_exactly(pipe, size))
        finally:
            recorder.terminate()


def _utterances_in(samples: bytes) -> Iterator[bytes]:
    """The utterances in samples that are all there."""
    pieces = _Pieces(samples)
    return utterances(pieces.read)


class _Pieces:
    """Samples that are given piece by piece."""

    def __init__(self, samples: bytes) -> None:
        self._samples, self._at = samples, 0

    def read(self, size: int) -> bytes:
        """The next piece."""
        self._at += size
        return self._samples[self._at - size : self._at]


def _read_exactly(pipe: IO[bytes], size: int) -> bytes:
    """So many bytes of a pipe, which may give fewer at a time."""
    data = b""
    while len(data) < size:
        piece = pipe.read(size - len(data))
        if not piece:
            break
        data += piece
    return data
