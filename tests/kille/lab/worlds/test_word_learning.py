"""Words that learn: by their own lessons only, and exactly as if others never were."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.meanings import adjective, noun, relation
from kille.lab.worlds.word_learning import LearnedWord
from kille.lab.worlds.worlds import Thing, World, draw_world

WORLD = draw_world(4, 6, 6)
THINGS = [f"o{number}" for number in WORLD.in_view]
SIGNS = [noun("cup"), adjective("big"), adjective("red"), relation("behind")]

lessons = st.lists(
    st.tuples(st.permutations(THINGS).map(lambda it: it[:2]), st.booleans()), max_size=6
)


def args(sign, pair):
    if sign.kind == "relation":
        return (*pair, WORLD.name, "away")
    return pair[0], WORLD.name


def taught(word, some):
    for pair, holds in some:
        word = word.after_lesson(*args(word.sign, pair), holds=holds)
    return word


def red_things(*places):
    things = zip(("cup", "car"), places, strict=True)
    return World(tuple(Thing(kind, "red", place=place) for kind, place in things))


def degrees(word):
    return [word(*args(word.sign, (x, y))) for x in THINGS for y in THINGS if x != y]


@given(st.sampled_from(SIGNS), lessons, lessons)
def test_what_is_unlearned_was_never_learned(sign, some, more):
    word = taught(LearnedWord.without_lessons(sign), some)
    after = taught(word, more)
    for lesson in reversed(after.lessons[len(word.lessons) :]):
        after = after.without_lesson(lesson.key)
    assert degrees(after) == degrees(word)
    assert after.lessons == word.lessons


@given(st.sampled_from(SIGNS), lessons)
def test_degrees_are_degrees_and_keys_are_never_used_twice(sign, some):
    word = taught(LearnedWord.without_lessons(sign), some)
    for p in degrees(word):
        lo, hi = p if isinstance(p, tuple) else (p, p)
        assert 0.0 <= lo <= hi <= 1.0
    left = word.without_lesson(word.lessons[0].key) if some else word
    again = taught(left, [(THINGS[:2], True)])
    assert len({it.key for it in again.lessons}) == len(again.lessons)


@given(lessons, st.sampled_from(THINGS))
def test_lessons_speak_for_and_against(some, x):
    cup = taught(LearnedWord(noun("cup")), some)
    said = cup.after_lesson(x, WORLD.name)
    assert said(x, WORLD.name) > cup(x, WORLD.name)
    assert said.after_lesson(x, WORLD.name, holds=False)(x, WORLD.name) < said(
        x, WORLD.name
    )


def test_what_was_taught_of_one_kind_is_true_of_that_kind_only():
    world = World(
        tuple(
            Thing(kind, "red", place=(x, 3))
            for x, kind in enumerate(["cup", "cup", "car", "book"])
        )
    )
    cup = LearnedWord(noun("cup")).after_lesson("o1", world.name)
    same, *others = (cup(x, world.name) for x in ("o2", "o3", "o4"))
    assert same > 0.5 > max(others)


def test_colours_are_known_from_the_start_and_other_adjectives_are_not():
    world = World(
        (Thing("cup", "red", place=(2, 2)), Thing("cup", "blue", place=(4, 2)))
    )
    red = LearnedWord.without_lessons(adjective("red"))
    assert red("o1", world.name) > 0.6 > 0.1 > red("o2", world.name)
    assert LearnedWord.without_lessons(adjective("big"))("o1", world.name) == (0.0, 1.0)
    assert red.is_known
    assert not LearnedWord.without_lessons(adjective("big")).is_known


def test_an_adjective_finds_out_what_it_speaks_of():
    things = [("red", 0.9), ("blue", 0.9), ("red", 0.1), ("green", 0.9), ("green", 0.1)]
    world = World(
        tuple(Thing("cup", hue, size, (x, 3)) for x, (hue, size) in enumerate(things))
    )
    big = LearnedWord(adjective("big"))
    for x, holds in (("o1", True), ("o2", True), ("o3", False)):
        big = big.after_lesson(x, world.name, holds=holds)
    assert big.weights()[1] > 0.8
    assert big("o4", world.name) > 0.5 > big("o5", world.name)


def test_relations_are_learned_turned():
    world = World(
        (Thing("cup", "red", place=(2, 5)), Thing("car", "red", place=(5, 5)))
    )
    behind = LearnedWord(relation("behind")).after_lesson(
        "o1", "o2", world.name, "left"
    )
    assert behind("o1", "o2", world.name, "left") == pytest.approx(0.8)
    assert behind("o1", "o2", world.name, "right") == 0.0
    other = World(
        (Thing("cup", "red", place=(5, 8)), Thing("car", "red", place=(5, 5)))
    )
    assert behind("o1", "o2", other.name, "away") == pytest.approx(0.8)


def test_nothing_is_learned_about_what_is_not_to_be_seen():
    world = World((Thing("cup", "red"),))
    with pytest.raises(ValueError, match="not to be seen"):
        LearnedWord(noun("cup")).after_lesson("o1", world.name)
    assert LearnedWord(noun("cup"))("o1", world.name) == (0.0, 1.0)


# --- places --------------------------------------------------------------------------


def beside(right, away):
    """A book so many steps right and away of a car."""
    place = (5 + right, 5 + away)
    things = Thing("book", "blue", place=place), Thing("car", "red", place=(5, 5))
    return "o1", "o2", World(things).name, "away"


NEAR = [(1, 0), (0, 1.2), (-1, 0), (0, -1.1), (0.8, 0.8), (-0.9, 0.7)]
LEFT = [(-1, 0), (-3, 0.5), (-2, -0.4), (-4, 0), (-1.5, 0.3), (-2.5, -0.5)]


def of_places(form, places):
    word = LearnedWord(relation(form))
    for place in places:
        word = word.after_lesson(*beside(*place))
    return word


def test_a_relation_is_one_of_direction_until_it_is_learned_to_be_of_distance():
    direction, distance = of_places("near", NEAR[:1]).weights()
    assert (direction, distance) == (1.0, 0.0)
    direction, distance = of_places("near", NEAR).weights()
    assert distance > direction
    direction, distance = of_places("left of", LEFT).weights()
    assert direction > 0.9


def test_near_is_near_in_any_direction():
    near = of_places("near", NEAR)
    close, far = near(*beside(0.7, -0.9)), near(*beside(4, 0))
    assert close > 0.7
    assert far < close


def test_left_is_left_at_any_distance():
    left = of_places("left of", LEFT)
    assert left(*beside(-4.4, 0)) > 0.8
    assert left(*beside(1, 0)) < 0.2
