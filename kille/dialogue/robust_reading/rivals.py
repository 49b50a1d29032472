"""Other ways to take a sentence: alternatives of the same uncertain event."""

from __future__ import annotations

from collections.abc import Iterable

from kille.dialogue.language import Sentence
from kille.dialogue.robust_reading.island_covers import Cover
from kille.dialogue.robust_reading.island_kinds import CLAIMS, FALLBACK

RIVAL = 0.5
"""From which share of the best cover's weight on others count as well."""


def are_rivals(cover: Cover, best: Cover) -> bool:
    """Whether a cover is another way to take a sentence as a move of the same sort."""
    if len(cover.islands) > 1 or cover.weight < RIVAL * best.weight:
        return False
    if _is_part(cover, best):
        return False
    one, other = cover.islands[0].rule, best.islands[0].rule
    return not {one, other} & FALLBACK and (one in CLAIMS) == (other in CLAIMS)


def _is_part(cover: Cover, whole: Cover) -> bool:
    """Whether a cover says less in the same way: "Here comes a teddy", of a bear."""
    one, other = cover.islands[0], whole.islands[0]
    within = other.first <= one.first and one.after <= other.after
    return one.rule == other.rule and one != other and within


def with_rivals(
    best: Sentence, weight: float, rivals: Iterable[tuple[float, Sentence]]
) -> Sentence:
    """A move with other readings of the sentence, each as probable as its cover."""
    weighed = {it.type: (it, weight) for it in best.readings}
    for share, rival in rivals:
        for it in rival.readings:
            weighed.setdefault(it.type, (it, share))
    readings, weights = zip(*weighed.values(), strict=True)
    return Sentence(best.text, tuple(readings), tuple(weights), best.adds)
