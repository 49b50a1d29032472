"""Theories at work: what two of them differ in is what they were said to differ in."""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.games import TUTORING
from kille.dialogue.meanings import noun, packaged_types, record_type, relation, theory
from kille.dialogue.rules import bind
from kille.dialogue.theory_files import redefine
from kille.grounding.lessons_and_learners import Knowledge
from kille.lab.errors import TheoryError
from kille.lab.playing_dialogues import play
from kille.lab.robots.simulated import SimulatedRobot
from kille.lab.study import Run, Study, Theory
from kille.lab.study_files import parse, read
from kille.lab.theories import agent_of, game_of, strategy_of
from kille.lab.theories.classifiers import learners_of
from kille.lab.theories.descriptions import describe, rules_apart
from kille.lab.theories.guest_learners import GuestRelations, logits
from kille.lab.theories.meanings import meanings_of
from kille.lab.theories.pupils import Pupil, PupilLesson
from kille.lab.theories.rules import algorithm_of, without_rules
from kille.lab.theories.simulated_words import PrototypeWord
from kille.lab.worlds.games import learned_words
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.word_learning import LearnedWord
from kille.lab.worlds.worlds import Thing, World, draw_world
from kille.memory import Memory
from kille.perception.descriptor_index import Background, View
from kille.perception.evidence import Evidence
from kille.perception.relations import RelationMemory
from kille.scene import Configuration
from ttr import TTRError
from ttr.types import TypeNode
from ttr.updates import Game, first, maybe, rules_of, seq

WORLD = World((Thing("cup", "red", 0.9, (2, 3)), Thing("car", "blue", 0.1, (7, 3))))
RULES = [rule.name for rule in rules_of(TUTORING)]

LESSON = """\
from kille.dialogue.moves import answering, plan
from ttr.updates import replace_rules, rule

@rule(when=answering("AskName"))
def admit_name(s):
    "It greets."
    return plan(s, "GreetBack")

several = [admit_name]
renamed = {"admit_name": admit_name}

def changed(games):
    return replace_rules(games, renamed)

whole = admit_name
nothing = 3

def fails(games):
    raise ValueError("no idea")
"""


PARTIAL = """
from functools import partial
def says(act, s):
    return plan(s, act)
made = partial(says, "GreetBack")
made.__name__ = "admit_name"
several = [rule(when=answering("AskName"))(made)]
"""


def packaged(name: str) -> str:
    return files("kille.grammars").joinpath(name).read_text(encoding="utf-8")


def dialogue(game: Game, said: Iterable[str | int | None]) -> list[str]:
    """What the robot says to texts; a number points at the thing.

    None puts all there anew, so that nothing has been said of it yet.
    """
    assert game.say is not None
    assert game.hear is not None
    now, world, answers = game.begin(), WORLD, []
    for one in said:
        if one is None:
            now = game.take(now, glance_event(world, World())).run
            continue
        if isinstance(one, int):
            event, world = glance_event(world.point_at(one), world), world.point_at(one)
            now = game.take(now, event).run
            continue
        turn = game.take(now, game.hear(one))
        now = turn.run
        answers += [game.say(move) for move in turn.said]
    return answers


LESSONS = (1, "This is a cup.", 2, "This is a car.")
NAMING = (*LESSONS, "What is this?")
NAMING_ANEW = (*LESSONS, None, "What is this?")


# --- what is changed ------------------------------------------------------------------


def test_a_theory_of_nothing_else_plays_the_games_as_they_are() -> None:
    usual = bind(TUTORING, packaged_types())
    assert game_of(Theory("plain"), WORLD).algorithm is usual
    said = dialogue(game_of(Theory("plain"), WORLD), NAMING)
    assert said[-1] == "This is a car."


def test_bands_are_those_of_the_strategy() -> None:
    shy = Theory("shy", strategy={"bands": {"sure": 0.95, "margin": 0}})
    assert strategy_of(shy).bands.margin == 0.0
    said = dialogue(game_of(shy, WORLD), NAMING_ANEW)
    assert said[-1].endswith("but I am not sure.")


