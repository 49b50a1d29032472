"""Tutors: what they hold to be so, how they err, answer and give feedback."""

import math
import re
from itertools import pairwise
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.lab import tutors as kinds
from kille.lab.errors import StudyError
from kille.lab.playing_dialogues import play
from kille.lab.settings import Problem
from kille.lab.study import Named, Phase, Run, Study, Theory
from kille.lab.tutors.spatial_judges import (
    HEADINGS,
    Person,
    RatedWords,
    Speaker,
    read_ratings,
)

LESSONS = (Phase("lessons", "teach", {"rounds": 4}),)
MISLED = Named("other", "simulated", {"calls": {"mug": "cup", "cup": "mug"}})
"""Whose robot answers wrongly, but for books."""

QUESTIONS = (
    Phase("to the other", "change_tutor", {"to": "other"}),
    Phase("lessons", "teach", {}),
    Phase("and back", "change_tutor", {"to": "tutor"}),
    Phase("practice", "practise", {}),
)
TABLE = Named("table", "drawn", {"kinds": ["cup", "mug", "book"], "noise": 0.05})


def played(phases, *, scene=TABLE, theory=None, seed=1, others=(), at=None, **set_):
    """The dialogue with a tutor of these settings."""
    kind = set_.pop("kind", "simulated")
    theory = theory or Theory("robot")
    tutors = {it.name: it for it in (Named("tutor", kind, set_), *others)}
    settings = {} if at is None else {"folder": at}
    study = Study(
        "t", {"robot": theory}, tutors, {"table": scene}, phases, (seed,), **settings
    )
    return play(study, Run("robot", "tutor", "table", seed))


def acts(it):
    return [turn.act for turn in it.turns]


def test_he_errs_as_often_as_he_is_said_to():
    right = played(LESSONS)
    wrong = played(LESSONS, errors=1.0)
    pairs = [
        (one.given, other.given)
        for one, other in zip(right.turns, wrong.turns, strict=True)
        if one.act == "instruct"
    ]
    assert pairs
    assert all(one != other for one, other in pairs)


def test_he_calls_things_as_he_does():
    it = played(LESSONS, calls={"mug": "cup"})
    assert not any("mug." in turn.given for turn in it.turns if turn.act == "instruct")


def test_he_speaks_only_of_what_he_has_words_for():
    it = played(LESSONS, vocabulary=["cup", "book"])
    said = {turn.given for turn in it.turns if turn.act == "instruct"}
    assert said == {"This is a cup.", "This is a book."}
    assert acts(it).count("shows") == 8


def test_he_neither_errs_nor_answers_in_words_that_he_has_not():
    only = ["cup", "book"]
    erring = played(LESSONS, vocabulary=only, errors=1.0)
    table = Named("table", "drawn", {"each": 2, "in_view": 4})
    talk = (Phase("talk", "talk", {"rounds": 2}),)
    alone = Theory("robot", mode="autonomous")
    for it in (
        erring,
        played(talk, scene=table, vocabulary=only),
        played(talk, scene=table, vocabulary=only, theory=alone),
    ):
        taught = [
            turn.given for turn in it.turns if turn.act in ("instruct", "correct")
        ]
        assert taught
        assert all(text.endswith((" a cup.", " a book.")) for text in taught)


def test_he_speaks_of_places_in_his_own_words():
    near = Speaker(Person(), only=("near", "behind"))
    assert near.words == ("behind", "near")
    said = {near.says((0.0, far), "", Random(1)) for far in (-0.3, 0.3)}
    assert said == {"near", "behind"}
    left = Speaker(Person(), only=("to the left of",))
    assert left.says((0.3, 0.0), "", Random(1)) == ""
    assert not left.accepts((0.3, 0.0), "")


def test_he_does_not_speak_of_places_that_he_has_no_word_for():
    ring = Named("table", "around", {"rings": [0.2], "points": 4})
    phases = tuple(Phase(do, do, {"what": "relations"}) for do in ("teach", "ask"))
    phases = (Phase("things", "teach", {}), *phases)
    words = ["book", "car", "to the left of"]
    it = played(phases, scene=ring, vocabulary=words)
    assert acts(it).count("relate") == 1
    assert [answer.right for answer in it.answers] == ["to the left of"]
    assert "relate" not in acts(played(phases, scene=ring, vocabulary=words[:2]))


def test_another_judge_errs_as_often():
    ring = Named("table", "around", {"rings": [0.3], "points": 4, "spread": 0.0})
    phases = (Phase("ask", "ask", {"what": "relations"}),)
    for errors, agree in ((0.0, 4), (1.0, 0)):
        it = played(phases, scene=ring, errors=errors)
        assert sum(answer.judge == answer.right for answer in it.answers) == agree


