"""Guess which pixels belong to the thing in a picture without depth.

People put what they show in the middle, before something that goes on to the picture's
edges. Three guesses add up, and GrabCut draws the outline: what differs from the
surfaces that reach the picture's edges (robust background detection), what is cut off
from its edges at many thresholds, as white before white is, and what contours enclose,
as they do glass.
"""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from kille.perception.geometry import Array
from kille.scene import Frame, Mask

_SIDE = 112  # pixels of a square picture at working size: the outline needs no more
_PATCH = 8  # pixels across a superpixel: about 180 of them
_ALIKE = 10.0  # units of Lab within which superpixels are one surface
_GRAIN = 3.0  # units of Lab: smaller differences between neighbours are ignored
_BOUND = 0.1  # the least smoothing, also between neighbours that differ
_AROUND = 0.25  # of the picture: the range within which contrast counts
_MIDDLE = (0.5, 0.55)  # of the picture's width and height: where things are put
_SPREAD = 0.3
_MILD = 0.7  # the weight of being in the middle
_ROUNDS = 2  # of GrabCut
_SMOOTH = 1.0  # pixels: the blur before thresholds
_LIGHT_STEP, _HUE_STEP = 6.0, 3.0  # units of Lab between thresholds at least
_MOST_STEPS = 14  # thresholds in a channel
_DARKEST, _LIGHTEST = 1, 99  # percentiles: what is beyond is ignored
_CONTOURS = 0.75  # of the pixels have less contrast than a contour
_FAINTEST = 6.0  # Lab units: no contour is fainter, as Sobel's filter measures it
_DIRECTIONS = 16  # in which contours are looked for
_OPEN = 8  # of these: so many are used, those with the fewest contours
# Saliency from which a pixel is taken for the thing: surely, if it is also near that of
# the picture's most salient tenth; probably; and below which it surely is not.
_SURE, _SURE_OF_TOP, _PROBABLE, _IMPROBABLE = 0.55, 0.8, 0.4, 0.08
_LEAST, _MOST = 0.004, 0.75  # the shares of the picture that a thing may cover
_LARGE = 0.15  # of the largest piece: smaller ones are specks
_ELLIPSE = 0.35  # half axes of the last resort, of the picture's sides


def guess(frame: Frame) -> Mask:
    """Guess the pixels (H, W) of the thing that the picture shows; never none.

    Source: saliency by Zhu, Liang, Wei & Sun 2014, "Saliency optimization from robust
    background detection"; thresholds by Zhang & Sclaroff 2013, "Saliency detection: a
    Boolean map approach"; outline by Rother, Kolmogorov & Blake 2004, "GrabCut".
    """
    height, width = frame.colour.shape[:2]
    small = _resize_to_working_size(frame.colour)
    if min(small.shape[:2]) < 2 * _PATCH:
        return np.ones((height, width), bool)
    near = 1 - _MILD + _MILD * _middle(small.shape)
    guesses = saliency(small), near * isolation(small), near * enclosure(small)
    whole = _stretch(np.sum([_stretch(it) for it in guesses], axis=0))
    found = _large(_grab_cut(small, whole))
    if not _LEAST <= found.mean() <= _MOST:
        found = _ellipse(found.shape)
    size = (width, height)
    full = cv2.resize(found.astype(np.float32), size, interpolation=cv2.INTER_LINEAR)
    mask: Mask = full > 0.5
    return mask if mask.any() else np.ones((height, width), bool)


def saliency(colour: NDArray[np.uint8]) -> Array:
    """How much each pixel (h, w) stands out from the background, from 0 to 1."""
    lab = _lab(colour)
    labels = _superpixels(lab)
    count = int(labels.max()) + 1
    sizes = np.bincount(labels.ravel(), minlength=count)
    means = np.stack([_sums(labels, lab[..., k], count) for k in range(3)], axis=1)
    means /= sizes[:, None]
    rows, columns = np.mgrid[: labels.shape[0], : labels.shape[1]]
    places = np.stack(
        [_sums(labels, columns, count), _sums(labels, rows, count)], axis=1
    )
    places = (places / sizes[:, None] + 0.5) / labels.shape[::-1]
    apart = _distances(means)
    joined = _neighbours(labels, count)
    border = _at_border(labels, count)
    background = _background(apart, joined, border)
    near = np.exp(-(_distances(places) ** 2) / (2 * _AROUND**2))
    contrast = (apart * near) @ background
    contrast /= max(float(contrast.max()), 1e-9)
    middle = np.exp(-(((places - _MIDDLE) / _SPREAD) ** 2).sum(axis=1) / 2)
    salient = _smooth_saliency(
        apart, joined, background, contrast * (1 - _MILD + _MILD * middle)
    )
    salient -= salient.min()
    salient /= max(float(salient.max()), 1e-9)
    return salient.astype(np.float32)[labels]