def test_a_wording_and_a_mode_are_those_of_the_file() -> None:
    four = strategy_of(Theory("four", mode="driven", wording="four"))
    assert (four.mode, four.wording) == ("driven", "four")


def test_a_rule_that_is_lacking_says_nothing() -> None:
    theory = Theory("never sure", without=("assert_name",))
    assert dialogue(game_of(theory, WORLD), NAMING)[-1].startswith("I do not know")


@pytest.mark.parametrize("name", ["admit_name", "several", "renamed", "changed"])
def test_rules_of_ones_own_stand_for_others(tmp_path: Path, name: str) -> None:
    (tmp_path / "own.py").write_text(LESSON)
    theory = Theory("polite", rules=f"{tmp_path / 'own.py'}:{name}")
    assert dialogue(game_of(theory, WORLD), ["What is this?"]) == ["Hello."]


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("severl", "has no severl: did you mean several?"),
        ("nothing", "is no rules: expected a rule"),
        ("fails", "failed: ValueError: no idea"),
    ],
)
def test_rules_that_are_none_are_told(tmp_path: Path, name: str, told: str) -> None:
    (tmp_path / "own.py").write_text(LESSON)
    with pytest.raises(TheoryError, match=r"own\.py") as raised:
        algorithm_of(Theory("polite", rules=f"{tmp_path / 'own.py'}:{name}"))
    assert told in str(raised.value)


def test_a_rule_that_is_no_function_of_a_file_is_told_by_what_it_is_for(
    tmp_path: Path,
) -> None:
    code = LESSON.replace("several = [admit_name]", PARTIAL)
    (tmp_path / "own.py").write_text(code)
    theory = Theory("partial", rules=f"{tmp_path / 'own.py'}:several")
    assert list(rules_apart(Theory("plain"), theory)) == ["admit_name"]


def test_chance_in_rules_does_not_go_on_from_another_dialogue(tmp_path: Path) -> None:
    code = LESSON.replace(
        "    return plan", "    form = str(CHANCE.random())\n    return plan"
    )
    code = f"from random import Random\nCHANCE = Random(7)\n{code}"
    code = code.replace('"GreetBack")', '"AssertName", said_of(s, noun(form), "o1"),')
    code = code.replace('o1"),', 'o1"), signs=[noun(form)])')
    code = "from kille.dialogue.meanings import noun\n" + code
    code = code.replace("answering, plan", "answering, plan, said_of")
    (tmp_path / "own.py").write_text(code)
    theory = Theory("draws", rules=f"{tmp_path / 'own.py'}:admit_name")
    once = dialogue(game_of(theory, WORLD), ["What is this?"])
    assert once[0].startswith("This is a 0.")
    assert dialogue(game_of(theory, WORLD), ["What is this?"]) == once


def test_rules_in_the_notation_stand_for_those_of_their_kind(tmp_path: Path) -> None:
    source = packaged("tutor.ttr")
    (tmp_path / "tutor.ttr").write_text(source, encoding="utf-8")
    (tmp_path / "own.ttr").write_text(
        'import "tutor.ttr"\n'
        "rule silent(s : State /\\ [private : [agenda = [] : Agenda],"
        " shared : [latest : AskName]])\n"
        '    "It says nothing." of admit_name\n'
        "    := [private : [failed = [] : list(Sign)]]\n"
    )
    theory = Theory("silent", rules=str(tmp_path / "own.ttr"))
    assert dialogue(game_of(theory, WORLD), ["What is this?", "Hello."]) == ["Hello."]
    assert "silent(s : State" in rules_apart(Theory("plain"), theory)["silent"][1]


def test_a_lexicon_of_ones_own_words_it_otherwise(tmp_path: Path) -> None:
    lexicon = packaged("lexicon.en.toml")
    packaged_wording = "OK, {one} (#{number}) is {a_word}."
    assert packaged_wording in lexicon
    own = lexicon.replace(packaged_wording, "So {a_word} it is.")
    (tmp_path / "lexicon.en.toml").write_text(own, encoding="utf-8")
    theory = Theory("otherwise", grammar=tmp_path)
    assert dialogue(game_of(theory, WORLD), NAMING)[0] == "So a cup it is."
    assert dialogue(game_of(Theory("plain"), WORLD), NAMING)[0] == (
        "OK, the one on the left (#1) is a cup."
    )


