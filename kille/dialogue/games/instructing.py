"""Games 1 and 4: the tutor says what a thing is, how it is, or where.

Source: Dobnik and de Graaf 2017, section 3.
"""

from __future__ import annotations

from kille.dialogue.commitments import undone
from kille.dialogue.moves import answering, content_of, plan
from kille.dialogue.reference import PARTS, thing_at
from ttr import Record
from ttr.updates import first, rule


@rule(when=answering("Instruct"))
def learn_word(s: Record) -> Record:
    """The tutor names a thing in view: learn the word from this very look."""
    return _taught(s, "Learned")


@rule(when=answering("Describe"))
def learn_quality(s: Record) -> Record:
    """The tutor says how a thing in view is: learn the word from this very look."""
    return _taught(s, "LearnedQuality")


@rule(when=answering("Relate"))
def learn_relation(s: Record) -> Record | None:
    """The tutor says how two things in view stand: learn the relation from them."""
    content = content_of(s)
    things = [thing_at(content, label) for label in PARTS]
    return _taught(s, "LearnedRelation") if set(things) <= set(s.view.placed) else None


@rule(when=answering("Relate"))
def need_places(s: Record) -> Record:
    """The things are in view, but not where they are."""
    return plan(s, "NeedDepth")


def _taught(s: Record, act: str) -> Record:
    content = content_of(s)
    signs = s.shared.latest.signs
    forgets = undone(s, content)
    return plan(s, act, content, signs=signs, teaches=[content], forgets=forgets)


INSTRUCTING = first(learn_word, learn_quality, learn_relation, need_places)
