"""Determinism across processes: the same dialogues under other hash seeds.

Sets, dictionaries of objects and addresses come in another order in another process; a
rule that depends on that order gives other states there.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings

from ttr.errors import TTRError
from ttr.printing import notation
from ttr.stories import setting
from ttr.strategies.dialogues import dialogues
from ttr.strategies.playing import Dialogue
from ttr.testing.companions import tutor_of

__all__ = ["differing"]

HASH_SEEDS = ("1", "2")


def differing(reference: str, folder: Path, *, examples: int, start: int) -> str:
    """How the dialogues of two processes differ, or an empty text if they do not.

    Raises `TTRError` where a process fails.
    """
    one, two = (
        _printed(reference, folder, examples, start, hash_seed)
        for hash_seed in HASH_SEEDS
    )
    for number, (line, other) in enumerate(zip(one, two, strict=False), start=1):
        if line != other:
            return f"dialogue {number} is another in a process with another hash seed"
    return ""


def _printed(
    reference: str, folder: Path, examples: int, start: int, hash_seed: str
) -> list[str]:
    """What a process of its own prints: a line for each dialogue."""
    command = [sys.executable, "-m", __name__, reference, str(folder)]
    run = subprocess.run(
        [*command, str(examples), str(start)],
        env={**os.environ, "PYTHONHASHSEED": hash_seed},
        capture_output=True,
        text=True,
        check=False,
    )
    if run.returncode:
        told = run.stderr.strip().splitlines() or ["it was stopped"]
        raise TTRError(f"a process that plays {reference} failed: {told[-1]}")
    return run.stdout.splitlines()


def main() -> None:
    """Prints a line for each dialogue: a digest of its rules and states."""
    reference, folder, examples, start = sys.argv[1:]
    game = setting(reference, Path(folder)).game

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
