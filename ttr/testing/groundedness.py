"""What is agreed on was said: P21, P22 and P23.

Source: Clark and Schaefer 1989 and Larsson 2002 for grounding: what becomes common
ground has been put forward in the dialogue, by somebody, and once.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from ttr.computing.subtyping import subtype
from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.judging.certainty import certainly
from ttr.testing.event_subjects import (
    SPEAKERS,
    agents_of,
    item_type,
    items_at,
    kin,
    mentions,
    same,
    speaker_of,
)
from ttr.testing.properties import Checked, Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.random_states import heard_by
from ttr.types.printing import notation
from ttr.types.syntax import Object, Record, RecordType, TypeNode, identity
from ttr.updates.games import Game
from ttr.updates.running import Step

__all__ = ["AGREED_ONCE", "SAID_FIRST", "added"]


def added(before: Sequence[Object], after: Sequence[Object]) -> list[Object]:
    """What is there more often than before, each as often as that."""
    if before is after:
        return []
    had = Counter(map(identity, before))
    more: list[Object] = []
    for one in after:
        had[identity(one)] -= 1
        if had[identity(one)] < 0:
            more.append(one)
    return more


# --- P21 -----------------------------------------------------------------------------


def _unsaid(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            for path in (roles.commitments, roles.qud, roles.pending):
                if path is not None:
                    for why in _unsaid_in(step, path, dialogue.game):
                        yield number, why


def _unsaid_in(step: Step, path: str, game: Game) -> Iterator[str]:
    """What a rule puts somewhere that neither the event nor the state offered."""
    more = added(items_at(step.before, path), items_at(step.after, path))
    if not more:
        return
    said = mentions(step.event, step.model)
    T = item_type(game.type, path)
    for item in more:
        if any(same(item, one) for one in said):
            continue
        if why := _another(item, T, step, game):
            yield f"{step.rule} puts {notation(item)} on {path}, {why}"
        if why := _of_another(item, step, game):
            yield f"{step.rule} puts {notation(item)} on {path}, {why}"


def _another(item: Object, T: TypeNode | None, step: Step, game: Game) -> str:
    """Whether an item is none of its sort that was said, or that was there before."""
    if isinstance(item, str):
        others = kin(item, T, step.event, step.model, game)
        if others:
            about = ", ".join(map(notation, others))
            return f"though what happened is about {about}"
        return ""
    if isinstance(item, RecordType) and item in _moves(game):
        return _another_move(item, step)
    return ""


def _another_move(item: RecordType, step: Step) -> str:
    """Whether a move counts as made that is not the one that was made."""
    if step.rule.on is None or not isinstance(step.event, Record):
        return ""
    if certainly(step.model.facts, step.event, item) or subtype(item, step.rule.on).yes:
        return ""
    in_state = (part for part in mentions(step.before, step.model))
    if any(same(item, part) for part in in_state):
        return ""
    return "which is a move that was not made"


def _moves(game: Game) -> frozenset[TypeNode]:
    """The types of moves that somebody makes in the game."""
    return frozenset(heard_by(game)) | {
        rule.on for rule in game.rules if rule.on is not None
    }


def _of_another(item: Object, step: Step, game: Game) -> str:
    """Whether an item says that somebody said it who did not."""
    who = speaker_of(step.event, step.model, agents_of(game))
    if who is None or not isinstance(item, Record):
        return ""
    for label, value in item._fields.items():
        if label in SPEAKERS and value in agents_of(game) and value != who:
            return f"but it was {who} who said it"
    return ""


# --- P22 -----------------------------------------------------------------------------


def _twice(dialogue: Dialogue, roles: Roles) -> Checked:
    path = str(roles.commitments)
    for number, trial in enumerate(dialogue.trials, start=1):
        if why := _twice_in(trial, path):
            yield number, why


def _twice_in(trial: Trial, path: str) -> str:
    """What one turn adds more often than it was said in it."""
    if trial.turn is None:
        return ""
    more = added(items_at(trial.before.state, path), items_at(trial.after.state, path))
    said = 1 + len(trial.turn.said)
    for key, count in Counter(map(identity, more)).items():
        if count > 1 and count > _times_said(key, trial, said):
            item = next(one for one in more if identity(one) == key)
            return f"{notation(item)} is put on {path} {count} times in one turn"
    return ""


def _times_said(key: object, trial: Trial, most: int) -> int:
    """How many events of a turn mention an item; all of them, if none does."""
    assert trial.turn is not None
    events = [trial.turn.heard, *(move.sit for move in trial.turn.said)]
    model = trial.turn.model
    times = sum(
        any(identity(one) == key for one in mentions(event, model))
        for event in events
        if isinstance(event, Record)
    )
    return times or 1


SAID_FIRST = Property(
    "P21",
    "said first",
    "what is agreed on or under discussion was said, by whom it says, in this turn.",
    _unsaid,
)
AGREED_ONCE = Property(
    "P22",
    "agreed once",
    "what is said once is agreed on once.",
    _twice,
    needs=("commitments",),
)
