"""Comparing things in view: which is bigger, and which is the biggest of several.

A comparative is a relation between two things that the model judges by what it sees. A
superlative chooses, of the things that the rest of a phrase is true of, those that no
other surely exceeds: where two are about as big, both are left.

Source: Fernández and Larsson 2014 for vague gradable words as perceptual types.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from kille.dialogue.meanings import value_at
from kille.dialogue.reference.perspectives import AWAY
from ttr import Model, Pred, Record, RecordType

COMPARATIVES: Mapping[str, str] = {
    "biggest": "bigger_than",
    "smallest": "smaller_than",
    "tallest": "taller_than",
    "lowest": "lower_than",
    "longest": "longer_than",
    "shortest": "shorter_than",
    "nearest": "nearer_than",
    "furthest": "further_than",
}
"""The comparative by which each superlative chooses, by names of predicates."""


SCALE = "scale"
"""The label by which a content says that its relation is judged by a measure."""

OF_ALL = "of all"
"""What that label says where one thing is said to be more than all others."""

ASIDE = 0.35
"""How far off the line between two things another may be, of their distance."""


def is_of_all(content: RecordType) -> bool:
    """Whether a content says that a thing is more than all others: "is the biggest"."""
    return SCALE in content and value_at(content, SCALE) == OF_ALL


def exceeds(s: Record, model: Model, more: Pred, x: str, y: str) -> float:
    """How probably x is more than y, as a comparative has it: bigger, nearer …"""
    seen = model.facts.perceive(None, more(x, y, s.view.look, AWAY))
    return 0.0 if seen is None else float(seen.lo)


def unexceeded_things(
    s: Record, model: Model, more: Pred, things: Sequence[str]
) -> Sequence[str]:
    """Those of some things that none of the others is surely more than."""
    sure = s.private.strategy.bands.sure
    return [
        x
        for x in things
        if not any(exceeds(s, model, more, y, x) >= sure for y in things if y != x)
    ]