def test_nobody_judges_what_people_have_said(data):
    """Else the agreement of two people, the ceiling, would be perfect."""
    folder = str(data / "spatial_rooms")
    rooms = Named("table", "statements", {"folder": folder, "words": ["near"]})
    it = played((Phase("ask", "ask", {"what": "relations"}),), scene=rooms)
    assert {(answer.right, answer.judge) for answer in it.answers} == {("near", "")}


@pytest.mark.parametrize(
    ("feedback", "says"),
    [
        ("none", set()),
        ("confirm", {"affirm", "deny"}),
        ("correct", {"correct"}),
        ("both", {"affirm", "correct"}),
    ],
)
def test_he_says_of_answers_what_his_feedback_is(feedback, says):
    it = played(QUESTIONS, others=(MISLED,), feedback=feedback)
    said = {turn.act for turn in it.turns if turn.phase == "practice"}
    assert said - {"shows", "ask_name"} == says


def test_only_what_sets_the_robot_right_is_a_correction():
    it = played(QUESTIONS, others=(MISLED,), feedback="correct")
    assert {turn.act for turn in it.turns if turn.corrects} == {"correct"}


def test_he_shows_another_example_where_it_is_asked_for():
    table = Named("table", "drawn", {"kinds": ["cup", "mug"], "each": 2, "in_view": 4})
    phases = (*QUESTIONS, Phase("talk", "talk", {"rounds": 2}))
    it = played(phases, scene=table, others=(MISLED,), feedback="correct")
    shown = [
        (turn.answer, after)
        for turn, after in pairwise(it.turns)
        if "Please show me another" in turn.answer and after.act != "shows"
    ]
    assert shown
    for asked, after in shown:
        word = asked.split()[-1]
        assert after.given.startswith("The ")
        assert after.given.endswith(f" one is a {word}")


def test_a_new_word_that_is_much_like_another_is_meant():
    """ "This is a cupp." "Do you mean a cup?" "That is wrong." """
    phases = (Phase("lessons", "teach", {}), Phase("questions", "ask", {}))
    it = played(phases, calls={"mug": "cupp"})
    offered = [
        after.given
        for turn, after in pairwise(it.turns)
        if turn.answer == "Do you mean a cup?"
    ]
    assert offered == ["That is wrong."]
    assert [answer.is_right for answer in it.answers] == [True] * 3


def test_he_clears_up_which_thing_he_meant():
    table = Named("table", "drawn", {"each": 2, "new": 0, "in_view": 6})
    phases = (Phase("lessons", "teach", {}), Phase("find", "find", {"by": "noun"}))
    cleared = []
    for seed in (1, 2, 3):
        it = played(phases, scene=table, seed=seed)
        mentions = {turn.number for turn in it.turns if turn.act == "mention"}
        cleared += [answer for answer in it.answers if answer.turn in mentions]
        asked = [turn for turn in it.turns if turn.act == "ask_find"]
        assert len(it.answers) == len(asked)
    assert cleared
    assert all(answer.is_right for answer in cleared if answer.said)


def test_he_tells_where_things_are_that_it_asks_about():
    table = Named("table", "drawn", {"kinds": ["cup", "book"], "in_view": 2})
    phases = (*LESSONS, Phase("talk", "talk", {"turns": 1}))
    it = played(phases, scene=table)
    (told,) = [turn for turn in it.turns if turn.act == "relate"]
    assert told.answer.startswith("OK, this relation is called")


def test_without_patience_he_answers_nothing():
    talk = (Phase("talk", "talk", {}),)
    assert sum(turn.asks for turn in played(talk).turns) > 0
    assert "instruct" in acts(played(talk))
    assert "instruct" not in acts(played(talk, patience=0))


def test_he_is_as_polite_as_he_is():
    phases = (*LESSONS, Phase("practice", "practise", {}))
    assert "thank" not in acts(played(phases))
    assert "thank" in acts(played(phases, politeness=1.0))


# --- places --------------------------------------------------------------------------

places = st.tuples(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4)).filter(
    lambda it: math.hypot(*it) > 0.02
)


@given(places, st.sampled_from(sorted(HEADINGS)))
def test_the_likeliest_word_is_accepted(place, front):
    for own in (0.0, 1.0):
        speaker = Speaker(Person(), own)
        assert speaker.says(place, front, Random(1)) in speaker.accepts(place, front)


