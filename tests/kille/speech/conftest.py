"""What the tests of speech share: a voice for the tutor, and a recogniser."""

from __future__ import annotations

import io
import subprocess
import wave
from collections.abc import Callable
from functools import cache
from shutil import which

import pytest

from kille.dialogue.meanings import sign
from kille.speech.expectations import expected_speech, speech
from kille.speech.recognition import Recogniser
from kille.speech.sound import RATE, read_wav

KNOWN = (
    *(sign(it, "noun") for it in ("cup", "book", "box", "apple", "ball", "mug")),
    *(sign(it, "adjective") for it in ("red", "blue", "green")),
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if {"spoken", "recogniser"} & set(getattr(item, "fixturenames", ())):
            item.add_marker("speech")


@pytest.fixture(scope="session")
def spoken() -> Callable[..., bytes]:
    """A tutor's voice: a sentence, spoken by flite, as samples at 16 kHz."""
    for program in ("flite", "espeak-ng"):
        if which(program) is None:
            pytest.skip(f"no {program} here: apt install {program}")

    @cache
    def said(text: str, voice: str = "rms") -> bytes:
        command = ["flite", "-voice", voice, "-t", text, "-o", "/dev/stdout"]
        done = subprocess.run(command, capture_output=True, check=True)
        margin = bytes(RATE * 2 // 5)
        return margin + read_wav(done.stdout).at(RATE).samples + margin

    return said


@pytest.fixture(scope="session")
def recogniser() -> Recogniser:
    """A recogniser that expects what may be said with the words of `KNOWN`."""
    pytest.importorskip("pocketsphinx")
    made = Recogniser(speech())
    made.expect(expected_speech(KNOWN))
    return made


@pytest.fixture(scope="session")
def lesson(spoken: Callable[..., bytes]) -> Callable[..., bytes]:
    """A WAV file of several sentences, with pauses between them."""

    def said(*texts: str) -> bytes:
        pause = bytes(2 * RATE)
        out = io.BytesIO()
        with wave.open(out, "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(RATE)
            file.writeframes(b"".join(spoken(it) + pause for it in texts))
        return out.getvalue()

    return said
