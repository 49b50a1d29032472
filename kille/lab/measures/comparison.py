"""Do two theories differ, by the dialogues that they had on the same occasions?

Two dialogues are a pair if tutor, scene and seed are the same. The main test is a
permutation test: if the theories do not differ, the two of a pair are exchangeable.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kille.lab.measures.measures import (
    Measure,
    Vector,
    percentile_estimate,
    resample_counts,
    tallies,
)
from kille.lab.measures.scored_dialogues import ScoredAnswer, ScoredDialogue
from kille.lab.results import Estimate

_EXACT = 15
"""Up to this many pairs are exchanged in all ways, more in ways drawn at random."""

_SHUFFLES = 9_999
_AT_ONCE = 1_000
_TINY = 1e-12  # sums in another order differ by this little

Pair = tuple[ScoredDialogue, ScoredDialogue]


class PairedDifference(NamedTuple):
    """How much more `other` has than `one`, with p and the number of pairs.

    `spread` is the standard deviation of the differences within the pairs, `apart`
    those differences themselves.
    """

    estimate: Estimate
    p: float
    pairs: int
    spread: float
    apart: Vector


class McNemar(NamedTuple):
    """How many answers only one of two theories has right, and McNemar's p."""

    one: int
    other: int
    p: float


class Contrast(NamedTuple):
    """Two theories, and how they differ in each measure and question by question.

    `pairs` is the number of pairs of dialogues that were compared.
    """

    one: str
    other: str
    differences: Mapping[str, PairedDifference]
    answers: McNemar
    pairs: int = 0


def in_pairs(
    one: Sequence[ScoredDialogue], other: Sequence[ScoredDialogue]
) -> list[Pair]:
    """Pair the dialogues that two theories had with the same tutor, scene and seed.

    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.measures import score_dialogue
    >>> from kille.lab.study import Run
    >>> one, other = (
    ...     [score_dialogue(Run(theory, "Ann", "table", 1), Played((), ()), 0.1)]
    ...     for theory in ("old", "new")
    ... )
    >>> [(a.run.theory, b.run.theory) for a, b in in_pairs(one, other)]
    [('old', 'new')]
    """
    others = {it.pair: it for it in other}
    found = [(it, others[it.pair]) for it in one if it.pair in others]
    return sorted(found, key=lambda it: it[0].pair)


def differences(
    measures: Sequence[Measure], pairs: Sequence[Pair], chance: np.random.Generator
) -> dict[str, PairedDifference]:
    """How much more of each measure the second of each pair has than the first.

    The 95 % confidence interval is that of resampled pairs (percentiles), p that of
    `permutation_p`. Pairs are resampled and exchanged alike for all measures; those
    count in which the measure is known for both dialogues. A measure that is the same
    in each pair, as by design, is left out.

    >>> from kille.lab.dialogues import Played
    >>> from kille.lab.measures import Measure, score_dialogue
    >>> from kille.lab.study import Run
    >>> lessons = Measure(
    ...     "lessons", "how often it was taught", lambda it: np.array([it.lessons, 1.0])
    ... )
    >>> def taught(theory, seed, times):
    ...     run, played = Run(theory, "Ann", "table", seed), Played((), (), times)
    ...     return score_dialogue(run, played, 0.1)
    >>> pairs = [(taught("old", n, 5), taught("new", n, 3 - n % 2)) for n in range(8)]
    >>> found = differences([lessons], pairs, np.random.default_rng(1))["lessons"]
    >>> float(found.estimate.value), found.pairs
    (-2.5, 8)
    """
    draws = resample_counts(len(pairs), chance)
    stays = exchanges(len(pairs), chance)
    found = {}
    for measure in measures:
        first = tallies(measure, [one for one, _ in pairs])
        second = tallies(measure, [other for _, other in pairs])
        if np.array_equal(first, second):
            continue
        known = np.isfinite(measure.of(first)) & np.isfinite(measure.of(second))
        first, second = first[known], second[known]
        found[measure.name] = PairedDifference(
            _difference(measure, first, second, draws[:, known]),
            permutation_p(measure, first, second, stays[:, known]),
            len(first),
            *_apart(measure, first, second),
        )
    return found


def _difference(
    measure: Measure, first: Vector, second: Vector, draws: Vector
) -> Estimate:
    value = float(measure.of(second.sum(axis=0)) - measure.of(first.sum(axis=0)))
    others = measure.of(draws @ second) - measure.of(draws @ first)
    return percentile_estimate(value, others, len(first), measure.decimals)


def _apart(measure: Measure, first: Vector, second: Vector) -> tuple[float, Vector]:
    """The differences within the pairs, after their standard deviation."""
    apart = measure.of(second) - measure.of(first)
    return float(apart.std(ddof=1)) if len(apart) > 1 else float("nan"), apart


def exchanges(pairs: int, chance: np.random.Generator) -> NDArray[np.bool_]:
    """Ways to exchange the two of some pairs: a row says which pairs stay.

    The first row exchanges none. For few pairs the rows are all ways that there are.
    """
    if pairs <= _EXACT:
        numbers = np.arange(2**pairs)[::-1, None]
        return (numbers >> np.arange(pairs)) & 1 > 0
    stays = chance.random((_SHUFFLES + 1, pairs)) < 0.5
    stays[0] = True
    return stays


