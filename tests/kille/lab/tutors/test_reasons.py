"""Tutors who correct reasons, and nouns whose reasons can be corrected."""

from __future__ import annotations

from itertools import pairwise
from random import Random

import pytest

from kille.dialogue.meanings import noun
from kille.lab.playing_dialogues.talking import play
from kille.lab.scenes.drawn import draw_scene
from kille.lab.scenes.kinds import SETTINGS
from kille.lab.settings import fill_settings
from kille.lab.study import Named, Phase, Run, Study, Theory
from kille.lab.theories.simulated_words import CueWord
from kille.lab.tutors.words import Words
from kille.lab.worlds.worlds import Thing, World
from ttr import record

THINGS = (
    Thing("cup", "red", 0.5, (1, 1)),
    Thing("book", "blue", 0.5, (3, 1)),
    Thing("cup", "blue", 0.5, (5, 1)),
)
LOOK = World(THINGS, noise=0.01).name


def cup() -> CueWord:
    return CueWord(noun("cup")).after_lesson("o1", LOOK)


def test_a_noun_is_judged_by_shape_colour_and_size() -> None:
    word = cup()
    assert word.weights() == pytest.approx([1 / 3] * 3)
    assert word("o1", LOOK) > word("o3", LOOK) > word("o2", LOOK)


def test_what_does_not_matter_makes_no_difference() -> None:
    word = cup().after_criterion("colour", False)
    assert word.weights() == pytest.approx([0.5, 0.0, 0.5])
    assert word("o3", LOOK) == pytest.approx(word("o1", LOOK), abs=0.02)
    cues = dict(word.cues(word.lessons[0].of))
    assert "colour" not in cues
    assert sum(cues.values()) == pytest.approx(1.0)


def test_what_matters_has_half_of_the_shares() -> None:
    assert cup().after_criterion("shape", True).weights()[0] == pytest.approx(0.5)


def test_taking_it_back_restores_the_degrees() -> None:
    word = cup()
    told = word.after_criterion("colour", False).after_criterion("size", False)
    first, second = told.criteria
    assert told.without_lesson(first.key).without_lesson(second.key)("o3", LOOK) == (
        word("o3", LOOK)
    )
    assert told.without_lesson(second.key).weights() == pytest.approx([0.5, 0.0, 0.5])


@pytest.mark.parametrize("language", ["en", "sv"])
def test_tutors_hear_which_cues_decide(language: str) -> None:
    cues = [("hue", 0.4), ("form", 0.3), ("outline", 0.2), ("size", 0.1)]
    shares = [record(name=name, share=share) for name, share in cues]
    assert Words(language).cited_cues(shares) == ("shape", "colour")


def test_things_are_taught_alike() -> None:
    set_ = fill_settings({"each": 3, "new": 8, "alike": True}, SETTINGS["drawn"])
    scene = draw_scene(set_, Random(1))
    for kind in scene.kinds:
        taught = [scene.start.thing(x) for x in scene.taught]
        kept = [scene.start.thing(x) for x in scene.kept]
        assert len({(it.colour, it.size) for it in taught if it.kind == kind}) == 1
        assert len({it.colour for it in kept if it.kind == kind}) > 1


def study(feedback: str, *matters: str) -> Study:
    settings = {"feedback": feedback, "matters": list(matters)}
    scene = {"each": 2, "new": 4, "alike": True, "noise": 0.1}
    return Study(
        "reasons",
        {"cues": Theory("cues", learners={"noun": "cues"})},
        {"ann": Named("ann", "simulated", settings)},
        {"table": Named("table", "drawn", scene)},
        (
            Phase("lessons", "teach"),
            Phase("practice", "practise", {"of": "new", "order": "shuffled"}),
        ),
        (1,),
    )


RUN = Run("cues", "ann", "table", 1)


@pytest.mark.parametrize(
    ("feedback", "act"), [("confirm", "reject"), ("both", "correct")]
)
def test_they_ask_why_and_correct_the_reason(feedback: str, act: str) -> None:
    turns = play(study(feedback, "shape"), RUN).turns
    assert any(it.act == "weigh_cue" for it in turns)
    for asked, then in pairwise(turns):
        if asked.act == "ask_why":
            assert then.act in ("weigh_cue", act)
            named = asked.answer.partition(":")[0]
            assert (then.act == "weigh_cue") is ("colour" in named or "size" in named)
        if asked.act == "weigh_cue":
            assert asked.answer.startswith("OK, I do not go by the ")
            assert then.act in ("weigh_cue", act)
    assert all("shape" not in it.given for it in turns if it.act == "weigh_cue")
    assert not any(it.act == "deny" for it in turns)


def test_who_knows_no_reasons_asks_for_none() -> None:
    acts = {it.act for it in play(study("both"), RUN).turns}
    assert not acts & {"ask_why", "weigh_cue", "reject"}
