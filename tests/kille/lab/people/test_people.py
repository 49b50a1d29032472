"""People at the keyboard: what tutors and players of the robot see, type, and mean."""

import io
from collections.abc import Iterator
from dataclasses import replace
from unittest.mock import patch

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.lab.errors import StudyError
from kille.lab.people.instructions import format_view
from kille.lab.people.person_as_robot import TypedRobot
from kille.lab.people.person_as_tutor import Keyboard
from kille.lab.people.typed_lines import Gone, read_line
from kille.lab.people.typed_sayings import claimed_words
from kille.lab.playing_dialogues import play
from kille.lab.robots.replies import Reply
from kille.lab.scenes.scene import Occasion
from kille.lab.scenes.table_commands import change_world
from kille.lab.study import Named, Phase, Run, Study, Theory
from kille.lab.tutors.tutor import Says, Task
from kille.lab.worlds.worlds import Thing, World

ME = Named("me", "keyboard")
ANN = Named("Ann", "simulated")
TABLE = Named("table", "drawn", {"kinds": ["cup", "mug"], "in_view": 2})
ROBOT, WIZARD = Theory("robot"), Theory("wizard", mode="person")
TEACH, ASK = (Phase(do, do, {"turns": 1}) for do in ("teach", "ask"))


def played(*phases, tutor=ME, theory=ROBOT, scene=TABLE, lines=()):
    """The dialogue in which a person types these lines."""
    theories, tutors = {theory.name: theory}, {tutor.name: tutor}
    study = Study("t", theories, tutors, {scene.name: scene}, phases, (1,))
    with patch("sys.stdin", io.StringIO("".join(f"{line}\n" for line in lines))):
        return play(study, Run(theory.name, tutor.name, scene.name, 1))


def said(it):
    """What was said or happened, by its act; the scenes are left out that were laid."""
    return [turn.act for turn in it.turns if turn.act != "shows"]


def answers(it):
    return [(answer.right, answer.said) for answer in it.answers]


# --- what is typed -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("This is a cup.", [("noun", "cup")]),
        ("A cup", [("noun", "cup")]),
        ("I think it is a cup.", [("noun", "cup")]),
        ("It's a big red cup", [("noun", "cup")]),
        ("This is a food can.", [("noun", "food can")]),
        ("This is an orange.", [("noun", "orange")]),
        ("No. It is red.", [("adjective", "red")]),
        ("It is behind the red car.", [("relation", "behind")]),
        ("Is it a cup?", []),
        ("This is a cup?", []),
        ("This is not a cup.", []),
        ("cup", []),
        ("", []),
    ],
)
def test_what_a_sentence_claims(text, found):
    assert list(claimed_words(text, "en")) == found


def test_what_a_swedish_sentence_claims():
    assert claimed_words("Det är ett rött äpple.", "sv") == (("noun", "äpple"),)


def test_nobody_who_is_gone_types(monkeypatch):
    for stdin in (io.StringIO(), None, closed()):
        monkeypatch.setattr("sys.stdin", stdin)
        with pytest.raises(Gone):
            read_line("> ")


@pytest.mark.parametrize("errors", ["strict", "replace", "surrogateescape"])
def test_what_is_not_utf_8_is_told(monkeypatch, capsys, errors):
    raw = io.BytesIO("Det här är en kopp.\n".encode("latin-1"))
    stdin = io.TextIOWrapper(raw, encoding="utf-8", errors=errors)
    monkeypatch.setattr("sys.stdin", stdin)
    with pytest.raises(Gone):
        read_line("> ")
    assert "What was typed is not UTF-8: save it so" in capsys.readouterr().out


def closed():
    file = io.StringIO()
    file.close()
    return file


# --- a tutor -------------------------------------------------------------------------


def test_a_tutor_sees_what_is_to_be_done_and_what_comes_of_it(capsys):
    it = played(TEACH, lines=["This is a cup.", "", "."])
    assert said(it) == ["instruct", "waits"]
    shown = capsys.readouterr().out
    for line in (
        "Step 1, teach: say what #1 is.",
        "  #1 brown cup, 4 right 0 away, facing left  <- pointed at",
        "  #2 yellow mug, 5 right 2 away",
        "me (you): This is a cup.",
        "Robot: OK, the one on the left (#1) is a cup.",
    ):
        assert f"{line}\n" in shown
    assert "You are the tutor" in shown