def permutation_p(
    measure: Measure, first: Vector, second: Vector, stays: NDArray[np.bool_]
) -> float:
    """How likely a difference as large as this is, if the theories do not differ.

    Then the two of a pair are exchangeable. p is the share of the ways to exchange them
    in which the difference is as large, the observed one included: of all ways for few
    pairs, else of 9,999 drawn at random. For means of equally many answers it is the
    test that flips the signs of the paired differences. NaN where nothing is known.
    Source: Fisher 1935, The design of experiments, section 21; Phipson and Smyth 2010,
    Permutation p-values should never be zero.
    """
    seen = abs(measure.of(second.sum(axis=0)) - measure.of(first.sum(axis=0)))
    if not np.isfinite(seen):
        return float("nan")
    whole = first.sum(axis=0) + second.sum(axis=0)
    large = count = 0
    for start in range(0, len(stays), _AT_ONCE):
        some = stays[start : start + _AT_ONCE].astype(np.float64)
        ones = some @ (first - second) + second.sum(axis=0)
        apart = np.abs(measure.of(whole - ones) - measure.of(ones))
        large += int((apart >= seen - _TINY).sum())
        count += int(np.isfinite(apart).sum())
    return large / count


def least_p(pairs: int) -> float:
    """The smallest p that this many pairs can give, if all differ in one direction.

    >>> least_p(2), least_p(5)
    (0.5, 0.0625)
    """
    return min(1.0, 2.0 ** (1 - pairs)) if pairs <= _EXACT else 1 / (_SHUFFLES + 1)


def pairs_needed(tests: int, alpha: float) -> int | None:
    """How many pairs it takes that the best of several tests has p < alpha after Holm.

    None if no number of pairs is enough.

    >>> pairs_needed(1, 0.05), pairs_needed(3, 0.05)
    (6, 7)
    """
    enough = (n for n in range(1, _EXACT + 1) if tests * least_p(n) < alpha)
    return next(enough, None)


# --- question by question ------------------------------------------------------------


def mcnemar(one: int, other: int) -> float:
    """The p of McNemar's exact test, of how many only one and only the other has right.

    Both sides of the binomial with p = 1/2: min(1, 2 P(X ≤ min(b, c))).
    Source: McNemar 1947, Note on the sampling error of the difference between
    correlated proportions or percentages.

    >>> round(mcnemar(2, 10), 4)
    0.0386
    """
    from scipy.stats import binomtest

    count = one + other
    return float(binomtest(one, count).pvalue) if count else 1.0


def mcnemar_of(pairs: Sequence[Pair]) -> McNemar:
    """McNemar's test on the questions for words that both theories were asked.

    Two questions are the same if both are the n-th of a phase and have the same right
    answer. The test takes answers to be independent, which those of one dialogue are
    not: p is too small rather than too large.

    >>> mcnemar_of([])
    McNemar(one=0, other=0, p=1.0)
    """
    one = other = 0
    for first, second in pairs:
        asked = {_question(it): it for it in first.answers if it.is_word}
        for it in second.answers:
            found = asked.get(_question(it))
            if found is not None and found.is_right != it.is_right:
                one, other = one + found.is_right, other + it.is_right
    return McNemar(one, other, mcnemar(one, other))


def _question(answer: ScoredAnswer) -> tuple[str, int, str, str]:
    return answer.phase, answer.nth, answer.kind, answer.right


# --- many tests ----------------------------------------------------------------------


def holm(ps: Sequence[float]) -> list[float]:
    """The p-values after Holm's correction for how many they are; NaN stays NaN.

    Of m tests that with the i-th smallest p has max over j ≤ i of (m - j + 1) p_j.
    Source: Holm 1979, A simple sequentially rejective multiple test procedure.

    >>> holm([0.01, 0.04, 0.03])
    [0.03, 0.06, 0.06]
    """
    ranked = sorted((p, i) for i, p in enumerate(ps) if p == p)
    found, highest = list(ps), 0.0
    for rank, (p, i) in enumerate(ranked):
        highest = max(highest, min(1.0, (len(ranked) - rank) * p))
        found[i] = highest
    return found


def contrasts(
    theories: Mapping[str, Sequence[ScoredDialogue]],
    which: Iterable[tuple[str, str]],
    measures: Sequence[Measure],
    chance: np.random.Generator,
) -> list[Contrast]:
    """Compare theories two by two; those without a pair of dialogues are left out.

    >>> chance = np.random.default_rng(1)
    >>> contrasts({"old": [], "new": []}, [("old", "new")], [], chance)
    []
    """
    found = []
    for one, other in which:
        pairs = in_pairs(theories[one], theories[other])
        if pairs:
            apart = differences(measures, pairs, chance)
            found.append(Contrast(one, other, apart, mcnemar_of(pairs), len(pairs)))
    return found