def isolation(colour: NDArray[np.uint8]) -> Array:
    """How often each pixel (h, w) is cut off from the edges of the picture.

    Each channel of Lab is cut at many thresholds, and what is above or below and does
    not reach the edges counts, the more the smaller it is.
    """
    lab = cv2.GaussianBlur(_lab(colour), (0, 0), _SMOOTH)
    often = np.zeros(lab.shape[:2], np.float32)
    for channel, least in zip(
        np.moveaxis(lab, 2, 0), (_LIGHT_STEP, _HUE_STEP, _HUE_STEP), strict=True
    ):
        low, high = np.percentile(channel, (_DARKEST, _LIGHTEST))
        step = max(least, (high - low) / _MOST_STEPS)
        for threshold in np.arange(low + least / 2, high, step):
            for side in (channel > threshold, channel <= threshold):
                inner = _inner(side)
                often += inner / np.sqrt(np.float32(max(inner.sum(), 1)))
    return often


def enclosure(colour: NDArray[np.uint8]) -> Array:
    """In how many directions each pixel (h, w) has contours before the picture ends.

    Two in a direction are as good as many; the directions with the fewest count.
    """
    lab = _lab(colour)
    contrast = np.hypot(
        cv2.Sobel(lab, cv2.CV_32F, 1, 0), cv2.Sobel(lab, cv2.CV_32F, 0, 1)
    ).max(axis=2)
    least = max(float(np.quantile(contrast, _CONTOURS)), _FAINTEST)
    contours = (contrast > least).astype(np.float32)
    height, width = contours.shape
    middle, size = (width / 2 - 0.5, height / 2 - 0.5), (width, height)
    crossed = np.empty((_DIRECTIONS, height, width), np.float32)
    for number in range(_DIRECTIONS):
        turn = cv2.getRotationMatrix2D(middle, 360 * number / _DIRECTIONS, 1)
        turned = cv2.warpAffine(contours, turn, size, flags=cv2.INTER_NEAREST)
        before = np.minimum(np.cumsum(turned, axis=1, dtype=np.float32), 2) / 2
        back = cv2.invertAffineTransform(turn)
        crossed[number] = cv2.warpAffine(before, back, size, flags=cv2.INTER_NEAREST)
    fewest = np.sort(crossed, axis=0)[:_OPEN]
    return np.asarray(fewest.mean(axis=0), np.float32)


def _inner(side: Mask) -> Mask:
    """The connected pieces of the mask that do not reach the edges of the picture."""
    _, labels = cv2.connectedComponents(side.astype(np.uint8), connectivity=4)
    inner = np.ones(int(labels.max()) + 1, bool)
    inner[0] = False
    for edge in (labels[0], labels[-1], labels[:, 0], labels[:, -1]):
        inner[edge] = False
    return np.asarray(inner[labels], bool)


def _stretch(values: Array) -> Array:
    """The values, from 0 for the least to 1 for the largest."""
    above = values - values.min()
    return np.asarray(above / max(float(above.max()), 1e-9), np.float32)


def _middle(shape: tuple[int, ...]) -> Array:
    """How near each pixel (h, w) is to where things are put: 1 in the middle."""
    x, y = _from_middle(shape)
    return np.exp(-(x**2 + y**2) / (2 * _SPREAD**2)).astype(np.float32)


