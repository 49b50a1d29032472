"""Property tests find the faults of the mutants, and none in the correct games."""

from __future__ import annotations

from functools import cache

import pytest
from mutants import GAMES, MUTANTS, Mutant, properties_of

from ttr.testing import Suite
from ttr.updates.checks import faults_of

DIALOGUES = 150

RARE = {
    "tutoring-never-guesses": 600,
    "tutoring-unpacks-nothing": 600,
    "fetch-skips-a-move": 600,
    "travel-no-is-yes": 300,
}
"""How many dialogues it takes where the fault is that something never happens."""

SLOW = {*RARE, "travel-decides-for-ever"}
"""Mutants that take too long to be found for every day."""


@cache
def found_in(mutant: Mutant) -> tuple[str, str]:
    """The property that a mutant breaks, and why it does; twice nothing for none."""
    beside = GAMES[mutant.game]
    count = RARE.get(str(mutant), DIALOGUES)
    suite = Suite(
        mutant.made,
        beside.tutor,
        properties=properties_of(mutant.game),
        roles=beside.roles,
        examples=count,
    )
    report = suite.played()
    if report.broken is not None:
        return report.broken.why.property.name, report.broken.why.why
    for broken, why in report.overall:
        return broken.name, why
    return "", ""


def test_there_are_many_mutants_of_every_game():
    assert len(MUTANTS) >= 40
    assert {mutant.game for mutant in MUTANTS} == set(GAMES)
    assert len({str(mutant) for mutant in MUTANTS}) == len(MUTANTS)


def by_name(name: str) -> Mutant:
    """The mutant with this name."""
    return next(one for one in MUTANTS if str(one) == name)


def parameter(mutant: Mutant):
    return pytest.param(mutant, id=str(mutant), marks=marks_of(str(mutant)))


def marks_of(name: str) -> list[pytest.MarkDecorator]:
    return [pytest.mark.deep] if name in SLOW else []


@pytest.mark.parametrize("mutant", [*map(parameter, MUTANTS)])
def test_a_mutant_is_found_by_playing(mutant):
    name, _ = found_in(mutant)
    assert name


MANY = pytest.param(25_000, marks=pytest.mark.deep)


@pytest.mark.slow
@pytest.mark.parametrize("dialogues", [100, MANY])
@pytest.mark.parametrize("name", GAMES)
def test_a_correct_game_is_left_alone(name, dialogues):
    beside = GAMES[name]
    suite = Suite(
        beside.game,
        beside.tutor,
        properties=properties_of(name),
        roles=beside.roles,
        examples=dialogues,
    )
    assert faults_of(beside.game) == ()
    assert suite.run().explain_failure() == ""


EXPECTED = {
    "asking-careless-downdate": "P8",
    "asking-forgetful": "P10",
    "asking-gullible": "P9",
    "asking-order-matters": "P5",
    "asking-greets-always": "P13",
    "asking-counted-twice": "P18",
    "fetch-brings-for-ever": "P4",
    "fetch-scribbles": "P2",
    "tutoring-latest-is-text": "P1",
    "tutoring-wrong-polarity": "P13",
    "tutoring-misspelt-path": "P7",
    "tutoring-looks-at-nothing": "P17",
    "tutoring-says-it-twice": "P14",
    "travel-no-is-yes": "P16",
}


@pytest.mark.parametrize(
    ("name", "found"),
    [pytest.param(*one, marks=marks_of(one[0])) for one in EXPECTED.items()],
)
def test_it_is_the_property_that_says_what_is_wrong(name, found):
    property_, _ = found_in(by_name(name))
    assert property_ == found


@pytest.mark.deep
def test_only_the_rule_that_is_never_applied_is_called_dead():
    _, why = found_in(by_name("tutoring-never-guesses"))
    assert why.startswith("guess_name is never applied")