def test_a_grammar_of_ones_own_reads_otherwise(tmp_path: Path) -> None:
    grammar = packaged("tutor.en.lark")
    (tmp_path / "tutor.en.lark").write_text(
        grammar.replace("hello", "ahoy"), encoding="utf-8"
    )
    game = game_of(Theory("sailor", grammar=tmp_path), WORLD)
    assert dialogue(game, ["Ahoy."]) == ["Hello."]
    assert game.hear is not None
    assert game.hear("Hello.") is None


# --- rules that are lacking -----------------------------------------------------------


@settings(max_examples=40)
@given(st.sets(st.sampled_from(RULES), max_size=8))
def test_what_is_lacking_is_gone_and_nothing_is_new(names: set[str]) -> None:
    left = without_rules(TUTORING, names)
    assert left is not None
    found = {rule.name for rule in rules_of(left)}
    assert not found & names
    assert found <= set(RULES)


def test_without_names_the_strategy_is_the_same() -> None:
    assert without_rules(TUTORING, ()) == TUTORING


def test_what_needs_a_rule_that_is_lacking_never_applies() -> None:
    a, b, *_ = rules_of(TUTORING)
    assert without_rules(seq(a, b), [a.name]) is None
    assert without_rules(seq(maybe(a), b), [a.name]) == seq(b)
    assert without_rules(first(a, b), [a.name]) == first(b)
    assert without_rules(first(seq(a, b), a), [a.name]) is None


# --- learners -------------------------------------------------------------------------

KEYS = st.lists(st.sampled_from(range(1, 9)), min_size=1, max_size=6)


def taught(word: LearnedWord, numbers: Iterable[int], world: World) -> LearnedWord:
    for number in numbers:
        word = word.after_lesson(f"o{number}", world.name, holds=number % 3 > 0)
    return word


@given(KEYS)
def test_a_prototype_of_one_lesson_is_that_instance(numbers: list[int]) -> None:
    world, number = draw_world(1, in_view=8), numbers[0]
    one = taught(LearnedWord(noun("cup")), [number], world)
    other = taught(PrototypeWord(noun("cup")), [number], world)
    for x in world.in_view:
        assert other(f"o{x}", world.name) == pytest.approx(one(f"o{x}", world.name))


@given(KEYS, st.randoms())
def test_a_prototype_knows_no_order(numbers: list[int], chance) -> None:
    world = draw_world(1, in_view=8)
    once = taught(PrototypeWord(noun("cup")), numbers, world)
    chance.shuffle(numbers)
    again = taught(PrototypeWord(noun("cup")), numbers, world)
    for x in world.in_view:
        assert again(f"o{x}", world.name) == pytest.approx(once(f"o{x}", world.name))


@given(KEYS)
def test_a_prototype_forgets_as_if_it_had_never_learned(numbers: list[int]) -> None:
    world = draw_world(1, in_view=8)
    before = taught(PrototypeWord(noun("cup")), numbers, world)
    after = taught(before, [1], world).without_lesson(f"cup/{before.count + 1}")
    for x in world.in_view:
        assert after(f"o{x}", world.name) == before(f"o{x}", world.name)


@given(
    st.lists(
        st.sampled_from([(x, y) for x in (1, 2, 3, 4) for y in (5, 6)]), min_size=1
    )
)
def test_prototypes_of_places_are_degrees(pairs: list[tuple[int, int]]) -> None:
    world, word = draw_world(1, in_view=8), PrototypeWord(relation("near"))
    for x, y in pairs:
        word = word.after_lesson(f"o{x}", f"o{y}", world.name, "away")
    for x, y in pairs:
        assert 0.0 < word(f"o{x}", f"o{y}", world.name, "away") <= 1.0


