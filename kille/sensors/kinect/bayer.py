"""Colour out of the sensor's mosaic."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray


def colour_of(mosaic: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The picture (H, W, 3) RGB of a mosaic (H, W) whose first rows are GRGR, BGBG.

    What a pixel lacks is the mean of its neighbours that have it.

    >>> colour_of(np.full((4, 4), 7, np.uint8)).shape
    (4, 4, 3)
    """
    return np.asarray(cv2.cvtColor(mosaic, cv2.COLOR_BayerGRBG2RGB), np.uint8)
