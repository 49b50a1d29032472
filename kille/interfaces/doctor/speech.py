"""Whether the robot can hear and speak."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from importlib.util import find_spec

from kille.interfaces.doctor.finding import Finding

__all__ = ["speech"]

_PROGRAMS = {
    "espeak-ng": ("speaking", "espeak-ng", "speaks with --say espeak"),
    "arecord": ("microphone", "alsa-utils", "records with --hear device"),
    "aplay": ("loudspeaker", "alsa-utils", "plays what is spoken"),
}


def speech() -> Iterator[Finding]:
    """What `kille talk --speech` needs."""
    if find_spec("pocketsphinx") is None:
        remedy = "pip install 'pocketsphinx>=5'"
        yield Finding("hearing", False, False, "pocketsphinx is not installed", remedy)
    else:
        yield Finding("hearing", True, False, "pocketsphinx, English")
    for program, (part, package, use) in _PROGRAMS.items():
        if shutil.which(program) is None:
            state, remedy = f"{program} is not installed", f"apt install {package}"
            yield Finding(part, False, False, state, remedy)
        else:
            yield Finding(part, True, False, f"{program} {use}")
