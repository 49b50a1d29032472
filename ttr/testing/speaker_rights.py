"""Who says it is who may: P24."""

from __future__ import annotations

from ttr.dialogues.dialogue import Dialogue
from ttr.testing.event_subjects import agents_of, field_at, speaker_of
from ttr.testing.properties import Checked, Property
from ttr.testing.strategies.discourse_roles import Roles, at
from ttr.types.syntax import Record, Singleton
from ttr.updates.games import Game
from ttr.updates.running import Step

__all__ = ["IN_TURN"]

HOLDING = ("turn", "floor", "has_turn", "has_floor", "next_speaker")
"""Fields of who may speak next; others may be of who spoke last."""


def _out_of_turn(dialogue: Dialogue, roles: Roles) -> Checked:
    path = str(roles.speaker)
    holds = path.rpartition(".")[2].lower() in HOLDING
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            if why := _to_oneself(step, roles):
                yield number, why
            who = _asked(step, path, dialogue.game)
            has = at(step.before, path)
            # A field that is called otherwise may be of who spoke last: then it is of
            # who may speak if it was once so that who had it spoke.
            if who is not None and who != has and holds:
                yield number, f"{step.rule} takes what {who} does, but {path} is {has}"
            holds = holds or (who is not None and who == has)


def _asked(step: Step, path: str, game: Game) -> str | None:
    """Who made the event of a step, if its rule asks who has the turn."""
    asked = field_at(step.rule.when, path)
    if step.rule.on is None or not isinstance(asked, Singleton):
        return None
    agents = agents_of(game)
    if at(step.before, path) not in agents:
        return None
    return speaker_of(step.event, step.model, agents)


def _to_oneself(step: Step, roles: Roles) -> str:
    """Whether who speaks has come to be who is spoken to."""
    if roles.addressee is None or roles.speaker is None:
        return ""
    before, after = (_pair(one, roles) for one in (step.before, step.after))
    if after[0] is None or after[0] != after[1] or before[0] == before[1]:
        return ""
    return f"after {step.rule} {roles.speaker} and {roles.addressee} are {after[0]}"


def _pair(state: Record, roles: Roles) -> tuple[object, object]:
    return at(state, str(roles.speaker)), at(state, str(roles.addressee))


IN_TURN = Property(
    "P24",
    "who may",
    "who says something is who may by the state that its rule asks for.",
    _out_of_turn,
    needs=("speaker",),
)
