"""How the robot speaks, and falls silent when somebody speaks over it."""

from __future__ import annotations

import os
import shutil
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.speech.sound import Sound, SoundError
from kille.speech.synthesis import (
    SYNTHESISERS,
    play,
    play_chunks,
    synthesise,
    uttered_words,
    voice,
)

RATE = 8_000


class Clock:
    """A clock that only sleeping moves."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


def play_until(seconds: float, stop_at: float) -> tuple[float, float]:
    """How much of a sound is played, and was given to the player, if stopped then."""
    clock, given_ = Clock(), bytearray()
    sound = Sound(RATE, bytes(2 * round(RATE * seconds)))
    done = play_chunks(
        sound,
        given_.extend,
        lambda: clock.now >= stop_at,
        clock=clock,
        sleep=clock.sleep,
    )
    return done, len(given_) / 2 / RATE


def test_a_sound_that_nobody_stops_is_played_to_its_end() -> None:
    assert play_until(1.0, 99.0) == (1.0, 1.0)
    assert play_until(0.0, 99.0) == (0.0, 0.0)


@given(st.floats(0.1, 5.0), st.floats(0.0, 4.9))
def test_a_sound_that_is_stopped_has_been_played_till_then(
    seconds: float, stop_at: float
) -> None:
    done, given_ = play_until(seconds, stop_at)
    assert done <= given_ + 1e-6
    assert given_ <= done + 0.3
    assert abs(done - min(stop_at, seconds)) < 0.11 or given_ < stop_at


@given(st.text("ab ", max_size=30), st.floats(0.0, 1.0))
def test_what_was_uttered_begins_the_sentence(text: str, share: float) -> None:
    words = uttered_words(text, share).split()
    assert text.split()[: len(words)] == words
    assert uttered_words(text, 1.0) == text
    more = uttered_words(text, min(1.0, share + 0.2)).split()
    assert more[: len(words)] == words


def test_nothing_was_uttered_at_the_beginning() -> None:
    assert uttered_words("This is a cup.", 0.0) == ""


PLAYER = """#!/bin/sh
cat > {heard}
"""

LONG = "This is a cup, and this is a book, and that over there is a box."


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A player that keeps what it has to play in a file, and where that is."""
    heard = tmp_path / "heard.raw"
    program = tmp_path / "aplay"
    program.write_text(PLAYER.format(heard=heard))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    return heard


def test_a_player_that_is_stopped_has_had_little_more_than_was_played(
    player: Path,
) -> None:
    sound = Sound(RATE, bytes(2 * RATE * 20))
    start = time.monotonic()
    asked = iter([False] * 5 + [True] * 99)
    done = play(sound, lambda: next(asked))
    assert time.monotonic() - start < 10.0
    assert done < 5.0
    assert player.stat().st_size / 2 / RATE < done + 1.0


@pytest.mark.skipif(
    all(shutil.which(it[0]) is None for it in SYNTHESISERS.values()),
    reason="nothing to speak with",
)
@pytest.mark.parametrize("program", SYNTHESISERS)
def test_a_real_voice_is_stopped_in_the_middle(program: str, player: Path) -> None:
    if shutil.which(SYNTHESISERS[program][0]) is None:
        pytest.skip(f"{program} is not installed")
    speak = voice(program)
    whole = synthesise(LONG, program).seconds
    ends = time.monotonic() + whole / 3 + 1.0
    uttered = speak(LONG, lambda: time.monotonic() > ends)
    assert LONG.startswith(uttered)
    assert uttered != LONG
    assert speak("Hi.", lambda: True) == ""
    assert speak("Hi.") == "Hi."


def test_a_player_that_fails_is_told_in_a_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "aplay"
    program.write_text("#!/bin/sh\necho no such card >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    with pytest.raises(SoundError, match="aplay failed") as caught:
        play(Sound(RATE, bytes(2 * RATE)))
    assert "(no such card)" in str(caught.value)


def test_into_a_file_it_speaks_to_the_end(tmp_path: Path) -> None:
    if shutil.which("espeak-ng") is None:
        pytest.skip("espeak-ng is not installed")
    speak = voice(str(tmp_path / "a.wav"))
    assert speak("Hello.", lambda: False) == "Hello."
