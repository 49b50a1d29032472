"""The robots of a study: simulated, whole, and played by a person."""

from random import Random

import pytest

from kille.lab import scenes
from kille.lab.errors import StudyError
from kille.lab.people.person_as_robot import TypedRobot
from kille.lab.playing_dialogues.players import robot_of
from kille.lab.robots.replies import degrees
from kille.lab.scenes.scene import Occasion
from kille.lab.study import Named, Run, Study, Theory
from kille.lab.worlds.worlds import Thing, World

WORLD = World(
    (Thing("cup", "red", 0.5, (2, 3)), Thing("book", "blue", 0.5, (6, 3))), noise=0.05
)


def robot(kind="drawn", theory=None, **set_):
    theory = theory or Theory("robot")
    study = Study("t", {"robot": theory}, {}, {"s": Named("s", kind, set_)}, (), (1,))
    run = Run("robot", "Ann", "s", 1)
    scene = scenes.open_scene(study, run)
    return robot_of(study, run, scene), scene


def shown(x, world=WORLD, glance=1):
    return Occasion("noun", world.point_at(x), x).at_glance(glance)


def test_it_replies_as_its_theory_says():
    it, _ = robot()
    it.see(shown(1))
    reply = it.hear("This is a cup.")
    learned = "OK, the one on the left (#1) is a cup."
    assert (reply.text, reply.acts) == (learned, ("learned",))
    assert "learn_word" in reply.rules
    asked = it.hear("What is this?")
    assert (asked.way, asked.claimed_word("noun")) == ("assert", "cup")
    found = degrees(asked.state, asked.model, "noun", it.name(1))
    assert found["cup"] > 0.5


def test_what_it_does_not_understand_changes_nothing():
    it, _ = robot()
    before = it.see(shown(1))
    reply = it.hear("Colourless green ideas sleep furiously.")
    assert reply.text.startswith("Sorry")
    assert not reply.acts
    assert reply.state is before.state


def test_it_may_say_something_when_it_has_the_floor():
    it, _ = robot()
    occasion = shown(1)
    it.see(occasion)
    reply = it.wait(occasion.look_again())
    assert reply.asks
    assert reply.wants == "ask_thing"
    assert reply.focus == 1


def test_it_does_not_know_what_was_moved_again():
    """What was said of where a thing was is not undone by where it is now."""
    it, _ = robot()
    for x, word in ((1, "cup"), (2, "book")):
        it.see(shown(x, glance=x))
        it.hear(f"This is a {word}.")
    it.see(shown(1, glance=3))
    it.hear("This is to the left of the book.")
    moved = shown(1, WORLD.move(1, (9, 3)), glance=4)
    it.see(moved)
    it.hear("Where is this?")
    reply = it.hear("No, this is to the right of the book.")
    lessons = [lesson.sign.form for lesson in reply.state.private.lessons]
    assert {"to the left of", "to the right of"} <= set(lessons)


def test_a_thing_is_pointed_out():
    it, _ = robot()
    it.see(shown(1))
    reply = it.hear("Show me the blue one.")
    assert (reply.way, reply.pointed_thing) == ("point", 2)


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("What is this?", "assert"),
        ("Is this a cup?", "yes"),
        ("Is this a book?", "none"),
        ("Where is the box?", "none"),
        ("What colour is this?", "assert"),
        ("Hello.", "none"),
    ],
)
def test_the_way_of_an_answer_is_that_of_its_move(text, way):
    it, _ = robot()
    it.see(shown(1))
    it.hear("This is a cup.")
    assert it.hear(text).way == way


def test_it_knows_on_another_day_what_it_was_taught():
    it, _ = robot()
    it.see(shown(1))
    it.hear("This is a cup.")
    it.rest()
    it.see(shown(1, glance=5))
    assert it.hear("What is this?").claimed_word("noun") == "cup"


def test_things_happen_by_commands():
    it, _ = robot()
    it.see(shown(1))
    it.happen("place 2 3.5 4")
    it.happen("point 2")
    assert it.happen("remove #1").focus == 2
    assert it.name(1) is None
    with pytest.raises(StudyError, match="@ fly 3: in front of a simulated scene"):
        it.happen("fly 3")
    with pytest.raises(StudyError, match="@ point"):
        it.happen("point to it")


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("point 9", "there is no #9 in view"),
        ("point 2.7", "there is no #2.7 in view"),
        ("remove 0", "there is no #0 in view"),
        ("place 2 20 4", "a place is two numbers from 0 to 9"),
        ("place 2 nan 4", "a place is two numbers from 0 to 9"),
        ("", "in front of a simulated scene write"),
    ],
)
def test_what_cannot_happen_does_not_happen(command, told):
    it, _ = robot()
    it.see(shown(1))
    with pytest.raises(StudyError, match=f"@ .*{told}"):
        it.happen(command)


