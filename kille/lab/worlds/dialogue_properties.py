"""Properties of dialogues that teach, besides those of all dialogues.

They are checked on dialogues, as those of `ttr.testing` are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from kille.dialogue.meanings import predicate_at, record_type, value_at
from kille.lab.worlds.games import learned_words
from ttr import Record, RecordType
from ttr.judging import Judgement
from ttr.testing import Property
from ttr.testing.strategies import Dialogue, Trial
from ttr.testing.strategies.discourse_roles import Roles

Checked = Iterator[tuple[int, str]]

CERTAINTY = {"admit_name": 0, "guess_name": 1, "hedge_name": 1, "assert_name": 2}
"""How certain the ways to name a thing sound."""


def _act(move: Judgement) -> str:
    """The name of a move's predicate."""
    assert isinstance(move.type, RecordType)
    return predicate_at(move.type, "e").name


def _moves_said(trial: Trial) -> Sequence[Judgement]:
    return () if trial.turn is None else trial.turn.said


def _numbered_trials(dialogue: Dialogue) -> Iterator[tuple[int, Trial]]:
    return enumerate(dialogue.trials, start=1)


# --- P10 -----------------------------------------------------------------------------


def _overretracted(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in _numbered_trials(dialogue):
        before, after = trial.before.state, trial.after.state
        gone = set(before.shared.commitments) - set(after.shared.commitments)
        keys = {key for it in _moves_said(trial) for key in _forgotten_keys(it.sit)}
        named = {it.content for it in before.private.lessons if it.key in keys}
        for content in gone - named:
            yield number, f"{content} is taken back, though nobody named it"


def _forgotten_keys(move: Record) -> Iterable[str]:
    """The keys of the lessons that a move unlearns."""
    undone = move.undone if move.undoes else ()
    return (*move.forgets, *move.dropped, *(it.key for it in undone))


# --- P11 -----------------------------------------------------------------------------


def _ungrounded_lessons(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in _numbered_trials(dialogue):
        for move in _moves_said(trial):
            for content in move.sit.teaches:
                if why := _why_ungrounded(content, trial):
                    yield number, f"{content} is learned, {why}"
        if why := _why_unlinked(trial):
            yield number, why


def _why_ungrounded(content: RecordType, trial: Trial) -> str:
    """Why a lesson was not given about this very thing in this very look, if so."""
    before = trial.before.state
    autonomous = before.private.strategy.mode == "autonomous"
    if not _has_spoken(trial) and not autonomous:
        return "but the tutor has said nothing"
    looks = {value_at(it, "look") for it in before.shared.pending}
    looks |= {value_at(it, "look") for it in before.shared.commitments}
    looks |= {before.view.look, trial.after.state.view.look}
    if value_at(content, "look") not in looks:
        return "about a look that was not talked of"
    if _is_move(trial, "Deny") and content in before.shared.pending:
        return "though the tutor has said no"
    return ""


def _why_unlinked(trial: Trial) -> str:
    """Why the lessons in the state are not those that were given; empty if they are."""
    before, after = (
        {lesson.key: lesson for lesson in run.state.private.lessons}
        for run in (trial.before, trial.after)
    )
    new = [it for key, it in after.items() if key not in before]
    taught = [content for it in _moves_said(trial) for content in it.sit.teaches]
    if sorted(str(it.content) for it in new) != sorted(map(str, taught)):
        return f"{len(taught)} lessons were given, but {len(new)} are kept"
    return ""


def _has_spoken(trial: Trial) -> bool:
    """Whether the tutor has said something in a turn."""
    taken = [step.event for step in trial.steps]
    return any(isinstance(it, Record) and "text" in it for it in taken)


def _is_move(trial: Trial, move: str) -> bool:
    """Whether what the tutor has said is such a move."""
    if trial.turn is None or not isinstance(trial.turn.heard, Record):
        return False
    return trial.turn.model.judge(trial.turn.heard, record_type(move)).at_least(1.0)


# --- P12 -----------------------------------------------------------------------------


def _changed_words(dialogue: Dialogue, roles: Roles) -> Checked:
    for number, trial in _numbered_trials(dialogue):
        before = {it.sign: it for it in learned_words(trial.before.model)}
        taught = {
            sign.meaning for move in _moves_said(trial) for sign in move.sit.signs
        }
        keys = {key for move in _moves_said(trial) for key in _forgotten_keys(move.sit)}
        for it in learned_words(trial.after.model):
            was = before.get(it.sign)
            own = was is not None and not keys.isdisjoint(was.keys)
            if was is not it and not own and it.sign.meaning not in taught:
                yield number, f"what {it.sign.form!r} means has changed"


# --- P19 -----------------------------------------------------------------------------


def _overclaims(dialogue: Dialogue, roles: Roles) -> Checked:
    named: list[tuple[int, float, float]] = []
    for number, trial in _numbered_trials(dialogue):
        beliefs = trial.after.state.private.beliefs
        for move in _moves_said(trial):
            rank = CERTAINTY.get(_act(move))
            if rank is None or not beliefs:
                continue
            best, rival = beliefs[0].p, beliefs[1].p if len(beliefs) > 1 else 0.0
            named.append((rank, best, best - rival))
            if best == rival and rank and _act(move) != "hedge_name":
                yield number, "two words are as probable, but only one is named"
        if why := _why_inverted(named):
            yield number, why


def _why_inverted(named: Sequence[tuple[int, float, float]]) -> str:
    """Why words are less certain for what is more probable; empty if they are not."""
    for rank, best, lead in named:
        for other, p, margin in named:
            if rank > other and best < p and lead < margin:
                return f"{best:.3g} is said with more certainty than {p:.3g}"
    return ""


# --- P17 -----------------------------------------------------------------------------


def _unworded_moves(dialogue: Dialogue, roles: Roles) -> Checked:
    say = dialogue.game.say
    assert say is not None
    for number, trial in _numbered_trials(dialogue):
        for move in _moves_said(trial):
            try:
                text = say(move)
            except Exception as error:
                yield number, f"no words for {_act(move)}: {error!r}"
                continue
            if not text.strip() or "{" in text:
                yield number, f"{_act(move)} is worded {text!r}"


RETRACTED = Property(
    "P10",
    "exact retraction",
    "what is taken back was named by the tutor, and nothing else is.",
    _overretracted,
)
GROUNDED = Property(
    "P11",
    "grounded learning",
    "what is learned was said by the tutor, about this very thing in this very look.",
    _ungrounded_lessons,
)
LOCAL = Property(
    "P12",
    "local learning",
    "a lesson changes what its own word means, and no other word.",
    _changed_words,
)
HONEST = Property(
    "P19",
    "honest wording",
    "more certain words only for what is more probable, or farther ahead.",
    _overclaims,
)
WORDED = Property(
    "P17",
    "never speechless",
    "there are words for every move.",
    _unworded_moves,
)

OF_TUTORING = (WORDED, RETRACTED, GROUNDED, LOCAL, HONEST)
"""All of them."""