def _from_middle(
    shape: tuple[int, ...],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """How far pixels (h, w) are right of the middle and below it, in pictures."""
    rows, columns = np.indices(shape[:2])
    return (
        (columns + 0.5) / shape[1] - _MIDDLE[0],
        (rows + 0.5) / shape[0] - _MIDDLE[1],
    )


def _background(
    apart: NDArray[np.float64], joined: Mask, border: Mask
) -> NDArray[np.float64]:
    """The probability that each superpixel is background, from how long the border of
    its surface is.
    """
    linked = joined | np.logical_and.outer(border, border)
    step = np.where(linked, np.maximum(apart - _GRAIN, 0), np.inf)
    np.fill_diagonal(step, 0)
    for via in range(len(step)):
        np.minimum(step, step[:, via, None] + step[None, via], out=step)
    same = np.exp(-(step**2) / (2 * _ALIKE**2))
    connectivity = same[:, border].sum(axis=1) / np.sqrt(same.sum(axis=1))
    background: NDArray[np.float64] = 1 - np.exp(-(connectivity**2) / 2)
    return background


def _smooth_saliency(
    apart: NDArray[np.float64],
    joined: Mask,
    background: NDArray[np.float64],
    salient: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Compute a saliency that is low on the background, high where contrast is high,
    and similar in neighbours.
    """
    alike = np.exp(-(apart**2) / (2 * _ALIKE**2)) + _BOUND
    weights = np.where(joined, alike, 0)
    smooth = np.diag(weights.sum(axis=1)) - weights
    system = smooth + np.diag(background + salient + 1e-6)
    return np.asarray(np.linalg.solve(system, salient), np.float64)


def _grab_cut(colour: NDArray[np.uint8], salient: Array) -> Mask:
    """Draw the outline by GrabCut, starting from the salient pixels."""
    sure = max(_SURE, _SURE_OF_TOP * float(np.quantile(salient, 0.9)))
    labels: NDArray[np.uint8] = np.full(salient.shape, cv2.GC_PR_BGD, np.uint8)
    labels[salient > _PROBABLE] = cv2.GC_PR_FGD
    labels[salient > sure] = cv2.GC_FGD
    labels[salient < _IMPROBABLE] = cv2.GC_BGD
    labels[:2], labels[:, :2], labels[:, -2:] = (cv2.GC_BGD,) * 3
    if not _foreground(labels).any():
        return _foreground(labels)
    nowhere, behind, before = (0, 0, 0, 0), np.zeros((1, 65)), np.zeros((1, 65))
    cv2.setRNGSeed(0)
    found = cv2.grabCut(
        colour, labels, nowhere, behind, before, _ROUNDS, cv2.GC_INIT_WITH_MASK
    )
    return _foreground(np.asarray(found[0], np.uint8))


def _foreground(labels: NDArray[np.uint8]) -> Mask:
    return np.isin(labels, (cv2.GC_FGD, cv2.GC_PR_FGD))


def _large(mask: Mask) -> Mask:
    """Remove the small pieces of the mask."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
    if count < 2:
        return mask
    areas = stats[:, cv2.CC_STAT_AREA].copy()
    areas[0] = 0
    return np.asarray((areas >= _LARGE * areas.max())[labels], bool)


def _ellipse(shape: tuple[int, ...]) -> Mask:
    x, y = _from_middle(shape)
    return np.asarray(x**2 + y**2 < _ELLIPSE**2, bool)


def _lab(colour: NDArray[np.uint8]) -> Array:
    light = colour.astype(np.float32) / np.float32(255)
    return np.asarray(cv2.cvtColor(light, cv2.COLOR_RGB2LAB), np.float32)


def _resize_to_working_size(colour: NDArray[np.uint8]) -> NDArray[np.uint8]:
    height, width = colour.shape[:2]
    scale = _SIDE / np.sqrt(height * width)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    smaller = cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(colour, size, interpolation=smaller), np.uint8)


def _superpixels(lab: Array) -> NDArray[np.intp]:
    slic = cv2.ximgproc.createSuperpixelSLIC(lab, cv2.ximgproc.SLICO, _PATCH)
    slic.iterate(5)
    slic.enforceLabelConnectivity(10)
    _, labels = np.unique(slic.getLabels(), return_inverse=True)
    return labels.reshape(lab.shape[:2])


def _sums(
    labels: NDArray[np.intp], values: NDArray[Any], count: int
) -> NDArray[np.float64]:
    sums = np.bincount(labels.ravel(), values.ravel().astype(float), count)
    return np.asarray(sums, np.float64)


def _distances(points: NDArray[np.float64]) -> NDArray[np.float64]:
    squares = ((points[:, None] - points[None]) ** 2).sum(axis=2)
    return np.asarray(np.sqrt(squares), np.float64)


def _neighbours(labels: NDArray[np.intp], count: int) -> Mask:
    joined = np.zeros((count, count), bool)
    for one, other in ((labels[1:], labels[:-1]), (labels[:, 1:], labels[:, :-1])):
        joined[one, other] = True
        joined[other, one] = True
    np.fill_diagonal(joined, False)
    return joined


def _at_border(labels: NDArray[np.intp], count: int) -> Mask:
    border = np.zeros(count, bool)
    for edge in (labels[0], labels[-1], labels[:, 0], labels[:, -1]):
        border[edge] = True
    return border