def test_a_person_claims_what_they_type():
    lines = iter(["This is a cup.", "It is to the left of the car.", "Hm.", "What?"])
    it = TypedRobot(ask=lambda prompt: next(lines))
    it.see(shown(1))
    assert it.hear("What is this?").claimed_word("noun") == "cup"
    assert it.hear("Where is this?").claimed_word("relation") == "to the left of"
    assert it.hear("And this?").way == "admit"
    assert it.hear("Hello?").asks


# --- the whole robot -----------------------------------------------------------------


def test_the_whole_robot_sees_what_is_rendered():
    it, scene = robot("rendered", kinds=["cup", "car"], target="cup", new=0)
    cup, car = (it for it in scene.round("noun", False, Random(1)))
    for occasion, word in ((cup, "cup"), (car, "car")):
        it.see(occasion)
        assert it.hear(f"This is a {word}.").text == f"OK, I learned a {word}."
    it.see(cup)
    reply = it.hear("What is this?")
    assert reply.claimed_word("noun") == "cup"
    assert it.name(cup.x) == "o1"
    placed = scene.round("relation", False, Random(1))[0]
    it.see(placed)
    assert it.hear("This is behind the car.").acts == ("learned_relation",)
    assert {it.name(placed.x), it.name(placed.y)} == {"o1", "o2"}
    it.rest()
    it.see(car)
    assert it.hear("What is this?").claimed_word("noun") == "car"
    it.close()


def test_the_whole_robot_sees_pictures(data):
    folder = str(data / "sota_kinect")
    it, scene = robot("pictures", folder=folder, kinds=["cup", "book"], each=1, new=1)
    cup, book = sorted(scene.round("noun", False, Random(1)), key=lambda it: it.group)[
        ::-1
    ]
    it.see(cup)
    it.hear("This is a cup.")
    it.see(book)
    it.hear("This is a book.")
    it.see(cup)
    assert it.hear("What is this?").claimed_word("noun") == "cup"
    it.close()


def test_the_whole_robot_sees_captures(data):
    """And asks of its own accord about what it sees in them."""
    folder = str(data / "ycbv_scenes")
    it, scene = robot("captures", folder=folder, teach=["0001"], each=1)
    taught = scene.round("noun", False, Random(1))
    assert {it.group for it in taught} == {
        "cracker box",
        "master chef can",
        "mustard bottle",
        "sugar box",
    }
    first, second = taught[:2]
    it.see(first)
    it.hear(f"This is a {first.group}.")
    it.see(second)
    assert it.hear("What is this?").claimed_word("noun") != second.group
    assert any(it.wait(second).asks for _ in range(2))
    pointed = it.hear(f"Show me the {first.group}.")
    assert pointed.way in ("point", "none")
    assert it.happen("look").state.view.things
    it.close()


def test_a_look_does_not_depend_on_what_was_seen_before():
    _, scene = robot("rendered", kinds=["cup"], target="cup", landmark="car", new=0)
    first, second = scene.round("noun", False, Random(2))[:2]
    theatre = scene.theatre
    theatre.turn_to(first)
    seen = theatre.frame()
    theatre.turn_to(second)
    theatre.frame()
    theatre.turn_to(first)
    assert (theatre.frame().colour == seen.colour).all()


def test_scenes_that_are_not_simulated_are_named():
    assert set(scenes.SETTINGS) >= scenes.WHOLE


SAID_IN_PARTS = [
    ("en", "Well, you know, this is a cup!", "learned", ""),
    ("en", "I have found a cup today!", "ask_meant", "Yes."),
    ("en", "Um, and, er, what is this?", "admit_name", ""),
    ("sv", "Öh, det här är liksom en kopp.", "learned", ""),
    ("sv", "Jag har hittat en kopp idag!", "ask_meant", "Ja."),
]


@pytest.mark.parametrize(("language", "text", "act", "answer"), SAID_IN_PARTS)
def test_the_simulated_robot_understands_by_parts_as_the_whole_one_does(
    language, text, act, answer
):
    """What is heard of a text does not depend on the scene of a study."""
    simulated, _ = robot(theory=Theory("robot", language=language))
    simulated.see(shown(1))
    whole, scene = robot(
        "rendered",
        Theory("robot", language=language),
        kinds=["cup"],
        target="cup",
        landmark="car",
        new=0,
    )
    whole.see(next(it for it in scene.round("noun", False, Random(1))))
    for it in (simulated, whole):
        assert it.hear(text).acts == (act,)
        if answer:
            assert it.hear(answer).acts == ("learned",)
    whole.close()


def test_of_several_moves_each_is_answered_and_a_question_ends_the_turn():
    it, _ = robot()
    it.see(shown(1))
    both = it.hear("This is a cup. What is this?")
    assert both.acts == ("learned", "assert_name")
    assert both.text.count("\n") == 1
    asked = it.hear("I have found a mug! What colour is it?")
    assert asked.acts[-1] == "ask_meant"
    assert asked.is_open


def test_what_it_does_not_understand_beside_other_things_is_said():
    it, _ = robot()
    it.see(shown(1))
    reply = it.hear("Blah blubb blubber is. What is this?")
    assert reply.acts == ("admit_name",)
    assert reply.text.startswith("I did not understand")
    assert not reply.is_lost
