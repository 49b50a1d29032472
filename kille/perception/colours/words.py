"""Colour words as most people use them: when each applies, and which one is chosen.

Two questions are asked of a word. Does it hold of a colour ("is this red?")? Several
words hold of most colours, each to a degree. And would one choose it ("what colour is
this?")? Then words compete, and what comes to mind more easily is chosen more often:

    P(word | colour) ∝ availability(word) · aptness(word, colour).

What is apt is narrower than what holds: a lime is green, but few would say no more
than that. So each word has borders for either question. They were fitted to 2.1 million
names that people gave to colours on their screens; the availability is that of a word
whose aptness is 1, which few words reach. Sources: McMahan and Stone 2015; the colour
survey of xkcd 2010, as published by Heer and Stone 2012.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from kille.perception.colours.borders import AXES, Borders, Numbers

BASIC = (
    "black",
    "white",
    "grey",
    "red",
    "green",
    "blue",
    "yellow",
    "orange",
    "brown",
    "pink",
    "purple",
)
"""The eleven basic colour words of English (Berlin and Kay 1969).

>>> from kille.perception.colours import BASIC
>>> print(*BASIC)
black white grey red green blue yellow orange brown pink purple
"""


@dataclass(frozen=True, eq=False)
class ColourWords:
    """Some colour words, with the borders of what they apply to and are chosen for."""

    names: tuple[str, ...]
    availability: Numbers
    holding: Borders
    apt: Borders

    def degrees(self, lab: ArrayLike) -> Numbers:
        """How well each word applies to colours (n, 3): (n, w), each in [0, 1].

        >>> red = np.array([[48, 66, 48]])
        >>> degrees = dict(zip(xkcd().names, xkcd().degrees(red)[0], strict=True))
        >>> [word for word, p in degrees.items() if p > 0.9]
        ['red']
        """
        return np.exp(self.holding.log_degrees(np.asarray(lab, float)))

    def chances(self, lab: ArrayLike) -> Numbers:
        """P(word | colour) for colours (n, 3): (n, w); each row sums to 1."""
        weights = self.apt.log_degrees(np.asarray(lab, float))
        weights = weights + np.log(self.availability)
        shares = np.exp(weights - weights.max(axis=1, keepdims=True, initial=-np.inf))
        return np.asarray(shares / shares.sum(axis=1, keepdims=True))

    def among(self, names: Iterable[str]) -> ColourWords:
        """Only these words; ValueError for an unknown one.

        >>> xkcd().among(["red", "green"]).names
        ('red', 'green')
        """
        wanted = tuple(dict.fromkeys(names))
        if missing := [name for name in wanted if name not in self.names]:
            raise ValueError(f"no such colour word: {', '.join(missing)}")
        which = [self.names.index(name) for name in wanted]
        return ColourWords(
            wanted,
            self.availability[which],
            self.holding.some(which),
            self.apt.some(which),
        )


@cache
def xkcd() -> ColourWords:
    """The 42 words, among them the eleven basic ones, as fitted to the survey of xkcd.

    >>> set(BASIC) < set(xkcd().names)
    True
    """
    text = files("kille.perception.colours").joinpath("xkcd.json").read_text("utf-8")
    return parse_colour_words(json.loads(text))


def parse_colour_words(fitted: Mapping[str, Any]) -> ColourWords:
    """Read the words from what `tools.fitting.colour_words` has written."""
    words: Mapping[str, Any] = fitted["words"]
    hues = np.array([word["hue"] for word in words.values()], float)
    return ColourWords(
        tuple(words),
        np.array([word["availability"] for word in words.values()], float),
        Borders(hues, _edges(words, "holds")),
        Borders(hues, _edges(words, "apt")),
    )


def _edges(words: Mapping[str, Any], kind: str) -> Numbers:
    return np.array([[word[kind][axis] for axis in AXES] for word in words.values()])
