"""How theories differ, and how many dialogues it takes to see it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from kille.lab.measures.comparison import (
    Contrast,
    PairedDifference,
    contrasts,
    holm,
    least_p,
    pairs_needed,
)
from kille.lab.measures.measures import ACCURACY, Measure
from kille.lab.measures.power import POWER, least_difference, power_of, runs_needed
from kille.lab.reports.findings import Theories
from kille.lab.reports.links import Places
from kille.lab.reports.row_figures import row_figures
from kille.lab.reports.short_names import shorten_names
from kille.lab.results import (
    UNKNOWN,
    Cell,
    Estimate,
    Figure,
    Result,
    Table,
    format_cell,
)

_SEED = 2  # of the chance by which pairs are resampled and exchanged
_MAIN = ACCURACY.name
CHANCE = 0.05
FEW = 3
"""Of more differences, only the significant ones are put into words."""
CORRECTED = "Each p is after Holm's correction."
_LEAST = 0.001
_SOUGHT = (0.05, 0.02)
"""Differences for which the table of power says how many pairs they need."""

TESTED = (
    "p: permutation test, in which the two of a pair are exchanged; then with Holm's "
    "correction, for the main measure ({main}) over its own tests, and for the "
    "others over all of theirs. What is the same in each pair is left out. The "
    "brackets are of 95 %, of pairs drawn anew; where they and the test of the same "
    "difference disagree about zero, the test counts, and no brackets are shown."
)
_NOTE = (
    "Each is that of the later theory less that of the earlier one, over dialogues "
    f"with the same tutor, scene and seed. {TESTED}"
)
_ANSWERED = (
    "Questions for words that both were asked. McNemar's exact test holds answers for "
    "independent, which those of one dialogue are not"
)
_MAIN_TEST = ": the permutation test above is the main one"
_POWERED = (
    f"For {{main}}. Spread: the standard deviation of the differences within pairs. "
    f"Seen with {POWER:.0%}: the smallest difference that so many pairs show with this "
    f"power, by the normal approximation; beside it its power found by simulation. "
    f"Then how many pairs it takes to see a difference."
)


def contrast_results(
    theories: Theories,
    which: Iterable[tuple[str, str]],
    measures: Sequence[Measure],
    places: Places,
    main: str = _MAIN,
) -> list[Result]:
    """How these pairs of theories differ, first in the main measure.

    Nothing if no two of them have a pair of dialogues.
    """
    tested = [it for it in measures if it.better]
    found = contrasts(theories, which, tested, np.random.default_rng(_SEED))
    if not found:
        return []
    asked = found if ACCURACY in measures else []
    mains = found if main in [it.name for it in measures] else []
    tested.sort(key=lambda it: it.name != main)
    tables = (
        differing := _differences_table(found, tested, places, main),
        _answers_table(asked, places, _MAIN_TEST if differing.rows else ""),
        _power_table(found, main),
    )
    filled = tuple(it for it in tables if it.rows)
    text = "\n\n".join(
        [*unreachable_significance(mains, main), _summary_text(mains, main)]
    )
    return [Result("How they differ", filled, _figures(found), text=text)]


def _summary_text(found: Sequence[Contrast], main: str) -> str:
    """What became of the main measure: a line for each pair of theories.

    Of many pairs, how many differ, and those that do.
    """
    mains = [it.differences.get(main) for it in found]
    ps = holm([float("nan") if it is None else it.p for it in mains])
    with_p = [(_sentence(it, p, main), p) for it, p in zip(found, ps, strict=True)]
    of = f"Of {len(found)} pairs of theories", f"differ in {main}"
    return "\n".join(summarise_tests(with_p, of))


def summarise_tests(
    sentences: Sequence[tuple[str, float]], of: tuple[str, str]
) -> Iterator[str]:
    """Put tests into words: a few sentences with their corrected p, or how many differ.

    Of more than a few only the significant ones are told, after their number, which
    stands between the two parts of `of`.

    >>> tests = [("A differs from B.", 0.01), ("A differs from C.", 0.5)]
    >>> list(summarise_tests(tests, ("Of 2", "differ")))[1:]
    ['A differs from C.', "Each p is after Holm's correction."]
    >>> list(summarise_tests(2 * tests, ("Of 4", "differ")))[:2]
    ["Of 4 2 differ (p < 0.05 after Holm's correction).", 'A differs from B.']
    """
    seen = sentences
    if len(sentences) > FEW:
        seen = [(sentence, p) for sentence, p in sentences if p < CHANCE]
        before, after = of
        yield f"{before} {len(seen)} {after} (p < {CHANCE} after Holm's correction)."
    yield from (sentence for sentence, _ in seen)
    if len(sentences) <= FEW and sum(p == p for _, p in sentences) > 1:
        yield CORRECTED


def _sentence(it: Contrast, p: float, measure: str) -> str:
    if not it.differences:
        alike = f"{it.other} and {it.one} do equally well in every pair of dialogues."
        return f"{alike}{_too_few_to_tell(it.pairs)}"
    main = it.differences.get(measure)
    if main is None:
        alike = f"{it.other} and {it.one} have the same {measure} in every pair."
        return f"{alike}{_too_few_to_tell(it.pairs)}"
    if not main.pairs:
        return f"{it.other} and {it.one} were never both asked for words."
    difference = format_difference(main, p)
    return f"The {measure} of {it.other} differs from that of {it.one} by {difference}."


def _too_few_to_tell(pairs: int) -> str:
    """That so few pairs could not show a difference, if it is so."""
    if not pairs or least_p(pairs) < CHANCE:
        return ""
    return (
        f" {pairs} pair{'s' * (pairs != 1)} could not show a difference: "
        f"that takes {pairs_needed(1, CHANCE)}, so give the study more seeds."
    )


def format_difference(difference: PairedDifference, p: float) -> str:
    """Format a difference with its confidence interval and its p, for a sentence."""
    estimate = drop_contradicting_interval(difference.estimate, p)
    return f"{format_cell(estimate)} (p = {format_p(p)})".replace("= <", "<")


def drop_contradicting_interval(estimate: Estimate, p: float) -> Estimate:
    """A difference without its interval, if interval and p disagree about zero.

    >>> drop_contradicting_interval(Estimate(0.2, 0.1, 0.3), 0.01)
    Estimate(value=0.2, low=0.1, high=0.3, decimals=3)
    >>> drop_contradicting_interval(Estimate(0.2, 0.1, 0.3), 0.06)
    Estimate(value=0.2, low=nan, high=nan, decimals=3)
    """
    apart = not estimate.low <= 0 <= estimate.high
    if apart == (p < CHANCE):
        return estimate
    return estimate._replace(low=float("nan"), high=float("nan"))


def unreachable_significance(
    found: Sequence[Contrast], main: str = _MAIN
) -> Iterator[str]:
    """Say that no difference can be significant, if there are too few pairs for it."""
    mains = [it.differences[main] for it in found if main in it.differences]
    most, tests = max((it.pairs for it in mains), default=0), len(mains)
    least = min(1.0, tests * least_p(most))
    if not most or least < CHANCE:
        return
    needed = pairs_needed(tests, CHANCE)
    correction = f" after Holm's correction for {tests} tests" if tests > 1 else ""
    yield (
        f"No difference in {main} can be significant: with {most} "
        f"pair{'s' if most != 1 else ''} of dialogues p is {format_p(least)} at "
        f"best{correction}. "
        + (
            f"It takes {needed} pairs: give the study more seeds."
            if needed
            else "Compare fewer theories."
        )
    )


def contrast_names(contrast: Contrast) -> str:
    """The name of a contrast: the later theory less the earlier one."""
    return f"{contrast.other} − {contrast.one}"


def format_p(p: float) -> str:
    """Format a p-value as papers write it.

    >>> format_p(0.0301), format_p(0.00002), format_p(float("nan"))
    ('0.030', '< 0.001', '–')
    """
    if p != p:
        return "–"
    return f"{p:.3f}" if p >= _LEAST else f"< {_LEAST}"


def _differences_table(
    found: Sequence[Contrast], measures: Sequence[Measure], places: Places, main: str
) -> Table:
    """The paired differences, measure by measure."""
    shown = [
        (it, measure.name, it.differences[measure.name])
        for measure in measures
        for it in found
        if measure.name in it.differences
    ]
    ps = correct_by_family([(name, d.p) for _, name, d in shown], main)
    rows = tuple(
        (contrast_names(it), name, *difference_cells(d, p))
        for (it, name, d), p in zip(shown, ps, strict=True)
    )
    columns = ("theories", "measure", "difference", "p", "p (Holm)", "pairs")
    links = {
        (row, 2): places.against(it.one, it.other)
        for row, (it, _, _) in enumerate(shown)
    }
    note = _NOTE.format(main=main)
    return Table("Paired differences", columns, rows, note, links)


def difference_cells(difference: PairedDifference, p: float) -> tuple[Cell, ...]:
    """The cells of a difference: its estimate, its p, its corrected p, its pairs."""
    estimate = drop_contradicting_interval(difference.estimate, difference.p)
    return estimate, format_p(difference.p), format_p(p), difference.pairs


def correct_by_family(
    ps: Sequence[tuple[str, float]], main: str = _MAIN
) -> list[float]:
    """Correct p-values by Holm's method, those of the main measure by themselves."""
    found = [p for _, p in ps]
    for is_main in (True, False):
        places = [i for i, (name, _) in enumerate(ps) if (name == main) == is_main]
        for i, p in zip(places, holm([ps[i][1] for i in places]), strict=True):
            found[i] = p
    return found


