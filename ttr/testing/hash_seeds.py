"""Determinism across processes: the same dialogues under other hash seeds.

Sets, dictionaries of objects and addresses come in another order in another process; a
rule that depends on that order gives other states there.
"""

from __future__ import annotations

import hashlib
import subprocess
import sys
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings

from ttr.dialogues.dialogue import Dialogue
from ttr.dialogues.stories import Setting, named_by_user, setting
from ttr.errors import TTRError
from ttr.safety.consent import Consent
from ttr.safety.python_files import separate_python
from ttr.testing.game_settings import tutor_of
from ttr.testing.strategies.random_dialogues import dialogues
from ttr.types.printing import notation

__all__ = ["differing"]

HASH_SEEDS = ("1", "2")


def differing(place: Setting, *, examples: int, start: int) -> str:
    """How the dialogues of two processes differ, or an empty text if they do not.

    The game is one that the user has named. Raises `TTRError` where a process fails.
    """
    one, two = (_printed(place, examples, start, it) for it in HASH_SEEDS)
    for number, (line, other) in enumerate(zip(one, two, strict=False), start=1):
        if line != other:
            return f"dialogue {number} is another in a process with another hash seed"
    return ""


def _printed(place: Setting, examples: int, start: int, hash_seed: str) -> list[str]:
    """What a process of its own prints: a line for each dialogue."""
    named = (place.reference, str(place.folder), str(examples), str(start))
    allowed = map(str, place.consent.folders)
    command, around = separate_python("-m", __name__, *named, *allowed)
    run = subprocess.run(
        command,
        env={**around, "PYTHONHASHSEED": hash_seed},
        capture_output=True,
        text=True,
        check=False,
    )
    if run.returncode:
        told = run.stderr.strip().splitlines() or ["it was stopped"]
        raise TTRError(f"a process that plays {place.reference} failed: {told[-1]}")
    return run.stdout.splitlines()


def main() -> None:
    """Prints a line for each dialogue: a digest of its rules and states."""
    reference, folder, examples, start, *allowed = sys.argv[1:]
    consent = named_by_user(reference, Path(folder), Consent.of(allowed))
    game = setting(reference, Path(folder), consent).game

    @seed(int(start))
    @settings(
        max_examples=int(examples),
        database=None,
        deadline=None,
        phases=(Phase.generate,),
        suppress_health_check=list(HealthCheck),
    )
    @given(dialogues(game, tutor_of(game)))
    def tell(dialogue: Dialogue) -> None:
        sys.stdout.write(f"{digest(dialogue)}\n")

    tell()


def digest(dialogue: Dialogue) -> str:
    """A short text that is the same where the rules and states are."""
    parts = [notation(state) for state in dialogue.states]
    parts += [step.rule.name for step in dialogue.steps]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


if __name__ == "__main__":
    main()
