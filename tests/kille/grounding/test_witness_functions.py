"""Learners as witness functions: degrees of words for things in remembered looks."""

from __future__ import annotations

import time
from dataclasses import replace
from functools import partial

import pytest

from kille.agent.attention import AttentiveSensor
from kille.dialogue.meanings import noun, relation, theory
from kille.dialogue.state import blank_model
from kille.grounding.witness_functions import UNKNOWN, WitnessFunctions, thing_name
from kille.perception.attributes import AttributeMemory
from kille.perception.look import Scans
from kille.perception.objects import ObjectMemory
from kille.perception.relations import RelationMemory
from kille.scene import Configuration, Look, Percept
from ttr import Model, Theory, record


@pytest.fixture(scope="module")
def seen() -> Look:
    """A book and a car, nearest first."""
    gaze = AttentiveSensor("synthetic:empty?seed=5", scans=2)
    gaze.change("show car")
    gaze.change("place book at -0.28 0.1")
    return gaze.look().look


@pytest.fixture
def objects(seen: Look) -> ObjectMemory:
    memory = ObjectMemory()
    for number, word in ((1, "car"), (2, "book")):
        memory.learn_one(seen.percepts[number - 1], word, key=number)
    return memory


@pytest.fixture
def witnesses(seen: Look, objects: ObjectMemory) -> WitnessFunctions:
    relations = RelationMemory()
    relations.learn_one(Configuration((-0.2, 0.1, 0.0)), "to_the_left_of", key=1)
    relations.learn_one(Configuration((0.2, 0.1, 0.0)), "to_the_right_of", key=2)
    made = WitnessFunctions(objects, relations)
    made.remember("look1", seen)
    return made


def test_a_degree_is_what_the_learner_says(
    witnesses: WitnessFunctions, objects: ObjectMemory, seen: Look
) -> None:
    for number, percept in enumerate(seen.percepts, start=1):
        for word, p in objects.predict_proba_one(percept).items():
            assert witnesses.noun(word, thing_name(number), "look1") == pytest.approx(p)
    assert witnesses.noun("unicorn", "o1", "look1") == 0.0


def test_who_asks_about_a_second_thing_has_the_scans_of_the_third_begun(
    objects: ObjectMemory, monkeypatch: pytest.MonkeyPatch
) -> None:
    gaze = AttentiveSensor("synthetic:empty?seed=5", scans=2)
    for act in ("show car", "place book at -0.28 0.1", "place banana at 0.28 0.1"):
        gaze.change(act)
    look = gaze.look().look
    begun: list[Scans] = []
    begin = Scans.begin

    def begin_scans(scans: Scans) -> None:
        begun.append(scans)
        begin(scans)

    monkeypatch.setattr(Scans, "begin", begin_scans)
    made = WitnessFunctions(objects, RelationMemory())
    made.remember("look1", look)
    first, _, third = (percept.scans for percept in look.percepts)
    made.noun("car", "o1", "look1")
    assert set(begun) <= {first}
    made.noun("car", "o2", "look1")
    assert third in begun
    degrees = [objects.predict_proba_one(it)["car"] for it in look.percepts]
    assert [made.noun("car", x, "look1") for x in ("o1", "o2", "o3")] == degrees


@pytest.mark.parametrize(("x", "look"), [("o3", "look1"), ("o1", "look9")])
def test_what_is_not_in_a_remembered_look_is_unknown(
    witnesses: WitnessFunctions, x: str, look: str
) -> None:
    assert witnesses.percept(x, look) is None
    assert witnesses.configuration(x, "o2", look) is None
    assert witnesses.noun("car", x, look) == UNKNOWN
    assert witnesses.relation("to_the_left_of", x, "o2", look) == UNKNOWN


