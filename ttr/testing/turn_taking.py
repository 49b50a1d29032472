"""Properties of who says what when: P13, P14, P16 and P18."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ttr.dialogues.dialogue import Dialogue, Trial, give
from ttr.judging.judgements import Judgement
from ttr.testing.properties import Checked, Property
from ttr.testing.strategies.discourse_roles import Roles, acts_in, at
from ttr.testing.strategies.random_states import heard_by, variants
from ttr.types.printing import notation
from ttr.types.syntax import Object, Rec, Record, TypeNode, freeze, identity
from ttr.updates.games import Game, Turn
from ttr.updates.nbest import NBest
from ttr.updates.running import Run

__all__ = ["EVENTS_ONCE", "FRESH_ANSWERS", "ROUND_TRIP", "TAKES_TURNS"]


# --- P13 -----------------------------------------------------------------------------


def _stale(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        why = ""
        if _talks(trial.given, trial.turn, roles):
            why = _unheeded(trial, trial.turn, roles) or _old_latest(trial, roles)
        if why := why or _unfitting(dialogue.game, trial.turn, roles):
            yield number, why


def _talks(given: Object, turn: Turn, roles: Roles) -> bool:
    """Whether something was said in the turn, by the tutor or by the system."""
    if turn.said:
        return True
    if turn.heard is None or isinstance(turn.heard, NBest):
        return False
    if isinstance(given, str):
        return True
    spoken = roles.spoken
    return spoken is not None and turn.model.judge(turn.heard, spoken).at_least(1.0)


def _unheeded(trial: Trial, turn: Turn, roles: Roles) -> str:
    """A move of the tutor's of which nothing is made."""
    if turn.trace or _is_over(trial.before, roles):
        return ""
    return f"nothing is made of {_given(turn.heard)}"


def _is_over(now: Run, roles: Roles) -> bool:
    over = roles.over
    return over is not None and now.model.judge(now.state, over).at_least(1.0)


def _old_latest(trial: Trial, roles: Roles) -> str:
    """Whether the latest move is one of an earlier turn, though there was a new one."""
    events = [step.event for step in trial.steps if step.rule.on is not None]
    if roles.latest is None or not events:
        return ""
    latest = at(trial.after.state, roles.latest)
    if latest is not at(trial.before.state, roles.latest):
        return ""
    if any(_is_part(latest, one) or _is_part(one, latest) for one in events):
        return ""
    return f"{roles.latest} is still {notation(latest)}, of an earlier turn"


def _is_part(part: Object, whole: Object) -> bool:
    if identity(part) == identity(whole):
        return True
    match whole:
        case Record():
            return any(_is_part(part, value) for value in whole._fields.values())
        case tuple():
            return any(_is_part(part, value) for value in whole)
    return False


def _unfitting(game: Game, turn: Turn, roles: Roles) -> str:
    """A move of the system's that is no answer to what happened in its turn."""
    if roles.fits is None or isinstance(turn.heard, NBest):
        return ""
    heard = None if turn.heard is None else _judged(game, turn)
    to = "silence" if heard is None else str(heard.type)
    for move in turn.said:
        if not roles.fits(heard, move):
            return f"{move.type} does not answer {to}"
    return ""


def _judged(game: Game, turn: Turn) -> Judgement:
    """The event of a turn, judged of the type that it was given as, or is heard as."""
    if isinstance(turn.event, TypeNode):
        return turn.model.judge(turn.heard, turn.event)
    judged = (turn.model.judge(turn.heard, T) for T in heard_by(game))
    fitting = (one for one in judged if one.at_least(1.0))
    return next(fitting, turn.model.judge(turn.heard, Rec))


# --- P14 -----------------------------------------------------------------------------