class Counting:
    """A learner that tells how often it was taught each word."""

    def __init__(self) -> None:
        self.keys: dict[object, str] = {}

    def learn_one(self, x: object, label: str, *, key: object = None) -> None:
        self.keys[key] = label

    def predict_proba_one(self, x: object) -> dict[str, float]:
        labels = list(self.keys.values())
        return {it: labels.count(it) / len(labels) for it in labels}


class Forgetful(Counting):
    def forget(self, key: object) -> None:
        del self.keys[key]


@given(
    st.lists(st.lists(st.integers(0, 9), unique=True, min_size=1), min_size=1),
    st.sampled_from([Counting, Forgetful]),
)
def test_a_pupil_knows_what_was_heard(
    lists: list[list[int]], make: Callable[[], Counting]
) -> None:
    pupil: Pupil[str] = Pupil(make)
    for keys in lists:
        heard = [PupilLesson(key, "x", "cup" if key % 2 else "mug") for key in keys]
        new: Pupil[str] = Pupil(make)
        assert pupil.degrees(heard, "y") == new.degrees(heard, "y")


def test_a_pupil_knows_a_lesson_by_all_of_it() -> None:
    pupil: Pupil[str] = Pupil(Forgetful)
    assert pupil.degrees([PupilLesson(1, "x", "cup")], "y") == {"cup": 1.0}
    assert pupil.degrees([PupilLesson(1, "x", "mug")], "y") == {"mug": 1.0}


OWN = """\
class Latest:
    "Takes everything for what it was told last."
    def __init__(self):
        self.told = {}
    def learn_one(self, x, label, *, key=None):
        self.told[key] = label
    def predict_proba_one(self, x):
        return {[*self.told.values()][-1]: 1.0} if self.told else {}
    def forget(self, key):
        del self.told[key]
"""


def test_a_learner_of_ones_own_judges_all_words_of_a_kind(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN)
    own = f"{tmp_path / 'own.py'}:Latest"
    game = game_of(Theory("latest", learners={"noun": own}), WORLD)
    said = dialogue(game, (*NAMING_ANEW, 1, "What is this?", "Forget that.", "Hello."))
    assert said[2:4] == ["This is a car.", "This is a car."]


COLOURS = """\
title = "Colours"
seeds = 1
[theories.default]
[theories.own]
learners.adjective = "own.py:Nearest"
[tutors.Ann]
kind = "simulated"
[scenes.table]
kind = "drawn"
colours = "taught"
each = 3
[[phases]]
do = "teach"
what = "adjectives"
[[phases]]
do = "ask"
what = "adjectives"
"""

NEAREST = """\
from math import dist

class Nearest:
    "Takes a thing to be as the nearest one that it was told of."
    def __init__(self):
        self.told = []
    def learn_one(self, x, label):
        self.told.append((x, label))
    def predict_proba_one(self, x):
        return {min(self.told, key=lambda it: dist(it[0], x))[1]: 1.0}
"""


@pytest.mark.parametrize("name", ["default", "own"])
def test_colours_that_are_taught_are_learned(tmp_path: Path, name: str) -> None:
    (tmp_path / "own.py").write_text(NEAREST)
    study = parse(COLOURS, tmp_path / "study.toml")
    answers = play(study, Run(name, "Ann", "table", 1)).answers
    assert sum(it.is_right for it in answers) > len(answers) / 2
    assert all(it.degrees for it in answers)


DRAWING = """\
import random
import numpy as np

class Drawing:
    "Draws from the generators that everybody has."
    def __init__(self):
        self.words = []
    def learn_one(self, x, label):
        self.words.append(label)
    def predict_proba_one(self, x):
        return {random.choice(self.words): np.random.random()} if self.words else {}
"""

DRAWN = """\
title = "By chance"
seeds = 1
[theories.one]
learners.noun = "own.py:Drawing"
[theories.other]
learners.noun = "own.py:Drawing"
[tutors.Ann]
kind = "simulated"
[scenes.table]
kind = "drawn"
[[phases]]
do = "teach"
[[phases]]
do = "ask"
"""


