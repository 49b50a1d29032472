"""Game 3: the tutor agrees with what the robot has claimed, or does not.

Source: Dobnik and de Graaf 2017, section 3; Larsson 2013 for what is rejected.
"""

from __future__ import annotations

from kille.dialogue.commitments import (
    affirmation,
    effects_of_denial,
    kind_of,
    plan_learning,
    signs_for,
)
from kille.dialogue.games.forgetting import plan_taking_back, taught_together
from kille.dialogue.meanings import (
    DialogueTypes,
    denial,
    is_denial,
    predicate_at,
    value_at,
    values_at,
)
from kille.dialogue.moves import plan, words_in
from kille.dialogue.rules import rule
from kille.dialogue.state import words
from ttr import Record, RecordType
from ttr.updates import first


@rule(answers="Affirm")
def learn_confirmed(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor confirms the robot's one claim: it is a lesson about that look."""
    if len(s.shared.pending) != 1:
        return None
    return plan_learning(s, s.shared.pending[0], types=types)


@rule(answers="Conceding")
def learn_denied(s: Record, *, types: DialogueTypes) -> Record | None:
    """The robot was right after all, before the tutor rejected that: so it is so."""
    if s.shared.pending or not s.private.last:
        return None
    said = s.private.last[-1]
    denied = [it for it in values_at(said, "teaches") if is_denial(it)]
    if predicate_at(said, "e").name != "ask_again" or len(denied) != 1:
        return None
    return plan_learning(s, affirmation(denied[0]), types=types)


ASKED = {"c": "AskWhich", "a": "AskWhichQuality", "rel": "AskWhichPlace"}
"""What it asks when it has claimed two things, by their label."""


@rule(answers="Affirm")
def ask_which(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor confirms, but the robot had named two: it asks which."""
    if len(s.shared.pending) != 2:
        return None
    content, rival = s.shared.pending
    act = next(ASKED[label] for label in ASKED if label in content)
    signs = words_in(words(s), content, rival)
    return plan(
        s, act, content, rival, signs=signs, pending=s.shared.pending, types=types
    )


@rule(answers="Affirm")
def learn_answer(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says yes to their own question, which it could not answer."""
    asked = _open_question(s)
    return None if asked is None else plan_learning(s, asked, types=types)


@rule(answers="Affirm")
def wonder_what(s: Record, *, types: DialogueTypes) -> Record:
    """The robot has claimed nothing to confirm."""
    return plan(s, "Wonder", types=types)


@rule(answers="Deny")
def learn_after_all(s: Record, *, types: DialogueTypes) -> Record | None:
    """The robot said that something is not so, and the tutor rejects that: so it is."""
    if len(s.shared.pending) != 1 or not is_denial(s.shared.pending[0]):
        return None
    return plan_learning(s, affirmation(s.shared.pending[0]), types=types)


@rule(answers="Deny")
def ask_again(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor rejects what the robot claimed: it learns that, and asks.

    Of what it was taught several times of this thing it takes back the last lesson.
    """
    if not s.shared.pending:
        return None
    teaches, forgets = effects_of_denial(s, s.shared.pending, types=types)
    signs = signs_for(s, *teaches)
    return plan(
        s, "AskAgain", signs=signs, teaches=teaches, forgets=forgets, types=types
    )


@rule(answers="Deny")
def learn_negative_answer(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says no to their own question, which it could not answer."""
    asked = _open_question(s)
    return None if asked is None else plan_learning(s, denial(asked), types=types)


def _open_question(s: Record) -> RecordType | None:
    """What the tutor asked whether it is so, and the robot has just not known."""
    if s.shared.pending or not s.private.last:
        return None
    said = s.private.last[-1]
    asked = value_at(said, "content")
    is_open = predicate_at(said, "e").name == "admit_whether"
    return asked if is_open and kind_of(asked) is not None else None


@rule(answers="Deny")
def take_back(s: Record, *, types: DialogueTypes) -> Record | None:
    """The robot has just learned something, and the tutor says no: it unlearns that.

    So it does with all that was learned at once.
    """
    if s.shared.pending or not s.private.last or not s.private.lessons:
        return None
    said, lesson = s.private.last[-1], s.private.lessons[-1]
    if predicate_at(said, "e").name not in JUST_LEARNED:
        return None
    if lesson.content not in values_at(said, "teaches"):
        return None
    return plan_taking_back(s, taught_together(s, lesson), types=types)


JUST_LEARNED = ("learned", "learned_quality", "learned_relation", "learned_several")
"""What the robot says when it has learned what the tutor said, or confirmed."""


@rule(answers="AgreePartly")
def ask_rest(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor agrees in part with what it has claimed: it asks what is right."""
    if not s.shared.pending:
        return None
    return plan(s, "AskRest", pending=s.shared.pending, types=types)


@rule(answers="AgreePartly")
def note_agreement(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor agrees in part, and it has claimed nothing."""
    return plan(s, "Noted", types=types)


@rule(answers="Deny")
def wonder_why(s: Record, *, types: DialogueTypes) -> Record:
    """The robot has claimed nothing to reject."""
    return plan(s, "Wonder", types=types)


CONFIRMING = first(
    learn_denied,
    learn_confirmed,
    ask_which,
    learn_answer,
    wonder_what,
    learn_after_all,
    ask_again,
    learn_negative_answer,
    take_back,
    ask_rest,
    note_agreement,
    wonder_why,
)
