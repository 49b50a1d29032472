"""How words are pronounced: by the dictionary, by their parts, or guessed by letters.

Sounds are written as in the CMU pronouncing dictionary (ARPAbet): "K AH P".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

Dictionary = Callable[[str], str | None]
"""The sounds of a word, or None if it is not in the dictionary."""

_SHORTEST = 3
"""Letters; each part of a compound has at least so many."""

_VOWELS = "aeiouy"


@dataclass(frozen=True)
class Pronouncer:
    """Ways to pronounce words of which the dictionary may know the parts.

    >>> said = Pronouncer(
    ...     dictionary={"hair": "HH EH R", "brush": "B R AH SH"}.get,
    ...     letters={"w": "W", "u": "AH", "g": "G", "d": "D", "a": "AE", "z": "Z"},
    ...     long={"a": "EY"},
    ... )
    >>> said.of("hairbrush"), said.of("wug"), said.of("daze"), said.of("wug-hair")
    ('HH EH R B R AH SH', 'W AH G', 'D EY Z', 'W AH G HH EH R')
    """

    dictionary: Dictionary
    letters: Mapping[str, str]
    long: Mapping[str, str]

    def of(self, word: str) -> str:
        """The sounds of a word; "" for one without letters, such as "7"."""
        parts = re.findall(r"[^\W\d_]+", word.lower())
        return " ".join(filter(None, map(self._part, parts)))

    def _part(self, word: str) -> str:
        return self.dictionary(word) or self._compound(word) or self._guess(word)

    def _compound(self, word: str) -> str:
        """The sounds of two words of the dictionary that make up this one."""
        for at in range(len(word) - _SHORTEST, _SHORTEST - 1, -1):
            first, second = self.dictionary(word[:at]), self.dictionary(word[at:])
            if first and second:
                return f"{first} {second}"
        return ""

    def _guess(self, word: str) -> str:
        """The sounds of the letters, with what a silent e at the end does to them."""
        *front, vowel, consonant, last = (*"  ", *word)[-max(3, len(word)) :]
        silent = last == "e" and consonant not in _VOWELS and vowel in self.long
        if silent:
            stem = "".join(front).strip()
            spoken = (self._spell(stem), self.long[vowel], self._spell(consonant))
            return " ".join(filter(None, spoken))
        return self._spell(word)

    def _spell(self, letters: str) -> str:
        """The sounds of letters, the longest that is known before the next."""
        sounds, rest = [], letters
        while rest:
            known = next(
                (rest[:n] for n in range(len(rest), 0, -1) if rest[:n] in self.letters),
                "",
            )
            sounds.append(self.letters.get(known, ""))
            rest = rest[max(1, len(known)) :]
        return " ".join(filter(None, sounds))
