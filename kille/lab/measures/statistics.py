"""Statistics of answers: how well they agree with what is right, and with each other.

What SciPy and scikit-learn have is left to them; they take a second to load, and so are
loaded by what needs them. Here is what they lack: a Brier score with *none of these*, a
reliability with counts, a confusion that refuses words without a row.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kille.lab.dialogues import margin
from kille.lab.results import Estimate
from ttr.aliases import former_names

__all__ = [
    "Interval",
    "accuracy",
    "auroc",
    "bootstrap",
    "brier",
    "calibration_error",
    "confusion",
    "distinctness",
    "kappa",
    "kappa_of_margins",
    "margin",
    "reliability",
    "spearman",
    "wilson",
]

__getattr__ = former_names(__name__, {"Band": "Interval"})

Interval = tuple[float, float]
"""The lower and the upper end of a confidence interval.

>>> from kille.lab.measures.statistics import Interval, wilson
>>> low_high: Interval = wilson(10, 10)
>>> round(low_high[0], 2)
0.72
"""

Degrees = Mapping[str, float]


def accuracy(right: Sequence[str], answers: Sequence[str]) -> float:
    """The share of the answers that are right; NaN of no answers.

    >>> accuracy(["cup", "cup", "car"], ["cup", "car", "car"])
    0.6666666666666666
    """
    return _mean([one == other for one, other in zip(right, answers, strict=True)])


def kappa(one: Sequence[str], other: Sequence[str]) -> float:
    """Cohen's kappa: how far two judges agree beyond what chance would give.

    kappa = (p_o - p_e) / (1 - p_e), p_o the share of the items they agree on and p_e
    what is expected of two who use each word as often as they do, by chance. 1 where
    both always say the same one word; NaN of no items.
    Source: Cohen 1960, A coefficient of agreement for nominal scales.

    >>> kappa(["left", "left", "near", "near"], ["left", "near", "near", "near"])
    0.5
    """
    from sklearn.metrics import cohen_kappa_score

    if not len(one):
        return float("nan")
    return 1.0 if list(one) == list(other) else float(cohen_kappa_score(one, other))


def kappa_of_margins(observed: float, expected: float) -> float:
    """Cohen's kappa of the agreement that was seen and that by chance.

    The paper's judges agreed on 17 of 32 questions, by chance on a share of .176.

    >>> round(kappa_of_margins(17 / 32, 0.176), 2)
    0.43
    """
    return float(kappa_of_counts(*np.array([[observed], [expected], [1.0]]))[0])


def kappa_of_counts(
    agreed: NDArray[np.float64],
    by_chance: NDArray[np.float64],
    count: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Cohen's kappa of each of several groups of items.

    Of `count` items the judges agree on `agreed`, and would by chance on `by_chance`.
    1 where they agree on all; NaN of no items.
    """
    over = np.where(count - by_chance > 1e-9, count - by_chance, np.nan)
    always = (count > 0) & (agreed >= count)
    found: NDArray[np.float64] = np.where(always, 1.0, (agreed - by_chance) / over)
    return found


def confusion(
    right: Sequence[str], answers: Sequence[str], labels: Sequence[str]
) -> NDArray[np.int64]:
    """How often (row: the right word, column: the answer) each pair came up.

    >>> confusion(["a", "a", "b"], ["a", "b", "b"], ["a", "b"]).tolist()
    [[1, 1], [0, 1]]
    """
    index = {label: i for i, label in enumerate(labels)}
    counts = np.zeros((len(labels), len(labels)), np.int64)
    for word, answer in zip(right, answers, strict=True):
        counts[index[word], index[answer]] += 1
    return counts


def distinctness(margins: Mapping[str, Sequence[float]]) -> list[tuple[str, float]]:
    """The words by their mean margin, the most distinct first.

    Source: Dobnik and de Graaf 2017, section 4.1, who rank what the robot learned by
    how far its own score lies above those of other things.

    >>> distinctness({"cap": [0.1, 0.3], "book": [0.9]})
    [('book', 0.9), ('cap', 0.2)]
    """
    means = [(word, _mean(them)) for word, them in margins.items()]
    return sorted(means, key=lambda it: (-it[1], it[0]))


def auroc(of_these: ArrayLike, of_others: ArrayLike) -> float:
    """How likely one of these has a higher score than one of the others.

    The area under the receiver operating characteristic; ties count half. .5 says that
    the score tells nothing; NaN where either is empty.
    Source: Hanley and McNeil 1982; the same as the Mann-Whitney U over m n.

    >>> auroc([0.9, 0.8], [0.1, 0.8])
    0.875
    """
    from scipy.stats import rankdata

    these, others = _numbers(of_these), _numbers(of_others)
    if not len(these) or not len(others):
        return float("nan")
    ranks = rankdata(np.concatenate((these, others)))[: len(these)]
    above = ranks.sum() - len(these) * (len(these) + 1) / 2
    return float(above / (len(these) * len(others)))


