"""A state says what is worth trying in it."""

import pytest

from kille.dialogue.language import LANGUAGES, understand
from kille.lab.tutors.leading_topics import leading_topics, situation
from kille.lab.worlds.games import simulated_game, world_of
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.robot_profiles import ROBOTS
from kille.lab.worlds.schooling import game_after_school
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.worlds import draw_world

GAME = game_after_school(simulated_game(draw_world(1)))


def acts(state, language="en"):
    now = situation(vocabulary(language), state)
    return {one.act for talk in leading_topics(now) for one in talk}


def after(*given):
    now = GAME.begin()
    for one in given:
        heard = GAME.hear(one) if isinstance(one, str) else one
        now = GAME.take(now, heard).run
    return now.state


@pytest.mark.parametrize("robot", ROBOTS, ids=[robot.name for robot in ROBOTS])
def test_all_that_leads_on_can_be_said_and_is_understood(robot):
    now = situation(vocabulary(robot.language), robot.game(1).start)
    for talk in leading_topics(now):
        for one in talk[::5]:
            assert understand(one.text, robot.language)[0].readings, one.text


def test_perspectives_are_taken_up_when_a_thing_faces_some_way():
    blank = simulated_game(draw_world(1)).start
    assert "orient" in acts(blank)
    assert "take_frame" not in acts(blank)
    assert "take_frame" in acts(GAME.start)


def test_who_learns_nothing_yet_is_asked_what_it_knows():
    assert "ask_knowledge" in acts(simulated_game(draw_world(1), colours=()).start)
    assert "ask_knowledge" not in acts(GAME.start)


def test_in_front_of_nothing_one_asks_what_there_is():
    world = world_of(GAME.start)
    assert "ask_view" in acts(after(glance_event(world.clear(), world)))


def test_places_are_talked_of_where_they_are_not_seen():
    world = world_of(GAME.start)
    flat = after(glance_event(world.flip_depth(), world))
    assert {"relate", "correct", "reject"} <= acts(flat)


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_language_has_a_robot(language):
    assert any(robot.language == language for robot in ROBOTS)


def test_the_shares_of_all_robots_are_one():
    assert sum(robot.share for robot in ROBOTS) == pytest.approx(1.0)
