"""Deciding by expected utility: the bands, the modes, and the robot of four bands."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from string import Formatter
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kille.dialogue.games import EXEMPLIFYING, GLANCED, LISTENING
from kille.dialogue.language import LANGUAGES, overhear
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import meaning_in, noun, predicate_at
from kille.dialogue.strategies import (
    MODES,
    WORDINGS,
    Option,
    Stake,
    best,
    expected_value,
    strategy,
    threshold,
)
from kille.dialogue.strategies import _data as shipped
from kille.dialogue.wording import say
from kille.interfaces.cli import main
from kille.interfaces.ros import _CHOICES
from ttr import record, replace
from ttr.updates import first, maybe, seq

Make = Callable[..., Any]

with_scenes = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
worth = st.floats(-5, 5)

# --- expecting -----------------------------------------------------------------------


@given(stronger=st.builds(Stake, worth, worth), weaker=st.builds(Stake, worth, worth))
def test_from_its_threshold_on_the_stronger_is_expected_to_be_worth_more(
    stronger: Stake, weaker: Stake
) -> None:
    steeper = (stronger.right - stronger.wrong) - (weaker.right - weaker.wrong)
    at = threshold(stronger, weaker)
    for p in (0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0):
        if steeper > 1e-3 and abs(p - at) > 1e-6:
            more = expected_value(stronger, p) > expected_value(weaker, p)
            assert more == (p > at)


def test_nothing_is_done_of_which_nothing_is_expected() -> None:
    even = Option("even", 0.5, Stake(1.0, -1.0))
    assert best([]) is None
    assert best([even]) is None
    assert best([even], nothing=-0.1) == even
    assert best([even._replace(p=math.nextafter(0.5, 1.0))]) is not None


@given(ps=st.lists(st.floats(0, 1), min_size=1, max_size=5))
def test_the_best_is_expected_to_be_worth_most(ps: list[float]) -> None:
    options = [Option(str(n), p, Stake(1.0, -0.2)) for n, p in enumerate(ps)]
    chosen = best(options)
    top = max(expected_value(it.stake, it.p) for it in options)
    assert (chosen is None) == (top <= 0.0)
    assert chosen is None or expected_value(chosen.stake, chosen.p) == top


def ways(wording: str) -> Mapping[str, Stake]:
    """What each way of speaking is worth, the strongest first."""
    wordings = shipped()["wordings"]
    stakes = wordings[wordings[wording].get("like", wording)]["stakes"]
    return {name: Stake(**stakes[name]) for name in ("assert", "think", "doubt")}


@pytest.mark.parametrize("wording", WORDINGS)
@given(p=st.floats(0, 1))
def test_bands_are_where_most_is_expected_of_a_way_to_speak(
    wording: str, p: float
) -> None:
    bands = strategy(wording=wording).bands
    edges = {"assert": bands.sure, "think": bands.think, "doubt": bands.likely}
    if any(abs(p - edge) < 1e-6 for edge in edges.values()):
        return
    by_band = next((way for way, edge in edges.items() if p >= edge), None)
    by_worth = best([Option(it, p, stake) for it, stake in ways(wording).items()])
    stakes = ways(wording)
    told = None if by_worth is None else stakes[by_worth.name]
    assert told == (None if by_band is None else stakes[by_band])


def test_the_shipped_bands_are_those_of_the_papers() -> None:
    paper, four, varied = (strategy(wording=it).bands for it in WORDINGS)
    assert varied == paper
    assert (paper.sure, paper.margin, paper.likely, paper.might) == (
        0.6,
        0.3,
        0.2,
        0.05,
    )
    assert (paper.name_margin, four.name_margin) == (0.6, four.margin)
    assert (four.sure, four.think, four.likely) == (0.8, 0.5, 0.3)


@pytest.mark.parametrize("names", [{"mode": "lazy"}, {"wording": "five"}])
def test_what_there_is_not_is_said(names: dict[str, str]) -> None:
    with pytest.raises(ValueError, match="choose one of"):
        strategy(**names)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("wording", WORDINGS)
def test_every_strategy_can_be_played(scene: Make, mode: str, wording: str) -> None:
    robot = scene(
        nouns=("cup",), known={("cup", "o1"): 0.9}, mode=mode, wording=wording
    )
    assert robot.state.private.strategy.mode == mode
    wordings = lexicon("en", wording)
    ways = (*wordings.says["assert_name"], *wordings.varied.get("assert_name", ()))
    sure = tuple(it.format(a_word="a cup") for it in ways)
    assert robot.hear("What is this?").startswith(sure)


# --- the decision flips exactly at the thresholds -------------------------------------

EDGES = [
    ("paper", 0.6, "guess_name", "assert_name"),
    ("paper", 0.2, "admit_name", "guess_name"),
    ("four", 0.8, "guess_name", "assert_name"),
    ("four", 0.5, "doubt_name", "guess_name"),
    ("four", 0.3, "admit_name", "doubt_name"),
]


@pytest.mark.parametrize(("wording", "edge", "below", "from_there"), EDGES)
def test_it_speaks_otherwise_exactly_from_a_threshold_on(
    scene: Make, wording: str, edge: float, below: str, from_there: str
) -> None:
    for p, act in ((math.nextafter(edge, 0.0), below), (edge, from_there)):
        robot = scene(nouns=("cup",), known={("cup", "o1"): p}, wording=wording)
        assert robot.acts("What is this?") == [act]


# --- the robot of four bands ----------------------------------------------------------

SAYS = {
    0.9: "This is a cup. Am I right?",
    0.6: "I think this is a cup. Am I right?",
    0.4: "I am not sure. Is this a cup?",
    0.1: "I don't know what this is. Please, tell me.",
}
LEARNS = {
    4: "Please, show me more examples of cup.",
    5: "I am learning cup.",
    6: "I am updating my systems on cup.",
}
CASES = [
    *(
        (p, said, count)
        for p in (0.9, 0.6, 0.4)
        for said in ("Yes.", "No.")
        for count in LEARNS
    ),
    *((0.1, "", count) for count in LEARNS),
]


def test_there_are_21_cases() -> None:
    assert len(CASES) == 21


@pytest.mark.parametrize(("p", "said", "count"), CASES)
def test_what_a_yes_and_a_no_do(scene: Make, p: float, said: str, count: int) -> None:
    robot = scene(nouns=("cup",), known={("cup", "o1"): p}, wording="four")
    for _ in range(count - 1):
        robot.hear("This is a cup.")
    robot.look(kept=())  # something else lies there now
    lessons = len(robot.state.private.lessons)
    assert robot.hear("What is this?") == SAYS[p]
    if said == "Yes." and p >= 0.5:
        assert robot.hear(said) == "Great!"
        assert len(robot.state.private.lessons) == lessons
        return
    if said == "Yes.":
        answer = robot.hear(said)
    else:
        if said:
            assert robot.hear(said) == "What is this, then?"
            assert len(robot.state.private.lessons) == lessons
        answer = robot.hear("This is a cup.")
    assert answer == LEARNS[count]
    assert len(robot.state.private.lessons) == lessons + 1


def test_four_bands_name_no_rival(scene: Make) -> None:
    known = {("cup", "o1"): 0.55, ("mug", "o1"): 0.54}
    robot = scene(nouns=("cup", "mug"), known=known, wording="four")
    assert robot.hear("What is this?") == "I think this is a cup. Am I right?"


def test_what_a_wording_set_does_not_have_is_as_ever() -> None:
    paper, four = lexicon(), lexicon(wording="four")
    assert four.says["greet_back"] == paper.says["greet_back"]
    assert four.says["assert_name"] != paper.says["assert_name"]


# --- of its own accord ----------------------------------------------------------------

TWO = {("book", "o1"): 0.9, ("box", "o2"): 0.9}
KNOWING: dict[str, Any] = {"things": 2, "nouns": ("book", "box")}


def test_who_is_driven_does_nothing_of_its_own_accord(scene: Make) -> None:
    robot = scene(**KNOWING, known=TWO, mode="driven")
    assert [robot.look() for _ in range(4)] == [[]] * 4
    assert robot.acts("This is a cup.") == ["learned"]


def test_it_asks_for_what_it_needs_most_and_for_nothing_twice(scene: Make) -> None:
    robot = scene(things=3, nouns=("book", "box"), known=TWO)
    assert robot.look() == ["ask_relation"]
    assert robot.look() == ["ask_thing"]
    assert robot.state.view.focus == ("o3",)
    assert robot.look() == []


def test_what_comes_into_view_is_the_tutors_to_name(scene: Make) -> None:
    robot = scene(things=1)
    assert robot.look(kept=[]) == []
    assert robot.look() == ["ask_thing"]
    assert robot.hear("A cup.") == "OK, I learned a cup."


def test_of_two_things_that_are_shown_to_it_it_asks_how_they_stand(scene: Make) -> None:
    """Also as they come into view: neither has to be named."""
    robot = scene(**KNOWING, known=TWO)
    assert robot.look(kept=[]) == ["ask_relation"]
    assert robot.look(kept=["o1"]) == []


def test_who_is_not_answered_asks_about_nothing_else(scene: Make) -> None:
    robot = scene(things=2)
    assert robot.look() == ["ask_thing"]
    assert robot.state.shared.latest.points == ("o1",)
    assert robot.look() == []
    robot.hear("It is a cup.")
    assert robot.look() == ["ask_thing"]
    assert robot.state.shared.latest.points == ("o2",)


def test_it_asks_for_examples_of_what_it_failed_at(scene: Make) -> None:
    known = {("cup", "o1"): 0.9, ("mug", "o1"): 0.1}
    robot = scene(nouns=("cup", "mug"), known=known)
    robot.hear("What is this?")
    robot.hear("No, this is a mug.")
    assert robot.state.private.failed[0].form == "cup"
    assert robot.look() == ["ask_example"]
    assert robot.look() == []


def test_of_equals_it_asks_for_the_first(scene: Make) -> None:
    robot = scene(nouns=("cup", "mug"), known={("cup", "o1"): 0.4, ("mug", "o1"): 0.3})
    robot.hear("What is this?")
    robot.hear("No.")
    assert [it.form for it in robot.state.private.failed] == ["cup", "mug"]
    for word in ("cup", "mug"):
        assert robot.look() == ["ask_example"]
        assert [it.form for it in robot.state.shared.latest.signs] == [word]


@pytest.mark.parametrize("answer", ["No, the cup is behind the book.", "No."])
def test_who_fails_at_a_place_has_not_failed_at_the_things(
    scene: Make, answer: str
) -> None:
    known = {("cup", "o1"): 0.9, ("book", "o2"): 0.9, ("near", "o1", "o2"): 0.9}
    robot = scene(2, nouns=["cup", "book"], relations=["near"], known=known)
    assert robot.hear("Where is the cup?") == "The cup is near the book."
    robot.hear(answer)
    assert robot.state.private.cost.corrections == 1
    assert robot.state.private.failed == ()


def test_a_no_to_a_question_of_its_own_is_no_correction(scene: Make) -> None:
    robot = scene(nouns=["cup"], known={("cup", "o1"): 0.9})
    assert robot.hear("This is a cupp.") == "Do you mean a cup?"
    robot.hear("No.")
    assert robot.state.private.cost.corrections == 0


def test_who_is_autonomous_learns_what_it_is_sure_of_once(scene: Make) -> None:
    robot = scene(nouns=("cup",), known={("cup", "o1"): 0.95}, mode="autonomous")
    assert robot.look() == ["learned_alone"]
    assert len(robot.state.private.lessons) == 1
    assert robot.look() == []


@with_scenes
@given(best_=st.floats(0, 1), second=st.floats(0, 1))
def test_nobody_learns_by_itself_what_it_is_not_sure_of(
    scene: Make, best_: float, second: float
) -> None:
    second, best_ = sorted((best_, second))
    known = {("cup", "o1"): best_, ("mug", "o1"): second}
    for mode in MODES:
        robot = scene(nouns=("cup", "mug"), known=known, mode=mode)
        robot.look()
        lessons = robot.state.private.lessons
        assert not lessons or (mode == "autonomous" and best_ - second >= 0.9 - 1e-9)


def test_what_it_costs_is_counted(scene: Make) -> None:
    robot = scene(nouns=("cup",), known={("cup", "o1"): 0.9})
    robot.hear("What is this?")
    robot.hear("No, this is a mug.")
    robot.look()
    cost = robot.state.private.cost
    assert (cost.turns, cost.words, cost.corrections, cost.questions) == (2, 8, 1, 1)


def test_examples_of_earlier_dialogues_count(scene: Callable[..., Any]) -> None:
    before = [record(sign=noun("cup"), lessons=4.0)]
    one = scene(nouns=["cup"], taught=before, wording="four")
    assert one.hear("This is a cup.") == "I am learning cup."
    assert one.hear("This is a cup.") == "I am updating my systems on cup."


def test_who_plans_no_answer_counts_no_examples(scene: Callable[..., Any]) -> None:
    rules = first(seq(LISTENING, maybe(EXEMPLIFYING)), GLANCED)
    robot = scene(1, wording="four", rules=rules)
    assert robot.acts("This is a cup.") == []


def test_what_never_or_always_is_worth_more_has_no_threshold_between() -> None:
    low, high = Stake(0.0, 0.0), Stake(1.0, 1.0)
    assert threshold(low, high) > 1.0
    assert threshold(high, low) == threshold(low, low) == 0.0


def test_who_names_two_is_not_taken_at_its_word_by_a_yes(scene: Make) -> None:
    """It asks which, even where a yes to what it is sure of teaches it nothing."""
    known = {("cup", "o1"): 0.55, ("mug", "o1"): 0.5}
    robot = scene(nouns=("cup", "mug"), known=known)
    eager = replace(robot.state, {"private.strategy.yes_below": 0.5})
    robot.now = robot.now._replace(state=eager)
    assert robot.acts("What is this?") == ["hedge_name"]
    assert robot.acts("Yes.") == ["ask_which"]


def test_what_a_no_to_two_teaches_goes_by_the_likelier_one(scene: Make) -> None:
    known = {("cup", "o1"): 0.55, ("mug", "o1"): 0.4}
    for below, lessons in ((0.5, 0), (0.6, 2)):
        robot = scene(nouns=("cup", "mug"), known=known)
        wary = replace(robot.state, {"private.strategy.no_below": below})
        robot.now = robot.now._replace(state=wary)
        assert robot.acts("What is this?") == ["hedge_name"]
        assert robot.acts("No.") == ["ask_again"]
        assert len(robot.state.private.lessons) == lessons


# --- in varied words -----------------------------------------------------------------


def slots_in(wording: str) -> set[str]:
    return {slot for _, slot, _, _ in Formatter().parse(wording) if slot}


@pytest.mark.parametrize("language", LANGUAGES)
def test_varied_words_say_as_much_as_the_others(language: str) -> None:
    known = lexicon(language, "varied")
    assert not lexicon(language).varied
    assert len(known.varied) >= 10
    for act, others in known.varied.items():
        ways = [slots_in(it) for it in known.says[act]]
        assert all(slots_in(it) in ways for it in others), act


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_of_the_varied_words_is_used_and_always_for_the_same_move(
    language: str,
) -> None:
    known, cup = lexicon(language, "varied"), noun("cup")
    moves = [
        record(e=f"s{n}", content=meaning_in("cup", "Naming"), signs=[cup])
        for n in range(200)
    ]
    said = [say(known, "assert_name", it) for it in moves]
    assert said == [say(known, "assert_name", it) for it in moves]
    assert len({*said}) == 1 + len(known.varied["assert_name"])
    plain = lexicon(language)
    assert len({say(plain, "assert_name", it) for it in moves}) == 1


@pytest.mark.parametrize("language", LANGUAGES)
def test_varied_words_are_understood_as_what_they_say(language: str) -> None:
    known, cup = lexicon(language, "varied"), noun("cup")
    for n in range(20):
        move = record(e=f"s{n}", content=meaning_in("cup", "Naming"), signs=[cup])
        for act in ("learned", "assert_name", "guess_name"):
            text = say(known, act, move)
            heard = overhear(text, language)
            acts = {predicate_at(it.type, "e").name for it in heard}
            assert act in acts, text


def test_the_commands_know_every_wording_and_mode(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with suppress(SystemExit):
        main(["talk", "--help"])
    told = capsys.readouterr().out
    assert f"{{{','.join(WORDINGS)}}}" in told
    assert f"{{{','.join(MODES)}}}" in told
    assert _CHOICES["wording"] == WORDINGS
    assert _CHOICES["mode"] == MODES
