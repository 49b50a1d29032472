"""What the robot makes of the things in the latest look, by judging words of them.

Only what is asked about is judged. A belief is a record {sit, sign, p}: that a
situation is of the type that the sign means; its judgements are in the model that is
given back with it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import permutations

from kille.dialogue.meanings import word_of
from ttr import Model, Record, record

__all__ = [
    "Beliefs",
    "best_pair",
    "best_thing",
    "has_rival",
    "is_sure",
    "knows",
    "nouns_of",
    "recognised",
    "relations_of",
    "thinks",
]

Beliefs = Sequence[Record]


def nouns_of(s: Record, model: Model, x: str) -> tuple[Beliefs, Model]:
    """How probably each noun is true of x, the most probable first."""
    sit = record(x=x, look=s.view.look)
    return _judged(model, sit, s.private.nouns)


def relations_of(s: Record, model: Model, x: str, y: str) -> tuple[Beliefs, Model]:
    """How probably x stands in each relation to y, the most probable first."""
    sit = record(look=s.view.look, target=record(x=x), landmark=record(x=y))
    return _judged(model, sit, s.private.relations)


def _judged(
    model: Model, sit: Record, signs: Iterable[Record]
) -> tuple[Beliefs, Model]:
    beliefs = []
    for sign in signs:
        judgement = model.perceive(sit, sign.meaning)
        model = judgement.model
        beliefs.append(record(sit=judgement.sit, sign=sign, p=judgement.p.lo))
    return sorted(beliefs, key=lambda b: (-b.p, b.sign.form)), model


def is_sure(s: Record, beliefs: Beliefs) -> bool:
    """Whether the first belief is certain enough, and far enough from the second."""
    if not beliefs:
        return False
    lead = beliefs[0].p - (beliefs[1].p if len(beliefs) > 1 else 0.0)
    return bool(beliefs[0].p >= s.private.sure and lead >= s.private.margin)


def thinks(s: Record, beliefs: Beliefs) -> bool:
    """Whether the first belief is worth saying."""
    return bool(beliefs) and bool(beliefs[0].p >= s.private.likely)


def has_rival(s: Record, beliefs: Beliefs) -> bool:
    """Whether the second belief is worth naming."""
    return len(beliefs) > 1 and bool(beliefs[1].p >= s.private.might)


def knows(words: Iterable[Record], sign: Record) -> bool:
    """Whether a word with the sign's predicate is among these."""
    return any(word_of(known) is word_of(sign) for known in words)


def recognised(s: Record, model: Model, x: str) -> tuple[Record | None, Model]:
    """The belief about x that the robot is sure of, if there is one."""
    beliefs, model = nouns_of(s, model, x)
    return (beliefs[0] if is_sure(s, beliefs) else None), model


def best_thing(s: Record, model: Model, sign: Record) -> tuple[Record | None, Model]:
    """The thing in view that the noun fits best, as a belief worth saying."""
    beliefs: list[Record] = []
    for x in s.view.things:
        judged, model = _judged(model, record(x=x, look=s.view.look), [sign])
        beliefs += judged
    best = max(beliefs, key=lambda b: b.p, default=None)
    return (best if best is not None and thinks(s, [best]) else None), model


def best_pair(
    s: Record, model: Model, target: Record, landmark: Record
) -> tuple[tuple[str, str] | None, Model]:
    """The two things in view that the two nouns fit best together."""
    fits: dict[tuple[str, str], float] = {}
    for x in s.view.things:
        for sign in (target, landmark):
            judged, model = _judged(model, record(x=x, look=s.view.look), [sign])
            fits[x, sign.form] = judged[0].p
    pairs = [
        (fits[x, target.form] * fits[y, landmark.form], (x, y))
        for x, y in permutations(s.view.things, 2)
        if min(fits[x, target.form], fits[y, landmark.form]) >= s.private.likely
    ]
    return (max(pairs)[1] if pairs else None), model
