"""Replaying: a dialogue goes as it went, or the first difference is told."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

import little_study
from kille.lab import log
from kille.lab.dialogues import Played
from kille.lab.log import Broken, Finished, Outcome
from kille.lab.log.outcomes import play_to_outcome
from kille.lab.running_studies import crew, replay, run
from kille.lab.running_studies.replaying import difference
from kille.lab.study import Run, Study
from little_study import BAD, GOOD, play

STUDY = little_study.study(theories=(GOOD, BAD))


def test_what_is_played_again_is_the_same(tmp_path: Path) -> None:
    run(STUDY, tmp_path, play)
    found = list(replay(STUDY, log.outcomes(tmp_path), play))
    assert len(found) == 6
    assert all(differs is None for _, differs in found)


def test_others_may_play_it_again(tmp_path: Path) -> None:
    run(STUDY, tmp_path, play)
    found = list(replay(STUDY, log.outcomes(tmp_path), play, crew(2)))
    assert sorted(str(it.run) for it, _ in found) == sorted(map(str, STUDY.runs()))
    assert all(differs is None for _, differs in found)


def before() -> Finished:
    found = play_to_outcome(STUDY, next(STUDY.runs()), play)
    assert isinstance(found, Finished)
    return found


def test_the_first_turn_that_differs_is_told() -> None:
    one = before()
    turns = list(one.played.turns)
    turns[1] = turns[1]._replace(answer="What?")
    turns[2] = turns[2]._replace(given="Never.")
    other = one._replace(played=replace(one.played, turns=tuple(turns)))
    found = difference(one, other)
    assert found == ("turn 2, answer", "OK.\nOh.", "What?")


@pytest.mark.parametrize("shorter", [0, 3])
def test_a_dialogue_that_ends_early_differs(shorter: int) -> None:
    one = before()
    turns = one.played.turns[:shorter]
    other = one._replace(played=replace(one.played, turns=turns))
    found = difference(one, other)
    assert found
    assert found.where == f"turn {shorter + 1}"
    assert found.now == "nothing"


def test_degrees_and_counts_matter_and_time_does_not() -> None:
    one = before()
    (answer,) = one.played.answers
    degrees = {word: p + 1e-12 for word, p in answer.degrees.items()}
    changed = replace(one.played, answers=(answer._replace(degrees=degrees),))
    found = difference(one, one._replace(played=changed))
    assert found
    assert found.where == "answer 1, degrees"
    found = difference(one, one._replace(played=replace(one.played, lessons=9)))
    assert found == ("at the end, lessons", "3", "9")
    assert difference(one, one._replace(seconds=99.0)) is None


def test_what_was_no_number_is_the_same_again() -> None:
    one = before()
    (answer,) = one.played.answers
    unknown = replace(one.played, answers=(answer._replace(degree=math.nan),))
    assert (
        difference(one._replace(played=unknown), one._replace(played=unknown)) is None
    )


def test_what_broke_breaks_again_or_differs() -> None:
    def as_ever(study: Study, run: Run) -> Played:
        raise ValueError("no cups")

    it = next(STUDY.runs())
    broken: Outcome = play_to_outcome(STUDY, it, as_ever)
    assert isinstance(broken, Broken)
    assert difference(broken, broken._replace(trace="", seconds=7.0)) is None
    found = difference(broken, before())
    assert found
    assert found.now == "played to its end"
    assert "no cups" in found.before