def test_colour_words_are_judged_of_what_is_seen() -> None:
    gaze = AttentiveSensor("synthetic:empty?seed=5", scans=1)
    gaze.change("show banana")
    made = WitnessFunctions(ObjectMemory(), RelationMemory())
    made.remember("look1", gaze.look().look)
    theory = Theory.parse("basic Ind, Look\npred yellow(Ind, Look), blue(Ind, Look)")
    model = Model(theory).given("look1", theory.Look).given("o1", theory.Ind)
    for word in ("yellow", "blue"):
        model = model.witnessed(theory[word], by=partial(made.colour, word))
    yellow = model.perceive(
        record(x="o1", look="look1"),
        theory.parse("[x : Ind, look : Look, c : yellow(x, look)]"),
    )
    assert made.colour("yellow", "o1", "look1") > 0.5
    assert made.colour("blue", "o1", "look1") < 0.1
    assert yellow.p.lo == pytest.approx(made.colour("yellow", "o1", "look1"))
    assert made.colour("yellow", "o1", "look9") == UNKNOWN
    assert made.colour("röd", "o1", "look1") == UNKNOWN


def test_without_depth_a_place_is_unknown_but_a_name_is_not(
    witnesses: WitnessFunctions, seen: Look
) -> None:
    flat = [
        replace(it, region=replace(it.region, place=None), scans=it.scans[:1])
        for it in seen.percepts
    ]
    bare = [
        replace(
            it, scans=[replace(s, points=s.points * float("nan")) for s in it.scans]
        )
        for it in flat
    ]
    witnesses.remember("look2", replace(seen, percepts=tuple(bare)))
    assert witnesses.configuration("o1", "o2", "look2") is None
    assert witnesses.relation("to_the_left_of", "o2", "o1", "look2") == UNKNOWN
    assert isinstance(witnesses.noun("car", "o1", "look2"), float)


def test_configurations_are_right_away_and_up_and_turn_around(
    witnesses: WitnessFunctions,
) -> None:
    there = witnesses.configuration("o2", "o1", "look1")
    back = witnesses.configuration("o1", "o2", "look1")
    assert there is not None
    assert back is not None
    assert there.offset == pytest.approx((-0.28, 0.1, there.offset[2]), abs=0.08)
    assert back.offset == pytest.approx([-it for it in there.offset], abs=1e-6)
    assert there.target_size == back.landmark_size


def test_old_looks_are_let_go_but_for_those_still_needed(
    witnesses: WitnessFunctions, seen: Look
) -> None:
    for number in range(2, 20):
        witnesses.remember(f"look{number}", seen, {"look1"})
    assert witnesses.look("look1") is seen
    assert witnesses.look("look2") is None
    assert witnesses.look("look19") is seen
    witnesses.remember("look20", seen)
    assert witnesses.look("look1") is None


def test_after_a_lesson_it_is_judged_anew(
    witnesses: WitnessFunctions, objects: ObjectMemory, seen: Look
) -> None:
    before = witnesses.noun("car", "o2", "look1")
    objects.learn_one(seen.percepts[1], "car", key=3)
    assert witnesses.noun("car", "o2", "look1") == before
    witnesses.reconsider()
    after = witnesses.noun("car", "o2", "look1")
    assert isinstance(before, float)
    assert isinstance(after, float)
    assert after > before


def test_the_theory_asks_them_when_it_perceives(witnesses: WitnessFunctions) -> None:
    car, left = noun("car"), relation("to the left of")
    model = witnesses.in_model(blank_model(), [car, left])
    model = model.given("look1", theory()["Look"])
    for x in ("o1", "o2"):
        model = model.given(x, theory()["Ind"])
    named_car = model.perceive(record(x="o1", look="look1"), car.meaning)
    degree = witnesses.noun("car", "o1", "look1")
    assert named_car.p.lo == named_car.p.hi == pytest.approx(degree)
    things = {
        "target": record(x="o2", look="look1"),
        "landmark": record(x="o1", look="look1"),
    }
    pair = record(look="look1", frame="away", **things)
    placed = model.perceive(pair, left.meaning)
    degree = witnesses.relation("to_the_left_of", "o2", "o1", "look1")
    assert placed.p.lo == pytest.approx(degree)
    assert placed.p.lo > 0.5


