"""Do cups have handles? The tutor asks what was said of all things of a kind.

The robot cites what it was told, of that kind or of one that it is a kind of. Where
nobody has said so it says that, and how those looked that it was shown.
"""

from __future__ import annotations

from kille.dialogue.criteria import (
    COMPONENT,
    CUE,
    PROPERTY,
    SUBJECT,
    criteria_about,
    sign_at,
)
from kille.dialogue.games.citing import cite
from kille.dialogue.games.criticising import claimed_noun
from kille.dialogue.meanings import DialogueTypes
from kille.dialogue.moves import content_of, plan
from kille.dialogue.rules import rule
from kille.dialogue.taxonomy import is_kind_of, subsumption
from ttr import Record, RecordType, rectype
from ttr.updates import first


@rule(answers="AskGeneric")
def tell_generic(s: Record, *, types: DialogueTypes) -> Record | None:
    """It was told of such things: it says what."""
    noun = _asked_noun(s)
    if noun is None:
        return None
    own = _about(s, noun)
    for it in criteria_about(s, own):
        return cite(s, [it], types=types)
    for upper in s.private.nouns:
        if not is_kind_of(s, noun, upper):
            continue
        for it in criteria_about(s, _about(s, upper)):
            kind, signs = subsumption(noun, upper), [noun, upper]
            pending = s.shared.pending
            known = plan(s, "KnowKind", kind, signs=signs, pending=pending, types=types)
            return cite(known, [it], types=types)
    return None


@rule(answers="AskGeneric")
def miss_generic(s: Record, *, types: DialogueTypes) -> Record:
    """Nobody has told it that: it says so, and how those looked that it was shown."""
    noun, content = _asked_noun(s), content_of(s)
    if noun is None:
        return plan(s, "WhichSubject", content, types=types)
    signs, pending = (noun, *s.shared.latest.signs), s.shared.pending
    own = _about(s, noun)
    missed = plan(s, "UnknownGeneric", own, signs=signs, pending=pending, types=types)
    if PROPERTY not in own:
        return missed
    return plan(
        missed,
        "MeanNoun",
        noun.meaning,
        signs=[noun, *s.private.adjectives],
        recalls=[noun],
        pending=pending,
        types=types,
    )


def _asked_noun(s: Record) -> Record | None:
    """The noun of the things that are asked about, or else of what was claimed."""
    said = sign_at(content_of(s), SUBJECT, s.shared.latest.signs)
    return claimed_noun(s) if said is None else said


def _about(s: Record, noun: Record) -> RecordType:
    """What is asked, of the things of a noun, however often it is asked to be so."""
    content = content_of(s)
    what = {it: content[it] for it in (CUE, PROPERTY, COMPONENT) if it in content}
    return rectype({SUBJECT: noun.meaning, **what})


GENERALISING = first(tell_generic, miss_generic)
"""What answers how things of a kind are."""
