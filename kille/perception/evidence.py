"""Evidence: how much each cue adds for each word, and the degrees that follow from it.

With e_c(w) what cue c adds for word w, the strength of a word and its degree are

    s(w) = exp(b + Σ_c e_c(w)),   p(w) = s(w) / (1 + Σ s)

so that "none of these words" has strength 1, and its degree is what the words leave
(the multinomial logit with an outside option: McFadden 1974, "Conditional logit
analysis of qualitative choice behavior"). A trait adds how far the regression on the
examples speaks for the word, features add their votes beyond chance, and metric size
takes off how unlike the example nearest in size is:

    e_c(w) = r score_c(w) [- a d_size(w) if c is size],   e_features(w) = v √votes(w)

where d_size is 3 at most, and 0 for a word no example of which has a known size. Size
alone rejects: it is what light, distance and dirt do not change, while a thing may
well have another colour than all examples of its word. b, r, a and v were fitted
(`tools.fitting.evidence`) to things of which many had not been taught, seen
in another light and partly hidden, and to pictures of things that are mostly new.

They are where a memory begins. As its lessons grow, they say how much a score proves
among these very things (`kille.perception.calibration`): b and r become

    b' = slope (b + u) + shift - u,   r' = slope r

where u is what the votes of features add on the whole, since lessons that are left out
are asked for their traits only. So degrees are right as often as they say, also where
half of what is asked about was never taught. How much is strange of what is asked about
a tutor may tell, and then b' is changed by that (`kille.perception.strangers`).
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files

import numpy as np

from kille.perception.calibration import LeftOut, calibrate
from kille.perception.likeness import SIZE, Kernel, Likeness, Numbers
from kille.perception.strangers import log_odds_of_strangers

__all__ = ["Evidence", "Weighing", "weighing"]

FEATURES = "features"
"""The name under which the votes of features are counted among the cues."""

FARTHEST = 3.0
"""What is less alike than that says no more."""


@dataclass(frozen=True)
class Weighing:
    """How evidence is weighed: b, r, v, a, the kernel of each cue, and u.

    >>> packaged = weighing()
    >>> "colour" in packaged.kernels
    True
    """

    base: float
    score: float
    votes: float
    size: float
    kernels: Mapping[str, Kernel]
    usual: float = 0.0

    def calibrate_by(self, found: LeftOut | None) -> Weighing:
        """The weighing of a memory whose lessons say this of each other."""
        if found is None or not self.score:
            return self
        traits = self.base + self.usual
        logits = traits + self.score * found.scores
        apart = -self.size * _as_far(found.unlike)
        by = calibrate(found, logits, apart)
        base = by.slope * traits + by.shift - self.usual
        return replace(self, base=base, score=by.slope * self.score)

    def reckon_with(self, known: Sequence[bool]) -> Weighing:
        """The same where so many strangers are to be reckoned with.

        `known` is of each thing told about whether it was known, the latest last.
        """
        if not known:
            return self
        return replace(self, base=self.base - log_odds_of_strangers(known))

    def evidence(
        self, labels: tuple[str, ...], likeness: Likeness, votes: Numbers
    ) -> Evidence:
        """What each cue adds for each word; `votes` (words,) are those beyond
        chance."""
        added = {cue: self.score * score for cue, score in likeness.scores.items()}
        if SIZE in added:
            added[SIZE] = added[SIZE] - self.size * unlike_in_size(likeness)
        added[FEATURES] = self.votes * np.sqrt(votes)
        return Evidence(labels, self.base, added)


def unlike_in_size(likeness: Likeness) -> Numbers:
    """d_size for each word (words,): 0 where no size of the word is known."""
    return _as_far(likeness.unlike[SIZE])


def _as_far(unlike: Numbers) -> Numbers:
    """d_size of dissimilarities, which are infinite where nothing is known."""
    return np.where(np.isfinite(unlike), np.minimum(unlike, FARTHEST), 0.0)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What each cue adds for each word, (words,) each, and the base they are added
    to.

    >>> added = {"colour": np.array([1.0, -1.0])}
    >>> degrees = Evidence(("cup", "book"), 0.0, added).degrees()
    >>> max(degrees, key=degrees.get)
    'cup'
    """

    labels: tuple[str, ...]
    base: float
    added: Mapping[str, Numbers]

    def degrees(self) -> dict[str, float]:
        """The degree of each word; they sum to 1 at most."""
        logs = self.base + sum(self.added.values(), np.zeros(len(self.labels)))
        highest = max(float(logs.max(initial=0.0)), 0.0)
        strengths = np.exp(logs - highest)
        degrees = strengths / (np.exp(-highest) + strengths.sum())
        return dict(zip(self.labels, degrees.tolist(), strict=True))

    def reasons(self, word: str, rival: str | None = None) -> dict[str, float]:
        """What each cue adds for a word, or adds more for it than for a rival.

        Largest first: these are logarithms of how many times stronger it makes the
        word. KeyError for a word that is not among the labels.
        """
        this = self._column(word)
        other = None if rival is None else self._column(rival)
        more = {
            cue: float(some[this] - (0.0 if other is None else some[other]))
            for cue, some in self.added.items()
        }
        return dict(sorted(more.items(), key=lambda item: -item[1]))

    def _column(self, word: str) -> int:
        try:
            return self.labels.index(word)
        except ValueError:
            raise KeyError(word) from None


@cache
def weighing(name: str = "default") -> Weighing:
    """One of the weighings that come with the package, `default` or `embedding`.

    Where there is nothing but the features it is `instances`, and nothing but the
    traits, `cues`. KeyError for another name.

    >>> weighing().size > 0
    True
    """
    text = files("kille.perception").joinpath("weighing.json").read_text("utf-8")
    fitted = json.loads(text)[name]
    cues = fitted["cues"]
    return Weighing(
        fitted["base"],
        fitted["score"],
        fitted["votes"],
        fitted["size"],
        {cue: Kernel(it["weight"], it["width"]) for cue, it in cues.items()},
        fitted["usual"],
    )
