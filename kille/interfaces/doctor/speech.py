"""Check whether the robot can hear and speak."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from importlib.util import find_spec

from kille.interfaces.doctor.findings import DoctorFinding
from kille.interfaces.doctor.packages import pip

_LIMIT = 10
"""Seconds to wait until a sound device is open."""

_SAMPLE = ("-q", "-t", "raw", "-f", "S16_LE", "-r", "16000", "-c", "1", "-s", "1")


def speech() -> Iterator[DoctorFinding]:
    """The requirements of `kille talk --speech`."""
    yield _check_hearing()
    yield _check_speaking()
    heard, played = ("arecord", *_SAMPLE, "/dev/null"), ("aplay", *_SAMPLE, "/dev/zero")
    yield _sound("microphone", heard, "records with --hear device")
    yield _sound("loudspeaker", played, "plays what is spoken")


def _check_hearing() -> DoctorFinding:
    if find_spec("pocketsphinx") is not None:
        return DoctorFinding("hearing", True, False, "pocketsphinx understands English")
    remedy = pip("kille[speech]")
    return DoctorFinding(
        "hearing", False, False, "pocketsphinx is not installed", remedy
    )


def _check_speaking() -> DoctorFinding:
    if shutil.which("espeak-ng") is not None:
        return DoctorFinding(
            "speaking", True, False, "espeak-ng speaks with --say espeak"
        )
    remedy = "sudo apt install espeak-ng"
    return DoctorFinding("speaking", False, False, "espeak-ng is not installed", remedy)


def _sound(part: str, command: Sequence[str], use: str) -> DoctorFinding:
    """Check a sound device by recording or playing one sample."""
    program = command[0]
    if shutil.which(program) is None:
        remedy = "sudo apt install alsa-utils"
        return DoctorFinding(part, False, False, f"{program} is not installed", remedy)
    try:
        done = subprocess.run(command, capture_output=True, timeout=_LIMIT)
    except subprocess.TimeoutExpired:
        state = f"{program} waits for it without end"
        return DoctorFinding(
            part, False, False, state, "unplug it and plug it in again"
        )
    if done.returncode == 0:
        return DoctorFinding(part, True, False, f"{program} {use}")
    told = done.stderr.decode(errors="replace").strip().rpartition("\n")[2]
    # ALSA's programs begin with their name and line: "arecord: main:831: ".
    reason = re.sub(r"^\w+: \w+:\d+: ", "", told) or str(done.returncode)
    state = f"there is none that opens ({reason})"
    remedy = f"connect one, `{program} -l` lists what is there"
    return DoctorFinding(part, False, False, state, remedy)
