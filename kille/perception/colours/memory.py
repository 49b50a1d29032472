"""Colour words as a tutor uses them, learned on top of what people mean by them.

For each colour of a thing, what is known beforehand counts as so many answers to the
question what it is called (`_FIRM`); a lesson counts as one more, for the colours near
it. So one odd lesson shifts the borders of a word a little, and after ten the tutor is
right. A word that nobody knew is learned from its lessons alone.

"This is red" said of what is no such thing to most people is also a small reason
against the words that do hold of it. A new word is none: it may be of another language.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.clouds import Cloud, cloud
from kille.perception.colours.naming import of_the_whole
from kille.perception.colours.palette import Palette
from kille.perception.colours.space import Lab
from kille.perception.colours.words import ColourWords
from kille.perception.learners import Key, own_key

Numbers = NDArray[np.float64]

Shown = tuple[Lab, Numbers]
"""The colours of a lesson, and how far each of them was meant."""

_FIRM = 4.0  # answers: after five lessons against it, the prior gives in
_UNKNOWN = 1.0  # answers of "none of these", where nothing is known beforehand
_DENIAL = 0.25  # of a lesson: to call it red says little about whether it is orange
_CREDIT = 0.05  # a word may be meant for a colour that it never held of


class ColourMemory:
    """A learner of colour words, from palettes.

    `prior` are words that it knows before any lesson; without it, it knows none.
    """

    def __init__(self, prior: ColourWords | None = None) -> None:
        self._prior = prior
        self._words: dict[Key, str] = {}
        self._shown: dict[str, dict[Key, Shown]] = {}
        self._clouds: dict[str, Cloud] = {}

    def copy(self) -> ColourMemory:
        """Another memory that knows the same; either learns without the other."""
        twin = ColourMemory(self._prior)
        twin._words, twin._clouds = dict(self._words), dict(self._clouds)
        twin._shown = {word: dict(shown) for word, shown in self._shown.items()}
        return twin

    @property
    def labels(self) -> tuple[str, ...]:
        """The words that it knows, in alphabetical order."""
        return tuple(sorted({*self._known, *self._taught}))

    def learn_one(self, x: Palette, label: str, *, key: Key | None = None) -> None:
        """Take x to be of that colour; ValueError if the key is taken."""
        if key is None:
            key = own_key(self._words)
        if key in self._words:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        shown = x.lab, self._credit(x, label)
        self._words[key] = label
        self._shown.setdefault(label, {})[key] = shown
        self._clouds.pop(label, None)

    def forget(self, key: Key) -> None:
        """Be as if this had never been learned; KeyError if it was not."""
        label = self._words.pop(key)
        del self._shown[label][key]
        if not self._shown[label]:
            del self._shown[label]
        self._clouds.pop(label, None)

    def degrees(self, x: Palette) -> dict[str, float]:
        """How well each word holds of a thing, in [0, 1]; several may hold at once."""
        names, held = self._known, self._holding(x.lab)
        heard = self._heard_of(x.lab, Cloud.degrees)
        reasons = {word: heard[word] for word in names if word in heard}
        columns = []
        for column, word in enumerate(names):
            before = held[:, column]
            pro = reasons.get(word, np.zeros(len(before)))
            contra = self._against(column, held, reasons)
            columns.append((_FIRM * before + pro) / (_FIRM + pro + contra))
        new = [word for word in heard if word not in names]
        columns += [heard[word] / self._cloud(word).lessons for word in new]
        if not columns:
            return {}
        return of_the_whole((*names, *new), x, np.stack(columns, axis=1))

    def predict_proba_one(self, x: Palette) -> dict[str, float]:
        """The chance that the tutor would choose each word; they sum to 1 at most."""
        heard = self._heard_of(x.lab, Cloud.nearness)
        answers = {word: np.zeros(len(x.lab)) for word in self._known} | heard
        if not answers:
            return {}
        total = sum(heard.values()) + (_FIRM if self._known else _UNKNOWN)
        for word, before in zip(self._known, self._chosen(x.lab).T, strict=True):
            answers[word] = answers[word] + _FIRM * before
        return {
            word: min(1.0, float(x.shares @ (count / total)))
            for word, count in answers.items()
        }

    @property
    def _known(self) -> tuple[str, ...]:
        return () if self._prior is None else self._prior.names

    @property
    def _taught(self) -> tuple[str, ...]:
        """The words of all lessons, in alphabetical order."""
        return tuple(sorted(self._shown))

    def _holding(self, lab: Lab) -> Numbers:
        return (
            np.empty((len(lab), 0)) if self._prior is None else self._prior.degrees(lab)
        )

    def _chosen(self, lab: Lab) -> Numbers:
        return (
            np.empty((len(lab), 0)) if self._prior is None else self._prior.chances(lab)
        )

    def _heard_of(
        self, lab: Lab, measure: Callable[[Cloud, Lab], Numbers]
    ) -> dict[str, Numbers]:
        """How many lessons of each taught word speak for it, for each colour."""
        clouds = {word: self._cloud(word) for word in self._taught}
        return {word: it.lessons * measure(it, lab) for word, it in clouds.items()}

    def _against(
        self, column: int, held: Numbers, reasons: dict[str, Numbers]
    ) -> Numbers:
        """The lessons against a word: of other words, which nobody expected there."""
        against = np.zeros(len(held))
        for word, lessons in reasons.items():
            other = self._known.index(word)
            if other != column:
                against += _DENIAL * lessons * (1 - held[:, other])
        return against

    def _cloud(self, word: str) -> Cloud:
        """The colours of a word's lessons; a thing of several colours counts once."""
        if word not in self._clouds:
            lab, weights = zip(*self._shown[word].values(), strict=True)
            self._clouds[word] = cloud(np.concatenate(lab), np.concatenate(weights))
        return self._clouds[word]

    def _credit(self, x: Palette, word: str) -> Numbers:
        """Which colours of a thing the tutor meant: those of which it may hold."""
        meant = x.shares
        if word in self._known:
            held = self._holding(x.lab)[:, self._known.index(word)]
            meant = meant * (_CREDIT + held)
        return np.asarray(meant / meant.sum())