@given(places)
def test_the_landmarks_left_is_the_viewers_where_it_faces_away(place):
    """Left and right are the same then, and near and far change places."""
    right, away = place
    own, viewers = Speaker(Person(), 1.0), Speaker(Person(), 0.0)
    there = own.says(place, "away", Random(1))
    assert there == viewers.says((right, -away), "away", Random(1))


def test_a_share_of_his_words_is_in_the_landmarks_frame():
    speaker = Speaker(Person(), 0.25)
    said = [speaker.says((0.3, 0.0), "right", Random(seed)) for seed in range(400)]
    assert 0.15 < said.count("in front of") / len(said) < 0.35
    assert said.count("to the right of") + said.count("in front of") == len(said)


@given(places)
def test_ratings_are_chances(place):
    grid = RatedWords({"left": [((-0.1, 0.0), 1.0)], "right": [((-0.1, 0.0), 0.5)]})
    chances = grid.chances(place)
    assert math.isclose(sum(chances.values()), 1.0)
    assert chances["left"] > chances["right"]


def test_people_rate_what_is_left_as_left(data):
    speaker = Speaker(read_ratings(data / "spatial_logan_sadler"))
    assert speaker.says((-0.3, 0.0), "", Random(1)) == "to the left of"
    assert speaker.says((0.3, 0.0), "", Random(1)) == "to the right of"
    assert speaker.says((0.0, 0.3), "", Random(1)) == "behind"


def test_a_tutor_speaks_as_people_rate(data):
    ring = Named("table", "around", {"rings": [0.2], "points": 4})
    phases = (
        Phase("things", "teach", {}),
        Phase("places", "teach", {"what": "relations"}),
        Phase("where", "ask", {"what": "relations"}),
    )
    folder = str(data / "spatial_logan_sadler")
    it = played(phases, scene=ring, kind="people", folder=folder)
    assert {answer.kind for answer in it.answers} == {"relation"}
    assert it.facts["not understood"] == 0.0


# --- scripts, several, one's own -----------------------------------------------------


def test_a_script_is_said_line_by_line(tmp_path):
    (tmp_path / "a.dlg").write_text(
        "U> This is a cup.\nS> OK, I learned a cup.\n"
        "U> What is this?\nS> This is a mug.\n@ point 1\nU> What is this?\n"
    )
    ring = Named("table", "around")
    phases = (Phase("talk", "talk", {}),)
    it = played(phases, scene=ring, kind="scripted", file="a.dlg", at=tmp_path)
    assert acts(it) == ["shows", "says", "says", "happens", "says"]
    assert [answer.is_right for answer in it.answers] == [True, False]
    assert it.answers[1].said == "This is a cup."


def test_a_reply_that_asks_back_may_be_what_a_script_expects(tmp_path):
    (tmp_path / "a.dlg").write_text(
        "U> This is a cup.\nS> OK, I learned a cup.\n"
        "U> This is a cupp.\nS> Do you mean a cup?\n"
        "U> Yes.\nS> OK, I learned a cup.\n"
    )
    phases = (Phase("talk", "talk", {"turns": 1}),)
    it = played(phases, kind="scripted", file="a.dlg", at=tmp_path)
    assert [answer.right for answer in it.answers] == [
        "OK, I learned a cup.",
        "Do you mean a cup?",
        "OK, I learned a cup.",
    ]
    assert it.answers[1].is_right


def test_a_script_that_comes_later_is_said_once(tmp_path):
    (tmp_path / "a.dlg").write_text("U> Hello.\n")
    script = Named("script", "scripted", {"file": "a.dlg"})
    phases = (
        Phase("first", "teach", {}),
        Phase("change", "change_tutor", {"to": "script"}),
        Phase("then", "teach", {}),
    )
    it = played(phases, others=(script,), at=tmp_path)
    assert [turn.given for turn in it.turns if turn.tutor == "script"][1:] == ["Hello."]


def test_a_script_with_what_cannot_happen_ends_the_dialogue(tmp_path):
    (tmp_path / "a.dlg").write_text("@ fly\nU> Hello.\n")
    phases = (Phase("talk", "talk", {}),)
    with pytest.raises(StudyError, match="@ fly"):
        played(phases, kind="scripted", file="a.dlg", at=tmp_path)


@pytest.mark.parametrize("turns", ["phase", "task"])
def test_several_take_turns(turns):
    others = (Named("Ann", "simulated"), Named("Bo", "simulated"))
    phases = (*LESSONS, Phase("questions", "ask", {}))
    set_ = {"kind": "several", "of": ["Ann", "Bo"], "turns": turns}
    it = played(phases, others=others, **set_)
    by = {
        phase: {turn.tutor for turn in it.turns if turn.phase == phase}
        for phase in ("lessons", "questions")
    }
    if turns == "phase":
        assert by == {"lessons": {"Ann"}, "questions": {"Bo"}}
    else:
        assert by == {"lessons": {"Ann", "Bo"}, "questions": {"Ann", "Bo"}}


