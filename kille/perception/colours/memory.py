"""Colour words as a tutor uses them, learned on top of common usage.

For each colour of a thing, what is known beforehand counts as so many answers to the
question what it is called (`_FIRM`); a lesson counts as one more, for the colours near
it. So one odd lesson shifts the borders of a word a little, and after ten the tutor is
right. A word that nobody knew is learned from its lessons alone.

A word that is denied of a thing, "no, this is not red", is weakened for the colours
near it, by enough answers against it (`_DENIED`) that it no longer holds there: a
corrected robot does not repeat its mistake. That is no reason for any other word, and a
word that was only denied is not known.

"This is red" said of what is no such thing to most people is also a small reason
against the words that do hold of it. A new word is none: it may be of another language.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.clouds import Cloud
from kille.perception.colours.lessons import Lessons, Shown
from kille.perception.colours.naming import of_the_whole
from kille.perception.colours.palette import Palette
from kille.perception.colours.space import Lab
from kille.perception.colours.words import ColourWords
from kille.perception.learners import Key, own_key

Numbers = NDArray[np.float64]

_FIRM = 4.0  # answers: after five lessons against it, the prior gives in
_UNKNOWN = 1.0  # answers of "none of these", where nothing is known beforehand
_DENIAL = 0.25  # of a lesson: to call it red says little about whether it is orange
_DENIED = 8.0  # answers: a word that is denied is weaker than 1/2 there at once
_CREDIT = 0.05  # a word may be meant for a colour that it never held of


class ColourMemory:
    """A learner of colour words, from palettes.

    `prior` are words that it knows before any lesson; without it, it knows none.

    >>> from kille.perception.colours import plain
    >>> memory = ColourMemory()
    >>> memory.learn_one(plain([48, 66, 48]), "red")
    >>> memory.learn_one(plain([30, 20, -60]), "blue")
    >>> degrees = memory.predict_proba_one(plain([50, 60, 40]))
    >>> max(degrees, key=degrees.get)
    'red'
    """

    def __init__(self, prior: ColourWords | None = None) -> None:
        self._prior = prior
        self._words: dict[Key, str] = {}
        self._shown = Lessons()
        self._denied = Lessons()

    def copy(self) -> ColourMemory:
        """A copy that knows the same; either learns without the other."""
        twin = ColourMemory()
        twin.become(self)
        return twin

    def become(self, other: ColourMemory) -> None:
        """Take over all that the other knows; afterwards either learns by itself."""
        self._prior, self._words = other._prior, dict(other._words)
        self._shown, self._denied = other._shown.copy(), other._denied.copy()

    @property
    def labels(self) -> tuple[str, ...]:
        """The words that it knows, in alphabetical order."""
        return tuple(sorted({*self._prior_words, *self._shown.words}))

    def knows(self, word: str) -> bool:
        """Is this a colour word, known beforehand or taught?"""
        return word in self._prior_words or word in self._shown.words

    def learn_one(self, x: Palette, label: str, *, key: Key | None = None) -> None:
        """Learn that the word applies to x; ValueError if the key is taken."""
        self._shown.add(
            label, self._reserve_key(label, key), self._colours_of_lesson(x, label)
        )

    def deny_one(self, x: Palette, label: str, *, key: Key | None = None) -> None:
        """Learn that the word does not apply to x; ValueError if the key is taken."""
        self._denied.add(
            label, self._reserve_key(label, key), self._colours_of_lesson(x, label)
        )

    def forget(self, key: Key) -> None:
        """Undo a lesson, as if it had never been given; KeyError if there was none."""
        label = self._words.pop(key)
        lessons = self._shown if self._shown.has(label, key) else self._denied
        lessons.drop(label, key)

    def nearest(self, x: Palette, label: str) -> Key | None:
        """The lesson in a word whose colours were most like those of x, if any."""
        return self._shown.nearest(label, x)

    def _reserve_key(self, label: str, key: Key | None) -> Key:
        """Reserve the key, or a new one, for a lesson in this word."""
        if key in self._words:
            raise ValueError(f"the key {key!r} was learned before; forget it first")
        named = own_key(self._words) if key is None else key
        self._words[named] = label
        return named

    def _colours_of_lesson(self, x: Palette, label: str) -> Shown:
        return x.lab, self._credit(x, label)

    def degrees(self, x: Palette) -> dict[str, float]:
        """How well each word applies, in [0, 1]; several may apply at once."""
        names, held = self._prior_words, self._prior_degrees(x.lab)
        heard = self._shown.near(x.lab, Cloud.degrees)
        denied = self._denied.near(x.lab, Cloud.degrees)
        nothing = np.zeros(len(x.lab))
        reasons = {word: heard[word] for word in names if word in heard}
        columns = []
        for column, word in enumerate(names):
            before = held[:, column]
            pro = reasons.get(word, nothing)
            contra = self._against(column, held, reasons)
            contra = contra + _DENIED * denied.get(word, nothing)
            columns.append((_FIRM * before + pro) / (_FIRM + pro + contra))
        new = [word for word in heard if word not in names]
        for word in new:
            lessons = self._shown.cloud(word).lessons
            denials = denied.get(word, nothing)
            columns.append(heard[word] / (lessons + _DENIED * denials))
        if not columns:
            return {}
        return of_the_whole((*names, *new), x, np.stack(columns, axis=1))

    def predict_proba_one(self, x: Palette) -> dict[str, float]:
        """The probability that the tutor chooses each word; they sum to 1 at most."""
        heard = self._shown.near(x.lab, Cloud.nearness)
        answers = {word: np.zeros(len(x.lab)) for word in self._prior_words} | heard
        if not answers:
            return {}
        total = sum(heard.values()) + (_FIRM if self._prior_words else _UNKNOWN)
        for word, before in zip(
            self._prior_words, self._prior_chances(x.lab).T, strict=True
        ):
            answers[word] = answers[word] + _FIRM * before
        for word, denials in self._denied.near(x.lab, Cloud.nearness).items():
            if word in answers:
                answers[word] = answers[word] * _FIRM / (_FIRM + _DENIED * denials)
        return {
            word: min(1.0, float(x.shares @ (count / total)))
            for word, count in answers.items()
        }

    @property
    def _prior_words(self) -> tuple[str, ...]:
        return () if self._prior is None else self._prior.names

    def _prior_degrees(self, lab: Lab) -> Numbers:
        return (
            np.empty((len(lab), 0)) if self._prior is None else self._prior.degrees(lab)
        )

    def _prior_chances(self, lab: Lab) -> Numbers:
        return (
            np.empty((len(lab), 0)) if self._prior is None else self._prior.chances(lab)
        )

    def _against(
        self, column: int, held: Numbers, reasons: dict[str, Numbers]
    ) -> Numbers:
        """The lessons against a word: those in other words that were unexpected
        there."""
        against = np.zeros(len(held))
        for word, lessons in reasons.items():
            other = self._prior_words.index(word)
            if other != column:
                against += _DENIAL * lessons * (1 - held[:, other])
        return against

    def _credit(self, x: Palette, word: str) -> Numbers:
        """How much each colour of a thing was probably meant by the tutor."""
        meant = x.shares
        if word in self._prior_words:
            held = self._prior_degrees(x.lab)[:, self._prior_words.index(word)]
            meant = meant * (_CREDIT + held)
        return np.asarray(meant / meant.sum())
