"""Games 1 and 4: the tutor says what a thing is, how it is, or where.

Source: Dobnik and de Graaf 2017, section 3.
"""

from __future__ import annotations

from kille.dialogue.commitments import opposite_lesson_keys
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.moves import content_of, plan
from kille.dialogue.reference import PARTS, thing_at
from kille.dialogue.rules import rule
from ttr import Record
from ttr.updates import first


@rule(answers="Instruct")
def learn_word(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor names a thing in view: learn the word from this very look."""
    return _plan_lesson(s, "Learned", types=types)


@rule(answers="Describe")
def learn_quality(s: Record, *, types: DialogueTypes) -> Record:
    """The tutor says how a thing in view is: learn the word from this very look."""
    return _plan_lesson(s, "LearnedQuality", types=types)


@rule(answers="Relate")
def learn_relation(s: Record, *, types: DialogueTypes) -> Record | None:
    """The tutor says how two things in view stand: learn the relation from them."""
    content = content_of(s)
    things = [thing_at(content, label) for label in PARTS]
    return (
        _plan_lesson(s, "LearnedRelation", types=types)
        if set(things) <= set(s.view.placed)
        else None
    )


@rule(answers="Relate")
def need_places(s: Record, *, types: DialogueTypes) -> Record:
    """The things are in view, but not where they are."""
    return plan(s, "NeedDepth", types=types)


def _plan_lesson(s: Record, act: str, *, types: DialogueTypes) -> Record:
    content = content_of(s)
    signs = s.shared.latest.signs
    forgets = opposite_lesson_keys(s, content, types=types)
    return plan(
        s, act, content, signs=signs, teaches=[content], forgets=forgets, types=types
    )


INSTRUCTING = first(learn_word, learn_quality, learn_relation, need_places)
