"""How theories differ, and how many dialogues it takes to tell: tables and a figure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from kille.experiments.report import shown
from kille.experiments.results import Cell, Figure, Result, Table
from kille.studies.measuring.comparing import Contrast, Difference, contrasts, holm
from kille.studies.measuring.measures import ACCURACY, Measure
from kille.studies.measuring.power import POWER, least_difference, power_of, runs_needed
from kille.studies.reporting.findings import Theories, as_drawn
from kille.studies.reporting.places import Places

__all__ = ["contrast_names", "contrasted", "corrected", "told_p"]

_SEED = 2  # of the chance by which pairs are drawn anew and exchanged
_MAIN = ACCURACY.name
_LEAST = 0.001
_SOUGHT = (0.05, 0.02)
"""Differences for which it is told how many dialogues they take."""

_TESTED = (
    "Each is that of the later theory less that of the earlier one, over dialogues "
    "with the same tutor, scene and seed. p: permutation test, in which the two of a "
    "pair are exchanged; then with Holm's correction, for accuracy, the main measure, "
    "over its own tests, and for the others over all of theirs. What is the same in "
    "each pair is left out."
)
_ANSWERED = (
    "Questions for words that both were asked. McNemar's exact test holds answers for "
    "independent, which those of one dialogue are not: the permutation test above is "
    "the main one."
)
_POWERED = (
    f"For accuracy. Spread: the standard deviation of the differences within pairs. "
    f"Seen with {POWER:.0%}: the smallest difference that so many pairs show with this "
    f"power, by the normal approximation; beside it its power found by simulation. "
    f"Then how many pairs it takes to see a difference."
)


def contrasted(
    theories: Theories,
    which: Iterable[tuple[str, str]],
    measures: Sequence[Measure],
    places: Places,
) -> list[Result]:
    """How theories differ, these two by two; nothing of none."""
    tested = [it for it in measures if it.better]
    found = contrasts(theories, which, tested, np.random.default_rng(_SEED))
    if not found:
        return []
    asked = found if ACCURACY in measures else []
    tables = (_differences(found, places), _answers(asked, places), _powers(found))
    told = tuple(it for it in tables if it.rows)
    return [Result("How they differ", told, _figures(found), text=_in_words(asked))]


def _in_words(found: Sequence[Contrast]) -> str:
    """What became of the main measure, a sentence for each two theories."""
    mains = [it.differences.get(_MAIN) for it in found]
    ps = holm([float("nan") if it is None else it.p for it in mains])
    told = [_sentence(it, p) for it, p in zip(found, ps, strict=True)]
    if np.isfinite(ps).sum() > 1:
        told.append("Each p is after Holm's correction.")
    return " ".join(told)


def _sentence(it: Contrast, p: float) -> str:
    if not it.differences:
        return f"{it.other} and {it.one} do equally well in every pair of dialogues."
    main = it.differences.get(_MAIN)
    if main is None:
        return f"{it.other} and {it.one} have the same {_MAIN} in every pair."
    if not main.pairs:
        return f"{it.other} and {it.one} were never both asked for words."
    told = f"{shown(main.estimate)} (p = {told_p(p)})".replace("= <", "<")
    return f"The {_MAIN} of {it.other} differs from that of {it.one} by {told}."


def contrast_names(contrast: Contrast) -> str:
    """What is compared, as the later less the earlier."""
    return f"{contrast.other} − {contrast.one}"


def told_p(p: float) -> str:
    """A probability of chance alone as papers write it.

    >>> told_p(0.0301), told_p(0.00002), told_p(float("nan"))
    ('0.030', '< 0.001', '–')
    """
    if p != p:
        return "–"
    return f"{p:.3f}" if p >= _LEAST else f"< {_LEAST}"


def _differences(found: Sequence[Contrast], places: Places) -> Table:
    told = [(it, name, d) for it in found for name, d in it.differences.items()]
    ps = corrected([(name, d.p) for _, name, d in told])
    rows = tuple(
        (contrast_names(it), name, d.estimate, told_p(d.p), told_p(p), d.pairs)
        for (it, name, d), p in zip(told, ps, strict=True)
    )
    columns = ("theories", "measure", "difference", "p", "p (Holm)", "pairs")
    links = {
        (row, 2): places.against(it.one, it.other)
        for row, (it, _, _) in enumerate(told)
    }
    return Table("Paired differences", columns, rows, _TESTED, links)


def corrected(ps: Sequence[tuple[str, float]]) -> list[float]:
    """Those of the main measure are one family of tests, all others another."""
    found = [p for _, p in ps]
    for is_main in (True, False):
        places = [i for i, (name, _) in enumerate(ps) if (name == _MAIN) == is_main]
        for i, p in zip(places, holm([ps[i][1] for i in places]), strict=True):
            found[i] = p
    return found


def _answers(found: Sequence[Contrast], places: Places) -> Table:
    corrected = holm([it.answers.p for it in found])
    rows = tuple(
        (*_sides(it), told_p(it.answers.p), told_p(p))
        for it, p in zip(found, corrected, strict=True)
    )
    columns = ("theory", "only it right", "theory", "only it right", "p", "p (Holm)")
    links = {
        (row, column): places.against(it.one, it.other)
        for row, it in enumerate(found)
        for column in (1, 3)
    }
    return Table("Question by question", columns, rows, _ANSWERED, links)


def _sides(it: Contrast) -> tuple[Cell, ...]:
    return it.one, it.answers.one, it.other, it.answers.other


# --- power ---------------------------------------------------------------------------


def _powers(found: Sequence[Contrast]) -> Table:
    told = [(it, it.differences[_MAIN]) for it in found if _MAIN in it.differences]
    rows = tuple((contrast_names(it), *_power(d)) for it, d in told)
    columns = (
        "theories",
        "pairs",
        "spread",
        f"seen with {POWER:.0%}",
        "power (simulated)",
        "difference found",
        "pairs for it",
        *(f"pairs for {d:g}" for d in _SOUGHT),
    )
    return Table("How many dialogues it takes", columns, rows, _POWERED)


def _power(d: Difference) -> tuple[Cell, ...]:
    least = least_difference(d.spread, d.pairs)
    chance = np.random.default_rng(_SEED)
    known = np.isfinite(least) and least > 0
    return (
        d.pairs,
        d.spread,
        least,
        power_of(d.apart, least, d.pairs, chance) if known else None,
        d.estimate.value,
        runs_needed(d.spread, d.estimate.value),
        *(runs_needed(d.spread, it) for it in _SOUGHT),
    )


# --- figures -------------------------------------------------------------------------


_SHARES = ("accuracy", "κ robot–tutor", "accepted", "reference", "margin")
"""Measures on one scale, whose differences are drawn together."""


def _figures(found: Sequence[Contrast]) -> tuple[Figure, ...]:
    drawn = [it for it in _SHARES if all(it in one.differences for one in found)]
    series = {
        name: as_drawn([it.differences[name].estimate for it in found])
        for name in drawn
    }
    if not series:
        return ()
    data = {
        "labels": [contrast_names(it) for it in found],
        "series": series,
        "xlabel": "difference",
        "zero": 0.0,
    }
    return (Figure("intervals", "Differences", data, "With bands of 95 %."),)
