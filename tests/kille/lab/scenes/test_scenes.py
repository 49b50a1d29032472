"""Scenes: what there is to talk of, the same for every theory and every tutor."""

import math
from itertools import pairwise
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.lab import scenes
from kille.lab.scenes.labelled import open_scenes
from kille.lab.scenes.scene import ORDERS, Occasion, order_occasions
from kille.lab.settings import Problem
from kille.lab.study import Named, Phase, Run, Study
from kille.lab.worlds.worlds import STEP


def opened(kind, seed=1, tutor="Ann", **set_):
    study = Study("t", {}, {}, {"s": Named("s", kind, set_)}, (), (seed,))
    return scenes.open_scene(study, Run("robot", tutor, "s", seed))


@given(st.integers(1, 50), st.sampled_from(["noun", "adjective", "relation"]))
def test_a_scene_is_that_of_its_seed(seed, kind):
    one, other = opened("drawn", seed=seed), opened("drawn", seed=seed, tutor="Bo")
    assert one == other
    assert one.round(kind, False, Random(1)) == other.round(kind, False, Random(1))


def test_seeds_draw_other_things():
    assert opened("drawn", seed=1) != opened("drawn", seed=2)


@given(st.integers(1, 50), st.booleans())
def test_things_that_are_kept_for_later_are_others(seed, new):
    scene = opened("drawn", seed=seed, each=2, new=3, kinds=["cup", "mug"])
    of = [{it.x for it in scene.round("noun", new, Random(1))} for new in (False, True)]
    assert len(of[0]) == 4
    assert len(of[1]) == 6
    assert not of[0] & of[1]


@given(st.integers(1, 30), st.integers(1, 5))
def test_so_many_things_are_in_view(seed, count):
    scene = opened("drawn", seed=seed, in_view=count)
    for it in scene.round("noun", False, Random(seed)):
        assert len(it.world.in_view) == count
        assert it.world.attended_thing == it.x


@given(st.integers(1, 50))
def test_each_side_of_a_landmark_is_shown(seed):
    scene = opened("drawn", seed=seed, in_view=2)
    round_ = scene.round("relation", False, Random(seed))
    assert sorted(it.group for it in round_) == ["behind", "in front", "left", "right"]
    assert all(it.thing.kind != it.landmark.kind for it in round_)


@given(st.integers(1, 50))
def test_of_one_colour_are_things_of_other_kinds_beside_each_other(seed):
    """Else there is nothing to say of where they are."""
    scene = opened("drawn", seed=seed, kinds=["cup", "mug"], each=3, hues=["red"])
    round_ = scene.round("relation", False, Random(seed))
    assert all(it.thing.kind != it.landmark.kind for it in round_)


# --- round a landmark ----------------------------------------------------------------


def test_the_target_is_put_on_rings():
    scene = opened("around", rings=[0.2], points=8, spread=0.0)
    for it in scene.round("relation", False, Random(1)):
        assert math.isclose(_far(it.world), 0.2, abs_tol=1e-3)
        assert it.seen is None


def _far(world):
    return STEP * math.dist(world.place(1), world.place(2))


@given(st.integers(1, 20))
def test_places_are_seen_off_and_talked_of_as_they_are(seed):
    clean, noisy = opened("around", seed=seed), opened("around", seed=seed, off=0.05)
    pairs = zip(
        clean.round("relation", False, Random(3)),
        noisy.round("relation", False, Random(3)),
        strict=True,
    )
    first, other = next(pairs)
    assert first.world.place(1) == other.world.place(1)
    assert other.world_seen.place(1) != other.world.place(1)
    assert other.world_seen.place(2) == other.world.place(2)


def test_as_many_places_are_astray_as_is_said():
    scene = opened("around", astray=0.25, points=100)
    round_ = scene.round("relation", False, Random(1))
    off = [
        it
        for it in round_
        if math.dist(it.world.place(1), it.world_seen.place(1)) > 0.1
    ]
    assert 0.15 < len(off) / len(round_) < 0.35


def test_a_landmark_has_moved_when_it_is_asked_about():
    scene = opened("around", shift=0.25)
    taught = scene.round("relation", False, Random(1))
    asked = scene.round("relation", True, Random(1))
    assert all(it.seen is None for it in taught)
    for it in asked:
        moved = STEP * math.dist(it.world.place(1), it.world_seen.place(1))
        assert math.isclose(moved, 0.25, abs_tol=1e-3)


def test_a_landmark_may_face_any_way():
    turning = opened("around", front="any").round("relation", False, Random(1))
    assert len({it.landmark.front for it in turning}) == 4
    still = opened("around", front="left").round("relation", False, Random(1))
    assert {it.landmark.front for it in still} == {"left"}


