"""What `ttr test` finds in small games with one slip each, without being told a thing.

How many dialogues it takes is far below the default of a thousand; slips that show only
in many dialogues have more. `make deep` plays the correct games 25,000 times.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from slips import HELD_OUT, ORIGINALS, PLANTED, Slip, game_of

from ttr.testing import Report, Suite
from ttr.theories.theory import load

ROOT = Path(__file__).resolve().parents[2]
DIALOGUES = 60
MANY = {
    "greeting: who leaves is not parted with": 700,
    "library: what was thanked for stays pending": 150,
    "accommodate: an answer leaves its question open": 150,
    "clarify: the clarification lies below what it clarifies": 700,
}
"""How many dialogues it takes where the slip is that something never happens."""

NOT_FOUND = {
    "library: the loan is the clerk's",
    "shopping: what was vetoed is on the list as well",
}
"""What is right or wrong by what the words mean alone."""

CORRECT = {
    **ORIGINALS,
    "door": ROOT / "tests" / "games" / "door.ttr",
    "rules": ROOT / "tests" / "theories" / "rules.ttr",
}


@cache
def report_of(slip: Slip) -> Report:
    """What came of testing a slip, as often as it is asked for."""
    return Suite(slip.game, examples=MANY.get(str(slip), DIALOGUES)).run()


def slow_if_many(slip: Slip):
    marks = [pytest.mark.deep] if MANY.get(str(slip), 0) > 500 else []
    return pytest.param(slip, id=str(slip), marks=marks)


SLIPS = [slow_if_many(slip) for slip in (*PLANTED, *HELD_OUT)]


@pytest.mark.slow
@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_found(slip):
    assert report_of(slip).holds == (str(slip) in NOT_FOUND)


def test_there_are_twenty_and_most_are_found():
    assert len(PLANTED) == 20
    assert sum(str(slip) not in NOT_FOUND for slip in PLANTED) >= 16
    assert {str(slip) for slip in (*PLANTED, *HELD_OUT)} > NOT_FOUND


@pytest.mark.slow
@pytest.mark.parametrize("name", ORIGINALS)
def test_a_correct_game_is_left_alone(name):
    assert Suite(game_of(name), examples=25).run().explain_failure() == ""


def test_a_rule_for_one_part_of_what_another_takes_is_applied():
    report = Suite(game_of("accommodate"), examples=100).run()
    assert report.coverage.missed_rules == ()


@pytest.mark.deep
@pytest.mark.parametrize("name", CORRECT)
def test_a_correct_game_is_left_alone_for_long(name):
    for game in load(CORRECT[name]).games.values():
        assert Suite(game, examples=25_000).run().explain_failure() == ""


WHY = {
    "talk: what was answered stays under discussion": ("P8", "is still on qud"),
    "talk: something is a fact that nobody said": ("P8", "but agrees on snow"),
    "talk: a fact is added twice": ("P22", "put on facts 2 times"),
    "library: what was thanked for stays pending": ("P25", "shared.pending is never"),
    "walk: nothing takes praise, which anybody may give": ("P27", "Praise looks like"),
    "walk: who has the floor is not who moves": ("P24", "but floor is ann"),
    "floor: news are put down to the one who listens": ("P21", "it was amy who said"),
}


@pytest.mark.parametrize("name", WHY)
def test_it_is_said_what_is_wrong(name):
    slip = next(one for one in (*PLANTED, *HELD_OUT) if str(one) == name)
    told = report_of(slip).explain_failure()
    property_, why = WHY[name]
    assert told.startswith(f"{property_} ")
    assert why in told
