"""Worlds: their names say all of them, and what is seen follows from the name."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.meanings import record_type
from kille.lab.worlds.games import model_of
from kille.lab.worlds.perception import (
    colour,
    direction,
    distance,
    glance_event,
    look_event,
    traits,
    view,
)
from kille.lab.worlds.worlds import (
    COLOURS,
    FRONTS,
    KINDS,
    SIDE,
    Thing,
    World,
    draw_world,
)

steps = st.integers(0, SIDE - 1) | st.integers(-900, 9900).map(lambda n: n / 1000)
places = st.none() | st.tuples(steps, steps)
things = st.builds(
    Thing,
    st.sampled_from(KINDS),
    st.sampled_from(list(COLOURS)),
    st.sampled_from([0.1, 0.5, 0.9]),
    places,
    st.sampled_from(["", *FRONTS]),
)


@st.composite
def worlds(draw):
    some = tuple(draw(st.lists(things, max_size=6)))
    focus = draw(st.none() | st.integers(1, len(some))) if some else None
    return World(
        some,
        focus,
        draw(st.booleans()),
        draw(st.integers(0, 99)),
        0.1,
        draw(st.integers(0, 99)),
    )


@given(worlds())
def test_a_name_says_all_of_a_world(world):
    assert World.from_name(world.name) == world


@pytest.mark.parametrize("name", ["", "look0", "look1 of 2", "look1 of 0~0.1: x"])
def test_other_texts_name_no_world(name):
    assert World.from_name(name) is None


@given(worlds().filter(lambda it: len(it.in_view) > 1), st.sampled_from(FRONTS))
def test_places_have_a_direction_unless_they_are_the_same(world, front):
    x, y, *_ = world.in_view
    way = direction(world, x, y, front)
    assert (way is None) is (not world.deep or distance(world, x, y) == 0)
    if way is not None:
        assert math.hypot(*way) == pytest.approx(1)


@given(worlds())
def test_what_is_seen_is_of_its_type(world):
    model = model_of(world)
    assert model.judge(view(world), record_type("View")).holds
    assert model.judge(look_event(world, world), record_type("Seen")).holds
    assert model.judge(glance_event(world, world), record_type("Glance")).holds


@given(worlds())
def test_the_same_look_shows_the_same(world):
    again = World.from_name(world.name)
    for number in world.in_view:
        assert traits(again, number) == traits(world, number)
        assert colour(again, number) == colour(world, number)


def test_the_nearest_is_attended_to_unless_another_is_pointed_at():
    world = World(
        (Thing("cup", "red", place=(5, 4)), Thing("box", "red", place=(5, 1)))
    )
    assert world.attended_thing == 2
    assert world.point_at(1).attended_thing == 1
    assert world.point_at(1).move(1, None).attended_thing == 2
    assert World().attended_thing is None


def test_nothing_that_happens_changes_the_world_it_happens_in():
    world = draw_world(3)
    name = world.name
    world.move(1, None), world.turn(1, "left"), world.point_at(2), world.clear()
    assert world.name == name


def test_things_keep_their_names():
    before = draw_world(3)
    after = before.move(2, None)
    assert look_event(after, before).view.things == ("o1", "o3", "o4")
    assert look_event(after, before).kept == ("o1", "o3", "o4")
    assert look_event(before, after).kept == ("o1", "o3", "o4")


def test_fronts_turn_what_is_left_of_what():
    world = World(
        (Thing("cup", "red", place=(2, 5)), Thing("car", "red", place=(5, 5)))
    )
    assert direction(world, 1, 2, "away") == (-1.0, 0.0)
    assert direction(world, 1, 2, "towards") == (1.0, 0.0)
    assert direction(world, 1, 2, "left") == (0.0, 1.0)
    assert direction(world, 1, 2, "right") == (0.0, -1.0)
    # The cup is at the car's own front, which is where a viewer would say "in front".
    assert direction(world, 1, 2, "faces_left") == (0.0, -1.0)
    assert direction(world, 1, 2, "nowhere") is None
    assert direction(world.flip_depth(), 1, 2, "away") is None


def test_the_same_seed_draws_the_same_world():
    assert draw_world(5) == draw_world(5)
    assert draw_world(5) != draw_world(6)
    assert len(draw_world(5, 7, 3).in_view) == 3
