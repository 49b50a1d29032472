"""White balance: estimate the light of a picture, and show colours in white light.

What the picture holds is grey on the whole, more so what is bright in it: the light's
colour is a mean that gives bright pixels more weight (shades of grey, Finlayson and
Trezzi 2004). And something in it is nearly white: the lightest thing in view is the
anchor by which people judge how light the others are (Gilchrist et al. 1999). Since a
thing of one colour may fill the picture, or all of it may be dark, only a part of the
cast is removed, and dark pictures are brightened only so far.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kille.scene import Colour

_NORM = 6  # what the paper found best
_PART = 0.75
_ANCHOR = 95  # percentile of the brightness that counts as nearly white
_WHITE = 1.3  # its light; above 1: things stand in less light than the lightest spot
_LIGHTER = 3.0  # times at most: all that is in view may be dark
_SAMPLES = 20_000  # pixels tell the light as well as all of them
_CLIPPED = 250  # brighter readings do not tell the colour of the light
_GAMMA = 2.2
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def balance_light(pixels: Colour, picture: Colour) -> NDArray[np.float32]:
    """Show pixels (n, 3) of a picture (h, w, 3) as in full white light."""
    linear = (pixels.astype(np.float32) / 255) ** _GAMMA * gains(picture)
    # What would be too bright keeps its hue: all three are lessened alike.
    linear /= np.maximum(1, linear.max(axis=1, keepdims=True))
    return np.asarray(255 * linear ** (1 / _GAMMA), np.float32)


def gains(picture: Colour) -> NDArray[np.float32]:
    """The factors (3,) for red, green and blue light."""
    seen = picture.reshape(-1, 3)
    seen = seen[:: max(1, len(seen) // _SAMPLES)]
    light = (seen / 255) ** _GAMMA
    cast = _cast(light[(seen.max(axis=1) < _CLIPPED) & (seen.max(axis=1) > 0)])
    bright = float(np.percentile(light @ _LUMINANCE, _ANCHOR))
    lighter = np.clip(_WHITE / max(bright, 1e-4), 1, _LIGHTER)
    return np.asarray(cast * lighter, np.float32)


def _cast(light: NDArray[np.float64]) -> NDArray[np.float64]:
    """Factors that remove a part of the light's colour and keep its brightness."""
    if not len(light):
        return np.ones(3)
    colour = np.mean(light**_NORM, axis=0) ** (1 / _NORM) + 1e-4
    gain = (colour.mean() / colour) ** _PART
    return np.asarray(gain / (gain @ _LUMINANCE))
