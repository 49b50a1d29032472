"""Names that the lab had until the last release: they work, and warn."""

from importlib import import_module
from operator import attrgetter

import pytest

from kille.lab.log import Log
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import Thing, World

WORLD = World((Thing("cup", "red", place=(2, 3)),))


@pytest.mark.parametrize(
    ("module", "former", "now"),
    [
        ("log", "broken", "broken_runs"),
        ("log", "named", "find_outcome"),
        ("log", "over", "count_outcomes"),
        ("scenes", "opened", "open_scene"),
        ("study_files", "checked", "read_and_check"),
        ("study_files", "parsed", "parse"),
        ("theories", "described", "describe"),
        ("tutors.exploring", "tutoring", "exploring_tutor"),
        ("worlds.games", "known", "with_known_words"),
        ("worlds.games", "simulated", "simulated_game"),
        ("worlds.perception", "glanced", "glance_event"),
        ("worlds.perception", "seen", "look_event"),
        ("worlds.schooling", "rested", "game_next_day"),
        ("worlds.schooling", "resumed", "continue_game"),
        ("worlds.schooling", "schooled", "game_after_school"),
        ("worlds.worlds", "drawn", "draw_world"),
    ],
)
def test_former_names_of_functions_work_and_warn(module, former, now):
    found = import_module(f"kille.lab.{module}")
    with pytest.warns(DeprecationWarning, match=rf"{former} is now .*{now}"):
        assert getattr(found, former) is getattr(found, now)


@pytest.mark.parametrize(
    ("value", "former", "now"),
    [
        (WORLD, "attended", "attended_thing"),
        (WORLD, "pointed", "point_at"),
        (World, "named", "from_name"),
        (Words("en"), "called", "word_for"),
        (Log, "opened", "open"),
    ],
)
def test_former_names_of_methods_work_and_warn(value, former, now):
    with pytest.warns(DeprecationWarning, match=f"{former} is now .*{now}"):
        assert attrgetter(former)(value) == getattr(value, now)
