"""Whoever says something has the turn: P24."""

from __future__ import annotations

from ttr.dialogues.dialogue import Dialogue
from ttr.testing.event_subjects import agents_of, speaker_of
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.types.objects import Record
from ttr.types.records import field_at, value_at
from ttr.types.syntax import Singleton
from ttr.updates.games import Game
from ttr.updates.running import Step

TURN_FIELDS = ("turn", "floor", "has_turn", "has_floor", "next_speaker")
"""Labels of who may speak next; other labels may be of who spoke last."""


def _check_speakers(dialogue: Dialogue, roles: Roles) -> Breaches:
    path = str(roles.speaker)
    holds = path.rpartition(".")[2].lower() in TURN_FIELDS
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            if why := _why_talking_to_oneself(step, roles):
                yield number, why
            who = _speaker_with_turn_asked(step, path, dialogue.game)
            has = value_at(step.before, path)
            # A field with another label may be of who spoke last. It is taken for who
            # may speak next once the one whom it named has spoken.
            if who is not None and who != has and holds:
                yield number, f"{step.rule} takes a move of {who}, but {path} is {has}"
            holds = holds or (who is not None and who == has)


def _speaker_with_turn_asked(step: Step, path: str, game: Game) -> str | None:
    """Who made the event of a step, if its rule looks at who has the turn."""
    asked = field_at(step.rule.when, path.split("."))
    if step.rule.on is None or not isinstance(asked, Singleton):
        return None
    agents = agents_of(game)
    if value_at(step.before, path) not in agents:
        return None
    return speaker_of(step.event, step.model, agents)


def _why_talking_to_oneself(step: Step, roles: Roles) -> str:
    """Why the speaker has become the addressee as well."""
    if roles.addressee is None or roles.speaker is None:
        return ""
    before, after = (
        _speaker_and_addressee(one, roles) for one in (step.before, step.after)
    )
    if after[0] is None or after[0] != after[1] or before[0] == before[1]:
        return ""
    both = f"{roles.speaker} and {roles.addressee}"
    return f"after {step.rule} {both} are both {after[0]}"


def _speaker_and_addressee(state: Record, roles: Roles) -> tuple[object, object]:
    return value_at(state, str(roles.speaker)), value_at(state, str(roles.addressee))


IN_TURN = Property(
    "P24",
    "who may speak",
    "a rule that looks at who has the turn takes moves of that one only.",
    _check_speakers,
    needs=("speaker",),
)