# --- orders --------------------------------------------------------------------------

rounds = st.lists(
    st.lists(
        st.tuples(st.sampled_from("abc"), st.floats(0, 1)), min_size=1, max_size=6
    ),
    min_size=1,
    max_size=3,
)


@given(rounds, st.sampled_from(ORDERS), st.integers(0, 9))
def test_an_order_leaves_nothing_out(rounds, order, seed):
    world = opened("drawn").start
    given_ = [
        [Occasion("noun", world, 1, group=word, hard=hard) for word, hard in one]
        for one in rounds
    ]
    found = order_occasions(given_, order, Random(seed))
    every = [it for one in given_ for it in one]
    assert sorted(map(id, found)) == sorted(map(id, every))
    match order:
        case "given":
            assert found == every
        case "easy first":
            assert [it.hard for it in found] == sorted(it.hard for it in every)
        case "hard first":
            assert [it.hard for it in found] == sorted(
                (it.hard for it in every), reverse=True
            )
        case "blocked":
            groups = [it.group for it in found]
            changes = sum(a != b for a, b in pairwise(groups))
            assert changes == len(set(groups)) - 1


# --- people's words, and captures ----------------------------------------------------


def test_what_people_stated_is_said(data):
    set_ = {"folder": str(data / "spatial_rooms"), "each": 3, "new": 2}
    scene = opened("statements", words=["to the left of", "near"], **set_)
    taught = scene.round("relation", False, Random(1))
    assert sorted(it.said for it in taught) == ["near"] * 3 + ["to the left of"] * 3
    assert len(scene.round("relation", True, Random(1))) == 4
    every = opened("statements", words=["to the left of"], **(set_ | {"each": 99}))
    left = [
        it.world.place(1)[0] < it.world.place(2)[0]
        for it in every.round("relation", False, Random(1))
    ]
    assert sum(left) > 0.9 * len(left)


def test_no_statement_is_both_taught_and_kept(data):
    """Though people have said some of them twice of the same place."""
    set_ = {"folder": str(data / "spatial_rooms"), "each": 30, "new": 30}
    for seed in (1, 2, 3):
        scene = opened("statements", seed=seed, words=["to the right of"], **set_)
        assert not {*scene.taught} & {*scene.kept}


def test_pictures_are_drawn_by_the_seed(data):
    set_ = {"folder": str(data / "sota_kinect"), "each": 2, "new": 1}
    one, other = opened("pictures", **set_), opened("pictures", seed=2, **set_)
    taught = one.round("noun", False, Random(1))
    kept = one.round("noun", True, Random(1))
    assert len(taught) == 24
    assert len(kept) == 12
    assert not {it.view for it in taught} & {it.view for it in kept}
    assert {it.view for it in taught} != {
        it.view for it in other.round("noun", False, Random(1))
    }


def test_a_folder_that_is_not_there_is_told(tmp_path):
    named = Named("s", "pictures", {"folder": "none"})
    study = Study("t", {}, {}, {"s": named}, (), (1,), folder=tmp_path)
    assert list(scenes.faults(named, study)) == [
        Problem(("folder",), f"there is no folder {tmp_path / 'none'}")
    ]
    (tmp_path / "nine").mkdir()
    (tmp_path / "none").write_text("")
    ((_, told, _),) = scenes.faults(named, study)
    assert told == f"{tmp_path / 'none'} is a file, not a folder"
    (tmp_path / "none").unlink()
    ((_, told, _),) = scenes.faults(named, study)
    assert told.endswith("none: did you mean nine?")


def faulty(kind, *phases, at=None, **set_):
    """What is wrong with a scene in a study of these phases, without its place."""
    named = Named("s", kind, set_)
    made = tuple(Phase(do, do, its) for do, its in phases)
    settings = {} if at is None else {"folder": at}
    study = Study("t", {}, {}, {"s": named}, made, (1,), **settings)
    return [it.what for it in scenes.faults(named, study)]


NEW = ("ask", {"of": "new"})


@pytest.mark.parametrize(
    ("kind", "set_"), [("drawn", {"new": 0}), ("rendered", {"new": 0})]
)
def test_what_was_taught_is_never_taken_for_what_was_kept(kind, set_):
    """A test of what was not taught would be one of what was."""
    assert not opened(kind, **set_).round("noun", True, Random(1))
    assert faulty(kind, NEW, **set_) == [
        "nothing is kept in s for the phase ask, which is of what is new: write new = 1"
    ]
    assert not faulty(kind, ("ask", {}), **set_)


