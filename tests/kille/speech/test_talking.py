"""A whole lesson through sound: the tutor is heard, and the robot's answers spoken."""

from __future__ import annotations

import io
import os
import pty
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from select import select

import pytest

from kille.interfaces.cli import main
from kille.interfaces.speech_input import SpeechInput
from kille.speech.listening import punctuate
from kille.speech.sound import RATE, Sound, SoundError, WavFile, read_wav

Lesson = Callable[..., bytes]

SCENE = "synthetic:empty?seed=7"


@pytest.fixture
def talk(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> Callable[..., tuple[int, str, str]]:
    def run(*options: str, sensor: str = SCENE) -> tuple[int, str, str]:
        memory = str(tmp_path / "m.db")
        code = main(["talk", "--sensor", sensor, "--memory", memory, *options])
        told = capsys.readouterr()
        return code, told.out, told.err

    return run


def test_a_lesson_is_heard_and_answered(
    talk: Callable[..., tuple[int, str, str]], lesson: Lesson, tmp_path: Path
) -> None:
    heard, answers = tmp_path / "tutor.wav", tmp_path / "robot.wav"
    texts = ("This is a cup.", "The red one.", "What is this?", "Goodbye.")
    heard.write_bytes(lesson(*texts))
    code, out, _ = talk(
        "--hear", str(heard), "--say", str(answers), sensor="synthetic?seed=7"
    )
    assert code == 0
    said = [line for line in out.splitlines() if line[:3] in ("U> ", "S> ")]
    assert said == [
        "U> This is a cup.",
        "S> Do you mean the violet one, the white one or the red one?",
        "U> The red one.",
        "S> OK, the one on the right (#2) is a cup.",
        "U> What is this?",
        "S> This is a cup.",
        "U> Goodbye.",
        "S> Goodbye.",
    ]
    spoken = read_wav(answers)
    assert spoken.rate == RATE
    assert spoken.seconds > 3


def test_a_pipe_of_samples_is_heard(
    talk: Callable[..., tuple[int, str, str]],
    lesson: Lesson,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    samples = bytes(RATE) + read_wav(lesson("Hello.", "Goodbye.")).samples
    pipe = io.TextIOWrapper(io.BytesIO(samples))
    monkeypatch.setattr(sys, "stdin", pipe)
    code, out, _ = talk("--hear", "-")
    assert code == 0
    assert "U> Hello.\nS> Hello.\nU> Goodbye.\nS> Goodbye.\n" in out


def test_other_talk_is_not_understood_and_the_talk_goes_on(
    talk: Callable[..., tuple[int, str, str]], lesson: Lesson, tmp_path: Path
) -> None:
    heard = tmp_path / "tutor.wav"
    heard.write_bytes(lesson("Elephants never forget their friends.", "Goodbye."))
    code, out, _ = talk("--hear", str(heard))
    assert code == 0
    assert "S> Sorry, I did not understand.\nU> Goodbye." in out


def test_a_sound_in_which_nobody_speaks_is_told(
    talk: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    pytest.importorskip("pocketsphinx")
    silence = tmp_path / "silence.wav"
    WavFile(silence)(Sound(RATE, bytes(4 * RATE)))
    code, _, complaint = talk("--hear", str(silence))
    assert code == 2
    assert complaint == f"kille: nobody speaks in {silence}: is it the right sound?\n"


RECORDER = """#!/bin/sh
for it in {folder}/*.raw; do
    mv "$it" {folder}/now && exec cat {folder}/now
done
"""


class Terminal:
    """A program at a terminal, of which what appears is waited for."""

    def __init__(self, command: list[str], path: str) -> None:
        self._end, other = pty.openpty()
        self._shown = ""
        with os.fdopen(other, "r+b", buffering=0) as slave:
            self._running = subprocess.Popen(
                command,
                stdin=slave,
                stdout=slave,
                stderr=slave,
                env={**os.environ, "PATH": path, "TERM": "dumb"},
            )

    def shows(self, text: str) -> None:
        """Wait until this appears after all that was waited for."""
        while text not in self._shown:
            assert select([self._end], [], [], 60)[0], self._shown
            self._shown += os.read(self._end, 4096).decode()
        self._shown = self._shown.partition(text)[2]

    def types(self, keys: str) -> None:
        """Press keys, when it is ready for them."""
        self.shows("(Enter to speak, or type)")
        os.write(self._end, keys.encode())

    def close(self) -> int:
        """End it if it has not ended; the exit code."""
        try:
            return self._running.wait(60)
        finally:
            self._running.kill()
            os.close(self._end)


def test_a_tutor_at_a_terminal_presses_enter_and_speaks(
    spoken: Callable[..., bytes], tmp_path: Path
) -> None:
    pytest.importorskip("pocketsphinx")
    for number, text in enumerate(("This is a cup.", "What is this?"), start=1):
        sound = tmp_path / f"{number}.raw"
        sound.write_bytes(bytes(RATE) + spoken(text) + bytes(4 * RATE))
    recorder = tmp_path / "arecord"
    recorder.write_text(RECORDER.format(folder=tmp_path))
    recorder.chmod(0o755)
    command = [sys.executable, "-m", "kille.interfaces.cli", "talk", "--hear", "device"]
    options = ["--sensor", SCENE, "--memory", str(tmp_path / "m.db")]
    terminal = Terminal([*command, *options], f"{tmp_path}:{os.environ['PATH']}")
    terminal.types("@ show cup\n")
    terminal.shows("One thing is in view")
    terminal.types("\n")
    terminal.shows("U> This is a cup.")
    terminal.shows("S> OK, I learned a cup.")
    terminal.types("\n")
    terminal.shows("S> This is a cup.")
    terminal.types("\n")
    terminal.shows("kille: nothing can be recorded")
    terminal.types("Goodbye.\n")
    terminal.shows("S> Goodbye.")
    assert terminal.close() == 0


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--hear", "no-such.wav"), "no-such.wav cannot be read"),
        (("--hear", __file__), "is not a WAV file"),
        (("--lang", "sv", "--hear", "device"), "only English can be heard"),
        (("--barge-in",), "--barge-in needs an open microphone: --hear always"),
        (("--hear", "device", "--barge-in"), "--barge-in needs an open microphone"),
        (("--say", "opera"), "there is no voice 'opera'"),
        (("--say", "no/such/folder.wav"), "cannot be written"),
    ],
)
def test_what_cannot_be_is_told_in_one_line(
    talk: Callable[..., tuple[int, str, str]], options: tuple[str, ...], told: str
) -> None:
    code, _, complaint = talk(*options)
    assert code == 2
    assert told in complaint
    assert len(complaint.strip().splitlines()) == 1


def test_a_recording_is_not_overwritten_by_the_answers(
    talk: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    heard = tmp_path / "tutor.wav"
    heard.write_bytes(b"a lesson")
    code, _, complaint = talk("--hear", str(heard), "--say", f"{tmp_path}/./tutor.wav")
    assert code == 2
    assert "give --say another file" in complaint
    assert heard.read_bytes() == b"a lesson"


def test_what_is_heard_is_written_as_a_sentence() -> None:
    assert punctuate("isn't this a cup") == "Isn't this a cup?"
    assert punctuate("no it is a mug") == "No it is a mug."


def test_ears_hear_only_what_there_is_a_model_for() -> None:
    with pytest.raises(SoundError, match="only English"):
        SpeechInput("device", "sv")
