"""How the robot speaks: a program that turns text into sound, and where that goes."""

from __future__ import annotations

import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from tempfile import TemporaryFile
from typing import Protocol

from kille.speech.sound import Sound, SoundError, WavFile, read_wav

Stop = Callable[[], bool]
"""Whether the robot should fall silent, since somebody speaks over it."""


def never() -> bool:
    """Nobody speaks over the robot."""
    return False


class Voice(Protocol):
    """Speaks a sentence; returns what of it was uttered when it was told to stop."""

    def __call__(self, text: str, stop: Stop = never) -> str:
        """Speak; `stop` is asked some twenty times a second."""
        ...


SYNTHESISERS = {
    "espeak": ("espeak-ng", "-v", "{voice}", "--stdin", "--stdout"),
    "flite": ("flite", "-voice", "rms", "-t", "{text}", "-o", "/dev/stdout"),
}
"""The programs that speak, and how they are asked to write a WAV file."""

_VOICES = {"en": "en-us", "sv": "sv"}
_PLAYER = ("aplay", "-q", "-")
_LIMIT = 60
"""Seconds; whatever program takes longer for a sentence is stopped."""

_CHUNK = 0.05
"""Seconds of sound that are given to the player at once."""

_AHEAD = 0.2
"""Seconds of sound that the player has before it has to play them, at most."""


def voice(how: str, language: str = "en") -> Voice:
    """The voice of this name: espeak, flite, none, or a WAV file that is written.

    Raises `SoundError` where the program it needs is missing.

    >>> voice("none")("Hello.")
    'Hello.'
    """
    if how == "none":
        return silent
    if how.lower().endswith(".wav"):
        program, file = "espeak", WavFile(Path(how))
        target = partial(_write_whole, file)
        return partial(_speak, _check_installed(program), language, target)
    if how not in SYNTHESISERS:
        raise SoundError(
            f"there is no voice {how!r}: choose espeak, flite, none or FILE.wav"
        )
    program = _check_installed(how)
    if shutil.which(_PLAYER[0]) is None:
        raise SoundError(
            "there is no program to play sounds with: apt install alsa-utils, or let "
            "it speak to a file, --say FILE.wav"
        )
    return partial(_speak, program, language, play)


def silent(text: str, stop: Stop = never) -> str:
    """Says nothing: what is said is printed all the same."""
    return text


def uttered_words(text: str, share: float) -> str:
    """The whole words that were uttered of a sentence, of which this share was.

    A letter is taken to last as long as any other.

    >>> uttered_words("This is a cup.", 0.6)
    'This is'
    """
    words = text.split()
    letters = sum(map(len, words)) * min(share, 1.0) + 1e-9
    whole = [
        number
        for number in range(len(words) + 1)
        if sum(map(len, words[:number])) <= letters
    ]
    return text if share >= 1.0 else " ".join(words[: whole[-1]])


def synthesise(text: str, program: str = "espeak", language: str = "en") -> Sound:
    """A text as sound; `SoundError` if the program is missing or fails."""
    command, text = SYNTHESISERS[_check_installed(program)], _spoken_form(text)
    filled = [it.format(voice=_VOICES[language], text=text) for it in command]
    return read_wav(_run_program(filled, text.encode()))


def play(sound: Sound, stop: Stop = never) -> float:
    """Play a sound by ALSA's player, until it ends or is stopped.

    Returns the seconds that were played; raises `SoundError` without a loudspeaker.
    """
    raw = ("-t", "raw", "-f", "S16_LE", "-c", "1", "-r", str(sound.rate))
    command = [*_PLAYER[:-1], *raw, _PLAYER[-1]]
    with _player(command) as (write, leave):
        played = play_chunks(sound, write, stop)
        leave(played < sound.seconds)
    return played


def play_chunks(
    sound: Sound,
    write: Callable[[bytes], object],
    stop: Stop = never,
    *,
    clock: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], object] = time.sleep,
) -> float:
    """Give a sound to a player chunk by chunk, as it is played.

    The player never has more than `_AHEAD` seconds that were not played. Returns how
    many seconds had been played when it was stopped, or all of them.
    """
    start = clock()
    size = 2 * max(1, round(_CHUNK * sound.rate))
    for begin in range(0, len(sound.samples), size):
        while begin / 2 / sound.rate > clock() - start + _AHEAD:
            sleep(_CHUNK)
            if stop():
                return min(clock() - start, sound.seconds)
        if stop():
            return min(clock() - start, begin / 2 / sound.rate)
        write(sound.samples[begin : begin + size])
    while (played := clock() - start) < sound.seconds:
        if stop():
            return played
        sleep(min(_CHUNK, sound.seconds - played))
    return sound.seconds


@contextmanager
def _player(
    command: list[str],
) -> Iterator[tuple[Callable[[bytes], object], Callable[[bool], None]]]:
    """A player: what gives it samples, and what has it leave, at once or when done.

    Raises `SoundError` with its last words if it fails.
    """
    with (
        TemporaryFile() as told,
        subprocess.Popen(
            command, stdin=subprocess.PIPE, stderr=told, bufsize=0
        ) as player,
    ):
        assert player.stdin is not None
        samples = player.stdin

        def leave(at_once: bool) -> None:
            if at_once:
                player.kill()
                return
            samples.close()
            if player.wait(_LIMIT):
                told.seek(0)
                raise _failure(command, told.read(), player.returncode)

        try:
            yield samples.write, leave
        except (BrokenPipeError, subprocess.TimeoutExpired):
            with suppress(subprocess.TimeoutExpired):
                player.wait(1)
            told.seek(0)
            raise _failure(command, told.read(), player.returncode) from None
        finally:
            player.kill()


def _write_whole(file: WavFile, sound: Sound, stop: Stop) -> float:
    """Write a sound to a file, which nobody can speak over."""
    file(sound)
    return sound.seconds


def _speak(
    program: str,
    language: str,
    target: Callable[[Sound, Stop], float],
    text: str,
    stop: Stop = never,
) -> str:
    if stop():
        return ""
    sound = synthesise(text, program, language)
    return uttered_words(text, target(sound, stop) / (sound.seconds or 1.0))


def _spoken_form(text: str) -> str:
    """A sentence as it is spoken: "#2" is "number 2", quotation marks are silent."""
    return re.sub(r"#(\d)", r"number \1", text).replace('"', "")


def _check_installed(program: str) -> str:
    command = SYNTHESISERS[program][0]
    if shutil.which(command) is None:
        raise SoundError(f"{command} is not installed: apt install {command}")
    return program


def _run_program(command: list[str], given: bytes) -> bytes:
    """What a program writes; `SoundError` with its last words if it fails."""
    try:
        done = subprocess.run(
            command, input=given, capture_output=True, check=True, timeout=_LIMIT
        )
    except subprocess.TimeoutExpired:
        raise SoundError(f"{command[0]} has not ended after {_LIMIT} seconds") from None
    except subprocess.CalledProcessError as error:
        raise _failure(command, error.stderr, error.returncode) from error
    return done.stdout


def _failure(command: list[str], told: bytes, code: int | None) -> SoundError:
    """The error of a program that has failed: its last words, or its exit code."""
    lines = told.decode(errors="replace").strip().splitlines()
    return SoundError(
        f"{command[0]} failed ({lines[-1] if lines else code}): without a loudspeaker, "
        "let it speak to a file, --say FILE.wav"
    )
