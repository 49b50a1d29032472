"""The one-number rule: a word is a threshold on an angle or a distance.

Of a few numbers of a place (the cosines with right, left, away, towards, up and down,
the distance and its negative) each word gets the one that best separates its examples
from the others', and the threshold with the fewest errors. It is the baseline for every
other learner. A caller may say beforehand which number a word is about.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from kille.perception.learners import Key, own_key
from kille.perception.relations.measures import clip_lengths, size_of
from kille.scene import Configuration

NUMBERS = ("right", "left", "away", "towards", "up", "down", "near", "far")
"""The numbers that a word may be about."""

_SHARPNESS = 6.0
_UNHEARD = 0.3  # how far below the least example the border is, if there is no other

Vector = NDArray[np.float64]


class AngleRule:
    """A learner of spatial words as borders on one number each; see the module.

    `about` names the number of the words for which it is known.

    >>> from kille.scene import Configuration
    >>> left, right = Configuration((-0.3, 0, 0)), Configuration((0.3, 0, 0))
    >>> memory = AngleRule()
    >>> for _ in range(3):
    ...     memory.learn_one(left, "left")
    ...     memory.learn_one(right, "right")
    >>> degrees = memory.predict_proba_one(Configuration((0.4, 0.1, 0)))
    >>> max(degrees, key=degrees.get)
    'right'
    """

    def __init__(self, about: Mapping[str, str] = MappingProxyType({})) -> None:
        self._about = about
        self._heard: dict[Key, tuple[Vector, str, bool]] = {}
        self._rules: dict[str, tuple[int, float]] | None = None

    @property
    def labels(self) -> tuple[str, ...]:
        """The learned words in alphabetical order."""
        return tuple(sorted({label for _, label, _ in self._heard.values()}))

    def learn_one(
        self, x: Configuration, label: str, *, key: Key | None = None
    ) -> None:
        """Take x as an instance of the word; ValueError if the key is taken."""
        self._learn(x, label, True, key)

    def judge_one(
        self, x: Configuration, label: str, degree: float, *, key: Key | None = None
    ) -> None:
        """Take x as an instance of the word or, below .5, as none; ValueError if the
        key is taken."""
        self._learn(x, label, degree >= 0.5, key)

    def _learn(self, x: Configuration, label: str, held: bool, key: Key | None) -> None:
        if key in self._heard:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        key = own_key(self._heard) if key is None else key
        self._heard[key] = (_numbers(x), label, held)
        self._rules = None

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        del self._heard[key]
        self._rules = None

    def degrees(self, x: Configuration) -> dict[str, float]:
        """How far x is inside the threshold of each word, as a degree in [0, 1]."""
        if self._rules is None:
            self._rules = {word: self._rule(word) for word in self.labels}
        numbers = _numbers(x)
        return {
            word: 1 / (1 + math.exp(-_SHARPNESS * (float(numbers[which]) - border)))
            for word, (which, border) in self._rules.items()
        }

    def predict_proba_one(self, x: Configuration) -> dict[str, float]:
        """The degrees, scaled down where they sum to more than 1."""
        degrees = self.degrees(x)
        total = max(1.0, sum(degrees.values()))
        return {word: degree / total for word, degree in degrees.items()}

    def _rule(self, word: str) -> tuple[int, float]:
        """Which number the word is about, and its border."""
        of_word = [it for it in self._heard.values() if it[1] == word]
        inside = np.array([numbers for numbers, _, held in of_word if held])
        # What was judged of the word tells more than what was said of others.
        outside = [numbers for numbers, _, held in of_word if not held] or [
            numbers for numbers, label, held in self._heard.values() if label != word
        ]
        candidates = (
            [NUMBERS.index(self._about[word])]
            if word in self._about
            else range(len(NUMBERS))
        )
        rules = [
            (*_border(inside, np.array(outside), which), which) for which in candidates
        ]
        _, _, border, which = min(rules)
        return which, border


def _border(inside: Vector, outside: Vector, which: int) -> tuple[float, float, float]:
    """The share of errors, the room at the threshold (negated), and the threshold."""
    ins = inside[:, which] if len(inside) else np.empty(0)
    outs = outside[:, which] if len(outside) else np.empty(0)
    if not len(outs):
        least = ins.min() - _UNHEARD
        return 0.0, -float(least), float(least)
    values = np.unique([*ins, *outs])
    middles = (values[1:] + values[:-1]) / 2
    borders = np.array([values[0] - _UNHEARD, *middles, values[-1] + _UNHEARD])
    missed = np.array([(ins < it).mean() if len(ins) else 0.0 for it in borders])
    taken = np.array([(outs >= it).mean() for it in borders])
    room = np.diff([borders[0], *values, borders[-1]]).max(initial=0.0)
    best = int(np.argmin(missed + taken))
    return float(missed[best] + taken[best]), -float(room), float(borders[best])


def _numbers(x: Configuration) -> Vector:
    place = np.nan_to_num(np.array(x.offset, np.float64), posinf=0.0, neginf=0.0)
    place = clip_lengths(place)
    right, away, up = place / max(float(np.linalg.norm(place)), 1e-9)
    far = math.log(max(float(np.linalg.norm(place)) / size_of(x), 1e-3))
    return np.array([right, -right, away, -away, up, -up, -far, far])
