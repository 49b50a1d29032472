"""What is agreed on was said: P21 and P22.

Source: Clark and Schaefer 1989 and Larsson 2002 for grounding: what becomes common
ground was put forward in the dialogue by somebody, once.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ttr.computing.subtyping import subtype
from ttr.dialogues.dialogue import Dialogue, Trial
from ttr.judging.certainty import is_certain
from ttr.testing.event_subjects import (
    SPEAKERS,
    agents_of,
    format_objects,
    is_same,
    item_type,
    items_added,
    items_at,
    mentions,
    mentions_of_sort,
    speaker_of,
)
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.strategies.discourse_roles import Roles
from ttr.testing.strategies.random_states import heard_by
from ttr.types.interning import identity
from ttr.types.objects import Object, Record
from ttr.types.printing import notation
from ttr.types.syntax import RecordType, TypeNode
from ttr.updates.games import Game
from ttr.updates.running import Step
from ttr.updates.update_strategies import event_types

# --- P21 -----------------------------------------------------------------------------


def _check_said(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        for step in trial.steps:
            for path in (roles.commitments, roles.qud, roles.pending):
                if path is not None:
                    for why in _why_unsaid(step, path, dialogue.game):
                        yield number, why


def _why_unsaid(step: Step, path: str, game: Game) -> Iterator[str]:
    """Why what a rule adds at a path was not said in this turn."""
    more = items_added(items_at(step.before, path), items_at(step.after, path))
    if not more:
        return
    said = mentions(step.event, step.model)
    T = item_type(game.type, path)
    for item in more:
        if any(is_same(item, one) for one in said):
            continue
        if why := _why_another(item, T, step, game):
            yield f"{step.rule} puts {notation(item)} on {path}, {why}"
        if why := _why_wrong_speaker(item, step, game):
            yield f"{step.rule} puts {notation(item)} on {path}, {why}"


def _why_another(item: Object, T: TypeNode | None, step: Step, game: Game) -> str:
    """Why something else was said than the item that was added."""
    if isinstance(item, str):
        others = mentions_of_sort(item, T, step.event, step.model, game)
        if others:
            return f"but the event is about {format_objects(others)}"
        return ""
    if isinstance(item, RecordType) and item in _move_types(game):
        return _why_move_not_made(item, step)
    return ""


def _why_move_not_made(item: RecordType, step: Step) -> str:
    """Why a move that counts as made was not made."""
    if step.rule.on is None or not isinstance(step.event, Record):
        return ""
    if (
        is_certain(step.model.facts, step.event, item)
        or subtype(item, step.rule.on).yes
    ):
        return ""
    in_state = (part for part in mentions(step.before, step.model))
    if any(is_same(item, part) for part in in_state):
        return ""
    return "which is a move that was not made"


def _move_types(game: Game) -> frozenset[TypeNode]:
    """The types of moves that anybody makes in the game."""
    return frozenset((*heard_by(game), *event_types(game.rules)))


def _why_wrong_speaker(item: Object, step: Step, game: Game) -> str:
    """Why an item names the wrong speaker."""
    who = speaker_of(step.event, step.model, agents_of(game))
    if who is None or not isinstance(item, Record):
        return ""
    for label, value in item._fields.items():
        if label in SPEAKERS and value in agents_of(game) and value != who:
            return f"but it was {who} who said it"
    return ""


# --- P22 -----------------------------------------------------------------------------


def _check_agreed_once(dialogue: Dialogue, roles: Roles) -> Breaches:
    path = str(roles.commitments)
    for number, trial in enumerate(dialogue.trials, start=1):
        if why := _why_agreed_twice(trial, path):
            yield number, why


def _why_agreed_twice(trial: Trial, path: str) -> str:
    """Why a turn adds something more often than it was said."""
    if trial.turn is None:
        return ""
    more = items_added(
        items_at(trial.before.state, path), items_at(trial.after.state, path)
    )
    for key, count in Counter(map(identity, more)).items():
        if count > 1 and count > _times_said(key, trial):
            item = next(one for one in more if identity(one) == key)
            return f"{notation(item)} is put on {path} {count} times in one turn"
    return ""


def _times_said(key: object, trial: Trial) -> int:
    """How many events of a turn mention an item; at least one is taken to do so."""
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
    "what is added to facts and questions was said in this turn, by the right person.",
    _check_said,
)
AGREED_ONCE = Property(
    "P22",
    "agreed once",
    "what is said once is agreed on only once.",
    _check_agreed_once,
    needs=("commitments",),
)