def test_of_pictures_that_are_all_taught_none_is_kept(data):
    set_ = {"folder": str(data / "sota_kinect"), "kinds": ["cup"]}
    assert not opened("pictures", **set_, each=1000).round("noun", True, Random(1))
    (told,) = faulty("pictures", NEW, **set_, each=1000)
    assert told.startswith("nothing is kept in s for the phase ask")
    assert told.endswith("of what is new: write a smaller each")
    assert not faulty("pictures", NEW, **set_)


def test_no_capture_is_both_taught_and_kept(data):
    folder = str(data / "ycbv_scenes")
    set_ = {"folder": folder, "teach": ["0001"], "new": ["0001"]}
    assert faulty("captures", NEW, **set_) == [
        "0001 is taught, so it is none that is kept for later"
    ]


def test_where_no_captures_are_labelled_nothing_is_kept_for_later(tmp_path):
    (told,) = faulty("captures", at=tmp_path, folder=".")
    assert told == f"{tmp_path} has no folders of labelled captures, one for each scene"


def test_of_captures_that_are_all_taught_none_is_kept(data):
    folder = data / "ycbv_scenes"
    every = [*open_scenes(folder, "s").shots]
    (told,) = faulty("captures", NEW, folder=str(folder), teach=every)
    assert told.endswith("of what is new: name the scenes that are, new = […]")


def test_of_one_scene_of_captures_all_may_be_taught(data, tmp_path):
    one = next(it for it in sorted((data / "ycbv_scenes").iterdir()) if it.is_dir())
    (tmp_path / one.name).symlink_to(one)
    (told,) = faulty("captures", at=tmp_path, folder=".")
    assert told.endswith("are kept for later: name some that are taught, teach = […]")
    set_ = {"folder": ".", "teach": [one.name]}
    assert not faulty("captures", ("teach", {}), at=tmp_path, **set_)
    (told,) = faulty("captures", NEW, at=tmp_path, **set_)
    assert told.startswith("nothing is kept in s for the phase ask")


def test_a_thing_by_itself_stands_beside_nothing():
    set_ = {"kinds": ["cup"], "each": 2, "new": 1}
    asked = ("ask", {"what": "relations", "of": "new"})
    (told,) = faulty("drawn", asked, **set_)
    assert told == (
        "nothing is kept in s for the phase ask, which is of what is new: write new = 2"
    )
    assert not faulty("drawn", asked, **set_ | {"new": 2})


@pytest.mark.parametrize(
    ("kind", "key"), [("drawn", "kinds"), ("drawn", "hues"), ("around", "rings")]
)
def test_a_list_of_nothing_is_told(kind, key):
    assert faulty(kind, **{key: []}) == [
        f"{key} of s is empty: name some, or leave it out"
    ]


def test_no_more_things_are_in_view_than_there_is_room_for():
    scene = opened("drawn", each=20, in_view=100)
    (first, *_) = scene.round("noun", False, Random(1))
    assert len(first.world.in_view) == 100
    assert scenes.SETTINGS["drawn"]["in_view"].problem_with(101)


def test_a_thing_stands_beside_another():
    named = Named("s", "around", {"target": "car"})
    study = Study("t", {}, {}, {"s": named}, (), (1,))
    assert list(scenes.faults(named, study)) == [
        Problem(("target",), "both target and landmark are the car: name two kinds")
    ]


def test_a_fault_of_the_camera_that_there_is_not_is_told():
    """It would be known only to whoever opens the camera, dialogue by dialogue."""
    (told,) = faulty("rendered", faults="nois")
    assert told.startswith("there is no fault 'nois' (did you mean noise?)")
    (told,) = faulty("rendered", faults="none&seed=3")
    assert told.startswith("there is no fault 'none&seed=3'")
    assert not faulty("rendered", faults="noise,steps")


@pytest.mark.parametrize("key", ["off", "spread", "shift"])
def test_who_means_centimetres_is_told(key):
    told = scenes.SETTINGS["around"][key].problem_with(5)
    assert told == "expected a number of metres from 0 to 1, found 5"


@pytest.mark.parametrize(
    ("kind", "key"), [("drawn", "noise"), ("drawn", "each"), ("around", "points")]
)
def test_a_slip_of_the_keyboard_is_no_setting(kind, key):
    """A noise that no name of a world can say, or more things than anybody draws."""
    assert scenes.SETTINGS[kind][key].problem_with(10**6)


@pytest.mark.parametrize("kind", sorted(scenes.SETTINGS))
def test_every_kind_says_what_may_be_set(kind):
    for name, setting in scenes.SETTINGS[kind].items():
        assert setting.needed or not setting.problem_with(setting.default), name