def test_what_cannot_be_seen_is_undecided_in_the_theory(
    witnesses: WitnessFunctions,
) -> None:
    car = noun("car")
    model = witnesses.in_model(blank_model(), [car])
    model = model.given("look9", theory()["Look"]).given("o1", theory()["Ind"])
    judged = model.perceive(record(x="o1", look="look9"), car.meaning)
    assert (judged.p.lo, judged.p.hi) == UNKNOWN


# --- how things are -------------------------------------------------------------------


def test_attributes_are_colours_or_what_was_taught(seen: Look) -> None:
    attributes = AttributeMemory()
    made = WitnessFunctions(ObjectMemory(), RelationMemory(), attributes=attributes)
    made.remember("look1", seen)
    assert made.attribute("is_red", "o1", "look1") == made.colour("red", "o1", "look1")
    light_blue = made.colour("light blue", "o2", "look1")
    assert made.attribute("is_light_blue", "o2", "look1") == light_blue
    assert made.attribute("is_big", "o1", "look1") == UNKNOWN
    assert made.attribute("is_red", "o9", "look1") == UNKNOWN
    attributes.learn_one(seen.percepts[0].traits, "is_big")
    assert made.attribute("is_big", "o1", "look1") == UNKNOWN
    made.reconsider()
    assert made.attribute("is_big", "o1", "look1") > 0.7


def test_a_word_that_was_only_denied_is_open_elsewhere(seen: Look) -> None:
    attributes = AttributeMemory()
    attributes.deny_one(seen.percepts[0].traits, "is_big")
    made = WitnessFunctions(ObjectMemory(), RelationMemory(), attributes=attributes)
    made.remember("look1", seen)
    low, high = made.attribute("is_big", "o1", "look1")
    assert (low, high < 0.05) == (0.0, True)
    low, high = made.attribute("is_big", "o2", "look1")
    assert (low, high > 0.3) == (0.0, True)


# --- perspectives ---------------------------------------------------------------------


def test_relations_are_judged_in_a_perspective(witnesses: WitnessFunctions) -> None:
    left = witnesses.relation("to_the_left_of", "o2", "o1", "look1")
    opposite = witnesses.relation("to_the_left_of", "o2", "o1", "look1", "towards")
    assert left > 0.5 > opposite
    assert witnesses.relation("to_the_right_of", "o2", "o1", "look1", "towards") > 0.5
    assert witnesses.relation("to_the_left_of", "o2", "o1", "look1", "up") == UNKNOWN
    here = witnesses.configuration("o2", "o1", "look1")
    there = witnesses.configuration("o2", "o1", "look1", "towards")
    assert here is not None
    assert there is not None
    assert there.offset[:2] == pytest.approx((-here.offset[0], -here.offset[1]))
    assert witnesses.configuration("o1", "o1", "look1") is None


def test_how_far_to_the_right_a_thing_is_seen(witnesses: WitnessFunctions) -> None:
    car, book = (witnesses.across(x, "look1") for x in ("o1", "o2"))
    assert 0 < book < car < 1
    assert witnesses.across("o3", "look1") == UNKNOWN


# --- how long it takes ----------------------------------------------------------------


def moved(percept: Percept, right: float) -> Percept:
    """The same thing, seen somewhere else."""
    place = percept.region.place
    assert place is not None
    there = place._replace(x=place.x + right)
    return replace(percept, region=replace(percept.region, place=there))


def test_what_was_judged_of_ten_things_is_found_at_once(
    witnesses: WitnessFunctions, seen: Look
) -> None:
    """A noun and an adjective of ten things, a relation of ninety pairs: looked up."""
    ten = [moved(it, 0.1 * step) for step in range(5) for it in seen.percepts]
    witnesses.remember("look2", replace(seen, percepts=tuple(ten)))
    witnesses.prepare("look2")
    things = [thing_name(number) for number in range(1, 11)]
    taken = []
    for _ in range(5):
        start = time.thread_time()
        for x in things:
            witnesses.noun("car", x, "look2")
            witnesses.attribute("is_red", x, "look2")
            for y in things:
                witnesses.relation("to_the_left_of", x, y, "look2")
        taken.append(time.thread_time() - start)
    assert min(taken) < 0.05
    assert witnesses.relation("to_the_left_of", "o1", "o9", "look2") > 0.5
