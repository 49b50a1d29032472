"""Determinism across processes: the same dialogues under different hash seeds.

The order of sets, and of objects by their addresses, differs between processes; a rule
that depends on that order gives other states in another process.
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

HASH_SEEDS = ("1", "2")


def first_difference(place: Setting, *, examples: int, start: int) -> str:
    """The first dialogue that differs between two processes; empty if none does.

    The game is one that the user has named. Raises `TTRError` if a process fails.
    """
    one, two = (_digests_in_process(place, examples, start, it) for it in HASH_SEEDS)
    for number, (line, other) in enumerate(zip(one, two, strict=False), start=1):
        if line != other:
            return f"dialogue {number} differs in a process with another hash seed"
    return ""


def _digests_in_process(
    place: Setting, examples: int, start: int, hash_seed: str
) -> list[str]:
    """The digests of the dialogues that a process with this hash seed plays."""
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
        lines = run.stderr.strip().splitlines() or ["it was stopped"]
        raise TTRError(f"a process that plays {place.reference} failed: {lines[-1]}")
    return run.stdout.splitlines()


def main() -> None:
    """Print a digest of each dialogue, on a line of its own."""
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
    """A short text that is the same for dialogues with the same rules and states."""
    parts = [notation(state) for state in dialogue.states]
    parts += [step.rule.name for step in dialogue.steps]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


if __name__ == "__main__":
    main()