def test_a_dialogue_does_not_go_on_without_its_tutor(capsys):
    with pytest.raises(KeyboardInterrupt):
        played(TEACH, ASK, lines=["This is a cup."])
    assert capsys.readouterr().out.endswith("me (you): \nThe input has ended.\n")


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("@", "@ …: in front of a simulated scene write `look`, `point 2`, "),
        ("@ fly", "@ fly: in front of a simulated scene write `look`, `point 2`, "),
        ("@ point 9", "@ point 9: there is no #9 in view, but #1, #2"),
        ("@ point -1", "@ point -1: there is no #-1 in view, but #1, #2"),
        (f"@ point {'9' * 5000}", "in view, but #1, #2"),
        ("@ remove", "@ remove: in front of a simulated scene write"),
        ("@ place 7 1 1", "there is no #7 in this scene, but #1, #2, #3, #4"),
        ("@ place 1 1 99", "a place is two numbers from 0 to 9, steps of 10 cm"),
        ("@ place 1 nan 1", "a place is two numbers from 0 to 9, steps of 10 cm"),
    ],
)
def test_what_cannot_happen_is_told(capsys, command, told):
    it = played(TEACH, lines=[command, "This is a cup.", "."])
    assert told in capsys.readouterr().out
    assert said(it) == ["instruct"]


def test_what_has_changed_is_seen_by_both(capsys):
    lines = ["@ point 2", "@ place 2 1 1.5", "", "This is a mug.", "@ remove 1", "."]
    it = played(TEACH, lines=lines)
    assert said(it) == ["waits", "instruct"]
    shown = capsys.readouterr().out
    assert "  #2 yellow mug, 1 right 1.5 away  <- pointed at\n" in shown
    waited = next(turn for turn in it.turns if turn.act == "waits")
    assert "*yellow mug 0.1 1,1.5" in waited.given
    assert shown.endswith(
        "On the table:\n  #2 yellow mug, 1 right 1.5 away  <- pointed at\nme (you): .\n"
    )


def test_what_is_seen_a_little_off_the_table_is_at_its_edge():
    world = World((Thing("cup", "red", place=(-0.04, 9.04)),))
    shown = format_view(Occasion("noun", world, 1), world)
    assert shown == "On the table:\n  #1 red cup, 0 right 9 away"


def test_every_look_is_another_one():
    it = played(TEACH, lines=["", "", "@ look", "."])
    looks = [turn.given for turn in it.turns]
    assert len(set(looks)) == len(looks) == 4


def test_another_day_may_begin(capsys):
    it = played(TEACH, lines=["This is a cup.", "@ restart", "What is this?", "."])
    assert it.turns[-1].answer == "This is a cup."
    assert "Another day begins.\n" in capsys.readouterr().out


def test_a_question_mark_asks_for_help_and_is_not_said(capsys):
    it = played(TEACH, Phase("more", "teach", {"turns": 1}), lines=[".", "?", "."])
    assert said(it) == []
    assert capsys.readouterr().out.count("You are the tutor") == 2


def test_what_corrects_the_robot_is_counted_as_that():
    lines = ["This is a cup.", "What is this?", "No, this is a mug.", "."]
    it = played(TEACH, lines=lines)
    assert [turn.corrects for turn in it.turns[1:]] == [False, False, True]
    assert said(it)[-1] == "correct"


def test_a_no_to_what_the_robot_asks_corrects_nothing():
    it = played(TEACH, lines=["This is a cup.", "This is a cupp.", "No.", "."])
    assert it.turns[2].asks
    assert not it.turns[3].corrects


def test_the_first_question_of_a_test_is_the_one_that_counts(capsys):
    lines = ["This is a cup.", ".", "Hello.", "Waht is this?", "What colour is this?"]
    it = played(TEACH, ASK, lines=[*lines, "What is this?", "What is it?", "."])
    assert answers(it) == [("cup", "cup")]
    assert it.answers[0].accepted
    assert "No answer is kept yet" not in capsys.readouterr().out


