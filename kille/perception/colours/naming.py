"""Colour words for a thing that may have several colours.

A thing is called red when much of it is red: half is enough, a tenth hardly is. So a
flag may be red and white, while a red apple with a brown stalk is not brown. With
g(s) = min(1, 2s), the degree to which a share s is much, the degree of a word is

    ∫ g(the share of the thing that the word holds of to a degree of t or more) dt

over t from 0 to 1: the integral of Choquet (1954), by which Zadeh's (1983) "most" is
taken of what is itself a matter of degree. Which word one would choose is shared out
among the colours of the thing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kille.perception.colours.palette import Palette
from kille.perception.colours.words import ColourWords, xkcd

_MUCH = 0.5
"""The share of a thing that is enough for a word to apply fully."""


def colour_words(
    palette: Palette, words: ColourWords | None = None
) -> dict[str, float]:
    """How well each word applies to a thing: {word: degree in [0, 1]}.

    Without `words` these are the 42 of `xkcd()`. Several may hold at once.

    >>> from kille.perception.colours.palette import plain
    >>> degrees = colour_words(plain([48, 66, 48]))
    >>> max(degrees, key=degrees.get)
    'red'
    """
    known = xkcd() if words is None else words
    return of_the_whole(known.names, palette, known.degrees(palette.lab))


def colour_chances(
    palette: Palette, words: ColourWords | None = None
) -> dict[str, float]:
    """P(word | thing), the word that people would choose for it; it sums to 1.

    >>> from kille.perception.colours import plain
    >>> chances = colour_chances(plain([48, 66, 48]))
    >>> max(chances, key=chances.get), round(sum(chances.values()), 6)
    ('red', 1.0)
    """
    known = xkcd() if words is None else words
    chances = palette.shares @ known.chances(palette.lab)
    return dict(zip(known.names, chances.tolist(), strict=True))


def of_the_whole(
    names: tuple[str, ...], palette: Palette, degrees: NDArray[np.float64]
) -> dict[str, float]:
    """The degrees of words for a thing, from those (k, w) for its colours."""
    order = np.argsort(-degrees, axis=0, kind="stable")
    much = np.minimum(1.0, np.cumsum(palette.shares[order], axis=0) / _MUCH)
    steps = np.diff(much, axis=0, prepend=0)
    whole = (np.take_along_axis(degrees, order, axis=0) * steps).sum(axis=0)
    return dict(zip(names, np.clip(whole, 0, 1).tolist(), strict=True))
