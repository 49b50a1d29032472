"""Do other tutors and other scenes change anything? Each against the first one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from kille.lab.measures.comparison import PairedDifference, differences, in_pairs
from kille.lab.measures.measures import Measure
from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.reports.contrasts import (
    TESTED,
    correct_by_family,
    difference_cells,
    format_difference,
    summarise_tests,
)
from kille.lab.reports.findings import Theories
from kille.lab.reports.links import Places
from kille.lab.results import Table
from kille.lab.study import Run

_SEED = 3  # of the chance by which pairs are resampled and exchanged
_MAIN = "accuracy"
_TESTED = (_MAIN, "κ robot–tutor", "words")
_NOTE = (
    "Each less the first, theory by theory, over dialogues that are alike in all else. "
    "Other tutors and scenes have other luck, so that these differences spread more "
    f"than those of theories. {TESTED.format(main=_MAIN)}"
)


class Comparison(NamedTuple):
    """A table of differences, and what became of the main measure, line by line."""

    table: Table
    text: str


class _NamedDifference(NamedTuple):
    """A difference of a theory in a measure between two tutors or scenes."""

    theory: str
    measure: str
    first: str
    other: str
    difference: PairedDifference
    place: str

    @property
    def name_cells(self) -> tuple[str, str, str]:
        """The cells that say what it is a difference of."""
        return self.theory, self.measure, f"{self.other} − {self.first}"


def compare_with_first(
    theories: Theories, measures: Sequence[Measure], places: Places
) -> Iterator[Comparison]:
    """Compare all tutors with the first tutor, and all scenes with the first scene."""
    tested = [it for it in measures if it.name in _TESTED]
    for what in ("tutor", "scene"):
        yield from _compare_names(what, theories, tested, places)


def _compare_names(
    what: str, theories: Theories, measures: Sequence[Measure], places: Places
) -> Iterator[Comparison]:
    first, *others = names = list(places.numbers[what])
    named = [
        one
        for theory, them in theories.items()
        for name in others
        for one in _differences_of(what, theory, them, (first, name), measures, places)
    ]
    if not named:
        return
    ps = correct_by_family([(it.measure, it.difference.p) for it in named])
    rows = tuple(
        (*it.name_cells, *difference_cells(it.difference, p))
        for it, p in zip(named, ps, strict=True)
    )
    columns = ("theory", "measure", what, "difference", "p", "p (Holm)", "pairs")
    links = {(row, 3): it.place for row, it in enumerate(named)}
    table = Table(f"Against the {what} {first}", columns, rows, _NOTE, links)
    mains = [
        (it, p)
        for it, p in zip(named, ps, strict=True)
        if it.measure == _MAIN and it.difference.pairs
    ]
    yield Comparison(table, "\n".join(_summary_lines(what, names, mains)))


def _summary_lines(
    what: str, names: Sequence[str], mains: Sequence[tuple[_NamedDifference, float]]
) -> Iterator[str]:
    """What became of the main measure: a line for each, or how many of many differ."""
    first, *others = names
    sentences = [(_sentence(what, first, it, p), p) for it, p in mains]
    of = f"Of {len(others)} {what}s", f"differ from {first} in {_MAIN}"
    return summarise_tests(sentences, of)


def _sentence(what: str, first: str, it: _NamedDifference, p: float) -> str:
    difference = format_difference(it.difference, p)
    return (
        f"The {_MAIN} of {it.theory} with the {what} {it.other} differs from that "
        f"with {first} by {difference}."
    )


def _differences_of(
    what: str,
    theory: str,
    dialogues: Sequence[ScoredDialogue],
    names: tuple[str, str],
    measures: Sequence[Measure],
    places: Places,
) -> Iterator[_NamedDifference]:
    """How the dialogues of a theory differ between two tutors, or scenes."""
    sides = (_without(what, dialogues, name) for name in names)
    pairs = in_pairs(*sides)
    if not pairs:
        return
    place = places.dialogues(theory, what, names[1])
    found = differences(measures, pairs, np.random.default_rng(_SEED))
    for measure, difference in found.items():
        yield _NamedDifference(theory, measure, *names, difference, place)


def _without(
    what: str, dialogues: Sequence[ScoredDialogue], name: str
) -> list[ScoredDialogue]:
    """The dialogues with a tutor or scene, without its name, to make them pairs."""
    return [
        replace(it, run=_run_without(what, it.run))
        for it in dialogues
        if getattr(it.run, what) == name
    ]


def _run_without(what: str, run: Run) -> Run:
    return replace(run, tutor="") if what == "tutor" else replace(run, scene="")