def test_who_has_not_asked_is_told_once(capsys):
    it = played(ASK, lines=[".", "."])
    assert answers(it) == []
    told = 'No answer is kept yet: ask, such as "What is this?", or type . once more'
    assert capsys.readouterr().out.count(told) == 1


def test_the_answer_is_about_what_is_pointed_at():
    it = played(ASK, lines=["@ point 2", "What is this?", "."])
    assert [(answer.right, answer.thing) for answer in it.answers] == [
        ("mug", "yellow mug")
    ]


def test_nothing_is_asked_about_an_empty_table():
    lines = ["@ remove 1", "@ remove 2", "What is this?", ".", "."]
    assert answers(played(ASK, lines=lines)) == []


def test_who_asks_for_a_thing_does_not_point_at_it(capsys):
    find = Phase("find", "find", {})
    lines = ["This is a cup.", ".", "Show me the brown cup.", ".", ".", "."]
    it = played(TEACH, find, lines=lines)
    assert capsys.readouterr().out.count("pointed at") == 1
    assert answers(it) == [("brown cup", "brown cup")]


@pytest.mark.parametrize(
    ("by", "told", "such"),
    [
        ("both", "", "the brown cup"),
        ("noun", " by its noun alone", "the cup"),
        ("colour", " by its colour alone", "the brown one"),
    ],
)
def test_by_which_words_a_thing_is_to_be_asked_for_is_said(capsys, by, told, such):
    played(Phase("find", "find", {"by": by}), lines=["."] * 4)
    shown = capsys.readouterr().out
    assert f"Step 1, find: ask for the brown cup{told}, at which nobody " in shown
    assert f'ask, such as "Show me {such}."' in shown


def test_who_asks_for_a_place_says_what_is_right(capsys):
    places = Phase("places", "ask", {"what": "relations", "turns": 2})
    lines = ["Where is this?", "left", "It is to the left of the mug.", "."]
    it = played(places, lines=[*lines, "Where is this?", "", "."])
    assert [answer.right for answer in it.answers] == ["to the left of"]
    assert "No word for a place is read in that" in capsys.readouterr().out


def test_what_is_to_be_forgotten_is_named(capsys):
    forget = Phase("forget", "forget", {"words": ["cup"]})
    it = played(forget, lines=["", "@ point 1", "Forget the word cup.", "."])
    shown = capsys.readouterr().out
    assert "Step 1, forget: have the robot forget the word for cup.\n" in shown
    assert "There is nothing to look at: type what you say.\n" in shown
    assert len(said(it)) == 1


@pytest.mark.parametrize(
    ("do", "what", "wanted"),
    [
        ("teach", "adjectives", "say what colour #1 is."),
        ("teach", "relations", "say where #2 is from #1."),
        ("practise", "nouns", "ask what #1 is, and then say what is right."),
        ("talk", "nouns", "talk of #1, or type nothing and let the robot talk."),
    ],
)
def test_what_is_wanted_is_said(capsys, do, what, wanted):
    phase = Phase("now", do, {"what": what, "turns": 1})
    played(phase, lines=[".", "."])
    assert f"Step 1, now: {wanted}\n" in capsys.readouterr().out


def test_a_tutor_may_speak_another_language():
    world = World((Thing("cup", "red", place=(2, 3)),)).point_at(1)
    task = Task(Run("a", "me", "t", 1), "p", "ask", 1, Occasion("noun", world, 1))
    prompts: list[str] = []

    def ask(prompt: str) -> str:
        prompts.append(prompt)
        return "Vad är det här?"

    moves = Keyboard("me", "sv", ask).turns(task)
    next(moves)
    move = moves.send(TypedRobot("sv").see(task.occasion))
    assert isinstance(move, Says)
    assert (move.act, move.asks.right) == ("ask_name", "kopp")
    assert "in Swedish" in prompts[0]
    assert '"Hjälp." asks the robot' in prompts[0]


