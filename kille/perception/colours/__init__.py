"""Colour words: which colours a thing has, and what they are called.

>>> degrees = colour_words(plain(lab_of([200, 30, 30])), xkcd().among(BASIC))
>>> {word: round(p, 1) for word, p in degrees.items() if p > 0.5}
{'red': 1.0}
"""

from __future__ import annotations

from kille.perception.colours.memory import ColourMemory
from kille.perception.colours.naming import colour_chances, colour_words
from kille.perception.colours.palette import (
    Palette,
    colours_in,
    colours_of,
    pack_palette,
    plain,
    unpack_palette,
)
from kille.perception.colours.space import Lab, lab_of, rgb_of
from kille.perception.colours.words import BASIC, ColourWords, xkcd
from ttr.aliases import former_names

__getattr__ = former_names(
    __name__, {"packed": "pack_palette", "unpacked": "unpack_palette"}
)

__all__ = [
    "BASIC",
    "ColourMemory",
    "ColourWords",
    "Lab",
    "Palette",
    "colour_chances",
    "colour_words",
    "colours_in",
    "colours_of",
    "lab_of",
    "pack_palette",
    "plain",
    "rgb_of",
    "unpack_palette",
    "xkcd",
]
