"""Whether other tutors and other scenes change anything: each against the first one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from kille.lab.measures.comparison import Difference, differences, in_pairs
from kille.lab.measures.measures import Measure
from kille.lab.measures.scored_dialogues import ScoredDialogue
from kille.lab.reports.contrasts import (
    CHANCE,
    CORRECTED,
    FEW,
    TESTED,
    agreeing,
    corrected,
    told_by,
    told_p,
)
from kille.lab.reports.findings import Theories
from kille.lab.reports.links import Places
from kille.lab.results import Cell, Table
from kille.lab.study import Run

_SEED = 3  # of the chance by which pairs are drawn anew and exchanged
_MAIN = "accuracy"
_TESTED = (_MAIN, "κ robot–tutor", "words")
_NOTE = (
    "Each less the first, theory by theory, over dialogues that are alike in all else. "
    "Other tutors and scenes have other luck, so that these differences spread more "
    f"than those of theories. {TESTED.format(main=_MAIN)}"
)


class Against(NamedTuple):
    """A table of differences, and what became of the main measure, line by line."""

    table: Table
    text: str


class _Told(NamedTuple):
    """A difference, of what, and where it leads to."""

    theory: str
    measure: str
    first: str
    other: str
    difference: Difference
    place: str

    @property
    def named(self) -> tuple[str, str, str]:
        """What it is a difference of."""
        return self.theory, self.measure, f"{self.other} − {self.first}"


def against_the_first(
    theories: Theories, measures: Sequence[Measure], places: Places
) -> Iterator[Against]:
    """The tutors against the first tutor, and the scenes against the first scene."""
    tested = [it for it in measures if it.name in _TESTED]
    yield from _against("tutor", list(places.tutors), theories, tested, places)
    yield from _against("scene", list(places.scenes), theories, tested, places)


def _against(
    what: str,
    names: Sequence[str],
    theories: Theories,
    measures: Sequence[Measure],
    places: Places,
) -> Iterator[Against]:
    first, *others = names
    told = [
        one
        for theory, them in theories.items()
        for name in others
        for one in _one(what, theory, them, (first, name), measures, places)
    ]
    if not told:
        return
    ps = corrected([(it.measure, it.difference.p) for it in told])
    rows = tuple(
        (*it.named, *_tested(it.difference, p)) for it, p in zip(told, ps, strict=True)
    )
    columns = ("theory", "measure", what, "difference", "p", "p (Holm)", "pairs")
    links = {(row, 3): it.place for row, it in enumerate(told)}
    table = Table(f"Against the {what} {first}", columns, rows, _NOTE, links)
    mains = [
        (it, p)
        for it, p in zip(told, ps, strict=True)
        if it.measure == _MAIN and it.difference.pairs
    ]
    yield Against(table, "\n".join(_in_words(what, names, mains)))


def _in_words(
    what: str, names: Sequence[str], mains: Sequence[tuple[_Told, float]]
) -> Iterator[str]:
    """What became of the main measure, a line for each; of many, how many differ."""
    (first, *others), seen = names, mains
    if len(mains) > FEW:
        seen = [(it, p) for it, p in mains if p < CHANCE]
        yield (
            f"Of {len(others)} {what}s {len(seen)} differ from {first} in {_MAIN} "
            f"(p < {CHANCE} after Holm's correction)."
        )
    yield from (_sentence(what, first, it, p) for it, p in seen)
    if 1 < len(mains) <= FEW:
        yield CORRECTED


def _sentence(what: str, first: str, it: _Told, p: float) -> str:
    told = told_by(it.difference, p)
    return (
        f"The {_MAIN} of {it.theory} with the {what} {it.other} differs from that "
        f"with {first} by {told}."
    )


def _tested(difference: Difference, p: float) -> tuple[Cell, ...]:
    told = agreeing(difference.estimate, difference.p)
    return told, told_p(difference.p), told_p(p), difference.pairs


def _one(
    what: str,
    theory: str,
    dialogues: Sequence[ScoredDialogue],
    names: tuple[str, str],
    measures: Sequence[Measure],
    places: Places,
) -> Iterator[_Told]:
    """How the dialogues of a theory differ between two tutors, or scenes."""
    sides = (_without(what, dialogues, name) for name in names)
    pairs = in_pairs(*sides)
    if not pairs:
        return
    place = places.tutor if what == "tutor" else places.scene
    found = differences(measures, pairs, np.random.default_rng(_SEED))
    for measure, difference in found.items():
        yield _Told(theory, measure, *names, difference, place(theory, names[1]))


def _without(
    what: str, dialogues: Sequence[ScoredDialogue], name: str
) -> list[ScoredDialogue]:
    """The dialogues of a tutor or scene, as if there were no other."""
    return [
        replace(it, run=_run(what, it.run))
        for it in dialogues
        if getattr(it.run, what) == name
    ]


def _run(what: str, run: Run) -> Run:
    return replace(run, tutor="") if what == "tutor" else replace(run, scene="")
