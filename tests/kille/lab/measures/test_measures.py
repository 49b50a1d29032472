"""Measures over dialogues keep to those over answers, and their bands to dialogues."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.lab.dialogues import Answer, Played, Turn
from kille.lab.measures.agreement import kappas, vocabulary
from kille.lab.measures.measures import (
    ACCEPTED,
    ACCURACY,
    BRIER,
    CORRECTIONS,
    MARGIN,
    QUESTIONS,
    REFERENCES,
    TO_CRITERION,
    TURNS,
    WORDS,
    estimate,
    value,
)
from kille.lab.measures.scored_dialogues import (
    ScoredDialogue,
    score_dialogue,
    split_dialogues,
)
from kille.lab.measures.statistics import accuracy, brier, kappa
from kille.lab.study import Run

SAID = st.sampled_from(["near", "left", "right", ""])
RIGHT = st.sampled_from(["near", "left", "right"])
TALKS = st.lists(
    st.lists(st.tuples(RIGHT, SAID), min_size=1, max_size=6), min_size=1, max_size=6
)


def asked(right: str, said: str, kind: str = "relation", **more: object) -> Answer:
    return Answer(1, "test", kind, right, said, "assert", **more)  # type: ignore[arg-type]


def dialogue(
    answers: Sequence[Answer], seed: int = 1, turns: Sequence[Turn] = ()
) -> ScoredDialogue:
    run = Run("both", "Ann", "table", seed)
    return score_dialogue(run, Played(tuple(turns), tuple(answers)), 0.5)


def talks_of(pairs: Sequence[Sequence[tuple[str, str]]]) -> list[ScoredDialogue]:
    return [
        dialogue([asked(right, said) for right, said in them], seed)
        for seed, them in enumerate(pairs)
    ]


@given(TALKS)
def test_accuracy_is_that_of_all_answers(pairs: list[list[tuple[str, str]]]) -> None:
    right, said = zip(*(it for them in pairs for it in them), strict=True)
    assert value(ACCURACY, talks_of(pairs)) == pytest.approx(accuracy(right, said))


@given(TALKS)
def test_kappa_is_that_of_all_answers(pairs: list[list[tuple[str, str]]]) -> None:
    talks = talks_of(pairs)
    right, said = zip(*(it for them in pairs for it in them), strict=True)
    robot, _, _ = kappas(vocabulary(talks))
    assert value(robot, talks) == pytest.approx(kappa(said, right))


def test_chance_agreement_is_that_within_each_kind_of_word() -> None:
    """Whoever always says the commonest word of a kind agrees by chance alone."""
    nouns = [asked("cup", "cup", "noun"), asked("car", "cup", "noun")]
    places = [asked("left", "left"), asked("near", "left")]
    talk = [dialogue([*nouns, *places])]
    robot, _, _ = kappas(vocabulary(talk))
    assert value(robot, talk) == pytest.approx(0.0)


def test_people_set_the_ceiling() -> None:
    said = [
        ("near", "left", "left"),
        ("left", "left", "left"),
        ("near", "near", "near"),
    ]
    talk = [dialogue([asked(a, b, judge=c) for a, b, c in said])]
    _, judge, people = kappas(vocabulary(talk))
    assert value(judge, talk) == 1
    assert value(people, talk) == pytest.approx(
        kappa(["near", "left", "near"], ["left", "left", "near"])
    )


def test_without_a_judge_there_is_no_ceiling() -> None:
    talk = [dialogue([asked("near", "near")])]
    _, judge, people = kappas(vocabulary(talk))
    assert math.isnan(value(judge, talk))
    assert math.isnan(value(people, talk))


@given(st.dictionaries(RIGHT, st.floats(0, 1), min_size=1))
def test_the_brier_score_takes_degrees_as_chances(degrees: dict[str, float]) -> None:
    talk = [dialogue([asked("near", "near", degrees=degrees)])]
    whole = max(1.0, sum(degrees.values()))
    chances = {word: it / whole for word, it in degrees.items()}
    assert value(BRIER, talk) == pytest.approx(brier(["near"], [chances]))
    assert 0 <= value(BRIER, talk) <= 2


def test_margins_are_those_of_the_right_word() -> None:
    degrees = {"near": 0.25, "left": 0.75}
    talk = [dialogue([asked("near", "left", degrees=degrees)])]
    assert value(MARGIN, talk) == -0.5


def test_things_found_are_not_words_said() -> None:
    found = [asked("o1", "o1", "reference"), asked("o2", "o1", "reference")]
    talk = [dialogue([*found, asked("near", "near", accepted=True)])]
    assert value(REFERENCES, talk) == 0.5
    assert value(ACCURACY, talk) == 1
    assert value(ACCEPTED, talk) == 1


def test_effort_is_counted_by_dialogue() -> None:
    turns = [
        Turn(1, "teach", "Ann", "shows", "look1", ""),
        Turn(
            2, "teach", "Ann", "instruct", "This is a cup.", "OK.", words=4, asks=True
        ),
        Turn(3, "test", "Ann", "correct", "No.", "OK.", words=1, corrects=True),
    ]
    talks = [dialogue([], 1, turns), dialogue([], 2)]
    found = [value(it, talks) for it in (TURNS, WORDS, CORRECTIONS, QUESTIONS)]
    assert found == [1.0, 2.5, 0.5, 0.5]
    assert [it.phase for it in talks[0].efforts] == ["teach", "test"]


@pytest.mark.parametrize(
    ("right", "count"),
    [("11111", 5), ("0111110", 6), ("1101101111", 11), ("", 1), ("11110" * 3, 16)],
)
def test_answers_to_criterion_end_with_five_in_a_row(right: str, count: int) -> None:
    answers = [asked("near", "near" if it == "1" else "far") for it in right]
    played = score_dialogue(Run("a", "Ann", "table", 1), Played((), tuple(answers)), 0)
    assert value(TO_CRITERION, [played]) == count


def test_of_nothing_there_is_no_number() -> None:
    assert math.isnan(value(ACCURACY, []))
    assert math.isnan(value(ACCURACY, [dialogue([])]))
    assert math.isnan(estimate(ACCURACY, [], np.random.default_rng(1)).low)


def test_a_band_is_as_wide_as_dialogues_vary() -> None:
    """Answers of a dialogue that are all alike are worth no more than one of them."""
    chance = np.random.default_rng(7)
    rights = chance.random(100) < 0.6
    alike = [
        dialogue([asked("near", "near" if it else "left")] * 10, seed)
        for seed, it in enumerate(rights)
    ]
    found = estimate(ACCURACY, alike, np.random.default_rng(1))
    by_theory = 2 * 1.96 * rights.std() / math.sqrt(len(rights))
    assert found.value == pytest.approx(rights.mean())
    assert found.high - found.low == pytest.approx(by_theory, rel=0.1)


def test_a_band_is_of_its_seed() -> None:
    talks = talks_of([[("near", "near")], [("near", "left")], [("left", "left")]] * 9)
    bands = {estimate(ACCURACY, talks, np.random.default_rng(it)) for it in (1, 1)}
    assert len(bands) == 1


def test_few_dialogues_have_no_band() -> None:
    talks = talks_of([[("near", "near")], [("near", "left")]] * 2)
    found = estimate(ACCURACY, talks, np.random.default_rng(1))
    assert found.value == 0.5
    assert math.isnan(found.low)
    assert math.isnan(found.high)


def test_dialogues_in_which_nothing_is_measured_do_not_make_it_surer() -> None:
    """Ten dialogues of which but four have such an answer tell no more than four."""
    asked_in_four = talks_of([[("near", "near")]] * 4 + [[]] * 6)
    robot, _, _ = kappas(vocabulary(asked_in_four))
    for measure in (ACCURACY, robot):
        assert math.isnan(
            estimate(measure, asked_in_four, np.random.default_rng(1)).low
        )
    asked_in_five = talks_of([[("near", "near")]] * 5 + [[]] * 6)
    assert estimate(ACCURACY, asked_in_five, np.random.default_rng(1)).low == 1


@given(TALKS)
def test_parts_add_up(pairs: list[list[tuple[str, str]]]) -> None:
    talks = talks_of(pairs)
    parts = split_dialogues(talks, lambda it: it.right)
    assert all(
        [it.pair for it in part] == [it.pair for it in talks] for part in parts.values()
    )
    count = sum(len(it.answers) for part in parts.values() for it in part)
    assert count == sum(map(len, pairs))
