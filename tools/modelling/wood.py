"""The wood of the table."""

from __future__ import annotations

import numpy as np

from kille.scene import Colour
from tools.modelling import drawing as draw


def wood() -> Colour:
    """Pale boards with a faint grain, two millimetres a texel."""
    rng = np.random.default_rng(71)
    wood = draw.blank(700, 550, (196, 168, 132))
    draw.mottle(wood, 4.0, (160, 5), rng)
    draw.mottle(wood, 2.0, (40, 2), rng)
    draw.mottle(wood, 3.0, (300, 90), rng)
    return wood
