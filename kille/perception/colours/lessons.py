"""Lessons in colour words: the colours shown for each word, and how near others are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.clouds import Cloud, cloud
from kille.perception.colours.palette import Palette
from kille.perception.colours.space import Lab
from kille.perception.learners import Key

Numbers = NDArray[np.float64]

Shown = tuple[Lab, Numbers]
"""The colours of a lesson, and how far each of them was meant."""


class Lessons:
    """The colours shown for some words, in the order of learning."""

    def __init__(self) -> None:
        self._shown: dict[str, dict[Key, Shown]] = {}
        self._clouds: dict[str, Cloud] = {}

    def copy(self) -> Lessons:
        """An independent copy of the lessons."""
        twin = Lessons()
        twin._shown = {word: dict(shown) for word, shown in self._shown.items()}
        twin._clouds = dict(self._clouds)
        return twin

    @property
    def words(self) -> tuple[str, ...]:
        """The words of all lessons, in alphabetical order."""
        return tuple(sorted(self._shown))

    def has(self, word: str, key: Key) -> bool:
        """Does the word have a lesson of this key?"""
        return key in self._shown.get(word, {})

    def add(self, word: str, key: Key, shown: Shown) -> None:
        """Add a lesson."""
        self._shown.setdefault(word, {})[key] = shown
        self._clouds.pop(word, None)

    def drop(self, word: str, key: Key) -> None:
        """Remove a lesson."""
        del self._shown[word][key]
        if not self._shown[word]:
            del self._shown[word]
        self._clouds.pop(word, None)

    def cloud(self, word: str) -> Cloud:
        """The cloud of a word's lessons; a thing of several colours counts once."""
        if word not in self._clouds:
            lab, weights = zip(*self._shown[word].values(), strict=True)
            self._clouds[word] = cloud(np.concatenate(lab), np.concatenate(weights))
        return self._clouds[word]

    def near(
        self, lab: Lab, measure: Callable[[Cloud, Lab], Numbers]
    ) -> dict[str, Numbers]:
        """How many lessons in each word are near each colour (n,)."""
        clouds = {word: self.cloud(word) for word in self.words}
        return {word: it.lessons * measure(it, lab) for word, it in clouds.items()}

    def nearest(self, word: str, x: Palette) -> Key | None:
        """The lesson in a word whose colours are most like those of a thing, if any."""
        unlike = {
            key: float(x.shares @ _apart(x.lab, lab).min(axis=1))
            for key, (lab, _) in self._shown.get(word, {}).items()
        }
        return min(unlike, key=lambda key: unlike[key]) if unlike else None


def _apart(some: Lab, others: Lab) -> Numbers:
    """The distances (n, m) between colours."""
    return np.asarray(np.linalg.norm(some[:, None] - others[None], axis=2))