def test_what_a_camera_sees_cannot_be_moved(capsys):
    scene = Named("table", "rendered", {"kinds": ["cup"], "target": "cup"})
    lines = ["@ point 1", "@ scene 1", "This is a cup.", "@ restart"]
    it = played(TEACH, scene=scene, lines=[*lines, "What is this?", "."])
    assert it.turns[-1].answer == "This is a cup."
    shown = capsys.readouterr().out
    assert "@ point 1: write `look` or `restart`, nothing else can happen" in shown
    assert "@ place" not in shown
    assert "Before the camera (synthetic:empty" in shown
    assert "  #1 cup  <- pointed at\n" in shown


def test_things_are_put_where_they_are_seen():
    world = World((Thing("cup", "red"), Thing("mug", "blue", place=(1, 1))))
    assert change_world(world, "place #1 2 3").place(1) == (2, 3)
    with pytest.raises(StudyError, match="no #1 in view, but #2"):
        change_world(world, "point 1")


LINES = st.lists(
    st.sampled_from(["", "?", "@", "@ look", "@ restart", "This is a cup.", "No."])
    | st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\r\n\ufffd"))
    | st.builds(
        "@ {} {} {} {}".format,
        st.sampled_from(["point", "place"]),
        *[st.integers(-1, 5) | st.floats()] * 3,
    )
    | st.builds(
        "@ {} {}".format, st.sampled_from(["point", "remove"]), st.integers(-1, 5)
    ),
    max_size=6,
)


@given(LINES, LINES, st.sampled_from([ROBOT, WIZARD]))
def test_no_line_breaks_a_dialogue(before, after, theory):
    on = [".", "."] * 20
    with patch("kille.lab.people.typed_lines.sys.stdout", io.StringIO()):
        it = played(TEACH, ASK, theory=theory, lines=[*before, ".", *after, *on])
    assert it.turns


# --- who plays the robot -------------------------------------------------------------


def test_who_plays_the_robot_sees_and_hears(capsys):
    it = played(TEACH, ASK, tutor=ANN, theory=WIZARD, lines=["OK.", "It's a cup"])
    assert answers(it) == [("cup", "cup")]
    shown = capsys.readouterr().out
    assert "You are the robot" in shown
    assert (
        "On the table:\n"
        "  #1 brown cup, 6 right 0 away, facing left  <- pointed at\n"
        "  #2 yellow mug, 0 right 4 away\n"
        "Tutor: What is this?\n"
        "Robot (you): It's a cup\n"
    ) in shown


def robot(*lines: str) -> TypedRobot:
    """A robot whose player types these lines, in front of a cup and a mug."""
    left: Iterator[str] = iter(lines)
    it = TypedRobot(ask=lambda prompt: next(left))
    it.see(occasion())
    return it


def occasion() -> Occasion:
    things = Thing("cup", "red", place=(2, 3)), Thing("mug", "blue", place=(4, 3))
    return Occasion("noun", World(things).point_at(1), 1, 2)


def way(it: Reply, kind: str = "noun") -> tuple[str, str]:
    return it.claimed_word(kind), it.way


def test_an_answer_that_cannot_be_read_is_asked_for_once_more():
    assert way(robot("cup", "A cup.").hear("What is this?")) == ("cup", "assert")
    assert way(robot("cup", "the cup").hear("What is this?")) == ("", "admit")
    near = robot("near the mug", "It is near the mug.").hear("Where is this?")
    assert way(near, "relation") == ("near", "assert")
    red = robot("It is a cup.", "It is red.").hear("What colour is this?")
    assert way(red, "adjective") == ("red", "assert")


@pytest.mark.parametrize("line", ["", ".", "I do not know.", "Which one?"])
def test_who_does_not_know_is_not_asked_again(line):
    assert way(robot(line).hear("What is this?")) == ("", "admit")


def test_nothing_is_asked_again_where_no_word_was_asked_for():
    assert robot("Hm, well").hear("This is a cup.").text == "Hm, well"


def test_a_question_claims_nothing():
    reply = robot("Is it a cup?").hear("What is this?")
    assert way(reply) == ("", "admit")
    assert reply.asks
    assert reply.is_open
    assert reply.wants == ""


