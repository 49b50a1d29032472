"""Reasons: what decided a judgement of a word, and the lesson it goes back to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from kille.memory import Lesson


@dataclass(frozen=True)
class Share:
    """How much of what speaks for a word is due to a cue, in [0, 1]."""

    cue: str
    share: float


@dataclass(frozen=True, eq=False)
class Reasons:
    """Why a word is taken to hold to a degree.

    `cues` speak for it, most first, with shares that sum to 1; there are none where
    nothing speaks for it. `lesson` is the remembered one that is nearest by that
    evidence, with its picture; None where the word was known without a lesson. `margin`
    is the degree less that of the rival, None where there is no rival.
    """

    word: str
    degree: float
    cues: tuple[Share, ...]
    lesson: Lesson | None
    rival: str | None
    margin: float | None


def shares_of(added: Mapping[str, float]) -> tuple[Share, ...]:
    """The shares of the cues that add something, the most first.

    >>> shares_of({"size": 1.0, "colour": 3.0, "shape": -2.0})
    (Share(cue='colour', share=0.75), Share(cue='size', share=0.25))
    """
    positive = {cue: more for cue, more in added.items() if more > 0}
    total = sum(positive.values())
    ordered = sorted(positive.items(), key=lambda item: -item[1])
    return tuple(Share(cue, more / total) for cue, more in ordered)


def best_rival(
    word: str, degrees: Mapping[str, float], rival: str | None = None
) -> tuple[str | None, float | None]:
    """The best other word, or the rival given, and by how much this one is ahead."""
    others = [other for other in degrees if other != word]
    named = rival or max(others, key=lambda other: degrees[other], default=None)
    if named is None:
        return None, None
    return named, degrees.get(word, 0.0) - degrees.get(named, 0.0)
