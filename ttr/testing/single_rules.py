"""Applying rules by themselves, where a step of a dialogue began."""

from __future__ import annotations

from ttr.errors import TTRError
from ttr.types.syntax import Record
from ttr.updates.algorithms import maybe, seq
from ttr.updates.games import Game
from ttr.updates.rules import Rule
from ttr.updates.running import Run, Step, run

__all__ = ["applied", "rerun"]


def applied(game: Game, step: Step, *rules: Rule) -> Run | None:
    """These rules, in this order, each if it applies, where a step began.

    None where one of them fails, or none applies.
    """
    algorithm = seq(*map(maybe, rules))
    events = () if step.given is None else (step.given,)
    try:
        after = run(
            algorithm, step.before, type=game.type, model=step.model, events=events
        )
    except TTRError:
        return None
    return after if after.trace else None


def rerun(step: Step, game: Game) -> Record | None:
    """The state that the rule of a step gives when it is applied once more, if any."""
    after = applied(game, step, step.rule)
    return None if after is None else after.state
