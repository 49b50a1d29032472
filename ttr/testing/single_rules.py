"""Applying single rules again to the state before a step of a dialogue."""

from __future__ import annotations

from ttr.errors import TTRError
from ttr.types.objects import Record
from ttr.updates.games import Game
from ttr.updates.rules import Rule
from ttr.updates.running import Run, Step, run
from ttr.updates.update_strategies import maybe, seq


def apply_rules(game: Game, step: Step, *rules: Rule) -> Run | None:
    """Apply these rules in this order, each if it can be, to the state before a step.

    None if one of them fails, or if none applies.
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


def state_when_rerun(step: Step, game: Game) -> Record | None:
    """The state that the rule of a step gives when it is applied again, if any."""
    after = apply_rules(game, step, step.rule)
    return None if after is None else after.state
