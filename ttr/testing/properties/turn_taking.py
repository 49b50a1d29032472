"""Properties of who says what when: P13, P14, P16 and P18."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ttr.dialogues.dialogue import Dialogue, Trial, give
from ttr.errors import describe_error
from ttr.judging.judgements import Judgement
from ttr.testing.event_subjects import format_objects
from ttr.testing.properties.property import Breaches, Property
from ttr.testing.strategies.discourse_roles import Roles, acts_in
from ttr.testing.strategies.random_states import heard_by, variants
from ttr.types.interning import identity
from ttr.types.objects import Object, Record, freeze
from ttr.types.printing import notation
from ttr.types.records import value_at
from ttr.types.syntax import Rec, TypeNode
from ttr.updates.games import Game, Turn, format_event
from ttr.updates.nbest import NBest
from ttr.updates.running import Run

# --- P13 -----------------------------------------------------------------------------


def _check_freshness(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        why = ""
        if _is_talk(trial.given, trial.turn, roles):
            why = _why_unheeded(trial, trial.turn, roles) or _why_latest_is_old(
                trial, roles
            )
        if why := why or _why_unfitting(dialogue.game, trial.turn, roles):
            yield number, why


def _is_talk(given: Object, turn: Turn, roles: Roles) -> bool:
    """Did the tutor or the system say anything in the turn?"""
    if turn.said:
        return True
    if turn.heard is None or isinstance(turn.heard, NBest):
        return False
    if isinstance(given, str):
        return True
    spoken = roles.spoken
    return spoken is not None and turn.model.judge(turn.heard, spoken).at_least(1.0)


def _why_unheeded(trial: Trial, turn: Turn, roles: Roles) -> str:
    """Why a move of the tutor's had no effect."""
    if turn.trace or _is_over(trial.before, roles):
        return ""
    return f"no rule takes {format_event(turn.heard)}"


def _is_over(now: Run, roles: Roles) -> bool:
    over = roles.over
    return over is not None and now.model.judge(now.state, over).at_least(1.0)


def _why_latest_is_old(trial: Trial, roles: Roles) -> str:
    """Why the latest move is still that of an earlier turn."""
    events = [step.event for step in trial.steps if step.rule.on is not None]
    if roles.latest is None or not events:
        return ""
    latest = value_at(trial.after.state, roles.latest)
    if latest is not value_at(trial.before.state, roles.latest):
        return ""
    if any(_is_part(latest, one) or _is_part(one, latest) for one in events):
        return ""
    return f"{roles.latest} is still {notation(latest)}, from an earlier turn"


def _is_part(part: Object, whole: Object) -> bool:
    if identity(part) == identity(whole):
        return True
    match whole:
        case Record():
            return any(_is_part(part, value) for value in whole._fields.values())
        case tuple():
            return any(_is_part(part, value) for value in whole)
    return False


def _why_unfitting(game: Game, turn: Turn, roles: Roles) -> str:
    """Why a move of the system's does not answer what happened in its turn."""
    if roles.fits is None or isinstance(turn.heard, NBest):
        return ""
    heard = None if turn.heard is None else _judge_event(game, turn)
    to = "silence" if heard is None else str(heard.type)
    for move in turn.said:
        if not roles.fits(heard, move):
            return f"{move.type} does not answer {to}"
    return ""


def _judge_event(game: Game, turn: Turn) -> Judgement:
    """The judgement of a turn's event: of the type that it was given or heard as."""
    if isinstance(turn.event, TypeNode):
        return turn.model.judge(turn.heard, turn.event)
    judged = (turn.model.judge(turn.heard, T) for T in heard_by(game))
    fitting = (one for one in judged if one.at_least(1.0))
    return next(fitting, turn.model.judge(turn.heard, Rec))


# --- P14 -----------------------------------------------------------------------------


