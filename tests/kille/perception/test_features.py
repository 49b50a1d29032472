"""The features of a region, however large the picture is."""

from __future__ import annotations

import time

import cv2
import numpy as np
import pytest

from kille.perception.features import features_of
from kille.perception.segment import region_of
from kille.scene import Features, Frame


def seen(height: int, width: int) -> Features:
    """The features of a picture of blobs, stretched to this size."""
    chance = np.random.default_rng(7)
    grain = chance.integers(0, 256, (60, 80, 3), dtype=np.uint8)
    colour = cv2.resize(grain, (width, height), interpolation=cv2.INTER_CUBIC)
    frame = Frame(np.asarray(colour, np.uint8), None, None, 0.0, {})
    return features_of(frame, region_of(frame, np.ones((height, width), bool)))


def test_a_huge_picture_takes_no_longer_than_a_large_one() -> None:
    start = time.process_time()
    huge = seen(4320, 7680)
    assert time.process_time() - start < 5
    assert 0 < len(huge.descriptors) < 20_000
    assert huge.pixels.min() >= 0
    assert (huge.pixels.max(axis=0) < (7680, 4320)).all()
    assert huge.pixels.max(axis=0) == pytest.approx((7680, 4320), rel=0.1)


def test_features_of_a_huge_picture_are_where_they_are_seen() -> None:
    """But for the fifth of a reduced pixel by which OpenCV's SIFT is off itself."""
    colour = np.zeros((4320, 7680, 3), np.uint8)
    middles = [(x, y) for x in range(3840, 7400, 500) for y in range(2300, 4200, 400)]
    for middle in middles:
        cv2.circle(colour, middle, 60, (255, 255, 255), -1)
    frame = Frame(colour, None, None, 0.0, {})
    found = features_of(frame, region_of(frame, np.ones((4320, 7680), bool))).pixels
    nearest = [np.linalg.norm(found - middle, axis=1).argmin() for middle in middles]
    assert np.abs(np.median(found[nearest] - middles, axis=0)).max() < 2


@pytest.mark.parametrize("size", [(1, 1), (1, 2_000_000), (3, 700_000), (2, 2)])
def test_a_picture_of_any_shape_has_features_or_none(size: tuple[int, int]) -> None:
    found = seen(*size)
    assert len(found.descriptors) == len(found.pixels) == len(found.points)