def spearman(one: ArrayLike, other: ArrayLike) -> float:
    """Spearman's rank correlation; ties share their mean rank.

    NaN where one of the two never changes or there are fewer than two.
    Source: Spearman 1904, The proof and measurement of association between two things.

    >>> spearman([1, 2, 3], [10, 20, 90])
    1.0
    """
    from scipy.stats import spearmanr

    first, second = _numbers(one), _numbers(other)
    if len({*first}) < 2 or len({*second}) < 2:
        return float("nan")
    return round(float(spearmanr(first, second).statistic), 12)


def wilson(successes: int, count: int) -> Interval:
    """The 95 % confidence interval of a share.

    It stays in [0, 1], and is not empty even after 10 successes of 10.
    Source: Wilson 1927, Probable inference, the law of succession.

    >>> low, high = wilson(10, 10)
    >>> round(low, 2), high
    (0.72, 1.0)
    """
    from scipy.stats import binomtest

    if not count:
        return 0.0, 1.0
    found = binomtest(successes, count).proportion_ci(method="wilson")
    return float(found.low), float(found.high)


def bootstrap(
    values: ArrayLike,
    chance: np.random.Generator,
    *,
    of: Callable[..., Any] = np.mean,
    rounds: int = 1000,
) -> Interval:
    """The 95 % confidence interval of a statistic of the values, by resampling them.

    Source: Efron 1979, Bootstrap methods: another look at the jackknife (percentiles).

    >>> bootstrap([0.5, 0.5, 0.5], np.random.default_rng(7))
    (0.5, 0.5)
    """
    from scipy import stats

    values = _numbers(values)
    if len(values) < 2:
        only = float(of(values)) if len(values) else float("nan")
        return only, only
    found = stats.bootstrap(
        (values,), of, n_resamples=rounds, method="percentile", random_state=chance
    ).confidence_interval
    return float(found.low), float(found.high)


def mean_and_range(values: ArrayLike) -> Estimate:
    """The mean of the values, with the range of the middle 80 % of them.

    >>> mean_and_range([0.0, 0.5, 1.0])[:3]
    (0.5, 0.1, 0.9)
    """
    low, high = np.quantile(_numbers(values), [0.1, 0.9]).tolist()
    return Estimate(float(np.mean(_numbers(values))), low, high)


def brier(right: Sequence[str], degrees: Sequence[Degrees]) -> float:
    """The mean squared distance of the degrees from 1 for the right word, 0 for others.

    0 is best and 2 is worst. What the degrees lack to 1 counts as the degree of *none
    of these*, and so as an error.
    Source: Brier 1950, Verification of forecasts expressed in terms of probability.

    >>> brier(["cup"], [{"cup": 1.0}]), brier(["cup"], [{"car": 1.0}])
    (0.0, 2.0)
    """
    return _mean([_distance(w, it) for w, it in zip(right, degrees, strict=True)])


def _distance(word: str, degrees: Degrees) -> float:
    rest = max(0.0, 1 - sum(degrees.values()))
    others = [degree for it, degree in degrees.items() if it != word]
    off = [1 - degrees.get(word, 0.0), rest, *others]
    return float(sum(it**2 for it in off))


def reliability(
    degrees: ArrayLike, right: ArrayLike, bins: int = 10
) -> list[tuple[float, float, int]]:
    """Do degrees mean what they say? (mean degree, share right, count) of each bin.

    Source: Murphy and Winkler 1977, Reliability of subjective probability forecasts.

    >>> reliability([0.9, 0.92, 0.1], [1, 0, 0], bins=2)
    [(0.1, 0.0, 1), (0.91, 0.5, 2)]
    """
    said, held = _numbers(degrees), _numbers(right)
    of_each = reliability_bin(said, bins)
    members = [of_each == number for number in range(bins)]
    return [
        (round(_mean(said[it]), 12), _mean(held[it]), int(it.sum()))
        for it in members
        if it.any()
    ]


def calibration_error(degrees: ArrayLike, right: ArrayLike, bins: int = 10) -> float:
    """The expected calibration error: how far degrees are from the shares right.

    Σ_b n_b / n |mean degree in b - share right in b| over bins b of equal width; 0 is
    best. NaN of no answers. Pool runs before: of few answers it is too high.
    Source: Naeini et al. 2015, Obtaining well calibrated probabilities.

    >>> round(calibration_error([0.9, 0.8, 0.75, 0.25], [1, 0, 1, 0], bins=2), 3)
    0.175
    """
    found = reliability(degrees, right, bins)
    whole = sum(count for _, _, count in found)
    if not whole:
        return float("nan")
    off = sum(count * abs(said - share) for said, share, count in found)
    return float(off / whole)


def reliability_bin(degrees: ArrayLike, bins: int = 10) -> NDArray[np.int64]:
    """The number of the bin of equal width that each degree falls in, from 0."""
    found: NDArray[np.int64] = np.clip(
        (np.asarray(degrees) * bins).astype(np.int64), 0, bins - 1
    )
    return found


def _mean(values: Iterable[float] | NDArray[np.float64]) -> float:
    them = np.asarray(list(values), np.float64)
    return float(them.mean()) if len(them) else float("nan")


def _numbers(values: ArrayLike) -> NDArray[np.float64]:
    return np.asarray(values, np.float64).ravel()