def _out_of_turn(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        said = _said(trial)
        if roles.moves is not None and len(said) > roles.moves:
            yield number, f"the system makes {len(said)} moves: {_listed(said)}"
    if dialogue.trials and dialogue.fault is None and _is_stuck(dialogue, roles):
        yield (
            len(dialogue.trials),
            "nothing that the tutor could do leads on from here",
        )


def _is_stuck(dialogue: Dialogue, roles: Roles) -> bool:
    now = dialogue.now
    if _is_over(now, roles):
        return False
    acts = _acts(dialogue, roles)
    tried = (give(dialogue.game, now, one) for one in acts)
    return not any(trial.steps or trial.fault is not None for trial in tried)


def _acts(dialogue: Dialogue, roles: Roles) -> Iterator[Object]:
    """What the tutor could do: what led on before, and events of each type heard."""
    state, model, _ = dialogue.now
    yield from reversed(dialogue.given)
    yield from acts_in(state, model, roles.acts)
    for T in heard_by(dialogue.game):
        yield from variants(T, model, state)


# --- P16 -----------------------------------------------------------------------------


def _misread(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None or isinstance(trial.turn.heard, NBest):
            continue
        if why := _misread_turn(dialogue.game, trial.turn, roles):
            yield number, why


def _misread_turn(game: Game, turn: Turn, roles: Roles) -> str:
    """Whether the words for the event of a turn are read as another event."""
    if game.hear is None or roles.words is None or turn.heard is None:
        return ""
    text = roles.words(turn.heard)
    if text is None:
        return ""
    worded = f"{notation(turn.heard)} is worded {text!r}, which"
    try:
        read = game.hear(text)
    except Exception as error:
        return f"{worded} cannot be read: {type(error).__name__}: {error}"
    return "" if _is_same(read, turn) else f"{worded} is read as {_given(read)}"


def _is_same(read: object, turn: Turn) -> bool:
    if isinstance(read, TypeNode):
        return turn.model.judge(turn.heard, read).at_least(1.0)
    return identity(freeze(read)) == identity(turn.heard)


# --- P18 -----------------------------------------------------------------------------


def _out_of_order(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        expected = [trial.turn.heard, *_said(trial)]
        took = [step.event for step in trial.steps if step.rule.on is not None]
        if why := _mixed_up(expected, took) or _misremembered(trial, took, roles):
            yield number, why


def _mixed_up(expected: Sequence[Object], took: Sequence[Object]) -> str:
    """Whether the rules took anything but the events of the turn, each in its time."""
    place = 0
    for event in took:
        while place < len(expected) and not _is_of(event, expected[place]):
            place += 1
        if place == len(expected):
            return f"{notation(event)} is taken once more, or out of its time"
    for move in expected[1:]:
        if not any(_is_of(event, move) for event in took):
            return f"the system's own move {notation(move)} is never taken in"
    return ""


def _misremembered(trial: Trial, took: Sequence[Object], roles: Roles) -> str:
    """Whether the history has not just got longer by what happened in the turn."""
    if roles.history is None:
        return ""
    before = at(trial.before.state, roles.history) or ()
    after = at(trial.after.state, roles.history) or ()
    events = tuple({identity(event): event for event in took}.values())
    if identity(after) in (
        identity((*before, *events)),
        identity((*reversed(events), *before)),
    ):
        return ""
    return (
        f"{roles.history} has got from {len(before)} to {len(after)} moves, "
        f"but there were {len(events)}: {_listed(events)}"
    )


def _is_of(event: Object, happened: Object) -> bool:
    if isinstance(happened, NBest):
        return any(identity(event) == identity(one) for one, _ in happened)
    return identity(event) == identity(happened)


def _said(trial: Trial) -> tuple[Object, ...]:
    """The moves that the system made in a turn."""
    return () if trial.turn is None else tuple(m.sit for m in trial.turn.said)


def _given(event: object) -> str:
    return str(event) if isinstance(event, NBest) else notation(event)


def _listed(objects: Sequence[Object]) -> str:
    return ", ".join(map(notation, objects))


FRESH_ANSWERS = Property(
    "P13",
    "fresh answers",
    "what is said belongs to this turn, and nothing that was said is passed over.",
    _stale,
)
TAKES_TURNS = Property(
    "P14",
    "turn-taking",
    "the system makes no more moves than it may, and there is always a way on.",
    _out_of_turn,
)
ROUND_TRIP = Property(
    "P16",
    "round trip",
    "the words for an event are read as that event, yes as yes and no as no.",
    _misread,
    needs=("words",),
)
EVENTS_ONCE = Property(
    "P18",
    "events once",
    "every event is taken in its turn, in order, and the system's own moves as well.",
    _out_of_order,
)
