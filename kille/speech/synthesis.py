"""How the robot speaks: a program that turns text into sound, and where that goes."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from functools import partial
from pathlib import Path

from kille.speech.sound import Sound, SoundError, WavFile, read_wav

Voice = Callable[[str], None]
"""Speaks a sentence, and comes back when it is spoken."""

SYNTHESISERS = {
    "espeak": ("espeak-ng", "-v", "{voice}", "--stdin", "--stdout"),
    "flite": ("flite", "-voice", "rms", "-t", "{text}", "-o", "/dev/stdout"),
}
"""The programs that speak, and how they are asked to write a WAV file."""

_VOICES = {"en": "en-us", "sv": "sv"}
_PLAYER = ("aplay", "-q", "-")
_LIMIT = 60
"""Seconds; whatever program takes longer for a sentence is stopped."""


def voice(how: str, language: str = "en") -> Voice:
    """The voice of this name: espeak, flite, none, or a WAV file that is written.

    Raises `SoundError` where the program it needs is missing.

    >>> voice("none")("Hello.")
    """
    if how == "none":
        return silent
    if how.lower().endswith(".wav"):
        program, target = "espeak", WavFile(Path(how))
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


def silent(text: str) -> None:
    """Says nothing: what is said is printed all the same."""


def synthesise(text: str, program: str = "espeak", language: str = "en") -> Sound:
    """A text as sound; `SoundError` if the program is missing or fails."""
    command = SYNTHESISERS[_check_installed(program)]
    filled = [it.format(voice=_VOICES[language], text=text) for it in command]
    return read_wav(_run_program(filled, text.encode()))


def play(sound: Sound) -> None:
    """Play a sound by ALSA's player; `SoundError` without a loudspeaker."""
    raw = ("-t", "raw", "-f", "S16_LE", "-c", "1", "-r", str(sound.rate))
    _run_program([*_PLAYER[:-1], *raw, _PLAYER[-1]], sound.samples)


def _speak(
    program: str, language: str, target: Callable[[Sound], None], text: str
) -> None:
    target(synthesise(_spoken_form(text), program, language))


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
        told = error.stderr.decode(errors="replace").strip().splitlines()
        raise SoundError(
            f"{command[0]} failed ({told[-1] if told else error.returncode}): without "
            "a loudspeaker, let it speak to a file, --say FILE.wav"
        ) from error
    return done.stdout
