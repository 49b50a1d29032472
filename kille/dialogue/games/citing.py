"""What the robot was told of all things of a kind, as it says in its answers."""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.beliefs import as_told, beliefs_about, thinks
from kille.dialogue.criteria import (
    COMPONENT,
    CUE,
    HALF,
    PROPERTY,
    criteria_of,
    degree_of,
    sign_at,
)
from kille.dialogue.meanings import DialogueTypes, word_of
from kille.dialogue.moves import plan
from kille.dialogue.taxonomy import are_synonyms
from ttr import Model, Record

MOST = 4
"""How many criteria of a noun are told, at most: the latest."""


def cite_all(s: Record, noun: Record, *, types: DialogueTypes) -> Record:
    """The state in which it also says by what the things of a noun are known."""
    return cite(s, [*criteria_of(s, noun)][-MOST:], types=types)


def tell_kinds(s: Record, noun: Record, *, types: DialogueTypes) -> Record:
    """The state in which it also says of which kinds a noun is one, or which of it."""
    own = word_of(noun)
    told = [
        it
        for it in s.private.kinds
        if any(word_of(sign) is own for sign in it.signs)
        and not are_synonyms(s, *it.signs)
    ]
    for it in told[-MOST:]:
        claims = s.shared.pending
        s = plan(s, "TellKind", it.content, signs=it.signs, pending=claims, types=types)
    return s


def cite_reasons(
    s: Record, model: Model, noun: Record, x: str, *, types: DialogueTypes
) -> Record:
    """The state in which it also says what it was told of such things that fits x.

    Those are qualities that it takes x to have, and parts, which it cannot see.
    """
    if x not in s.view.things:
        return s
    found = [
        it
        for it in criteria_of(s, noun)
        if CUE not in it.content
        and degree_of(it.content) > HALF
        and (COMPONENT in it.content or _has_quality(s, model, it, x))
    ]
    return cite(s, found[-MOST:], types=types)


def _has_quality(s: Record, model: Model, it: Record, x: str) -> bool:
    """Whether it takes a thing to have the quality that a criterion speaks of."""
    sign = sign_at(it.content, PROPERTY, it.signs)
    return sign is not None and thinks(
        s, as_told(s, beliefs_about(s, model, [sign], x))
    )


def cite(s: Record, them: Iterable[Record], *, types: DialogueTypes) -> Record:
    """The state in which it also says that it was told these criteria."""
    for it in them:
        act = "CiteGeneric"
        if CUE in it.content:
            act = "CiteCue" if degree_of(it.content) else "CiteIgnoredCue"
        pending = s.shared.pending
        s = plan(s, act, it.content, signs=it.signs, pending=pending, types=types)
    return s
