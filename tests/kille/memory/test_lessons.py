from __future__ import annotations

import math

import numpy as np
import pytest

from kille.memory import Arrangement, Scan, Sighting
from kille.scene import Point

DESCRIPTORS = np.zeros((4, 128), np.uint8)
POINTS = np.zeros((4, 3), np.float32)


@pytest.mark.parametrize(
    ("descriptors", "points", "complaint"),
    [
        (DESCRIPTORS.astype(np.float32), POINTS, "descriptors must be uint8"),
        (DESCRIPTORS[:, :64], POINTS, r"descriptors must be uint8 \(4, 128\), not"),
        (DESCRIPTORS, POINTS.astype(np.float64), "points must be float32"),
        (DESCRIPTORS, POINTS[:3], r"points must be float32 \(4, 3\), not"),
        (DESCRIPTORS, POINTS[:, :2], r"points must be float32 \(4, 3\), not"),
    ],
)
def test_arrays_that_would_not_come_back_are_refused(
    descriptors: np.ndarray, points: np.ndarray, complaint: str
) -> None:
    with pytest.raises(ValueError, match=complaint):
        Scan(descriptors, points)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_place_is_finite_or_none(bad: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        Sighting("synthetic", 0.0, (), Point(0.0, bad, 1.0))
    with pytest.raises(ValueError, match="finite"):
        Sighting("synthetic", bad, (), None)
    with pytest.raises(ValueError, match="finite"):
        Sighting("synthetic", 0.0, (), None, size=(0.1, bad, 0.1))
    with pytest.raises(ValueError, match="finite"):
        Sighting("synthetic", 0.0, (), None, colour=np.array([bad], np.float32))
    with pytest.raises(ValueError, match="finite"):
        Arrangement("synthetic", 0.0, "book", "car", Point(bad, 0.0, 0.0))


@pytest.mark.parametrize("bad", [np.zeros(3), np.zeros((3, 1), np.float32)])
def test_a_colour_that_would_not_come_back_is_refused(bad: np.ndarray) -> None:
    with pytest.raises(ValueError, match="colour must be float32"):
        Sighting("synthetic", 0.0, (), None, colour=bad)
