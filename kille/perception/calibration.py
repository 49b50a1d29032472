"""Calibration: degrees made true by what the robot's own lessons say of each other.

How much a score of the regression proves depends on what was taught: things that are
seen again are told apart with certainty, new things of a kind are not. So lessons are
left out, and the others are asked about them. Each is left out twice: with lessons of
all other words, and then its word is right; and with its whole word, and then no word
is. Strangers count for half. With the score of word w for such a lesson, and its
dissimilarity in size d,

    log strength of w = slope (b + r score_w) + shift - a d_w,

and `slope` and `shift` make what was right most probable, with Gaussian priors around
1 and 0: a few lessons prove little. Without two different lessons of a word nothing is
changed.

No regression is made anew. With A the system of the examples (see
`kille.perception.likeness`), Y its targets and α = A⁻¹ Y, what the others say of a
block B of examples is

    f_B = Y_B - (A⁻¹_BB)⁻¹ α_B.

Lessons are left out in up to five folds, one part of each word's lessons at a time, so
that the words left have shrunk alike. Views that are as alike as frames of one scene
count as one lesson, and are left out together: they foretell each other whatever was
learned.

Source: Pahikkala, Boberg & Salakoski 2006, "Fast n-fold cross-validation for
regularized least-squares"; Platt 1999, "Probabilistic outputs for support vector
machines" (slope and shift); Guo et al. 2017, "On calibration of modern neural
networks".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
Places = NDArray[np.intp]

STRANGE = -1
"""The column of a lesson that was left out with its whole word."""

_SAME = 0.9  # likeness: of poses of one thing a tenth, of frames of one scene all
_FOLDS = 5
_PRIOR = np.array([1.0, 0.0])  # slope and shift
_PRECISION = np.array([1.0, 1.0])  # of the priors: 1 / variance
_LEAST, _MOST = 0.5, 3.0  # of the slope
_STEPS = 30  # of Newton's method, which takes four or five
_CLOSE = 1e-9
_LONGEST = 1.0  # of one step


@dataclass(frozen=True)
class Calibration:
    """By how much the evidence of the examples is multiplied, and what is added."""

    slope: float = 1.0
    shift: float = 0.0


@dataclass(frozen=True, eq=False)
class LeftOut:
    """What the other examples say of lessons that were left out.

    `scores` and `unlike` (m, w): the scores of all words, and the dissimilarity in size
    from the nearest example; `taught` (m, w): which words were left; `columns` (m,):
    the right word, or STRANGE; `weights` (m,): strangers have half of all.
    """

    scores: Numbers
    unlike: Numbers
    taught: NDArray[np.bool_]
    columns: Places
    weights: Numbers


def leave_out(
    kernel: Numbers, inverse: Numbers, owners: Places, unlike: Numbers
) -> LeftOut | None:
    """Leave each example out, with its word and without; None if that tells nothing.

    Of n examples: `kernel` (n, n) is how alike they are, `inverse` (n + k, n + k) is
    A⁻¹, in which k rows more may stand for what was never taught, `owners` (n,) are the
    columns of their words, in order, and `unlike` (n, n) is how unlike in size.

    >>> alike, words = np.array([[1, 0.8], [0.8, 1]]), np.array([0, 1])
    >>> leave_out(alike, np.linalg.inv(alike + np.eye(2)), words, alike) is None
    True
    """
    lessons, folds = _lessons_and_folds(kernel, owners)
    words = int(owners.max(initial=-1)) + 1
    if words < 2 or not (folds >= 0).any():
        return None
    signs = np.full((len(inverse), words), -1.0)
    signs[np.arange(len(owners)), owners] = 1.0
    weights = inverse @ signs
    found, columns, gone = [], [], []
    for block in _blocks(folds):
        found.append((block, _scores_without(block, inverse, weights, signs)))
        columns.append(owners[block])
        gone.append(_unlike_without(block, owners, unlike))
    for block in _blocks(owners):
        found.append((block, _scores_without(block, inverse, weights, signs)))
        columns.append(np.full(len(block), STRANGE))
        gone.append(_unlike_without(block, owners, unlike))
    places = np.concatenate([block for block, _ in found])
    right = np.concatenate(columns)
    taught = (right[:, None] != STRANGE) | (owners[places][:, None] != np.arange(words))
    each = 1 / np.bincount(lessons)[lessons][places]
    known = right != STRANGE
    each[~known] *= each[known].sum() / each[~known].sum()
    scores = np.concatenate([scores for _, scores in found])
    return LeftOut(scores, np.concatenate(gone), taught, right, each)


def calibrate(found: LeftOut, logits: Numbers, fixed: Numbers) -> Calibration:
    """The slope and shift that make what was right most probable.

    The log strengths of the words are slope · logits + shift + fixed, (m, w) each; that
    of none of the words is 0. Newton's method: the problem is convex.

    >>> scores = np.array([[2.0, -1.0], [-1.0, 2.0], [-1.0, -1.0], [-1.0, -1.0]])
    >>> columns, every = np.array([0, 1, STRANGE, STRANGE]), np.ones((4, 2), bool)
    >>> found = LeftOut(scores, 0 * scores, every, columns, np.ones(4))
    >>> calibrate(found, scores, 0 * scores).slope > 1.5
    True
    """
    known = found.columns != STRANGE
    rows = np.flatnonzero(known)
    right = np.zeros(len(known))
    right[rows] = logits[rows, found.columns[rows]]
    at = _PRIOR.copy()
    for _ in range(_STEPS):
        shares = _shares(at[0] * logits + at[1] + fixed, found.taught)
        some = shares.sum(axis=1)
        mean = (shares * logits).sum(axis=1)
        square = (shares * logits**2).sum(axis=1)
        errors = np.stack([mean - right, some - known])
        slope = errors @ found.weights + _PRECISION * (at - _PRIOR)
        across = found.weights @ (mean * (1 - some))
        curve = np.array(
            [
                [found.weights @ (square - mean**2), across],
                [across, found.weights @ (some * (1 - some))],
            ]
        )
        step = np.linalg.solve(curve + np.diag(_PRECISION), slope)
        step *= min(1.0, _LONGEST / max(float(np.abs(step).max()), _CLOSE))
        at = at - step
        if np.abs(step).max() < _CLOSE:
            break
    return Calibration(float(np.clip(at[0], _LEAST, _MOST)), float(at[1]))


def _shares(logs: Numbers, taught: NDArray[np.bool_]) -> Numbers:
    """The degrees (m, w) of the words that are left, beside none of them."""
    logs = np.where(taught, logs, -np.inf)
    highest = np.maximum(logs.max(axis=1, keepdims=True), 0)
    strengths = np.exp(logs - highest)
    shares: Numbers = strengths / (
        np.exp(-highest) + strengths.sum(axis=1, keepdims=True)
    )
    return shares


def _blocks(numbers: Places) -> Iterator[Places]:
    """The places of each number that is not negative."""
    for number in range(int(numbers.max(initial=-1)) + 1):
        if len(block := np.flatnonzero(numbers == number)):
            yield block


def _scores_without(
    block: Places, inverse: Numbers, weights: Numbers, signs: Numbers
) -> Numbers:
    """What the others say of a block of examples, (m, w)."""
    among = inverse[np.ix_(block, block)]
    scores: Numbers = signs[block] - np.linalg.solve(among, weights[block])
    return scores


def _unlike_without(block: Places, owners: Places, unlike: Numbers) -> Numbers:
    """How unlike a block is the nearest of the others of each word, (m, w)."""
    apart = unlike[block]
    apart[:, block] = np.inf
    firsts = np.flatnonzero(np.diff(owners, prepend=-1))
    nearest: Numbers = np.minimum.reduceat(apart, firsts, axis=1)
    return nearest


def _lessons_and_folds(kernel: Numbers, owners: Places) -> tuple[Places, Places]:
    """The number of the lesson of each example, and that of its fold.

    Examples of a word that are nearly the same are one lesson. The fold is -1 for a
    word of one lesson, which is never left out by itself.
    """
    lessons, folds = np.zeros(len(owners), np.intp), np.full(len(owners), -1)
    so_far = 0
    for own in _blocks(owners):
        numbers = _group_alike(kernel[np.ix_(own, own)])
        count = int(numbers.max()) + 1
        lessons[own] = so_far + numbers
        so_far += count
        if count > 1:
            folds[own] = numbers * min(count, _FOLDS) // count
    return lessons, folds


def _group_alike(kernel: Numbers) -> Places:
    """Number examples (n,): one that is nearly an earlier one has its number."""
    numbers, firsts = np.zeros(len(kernel), np.intp), list[int]()
    for place, alike in enumerate(kernel):
        same = np.flatnonzero(alike[firsts] > _SAME)
        numbers[place] = same[0] if len(same) else len(firsts)
        if not len(same):
            firsts.append(place)
    return numbers