def test_what_a_learner_draws_follows_from_the_run(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(DRAWING)
    study = parse(DRAWN, tmp_path / "study.toml")
    once, again, other = (
        play(study, Run(it, "Ann", "table", 1)) for it in ("one", "one", "other")
    )
    assert once == again == other
    assert len({it.degree for it in once.answers}) > 4


def test_a_state_of_a_game_with_a_guest_is_played_on_alike(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN)
    own = f"{tmp_path / 'own.py'}:Latest"
    game = game_of(Theory("latest", learners={"noun": own}), WORLD)
    now = game.play([game.hear("This is a cup.")])[-1].run

    def asked() -> list[str]:
        turn = game.take(now, game.hear("What is this?"))
        return [game.say(move) for move in turn.said]

    once = asked()
    game.take(
        game.take(now, game.hear("This is a mug.")).run, game.hear("Is it a mug?")
    )
    assert asked() == once == ["This is a cup."]


@pytest.mark.parametrize("name", ["default", "kille", "angle", "prototype"])
def test_learners_of_places_learn_left_and_right(name: str) -> None:
    game = game_of(Theory(name, learners={"relation": name}), WORLD)
    said = [
        *(1, "This is a cup.", 2, "This is a car."),
        *(1, "This is to the left of the car."),
        *(2, "This is to the right of the cup.", "Where is this?"),
    ]
    assert "to the right of" in dialogue(game, said)[-1]


def test_what_was_learned_is_in_the_model_alone() -> None:
    game = game_of(Theory("p", learners={"noun": "prototype"}), WORLD)
    turn = game.play([game.hear("This is a cup.")])[-1]
    [cup] = [it for it in learned_words(turn.model) if it.sign.form == "cup"]
    assert isinstance(cup, PrototypeWord)
    assert not any(it.lessons for it in learned_words(game.model))


@pytest.mark.parametrize("learner", ["both", "instances", "cues", "kille", "votes"])
def test_the_whole_robot_learns_by_any_of_its_learners(learner: str) -> None:
    theory = Theory(learner, learners={"noun": learner}, mode="driven")
    with agent_of(theory, "synthetic:empty?seed=3", scans=1) as robot:
        robot.do("show cup")
        robot.hear("This is a cup.")
        robot.do("show book")
        robot.hear("This is a book.")
        assert "a book" in robot.hear("What is this?")
        robot.hear("Forget that.")
        assert "a book" not in robot.hear("What is this?").partition("but")[0]


@pytest.mark.parametrize("learner", ["default", "cues", "votes"])
def test_no_answer_depends_on_the_speed_of_the_machine(
    learner: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Background, "begin", lambda *_: pytest.fail("it is in a hurry"))
    theory = Theory(learner, learners={"noun": learner})
    chance = np.random.default_rng(1)
    with Memory.transient() as memory:
        objects = Knowledge(memory, learners_of(theory)).objects
        for key in range(3):
            many = chance.integers(0, 256, (5000, 128), np.uint8)
            objects.learn(View(key, "cup", many, {}))


@pytest.mark.parametrize("learner", ["both", "votes"])
def test_the_whole_robot_knows_its_words_on_another_day(learner: str) -> None:
    theory = Theory(learner, learners={"noun": learner}, mode="driven")
    with agent_of(theory, "synthetic:empty?seed=3", scans=1) as robot:
        robot.do("show cup")
        robot.hear("This is a cup. It is not a book.")
        robot.do("restart")
        assert "a cup" in robot.hear("What is this?")


def test_the_whole_robot_has_the_rules_of_its_theory(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(LESSON)
    theory = Theory("polite", rules=f"{tmp_path / 'own.py'}:admit_name")
    with agent_of(theory, "synthetic:empty?seed=3", scans=1) as robot:
        robot.do("show cup")
        assert robot.hear("What is this?") == "Hello."


# --- shown ----------------------------------------------------------------------------


def test_theories_are_shown_by_the_same_parts() -> None:
    shown = [
        describe(Theory("one")),
        describe(Theory("two", language="sv", without=("hedge_name",))),
        describe(Theory("three", mode="person")),
    ]
    assert len({tuple(it) for it in shown}) == 1
    assert isinstance(shown[0]["state"], TypeNode)
    assert str(shown[1]["noun"]) == "[look : Look, x : Ind, c : kopp(x, look)]"


def test_rules_in_which_theories_differ_are_told(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(LESSON)
    plain = Theory("plain")
    polite = Theory("polite", rules=f"{tmp_path / 'own.py'}:several")
    apart = rules_apart(plain, polite)
    assert list(apart) == ["admit_name"]
    assert "GreetBack" in apart["admit_name"][1]
    assert not rules_apart(plain, Theory("bold", strategy={"bands": {"sure": 0.9}}))


# --- guests ---------------------------------------------------------------------------

PLACES = st.tuples(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.just(0.0)).filter(
    lambda it: abs(it[0]) + abs(it[1]) > 0.01
)
LESSONS = st.lists(
    st.tuples(PLACES, st.sampled_from(["left", "near"]), st.booleans()),
    min_size=1,
    max_size=5,
)


@settings(max_examples=15)
@given(LESSONS, PLACES, st.data())
def test_a_guest_that_is_the_robots_own_memory_changes_nothing(
    lessons: list[tuple[tuple[float, float, float], str, bool]],
    asked: tuple[float, float, float],
    data: st.DataObject,
) -> None:
    own, guest = RelationMemory(), GuestRelations(RelationMemory)
    for memory in (own, guest):
        for key, (place, word, holds) in enumerate(lessons):
            if holds:
                memory.learn_one(Configuration(place), word, key=key)
            else:
                memory.judge_one(Configuration(place), word, 0.0, key=key)
    x = Configuration(asked)
    assert guest.degrees(x) == pytest.approx(own.degrees(x), abs=1e-6)
    gone = data.draw(st.integers(0, len(lessons) - 1))
    before = guest.copy()
    for memory in (own, guest):
        memory.forget(gone)
    assert guest.degrees(x) == pytest.approx(own.degrees(x), abs=1e-6)
    assert guest.degrees_of([x]) == [guest.degrees(x)]
    guest.become(before)
    assert len(guest.degrees(x)) == len({word for _, word, _ in lessons})


def test_degrees_of_a_guest_are_those_that_it_gave() -> None:
    given_ = np.array([0.7, 0.0, 0.3])
    found = Evidence(("a", "b", "c"), 0.0, {"": logits(given_)}).degrees()
    assert list(found.values()) == pytest.approx(given_, abs=1e-6)


# --- meanings of one's own ------------------------------------------------------------

SCRIPT = """\
--- it
@ place 2 7 3
@ point 2
U> This is a car.
@ point 1
U> This is a cup.
@ point 2
U> The cup is big.
U> What is it?
"""

SHOWN = "It    := [x : Ind, look : Look, d : shown(x, look)]"

STUDY = """\
title = "What is it?"
seeds = 1
[theories.mentioned]
[theories.shown]
meanings = "own.ttr"
[theories.inline]
meanings.It = '''[x : Ind, look : Look,
    d : shown(x, look)]'''
[theories.fails]
meanings = "own.ttr"
rules = "own.py:assert_name"
[tutors.script]
kind = "scripted"
file = "it.dlg"
[scenes.table]
kind = "around"
[[phases]]
do = "talk"
"""


@pytest.fixture(scope="module")
def deictic(tmp_path_factory: pytest.TempPathFactory) -> Study:
    """A study of which one theory has it that "it" is what is shown."""
    folder = tmp_path_factory.mktemp("deictic")
    theory = packaged("tutor.ttr")
    mentioned = "It    := [x : Ind, look : Look, d : mentioned(x, look)]"
    assert mentioned in theory
    shown = theory.replace(mentioned, mentioned.replace("mentioned", "shown"))
    (folder / "own.ttr").write_text(shown, encoding="utf-8")
    (folder / "own.py").write_text(
        LESSON.replace("admit_name", "assert_name").replace(
            'return plan(s, "GreetBack")', 'raise ValueError("no idea")'
        )
    )
    (folder / "it.dlg").write_text(SCRIPT)
    (folder / "study.toml").write_text(STUDY)
    return read(folder / "study.toml")


def test_a_theory_may_have_meanings_of_its_own(deictic: Study) -> None:
    last = {
        name: play(deictic, Run(name, "script", "table", 1)).turns[-1].answer
        for name in ("mentioned", "shown", "inline", "mentioned")
    }
    assert last == {
        "mentioned": "This is a cup.",
        "shown": "This is a car.",
        "inline": "This is a car.",
    }


def test_what_has_meanings_of_its_own_is_played_the_same_each_time(
    deictic: Study,
) -> None:
    run = Run("shown", "script", "table", 1)
    assert play(deictic, run) == play(deictic, run)


def test_meanings_of_ones_own_are_shown(deictic: Study) -> None:
    parts = [describe(it) for it in list(deictic.theories.values())[:3]]
    assert list(parts[0]) == list(parts[1])
    assert parts[0]["noun"] is parts[1]["noun"]
    own, other, inline = (dict(it["meanings"]) for it in parts)
    assert other == inline
    assert [name for name in own if own[name] != other[name]] == ["It"]


@pytest.mark.parametrize("name", sorted(theory().definitions))
def test_any_type_can_be_redefined_as_it_is(name: str) -> None:
    text = packaged("tutor.ttr")
    again = redefine(text, {name: str(theory()[name])})
    assert again.count("\n") == text.count("\n")
    [line] = [it for it in again.splitlines() if it.startswith(f"{name} := ")]
    assert line == f"{name} := {theory()[name]}"


def test_what_fails_says_where_it_was_and_leaves_the_others_as_they_were(
    deictic: Study,
) -> None:
    run, other = (Run(it, "script", "table", 1) for it in ("fails", "shown"))
    before = play(deictic, other)
    with pytest.raises(TTRError, match="no idea") as raised:
        play(deictic, run)
    assert "own.py" in "".join(traceback.format_exception(raised.value))
    assert play(deictic, other) == before


def test_who_interrupts_a_theory_leaves_the_others_as_they_were(
    deictic: Study, monkeypatch: pytest.MonkeyPatch
) -> None:
    run, other = (Run(it, "script", "table", 1) for it in ("shown", "inline"))
    before = play(deictic, other)
    with monkeypatch.context() as patched:
        patched.setattr(SimulatedRobot, "hear", _interrupted)
        with pytest.raises(KeyboardInterrupt):
            play(deictic, run)
    assert play(deictic, other) == before
    assert play(deictic, run).turns


def _interrupted(robot: SimulatedRobot, text: str) -> NoReturn:
    raise KeyboardInterrupt


def test_a_theory_that_has_changed_is_read_anew(deictic: Study) -> None:
    theory = deictic.theories["shown"]
    assert isinstance(theory.meanings, str)
    file, shown = Path(theory.meanings), meanings_of(theory)["It"]
    text, at = file.read_text(encoding="utf-8"), file.stat().st_mtime_ns
    try:
        file.write_text(text.replace(SHOWN, "It := Phrase"), encoding="utf-8")
        os.utime(file, ns=(at + 1, at + 1))
        assert meanings_of(theory)["It"] is record_type("Phrase")
    finally:
        file.write_text(text, encoding="utf-8")
        os.utime(file, ns=(at, at))
    assert meanings_of(theory)["It"] is shown


def test_theories_are_played_in_threads_as_alone(deictic: Study) -> None:
    runs = [Run(it, "script", "table", 1) for it in ("mentioned", "shown", "inline")]
    alone = [play(deictic, run).turns for run in runs]
    with ThreadPoolExecutor(len(runs)) as pool:
        together = [it.turns for it in pool.map(partial(play, deictic), runs * 2)]
    assert together == alone * 2
