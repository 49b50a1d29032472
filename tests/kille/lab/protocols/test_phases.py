"""Protocols: the tasks of phases, and what is wrong with them."""

import pytest

from kille.lab import scenes
from kille.lab.protocols import phases
from kille.lab.protocols.phases import tasks
from kille.lab.settings import Problem
from kille.lab.study import Named, Phase, Run, Study, Theory


def made(*phases, tutors=("Ann", "Bo"), scene=None, seed=1):
    scene = scene or Named("s", "drawn", {"kinds": ["cup", "mug", "book"]})
    return Study(
        "t",
        {"robot": Theory("robot")},
        {name: Named(name, "simulated") for name in tutors},
        {"s": scene},
        tuple(Phase(f"{n}", do, set_) for n, (do, set_) in enumerate(phases)),
        (seed,),
    )


def done(*phases, tutor="Ann", theory="robot", **settings):
    study = made(*phases, **settings)
    run = Run(theory, tutor, "s", 1)
    return [task for _, task in tasks(study, run, scenes.open_scene(study, run))]


def test_a_round_has_a_task_for_each_thing():
    found = done(("teach", {"rounds": 2}), ("rest", {}), ("ask", {}))
    assert [task.do for task in found] == ["teach"] * 6 + ["rest"] + ["ask"] * 3
    assert [task.number for task in found] == list(range(1, 11))


@pytest.mark.parametrize("turns", [1, 4, 7])
def test_so_many_things_are_shown(turns):
    assert len(done(("talk", {"turns": turns}))) == turns


def test_no_two_tasks_have_a_look_in_common():
    found = done(("teach", {"rounds": 3}), ("ask", {}))
    looks = [task.occasion.world.name for task in found]
    later = [task.occasion.look_again().world.name for task in found]
    assert len({*looks, *later}) == 2 * len(found)


def test_every_word_is_forgotten_by_itself():
    found = done(("forget", {"words": ["cup", "mug"]}))
    assert [task.settings["word"] for task in found] == ["cup", "mug"]


def test_the_chance_of_a_task_is_its_own():
    one, other, *_ = done(("teach", {}))
    assert one.chance("error").random() == one.chance("error").random()
    assert one.chance("error").random() != other.chance("error").random()
    assert one.chance("error").random() != one.chance("place").random()


def test_the_chance_of_a_task_is_the_tutors_and_not_the_theorys():
    ann, bo = done(("teach", {})), done(("teach", {}), tutor="Bo")
    other = done(("teach", {}), theory="other")
    assert ann[0].chance("error").random() == other[0].chance("error").random()
    assert ann[0].chance("error").random() != bo[0].chance("error").random()
    assert [it.of for it in ann] == [it.of for it in bo]


def test_orders_are_the_same_for_all():
    first, second = (done(("teach", {"order": "shuffled"})) for _ in range(2))
    assert first == second


def test_who_goes_on_must_be_there():
    study = made(("change_tutor", {"to": "Cy"}))
    (told,) = phases.faults(study.phases[0], study)
    assert told == Problem(("to",), "there is no tutor Cy: there is Ann, Bo")
    study = made(("change_tutor", {"to": "ann"}))
    (told,) = phases.faults(study.phases[0], study)
    assert told == Problem(("to",), "there is no tutor ann: did you mean Ann?")
    alone = made(("swap", {}), tutors=("Ann",))
    assert list(phases.faults(alone.phases[0], alone))


def test_what_a_scene_lacks_is_told(tmp_path):
    one = Named("s", "drawn", {"kinds": ["cup"], "each": 3})
    study = made(*((do, {"what": "relations"}) for do in ("teach", "ask")), scene=one)
    assert not list(phases.faults(study.phases[0], study))
    ((key, told, _),) = phases.faults(study.phases[1], study)
    assert key == ("what",)
    assert told.startswith("there is one kind of thing in s, and the robot does not ")
    seen = Named("s", "pictures", {"folder": str(tmp_path)})
    study = made(("find", {}), scene=seen)
    ((key, told, _),) = phases.faults(study.phases[0], study)
    assert key == ("do",)
    assert told == "find cannot be done with s, which is pictures"


@pytest.mark.parametrize(
    ("kind", "more"),
    [("drawn", "in_view = 4"), ("around", 'kind = "drawn" and in_view = 4')],
)
def test_what_is_alone_in_view_is_not_to_be_found(kind, more):
    """It would be found whatever is said: a success of nobody's."""
    study = made(("find", {}), scene=Named("s", kind))
    ((_, told, _),) = phases.faults(study.phases[0], study)
    assert told == (
        "one thing at a time is in view in s, and is found whatever is asked for: "
        f"write {more}"
    )
    study = made(("find", {}), scene=Named("s", "drawn", {"in_view": 2}))
    assert not list(phases.faults(study.phases[0], study))
    cup = Named("s", "drawn", {"in_view": 2, "kinds": ["cup"], "each": 2})
    assert not list(phases.faults(study.phases[0], made(scene=cup)))
    study = made(("find", {"of": "new"}), scene=cup)
    ((_, told, _),) = phases.faults(study.phases[0], study)
    assert told.startswith("one thing at a time")
    assert told.endswith("write new = 4 and in_view = 4")


def test_how_much_comes_is_said_once():
    study = made(("teach", {"rounds": 2, "turns": 4}))
    assert list(phases.faults(study.phases[0], study)) == [
        Problem(
            ("turns",), "rounds and turns both say how much comes: write one of them"
        )
    ]


@pytest.mark.parametrize(
    "phase",
    [
        ("teach", {"rounds": 3}),
        ("talk", {"turns": 7}),
        ("ask", {"what": "relations", "of": "new"}),
        ("find", {"rounds": 2}),
        ("align", {}),
        ("rest", {}),
        ("swap", {}),
        ("forget", {"words": ["cup", "mug"]}),
    ],
)
def test_a_phase_is_as_long_as_it_has_tasks(phase):
    study = made(phase)
    scene = scenes.open_scene(study, Run("robot", "Ann", "s", 1))
    assert phases.length(study.phases[0], scene) == len(done(phase))


@pytest.mark.parametrize("do", sorted(phases.SETTINGS))
def test_every_phase_says_what_may_be_set(do):
    for name, setting in phases.SETTINGS[do].items():
        assert setting.needed or not setting.problem_with(setting.default), name