OWN = '''
from kille.lab.tutors.tutor import Says, Shows

class Shouting:
    """Says what a thing is, so often."""

    def __init__(self, name, words, times=1):
        self.name, self._words, self._times = name, words, times

    def turns(self, task):
        yield Shows(task.occasion)
        kind = self._words.word_for(task.occasion.thing.kind)
        for _ in range(self._times):
            reply = yield Says(self._words.lesson("noun", kind), "instruct")
            assert reply.acts == ("learned",)

nobody = None
'''


def test_a_tutor_may_be_ones_own(tmp_path):
    (tmp_path / "own.py").write_text(OWN)
    set_ = {"make": "own.py:Shouting", "settings": {"times": 2}}
    it = played((Phase("lessons", "teach", {}),), kind="own", at=tmp_path, **set_)
    assert acts(it) == ["shows", "instruct", "instruct"] * 3
    assert it.lessons == 6


ODD = """
nobody = 3

class Mute:
    def __init__(self, name, words):
        self.name = name

class Broken:
    def __init__(self, name, words):
        raise ValueError("no voice")

class Shy:
    def __init__(self, name, words):
        pass

    @property
    def name(self):
        raise ValueError("no name")
"""


def test_a_tutor_of_ones_own_is_made_anew_for_each_dialogue(tmp_path):
    """What his file draws by chance does not go on from the dialogue before."""
    counting = OWN.replace("name, words, times\n", "name, words, len(made)\n").replace(
        "yield Shows", "made.append(1); yield Shows"
    )
    (tmp_path / "own.py").write_text(f"made = []\n{counting}")
    phases = (Phase("lessons", "teach", {}),)
    one, other = (
        played(phases, kind="own", at=tmp_path, make="own.py:Shouting") for _ in "12"
    )
    assert one == other


@pytest.mark.parametrize(
    ("make", "why"),
    [
        ("own.py", "own.py names no tutor: write FILE.py:NAME or MODULE:NAME"),
        ("none.py:A", "there is no file "),
        ("own.py:Shoutin", "own.py has no Shoutin: did you mean Shouting?"),
        ("own.py:nobody", "nobody of own.py makes no tutor: name a class"),
        ("own.py:Mute", "a tutor needs turns, and what own.py:Mute makes has none"),
        ("own.py:Broken", "own.py:Broken makes no tutor: ValueError: no voice (line "),
        ("own.py:Shy", "own.py:Shy makes no tutor: ValueError: no name (line "),
        ("gone.py:A", "gone.py cannot be run: SystemExit: 3 (line 2)"),
        ("no_such:A", "there is no module no_such: write FILE.py:NAME"),
    ],
)
def test_what_makes_no_tutor_is_told(tmp_path, make, why):
    (tmp_path / "own.py").write_text(OWN + ODD)
    (tmp_path / "gone.py").write_text("import sys\nsys.exit(3)\n")
    named = Named("me", "own", {"make": make})
    study = Study("t", {}, {"me": named}, {}, (), (1,), folder=tmp_path)
    ((key, told, _),) = kinds.faults(named, study)
    assert key == ("make",)
    assert told.startswith(why)


def test_settings_that_a_tutor_of_ones_own_does_not_take_are_told(tmp_path):
    (tmp_path / "own.py").write_text(OWN)
    study = Study("t", {}, {}, {}, (), (1,), folder=tmp_path)
    make = {"make": "own.py:Shouting"}
    assert not list(kinds.faults(Named("me", "own", make), study))
    wrong = Named("me", "own", {**make, "settings": {"time": 2}})
    ((_, told, _),) = kinds.faults(wrong, study)
    assert told == (
        "own.py:Shouting cannot be called with name, words and its settings: "
        "got an unexpected keyword argument 'time'"
    )
    named = Named("me", "own", {**make, "settings": {"name": "you"}})
    assert list(kinds.faults(named, study)) == [
        Problem(("settings", "name"), "name is not to be set: the study gives it")
    ]


