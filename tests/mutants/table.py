"""Prints which properties find which mutants, as a table in Markdown.

Run it with `python tests/mutants/table.py [DIALOGUES [MUTANTS]]`: so many dialogues
for each of the mutants with this in their names.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from hypothesis import HealthCheck, Phase, Verbosity, given, seed, settings
from hypothesis.errors import Flaky

sys.path.append(str(Path(__file__).parent))

from mutants import GAMES, MUTANTS, Mutant, properties_of

from ttr.testing import ALL, Coverage, Dialogue
from ttr.testing.strategies import dialogues
from ttr.updates.checks import faults_of

DIALOGUES = 200
STATIC = "static"
NAMES = (STATIC, *sorted((one.name for one in ALL), key=lambda name: int(name[1:])))


def killers(mutant: Mutant, count: int) -> set[str]:
    """What finds the mutant: the static checks, and properties by their names."""
    game, beside = mutant.made, GAMES[mutant.game]
    properties = properties_of(mutant.game)
    found = {STATIC} if faults_of(game) else set()
    coverage = Coverage(game)

    @seed(0)
    @settings(
        max_examples=count,
        database=None,
        deadline=None,
        phases=(Phase.generate,),
        verbosity=Verbosity.quiet,
        suppress_health_check=list(HealthCheck),
    )
    @given(dialogues(game, beside.tutor))
    def look(dialogue: Dialogue) -> None:
        coverage.add(dialogue)
        for one in properties:
            if one.name not in found and one.breach(dialogue, beside.roles):
                found.add(one.name)

    try:
        look()
    except Flaky:
        found.add("P3")
    return found | {
        one.name for one in properties if one.overall and one.overall(coverage)
    }


def table(count: int, named: str) -> Iterator[str]:
    """The lines of the table, a mutant each."""
    yield f"| mutant | slip | {' | '.join(NAMES)} |"
    yield f"| --- | --- |{' :-: |' * len(NAMES)}"
    by_name = dict.fromkeys(NAMES, 0)
    total = played = 0
    for mutant in MUTANTS:
        if named not in str(mutant):
            continue
        by = killers(mutant, count)
        total += 1
        played += bool(by - {STATIC})
        for name in by:
            by_name[name] += 1
        marks = " | ".join("✗" if name in by else "" for name in NAMES)
        yield f"| {mutant} | {mutant.slip} | {marks} |"
    counts = " | ".join(str(by_name[name]) for name in NAMES)
    yield f"| **found by playing: {played} of {total}** | | {counts} |"


if __name__ == "__main__":
    asked = sys.argv[1:]
    count = int(asked[0]) if asked else DIALOGUES
    for line in table(count, asked[1] if asked[1:] else ""):
        print(line, flush=True)
