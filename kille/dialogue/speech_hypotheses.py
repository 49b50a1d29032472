"""Weigh what may have been said, when it was not heard for certain.

The weight of an alternative is the probability of its text, times how well it fits:
known words come before new ones, few before many, and where texts differ, a claim fits
as well as it is true of what is seen.

Source: Lison 2013, for combining what is heard with what is known before deciding.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from itertools import groupby
from typing import NamedTuple

from kille.dialogue.beliefs import degree, known_words, knows_word
from kille.dialogue.meanings import (
    CLAIMS,
    DialogueTypes,
    claims,
    is_denial,
    value_at,
    word_of,
)
from kille.dialogue.reference import PARTS, phrases, possible_readings, thing_at
from ttr import Model, Pred, Record, RecordType
from ttr.types import PType
from ttr.updates import NBest

FAINTLY = 1e-6
"""The least probability of a text for it to be answered at all."""

UNKNOWN = 0.1
"""The factor for every part of a word that is not known."""

UNTEACHABLE = 0.01
"""The factor for a lesson that cannot be learned as it is."""

LONGER = 0.9
"""The factor for every word."""

SURE = 0.9
"""From this probability on a text counts as if it had been typed."""


_ROUNDING = 1e-9


class WeighedMove(NamedTuple):
    """What the tutor may have said, and how probable that is."""

    said: Record
    p: float


def weigh_readings(
    s: Record, model: Model, heard: NBest, *, types: DialogueTypes
) -> Sequence[WeighedMove]:
    """The likeliest reading of each text, the most probable first.

    What the probabilities lack to 1 is that of something else, which fits as well as
    `strange` says.
    """
    known = known_words(s)
    if is_of_one_text(heard):

        def weight(alternative: tuple[Record, float]) -> float:
            one, p = alternative
            fails = _describes_unknown(known, one) and teaches(one)
            return p * _word_weight(known, one) * (UNTEACHABLE if fails else 1.0)

        def teaches(one: Record) -> bool:
            return types.has(one, "Teaching", model)

        return [WeighedMove(max(_by_text(heard), key=weight)[0], 1.0)]
    texts = [list(them) for _, them in groupby(_by_text(heard), key=_text)]
    other = max(0.0, 1.0 - sum(p for them in texts for _, p in them))
    fits = [_best(s, model, known, them, types=types) for them in texts]
    strange = s.private.strategy.hearing.strange
    whole = sum(it.p for it in fits) + other * strange
    shares = [WeighedMove(it.said, it.p / whole if whole else 0.0) for it in fits]
    return sorted(shares, key=lambda it: -it.p)


def is_of_one_text(heard: NBest) -> bool:
    """Whether it is certain which words were said, in whatever way they are meant."""
    (first, _), *_ = heard
    return all(it.text == first.text for it, _ in heard) and (
        1.0 - sum(p for _, p in heard) < _ROUNDING
    )


def _by_text(heard: NBest) -> Iterable[tuple[Record, float]]:
    return sorted(heard, key=_text)


def _text(alternative: tuple[Record, float]) -> str:
    return str(alternative[0].text)


def _best(
    s: Record,
    model: Model,
    known: Set[Pred],
    readings: Sequence[tuple[Record, float]],
    *,
    types: DialogueTypes,
) -> WeighedMove:
    """The likeliest reading of a text, and the weight of the text."""
    likely = max(p for _, p in readings)
    fits = [
        WeighedMove(
            said,
            _word_weight(known, said)
            * _scene_weight(s, model, said, types=types)
            * (p / likely),
        )
        for said, p in readings
    ]
    best = max(fits, key=lambda it: it.p)
    return WeighedMove(best.said, best.p * sum(p for _, p in readings))


def _describes_unknown(known: Set[Pred], said: Record) -> bool:
    """Whether a noun is said of a thing that a new adjective describes: a toy car.

    Such a lesson would be refused, for want of the adjective.
    """
    return "c" in said.content and any(
        it.kind == "adjective" and word_of(it) not in known for it in said.signs
    )


def _word_weight(known: Set[Pred], said: Record) -> float:
    """How likely a reading is, by its words: known ones, and few of them."""
    new = [sign for sign in said.signs if word_of(sign) not in known]
    parts = sum(len(sign.form.split()) for sign in new)
    return float(LONGER ** len(said.signs) * UNKNOWN**parts)


def _scene_weight(
    s: Record, model: Model, said: Record, *, types: DialogueTypes
) -> float:
    """How likely it is that this is said, by what is seen."""
    content, strange = said.content, s.private.strategy.hearing.strange
    if not phrases(content):
        return 1.0
    ways = possible_readings(s, model, content, types=types)
    teaches = types.has(said, "Teaching", model)
    true = [
        way.p * (_truth(s, model, said, way.content) if teaches else 1.0)
        for way in ways
    ]
    return float(strange + (1.0 - strange) * max(true, default=0.0))


def _truth(s: Record, model: Model, said: Record, content: RecordType) -> float:
    """How probable a lesson is; a word that is not known may be true of anything."""
    if not all(knows_word(s, it) for it in said.signs if claims(content, it)):
        return 1.0
    claim = next((content[label] for label in CLAIMS if label in content), None)
    if not isinstance(claim, PType) or is_denial(content):
        return 1.0
    things = [x for x in (thing_at(content, it) for it in PARTS) if x is not None]
    front = [value_at(content, "frame")] if "frame" in content else []
    return degree(model, claim.pred(*things, s.view.look, *front))
