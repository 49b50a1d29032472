"""What a tutor says of all things of a kind, as evidence for what a thing is.

"Mugs are white." gives the degree t to which a thing is white if it is a mug. Of a
thing that is white to the degree d it makes the word stronger by

    log (d t + (1 - d)(1 - t)) / (d q + (1 - d)(1 - q))

the logarithm of how much likelier that is of a mug than of any thing, of which q are so
(naive Bayes with evidence that is itself uncertain: Pearl 1988, section 2.2). Where the
word for the quality is not known, or its degree cannot be told, it adds nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.perception.learners import Key

CUE = "told"
"""The name under which this evidence is counted among the cues."""

USUAL = 0.2
"""q: how many of all things have a quality that is worth saying of some of them."""

Degree = float | tuple[float, float]


class Generic(NamedTuple):
    """How many of the things that a noun is said of have a quality."""

    noun: str
    quality: str
    degree: float


class Generics:
    """A learner of generics: it keeps them by the keys of their lessons."""

    def __init__(self) -> None:
        self._learned: dict[Key, Generic] = {}

    def copy(self) -> Generics:
        """A copy that knows the same; either learns without the other."""
        twin = Generics()
        twin.become(self)
        return twin

    def become(self, other: Generics) -> None:
        """Take over all that the other knows; afterwards either learns by itself."""
        self._learned = dict(other._learned)

    def learn_one(self, generic: Generic, *, key: Key) -> None:
        """Learn a generic; ValueError if the key is taken."""
        if key in self._learned:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        self._learned[key] = generic

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        del self._learned[key]

    def evidence(
        self, labels: Sequence[str], degree: Callable[[str], Degree]
    ) -> NDArray[np.float64] | None:
        """What they add for each word (words,); None where nothing is known of any.

        `degree` says how far a quality, named by its predicate, is true of the thing.
        """
        known = [it for it in self._learned.values() if it.noun in labels]
        if not known:
            return None
        added = np.zeros(len(labels))
        for it in known:
            added[labels.index(it.noun)] += support(it.degree, degree(it.quality))
        return added


def support(generic: float, seen: Degree) -> float:
    """How much stronger a word becomes, as a logarithm.

    `generic` is how many of its things have a quality, `seen` how far this one has it.

    >>> round(support(0.9, 1.0), 2), round(support(0.9, 0.0), 2), support(0.9, (0, 1))
    (1.5, -2.08, 0.0)
    """
    if isinstance(seen, tuple):
        return 0.0
    of_these = seen * generic + (1 - seen) * (1 - generic)
    of_all = seen * USUAL + (1 - seen) * (1 - USUAL)
    return math.log(max(of_these, 1e-3) / of_all)
