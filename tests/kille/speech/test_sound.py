"""Sounds come from WAV files of any kind, and keep their length and pitch."""

from __future__ import annotations

import io
import wave
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.speech.sound import RATE, Sound, SoundError, WavFile, read_wav
from ttr.safety.limits import Limit


def wav(samples: bytes, rate: int, width: int, channels: int) -> bytes:
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(channels)
        file.setsampwidth(width)
        file.setframerate(rate)
        file.writeframes(samples)
    return out.getvalue()


@pytest.mark.parametrize("rate", [8_000, 16_000, 22_050, 44_100, 48_000])
def test_a_tone_keeps_its_pitch_at_any_rate(rate: int) -> None:
    t = np.arange(rate) / rate
    tone = (8_000 * np.sin(2 * np.pi * 440 * t)).astype("<i2")
    heard = read_wav(wav(tone.tobytes(), rate, 2, 1)).at(RATE)
    assert heard.seconds == pytest.approx(1)
    values = np.frombuffer(heard.samples, "<i2")
    assert np.abs(np.fft.rfft(values)).argmax() == 440
    assert np.abs(values).max() == pytest.approx(8_000, rel=0.05)


@given(st.lists(st.integers(-32768, 32767), min_size=1, max_size=50))
def test_widths_and_channels_make_no_difference(values: list[int]) -> None:
    plain = np.array(values, "<i2")
    stereo = np.repeat(plain, 2).tobytes()
    wide = (plain.astype("<i4") << 16).tobytes()
    assert read_wav(wav(plain.tobytes(), RATE, 2, 1)).samples == plain.tobytes()
    assert read_wav(wav(stereo, RATE, 2, 2)).samples == plain.tobytes()
    assert read_wav(wav(wide, RATE, 4, 1)).samples == plain.tobytes()


def test_eight_bits_have_no_sign() -> None:
    heard = read_wav(wav(bytes([128, 255, 0]), RATE, 1, 1))
    assert np.frombuffer(heard.samples, "<i2").tolist() == [0, 127 * 256, -32768]


def test_a_file_is_whole_after_each_sound(tmp_path: Path) -> None:
    path = tmp_path / "said.wav"
    file = WavFile(path)
    file(Sound(RATE, bytes(2 * RATE)))
    assert read_wav(path).seconds == pytest.approx(1.4)
    file(Sound(8_000, bytes(16_000)))
    assert read_wav(path).seconds == pytest.approx(2.8)


@pytest.mark.parametrize("junk", [b"", b"RIFF", b"no sound at all", bytes(100)])
def test_what_is_no_sound_is_told(junk: bytes) -> None:
    with pytest.raises(SoundError, match="is not a WAV file"):
        read_wav(junk)


@pytest.mark.parametrize("rate", [1, 999, 10**6])
def test_a_rate_that_nothing_is_recorded_at_is_refused(
    tmp_path: Path, rate: int
) -> None:
    path = tmp_path / "a.wav"
    with wave.open(str(path), "wb") as file:
        file.setparams((1, 2, rate, 0, "NONE", ""))
        file.writeframes(bytes(2000))
    with pytest.raises(SoundError, match=f"it has {rate} samples a second"):
        read_wav(path)


def test_a_sound_is_no_longer_than_it_may_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.wav"
    with wave.open(str(path), "wb") as file:
        file.setparams((1, 2, RATE, 0, "NONE", ""))
        file.writeframes(bytes(2 * RATE * 3))
    assert read_wav(path).seconds == 3
    monkeypatch.setattr("kille.speech.sound.SOUND", Limit(2, "seconds"))
    with pytest.raises(SoundError, match="it has 3 seconds, and no more than 2"):
        read_wav(path)


def test_a_long_sound_keeps_its_length_at_another_rate() -> None:
    seconds = 250
    assert Sound(8_000, bytes(2 * 8_000 * seconds)).at(RATE).seconds == seconds
    assert Sound(400_000, bytes(2)).at(RATE).samples == b""