def test_what_it_learned_alone_is_set_right():
    """That very thing, and only where it is not so."""
    wants = {"wants": {"learning": {"right": 0.5, "wrong": -0.5}}}
    theory = Theory("robot", mode="autonomous", strategy=wants)
    table = Named("table", "drawn", {"each": 4, "in_view": 3, "noise": 0.15})
    phases = (Phase("talk", "talk", {"turns": 16, "order": "shuffled"}),)
    wrong = right = 0
    for seed in (1, 2, 3, 4):
        it = played(phases, theory=theory, scene=table, seed=seed)
        for turn, after in pairwise(it.turns):
            alone = turn.answer.startswith("I am sure that this is a")
            right += alone and after.act == "shows"
            if turn.corrects:
                wrong += 1
                assert re.match(r"OK, (this|the one .*|#\d+) is a", turn.answer)
                assert ", not a" in turn.answer
    assert wrong
    assert right > wrong


def test_what_is_not_there_is_told(tmp_path):
    study = Study(
        "t", {}, {"Ann": Named("Ann", "simulated")}, {}, (), (1,), folder=tmp_path
    )
    found = [
        *kinds.faults(Named("S", "scripted", {"file": "none.dlg"}), study),
        *kinds.faults(Named("P", "people", {"folder": "none"}), study),
        *kinds.faults(Named("B", "several", {"of": ["Ann", "Bo"]}), study),
        *kinds.faults(Named("O", "several", {"of": ["Ann", "Ann"]}), study),
        *kinds.faults(Named("C", "simulated", {"calls": {"mug": 3}}), study),
        *kinds.faults(Named("H", "scripted", {"file": "~no-such-user/a.dlg"}), study),
    ]
    assert found == [
        Problem(("file",), f"there is no file {tmp_path / 'none.dlg'}"),
        Problem(("folder",), f"there is no folder {tmp_path / 'none'}"),
        Problem(("of",), "there is no tutor Bo: there is Ann"),
        Problem(("of",), "Ann alone is not several: name another tutor, too"),
        Problem(
            ("calls", "mug"),
            'a mug is called a text, as in { mug = "cup" }, and not 3',
        ),
        Problem(("file",), f"there is no file {tmp_path / '~no-such-user/a.dlg'}"),
    ]


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("@ pont 2", "@ pont 2 is no command in these scenes: write look, restart, po"),
        ("@ point 0", "@ point 0 is no command in these scenes"),
        ("@ place 2", "@ place 2 is no command in these scenes"),
        ("@ place 2 20 4", "@ place 2 20 4: a place is two numbers from 0 to 9"),
        ("@ place 2 3 -1", "@ place 2 3 -1: a place is two numbers from 0 to 9"),
        ("@ sensor synthetic", "@ sensor synthetic is no command in these scenes"),
        ("U~ This is a cup. 1", "nobody mishears in a study: write U> and one text"),
    ],
)
def test_lines_that_nobody_could_play_are_told(tmp_path, line, told):
    """They would break every dialogue, or be passed over."""
    (tmp_path / "a.dlg").write_text(f"--- a\nU> Hello.\n{line}\n")
    named = Named("S", "scripted", {"file": "a.dlg"})
    study = Study("t", {}, {}, {"table": TABLE}, (), (1,), folder=tmp_path)
    ((key, found, _),) = kinds.faults(named, study)
    assert key == ("file",)
    assert found.startswith(f"{tmp_path / 'a.dlg'}:3: {told}")


def test_nothing_is_laid_or_removed_by_a_script_before_the_robots_own_eyes(tmp_path):
    (tmp_path / "a.dlg").write_text("--- a\n@ point #2\n@ place 2  3.5 4\n@ look\n")
    named = Named("S", "scripted", {"file": "a.dlg"})
    seen = {"table": Named("table", "rendered")}
    study = Study("t", {}, {}, {"table": TABLE}, (), (1,), folder=tmp_path)
    assert not list(kinds.faults(named, study))
    study = Study("t", {}, {}, seen, (), (1,), folder=tmp_path)
    ((_, told, _),) = kinds.faults(named, study)
    assert told.endswith(": write look, restart, point 2")


def test_in_swedish_he_has_the_words_for_places_that_people_rated(data):
    ring = Named("table", "around", {"rings": [0.1], "points": 8, "spread": 0.0})
    phases = (Phase("teach", "teach", {"what": "relations"}),)
    it = played(
        phases,
        scene=ring,
        theory=Theory("robot", language="sv"),
        kind="people",
        places="drawn",
        folder=str(data / "spatial_logan_sadler"),
        vocabulary=["next to", "far from"],
    )
    said = [turn.given for turn in it.turns if turn.act == "relate"]
    assert said
    assert all("bredvid" in text or "långt från" in text for text in said)
    assert it.facts["not understood"] == 0.0