def _answers_table(found: Sequence[Contrast], places: Places, beside: str) -> Table:
    """McNemar's test; `beside` says which test counts more, if there is one."""
    ps = holm([it.answers.p for it in found])
    rows = tuple(
        (*_side_cells(it), format_p(it.answers.p), format_p(p))
        for it, p in zip(found, ps, strict=True)
    )
    columns = ("theory", "only it right", "theory", "only it right", "p", "p (Holm)")
    links = {
        (row, column): places.against(it.one, it.other)
        for row, it in enumerate(found)
        for column in (1, 3)
    }
    return Table("Question by question", columns, rows, f"{_ANSWERED}{beside}.", links)


def _side_cells(it: Contrast) -> tuple[Cell, ...]:
    return it.one, it.answers.one, it.other, it.answers.other


# --- power ---------------------------------------------------------------------------


def _power_table(found: Sequence[Contrast], main: str) -> Table:
    known = [(it, it.differences[main]) for it in found if main in it.differences]
    rows = tuple((contrast_names(it), *_power_cells(d)) for it, d in known)
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
    return Table(
        "How many dialogues it takes", columns, rows, _POWERED.format(main=main)
    )


def _power_cells(d: PairedDifference) -> tuple[Cell, ...]:
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
_LINE = 24
"""Two names of so many letters together fit on a line beside a figure."""


def _figures(found: Sequence[Contrast]) -> tuple[Figure, ...]:
    shares = [it for it in _SHARES if any(it in one.differences for one in found)]
    pairs = [it for it in found if any(name in it.differences for name in shares)]
    series = {
        name: [_estimate(it.differences.get(name)) for it in pairs] for name in shares
    }
    called = shorten_names(name for it in pairs for name in (it.one, it.other))
    labels = [_on_two_lines(called[it.other], called[it.one]) for it in pairs]
    settings = {"xlabel": "difference", "zero": 0.0}
    return tuple(row_figures("Differences", labels, series, settings))


def _estimate(difference: PairedDifference | None) -> Estimate:
    if difference is None:
        return UNKNOWN
    return drop_contradicting_interval(difference.estimate, difference.p)


def _on_two_lines(other: str, one: str) -> str:
    """Two names, the second below the first if they are long."""
    return f"{other} −{' ' if len(other + one) <= _LINE else chr(10)}{one}"