def test_the_player_points_by_number():
    reply = robot("Here: #2").hear("Show me the mug.")
    assert (reply.pointed_thing, reply.way) == (2, "point")
    assert robot("this one", "#1").hear("Show me the cup.").pointed_thing == 1
    assert robot("#9", "#2").hear("Show me the mug.").pointed_thing == 2
    assert robot("this", "one").hear("Show me the mug.").pointed_thing is None


def test_who_says_two_words_means_the_last():
    reply = robot("It is a cup. No, it is a mug.").hear("What is this?")
    assert way(reply) == ("mug", "assert")


def test_the_player_may_read_what_to_type():
    prompts: list[str] = []
    lines = iter(["?", "Hello."])

    def ask(prompt: str) -> str:
        prompts.append(prompt)
        return next(lines)

    assert TypedRobot(ask=ask).hear("Hello.").text == "Hello."
    assert all("You are the robot" in it for it in prompts)


def test_a_tutor_tells_what_the_player_asks():
    talk = Phase("talk", "talk", {"turns": 1})
    it = played(talk, tutor=ANN, theory=WIZARD, lines=["What is this?", "OK."])
    assert said(it) == ["waits", "instruct"]
    assert it.turns[-1].given == "This is a cup."


def test_a_tutor_tells_the_player_where_things_are():
    talk = Phase("talk", "talk", {"what": "relations", "turns": 1})
    it = played(talk, tutor=ANN, theory=WIZARD, lines=["Where is this?", "OK."])
    assert said(it) == ["waits", "relate"]


def test_a_test_tells_the_player_nothing():
    lines = ["Is it a mug?"]
    it = played(ASK, tutor=ANN, theory=WIZARD, lines=lines)
    assert said(it) == ["ask_name"]
    assert answers(it) == [("cup", "")]


def test_the_player_finds_things():
    find = Phase("find", "find", {})
    it = played(find, tutor=ANN, theory=WIZARD, lines=["#1", "#1"])
    assert answers(it) == [("brown cup", "brown cup"), ("yellow mug", "brown cup")]


def test_the_player_is_told_of_another_day(capsys):
    phases = TEACH, Phase("night", "rest", {}), ASK
    played(*phases, tutor=ANN, theory=WIZARD, lines=["OK.", "It is a cup."])
    assert "Another day begins: you know what you were taught.\n" in (
        capsys.readouterr().out
    )


def test_the_player_sees_what_a_script_has_happen():
    it = robot("Well.")
    prompts: list[str] = []
    it._ask = lambda prompt: prompts.append(prompt) or "Well."
    assert it.happen("point 2").text == ""
    assert it.happen("look").text == "Well."
    assert "#2 blue mug, 4 right 3 away  <- pointed at" in prompts[0]
    assert it.happen("restart").text == ""
    with pytest.raises(StudyError, match="@ fly"):
        it.happen("fly")


def test_the_player_has_the_floor_at_a_look_through_a_camera():
    it = robot("What is this?")
    it.see(replace(occasion(), view="a picture"))
    assert it.happen("point 2").text == ""
    assert it.happen("look").text == "What is this?"


# --- both ----------------------------------------------------------------------------


def test_both_may_be_people(capsys):
    lines = ["This is a cup.", "OK.", ".", "What is this?", "It is a cup.", "."]
    it = played(TEACH, ASK, theory=WIZARD, lines=lines)
    assert answers(it) == [("cup", "cup")]
    shown = capsys.readouterr().out
    assert "Tutor: What is this?\nRobot (you): It is a cup.\n" in shown
    assert "Robot: It is a cup.\nme (you): .\n" in shown


def test_who_asks_back_has_not_answered_a_person():
    lines = ["What is this?", "The green one?", "Yes.", "It is a cup.", "."]
    it = played(ASK, theory=WIZARD, lines=lines)
    assert answers(it) == [("cup", "cup")]


def test_who_points_when_asked_back_has_not_been_answered_yet():
    lines = ["What is this?", "This one?", "@ point 1", "Yes.", "It is a cup.", "."]
    it = played(ASK, theory=WIZARD, lines=lines)
    assert answers(it) == [("cup", "cup")]
