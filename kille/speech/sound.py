"""Sounds: samples of 16 bits in one channel, read from and written to WAV files."""

from __future__ import annotations

import io
import wave
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, cast

import numpy as np

from ttr.safety.inputs import read_bytes
from ttr.safety.limits import SOUND, SOUND_FILE

RATE = 16_000
"""Samples a second in what is heard; what the model of sounds was trained on."""

_PART = 120
"""Seconds of sound that are brought to another rate at once."""

_PAUSE = 0.4
"""Seconds of silence between sentences in a file."""


_FILE_SIZE, _DATA_SIZE, _HEADER = 4, 40, 44
"""Where a WAV file says how long it is and its samples are, and where these begin."""


class SoundError(Exception):
    """A sound that cannot be heard or spoken: what, why, and what to do."""


@dataclass(frozen=True)
class Sound:
    """Samples (16 bits, little-endian, one channel), so many a second."""

    rate: int
    samples: bytes

    @property
    def seconds(self) -> float:
        """How long it lasts."""
        return len(self.samples) / 2 / self.rate

    def at(self, rate: int) -> Sound:
        """The same sound with so many samples a second, by its Fourier transform.

        >>> Sound(8_000, bytes(1600)).at(16_000).seconds
        0.1
        """
        if rate == self.rate or not self.samples:
            return Sound(rate, self.samples)
        # A long sound is taken in parts of whole seconds, which takes less memory.
        size = 2 * self.rate * _PART
        parts = range(0, len(self.samples), size)
        return Sound(rate, b"".join(self._at(rate, it, it + size) for it in parts))

    def _at(self, rate: int, start: int, end: int) -> bytes:
        values = np.frombuffer(self.samples[start:end], dtype="<i2").astype(float)
        wanted = round(len(values) * rate / self.rate)
        if not wanted:
            return b""
        spectrum = np.fft.rfft(values)[: wanted // 2 + 1]
        spectrum = np.pad(spectrum, (0, wanted // 2 + 1 - len(spectrum)))
        new = np.fft.irfft(spectrum, wanted) * (wanted / len(values))
        return np.clip(new.round(), -32768, 32767).astype("<i2").tobytes()


def read_wav(source: Path | bytes) -> Sound:
    """A WAV file, or its bytes, as a sound; of several channels, their mean.

    Raises `SoundError` for what is no WAV file of whole numbers.
    """
    name = source if isinstance(source, Path) else "the sound"
    try:
        data = source if isinstance(source, bytes) else read_bytes(source, SOUND_FILE)
        with wave.open(io.BytesIO(data)) as file:
            rate = file.getframerate()
            if rate not in _RATES:
                raise wave.Error(f"it has {rate} samples a second")
            # A stream that is piped claims to be hours long.
            SOUND.check(min(file.getnframes(), len(data) // _width(file)) // rate)
            return Sound(rate, b"".join(_pieces(file)))
    except OSError as error:
        raise SoundError(f"{name} cannot be read: {error.strerror}") from error
    except (wave.Error, EOFError, ValueError, RuntimeError) as error:
        told = str(error) or "it is cut short"
        raise SoundError(
            f"{name} is not a WAV file that can be heard ({told}): make one with "
            "sox IN -r 16000 -c 1 -b 16 OUT.wav"
        ) from error


def write_wav(sound: Sound) -> bytes:
    """A sound as the bytes of a WAV file.

    >>> read_wav(write_wav(Sound(8_000, bytes(800)))).seconds
    0.05
    """
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(sound.rate)
        file.writeframes(sound.samples)
    return out.getvalue()


_RATES = range(1_000, 400_000)
"""How many samples a second there may be in a file."""

_PIECE = 1 << 16
"""How many samples of a file are read at once."""


def _width(file: wave.Wave_read) -> int:
    """The bytes of a sample, of all channels."""
    return file.getnchannels() * file.getsampwidth()


def _pieces(file: wave.Wave_read) -> Iterator[bytes]:
    """The samples of a file in one channel, piece by piece."""
    while data := file.readframes(_PIECE):
        yield _mono(data, file.getnchannels(), file.getsampwidth())


def _mono(data: bytes, channels: int, width: int) -> bytes:
    """Samples of any width as those of 16 bits, in one channel."""
    whole = len(data) - len(data) % (channels * width)
    samples = np.frombuffer(data[:whole], dtype=np.uint8).reshape(-1, channels, width)
    top = samples[:, :, -1].astype(np.int16)
    if width == 1:
        values = (top - 128) * 256
    else:
        values = (top.astype(np.int8).astype(np.int16) << 8) | samples[:, :, -2]
    return bytes(values.mean(axis=1).round().astype("<i2").tobytes())


class WavFile:
    """A WAV file to which sounds are added; after each it is whole.

    Raises `SoundError` if it cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        with self._open_file("wb") as file, wave.open(file, "wb") as empty:
            empty.setnchannels(1)
            empty.setsampwidth(2)
            empty.setframerate(RATE)

    def __call__(self, sound: Sound) -> None:
        """Add a sound, and a pause."""
        with self._open_file("r+b") as file:
            file.seek(0, io.SEEK_END)
            file.write(sound.at(RATE).samples + bytes(2 * int(_PAUSE * RATE)))
            size = file.tell()
            for place, rest in ((_FILE_SIZE, 8), (_DATA_SIZE, _HEADER)):
                file.seek(place)
                file.write((size - rest).to_bytes(4, "little"))

    @contextmanager
    def _open_file(self, mode: str) -> Iterator[BinaryIO]:
        try:
            with self._path.open(mode) as file:
                yield cast(BinaryIO, file)
        except OSError as error:
            told = f"{self._path} cannot be written: {error.strerror}"
            raise SoundError(told) from error