def _check_turn_taking(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        said = _system_moves(trial)
        if roles.moves is not None and len(said) > roles.moves:
            yield number, f"the system makes {len(said)} moves: {format_objects(said)}"
    if dialogue.trials and dialogue.fault is None and _is_stuck(dialogue, roles):
        yield (
            len(dialogue.trials),
            "the game is stuck here: no rule takes anything that the tutor could do",
        )


def _is_stuck(dialogue: Dialogue, roles: Roles) -> bool:
    now = dialogue.now
    if _is_over(now, roles):
        return False
    acts = _possible_acts(dialogue, roles)
    tried = (give(dialogue.game, now, one) for one in acts)
    return not any(trial.steps or trial.fault is not None for trial in tried)


def _possible_acts(dialogue: Dialogue, roles: Roles) -> Iterator[Object]:
    """What the tutor could do: anything done before, and events of each type heard."""
    state, model, _ = dialogue.now
    yield from reversed(dialogue.given)
    yield from acts_in(state, model, roles.acts)
    for T in heard_by(dialogue.game):
        yield from variants(T, model, state)


# --- P16 -----------------------------------------------------------------------------


def _check_round_trip(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None or isinstance(trial.turn.heard, NBest):
            continue
        if why := _why_misread(dialogue.game, trial.turn, roles):
            yield number, why


def _why_misread(game: Game, turn: Turn, roles: Roles) -> str:
    """Why the words for a turn's event are not read as that event."""
    if game.hear is None or roles.words is None or turn.heard is None:
        return ""
    text = roles.words(turn.heard)
    if text is None:
        return ""
    worded = f"{notation(turn.heard)} is worded {text!r}, which"
    try:
        read = game.hear(text)
    except Exception as error:
        return f"{worded} cannot be read: {describe_error(error)}"
    return (
        ""
        if _is_same_event(read, turn)
        else f"{worded} is read as {format_event(read)}"
    )


def _is_same_event(read: object, turn: Turn) -> bool:
    if isinstance(read, TypeNode):
        return turn.model.judge(turn.heard, read).at_least(1.0)
    return identity(freeze(read)) == identity(turn.heard)


# --- P18 -----------------------------------------------------------------------------


def _check_order_of_events(dialogue: Dialogue, roles: Roles) -> Breaches:
    for number, trial in enumerate(dialogue.trials, start=1):
        if trial.turn is None:
            continue
        expected = [trial.turn.heard, *_system_moves(trial)]
        took = [step.event for step in trial.steps if step.rule.on is not None]
        if why := _why_mixed_up(expected, took) or _why_history_differs(
            trial, took, roles
        ):
            yield number, why


def _why_mixed_up(expected: Sequence[Object], took: Sequence[Object]) -> str:
    """Why the rules did not take the events of the turn, each once and in order."""
    place = 0
    for event in took:
        while place < len(expected) and not _is_event_of(event, expected[place]):
            place += 1
        if place == len(expected):
            return f"{notation(event)} is taken again, or out of order"
    for move in expected[1:]:
        if not any(_is_event_of(event, move) for event in took):
            return f"no rule takes the system's own move {notation(move)}"
    return ""


def _why_history_differs(trial: Trial, took: Sequence[Object], roles: Roles) -> str:
    """Why the history did not become longer by just what happened in the turn."""
    if roles.history is None:
        return ""
    before = value_at(trial.before.state, roles.history) or ()
    after = value_at(trial.after.state, roles.history) or ()
    events = tuple({identity(event): event for event in took}.values())
    if identity(after) in (
        identity((*before, *events)),
        identity((*reversed(events), *before)),
    ):
        return ""
    return (
        f"{roles.history} went from {len(before)} to {len(after)} moves, "
        f"but {len(events)} were made: {format_objects(events)}"
    )


def _is_event_of(event: Object, happened: Object) -> bool:
    if isinstance(happened, NBest):
        return any(identity(event) == identity(one) for one, _ in happened)
    return identity(event) == identity(happened)


def _system_moves(trial: Trial) -> tuple[Object, ...]:
    """The moves that the system made in a turn."""
    return () if trial.turn is None else tuple(m.sit for m in trial.turn.said)


FRESH_ANSWERS = Property(
    "P13",
    "fresh answers",
    "what is said answers this turn, and nothing that the tutor says is ignored.",
    _check_freshness,
)
TAKES_TURNS = Property(
    "P14",
    "turn-taking",
    "the system makes no more moves than it may, and is never stuck.",
    _check_turn_taking,
)
ROUND_TRIP = Property(
    "P16",
    "round trip",
    "the words for an event are read as that event, yes as yes and no as no.",
    _check_round_trip,
    needs=("words",),
)
EVENTS_ONCE = Property(
    "P18",
    "events once",
    "rules take every event in its turn, once and in order, the system's moves, too.",
    _check_order_of_events,
)
