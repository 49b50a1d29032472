"""Looking for a dialogue with something wrong with it, among many that are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from hypothesis import HealthCheck, Phase, Verbosity, given, seed, settings
from hypothesis import strategies as st
from hypothesis.errors import Flaky

from ttr.dialogues.dialogue import Dialogue
from ttr.errors import TTRError
from ttr.testing.shrinking import Broken, Verdict, shortest

__all__ = ["DRAWN", "DRAWN_AND_SHRUNK", "Unsteady", "how_many", "search"]

Why = TypeVar("Why")

DRAWN = (Phase.generate,)
"""Dialogues that begin where the game does: what is found is made shorter here."""

DRAWN_AND_SHRUNK = (Phase.generate, Phase.shrink)
"""Dialogues of which more is drawn, as where they begin: Hypothesis shrinks that."""


def how_many(examples: int | None) -> int:
    """As many as are asked for, else as the Hypothesis profile says; from 1 on.

    >>> how_many(20)
    20
    """
    if examples is None:
        count: int = settings().max_examples
        return count
    if not isinstance(examples, int) or examples < 1:
        raise TTRError(f"examples= is a number from 1 on, found {examples!r}")
    return examples


class _Stop(Exception):
    """Something is wrong with the dialogue that was drawn."""


class Unsteady(Exception):
    """A dialogue that was not the same when it was drawn once more."""

    def __init__(self, dialogue: Dialogue) -> None:
        super().__init__("a dialogue is not the same when it is drawn once more")
        self.dialogue = dialogue


def search(
    drawn: st.SearchStrategy[Dialogue],
    counted: Verdict[Why],
    verdict: Verdict[Why],
    *,
    examples: int,
    start: int,
    phases: Sequence[Phase] = DRAWN,
) -> Broken[Why] | None:
    """The shortest dialogue found with something wrong with it, of so many drawn.

    `counted` is the verdict on what is drawn, `verdict` the same on what is made of it
    while it is made shorter. The same `start` of the random numbers draws the same
    dialogues. Raises `Unsteady` where they are not the same within one search.
    """
    found: list[Broken[Why]] = []
    seen: list[Dialogue] = []

    @seed(start)
    @settings(
        max_examples=examples,
        database=None,
        deadline=None,
        phases=phases,
        report_multiple_bugs=False,
        verbosity=Verbosity.quiet,
        suppress_health_check=list(HealthCheck),
    )
    @given(drawn)
    def look(dialogue: Dialogue) -> None:
        seen[:] = [dialogue]
        why = verdict(dialogue) if found else counted(dialogue)
        if why is not None:
            found[:] = [Broken(dialogue, why)]
            raise _Stop

    # What is found is made shorter when the exception is over, so that no failure that
    # is raised then comes "during the handling of another".
    try:
        look()
    except _Stop:
        pass
    except Flaky as error:
        if not found:
            raise Unsteady(*seen) from error
    return shortest(found[0], verdict) if found else None
