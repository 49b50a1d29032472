"""What is measured of a look, once and when it is first asked for."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kille.grounding.comparisons import Extents, extents_of
from kille.perception.colours import Palette, colours_of
from kille.perception.relations.configurations import configurations
from kille.perception.relations.memory import template_odds
from kille.perception.relations.perspectives import AWAY, seen_from
from kille.scene import Configuration, Look

Pair = tuple[int, int]
"""The numbers of a target and a landmark in a look, from 0."""


class Measurements:
    """A look, with what the learners of words ask of it."""

    def __init__(self, look: Look) -> None:
        self.look = look
        self._palettes: dict[int, Palette | None] = {}
        self._pairs: dict[str, Mapping[Pair, Configuration]] = {}
        self._odds: dict[str, NDArray[np.float64]] = {}

    @cached_property
    def extents(self) -> tuple[Extents | None, ...]:
        """How big each thing is, and how far away; None for what has no place."""
        return extents_of(self.look)

    def palette(self, number: int) -> Palette | None:
        """The colours of a thing; None if it has none, or was only described."""
        if number not in self._palettes:
            percept = self.look.percepts[number]
            self._palettes[number] = (
                None
                if percept.frame is None
                else colours_of(percept.frame, percept.region)
            )
        return self._palettes[number]

    def configurations(self, front: str = AWAY) -> Mapping[Pair, Configuration]:
        """How any two things stand to each other, in a perspective of `FRONTS`.

        Pairs with an unknown place are missing.
        """
        if front not in self._pairs and front != AWAY:
            seen = self.configurations()
            self._pairs[front] = {
                pair: seen_from(stand, front) for pair, stand in seen.items()
            }
        if front not in self._pairs:
            regions = [it.region for it in self.look.percepts]
            self._pairs[front] = configurations(self.look.frame, regions, self.look.up)
        return self._pairs[front]

    def template_odds(self, front: str = AWAY) -> NDArray[np.float64]:
        """What the templates that spatial words may mean say of these, in order."""
        if front not in self._odds:
            self._odds[front] = template_odds(
                tuple(self.configurations(front).values())
            )
        return self._odds[front]
