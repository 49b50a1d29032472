"""Utterances are parted by pauses, in files and pipes of any length."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import pytest

from kille.speech.recognition import Recogniser
from kille.speech.sound import RATE, SoundError
from kille.speech.utterances import (
    LONGEST,
    SpokenOver,
    from_file,
    from_microphone,
    from_pipe,
)

pytest.importorskip("pocketsphinx")

FRAME = 960
"""Bytes that the detector of voices takes at once."""


@pytest.mark.parametrize("size", [0, 1, FRAME, 10 * FRAME, 10 * FRAME + 3])
def test_silence_of_any_length_holds_no_utterance(size: int) -> None:
    assert list(from_pipe(io.BytesIO(bytes(size)))) == []


def test_utterances_are_parted_by_pauses(
    lesson: Callable[..., bytes], tmp_path: Path
) -> None:
    path = tmp_path / "said.wav"
    path.write_bytes(lesson("This is a cup.", "No, it is a mug.", "Thank you."))
    assert len(list(from_file(path))) == 3


def test_speech_at_the_very_end_is_heard(spoken: Callable[..., bytes]) -> None:
    sound = spoken("This is a cup.")
    cut = sound[: 2 * RATE * 3 // 2]
    assert len(list(from_pipe(io.BytesIO(bytes(RATE) + cut)))) == 1


def test_a_voice_without_end_is_cut(spoken: Callable[..., bytes]) -> None:
    voice = spoken("The book is to the left of the box.")[RATE : 3 * RATE]
    found = list(from_pipe(io.BytesIO(voice * 30)))
    assert len(found) > 1
    assert all(len(it) / 2 / RATE < LONGEST + 2 for it in found)


def test_without_a_recorder_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(SoundError, match="apt install alsa-utils"):
        from_microphone()


@pytest.fixture
def recorder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[[str], None]:
    """Has a script in place of the recorder of sounds."""

    def made(script: str) -> None:
        path = tmp_path / "arecord"
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)
        monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")

    return made


def test_who_presses_enter_and_says_nothing_is_not_waited_for(
    recorder: Callable[[str], None],
) -> None:
    recorder("exec cat /dev/zero")
    assert from_microphone(5.0) == b""


def test_a_recorder_may_complain_without_end_and_record(
    recorder: Callable[[str], None], spoken: Callable[..., bytes], tmp_path: Path
) -> None:
    sound = tmp_path / "said.raw"
    sound.write_bytes(bytes(RATE) + spoken("This is a cup.") + bytes(4 * RATE))
    recorder(f"yes overrun! | head -c 300000 >&2; exec cat {sound}")
    assert len(from_microphone()) > RATE


def test_a_recorder_that_fails_is_told_in_its_words(
    recorder: Callable[[str], None],
) -> None:
    recorder("echo 'no soundcards found' >&2")
    with pytest.raises(SoundError, match="no soundcards found"):
        from_microphone()


class Recording:
    """A sound that is recorded while a clock goes on."""

    def __init__(self, samples: bytes) -> None:
        self.samples, self.seconds, self._at = samples, 0.0, 0

    def read_recorded(self) -> bytes:
        """What has come since it was last asked."""
        return self.read(2 * int(self.seconds * RATE) - self._at)

    def read(self, size: int) -> bytes:
        """The next samples, however long they take."""
        piece = self.samples[self._at : self._at + max(0, size)]
        self._at += len(piece)
        return piece


def test_who_speaks_over_the_robot_is_noticed_soon_and_heard_whole(
    spoken: Callable[..., bytes], recogniser: Recogniser
) -> None:
    said = spoken("What is this?")
    recording = Recording(bytes(4 * RATE) + said + bytes(4 * RATE))
    spoken_over = SpokenOver(recording.read_recorded, recording.read)
    while recording.seconds < 1.9:
        assert not spoken_over()
        recording.seconds += 0.05
    while not spoken_over():
        recording.seconds += 0.05
        assert recording.seconds < 3.5
    heard = spoken_over.utterance()
    assert len(heard) > 0.7 * len(said)
    assert recogniser.hear(heard)[0].text == "what is this"


def test_silence_is_not_taken_for_somebody_who_speaks() -> None:
    recording = Recording(bytes(2 * RATE * 10))
    spoken_over = SpokenOver(recording.read_recorded, recording.read)
    for _ in range(100):
        recording.seconds += 0.1
        assert not spoken_over()
