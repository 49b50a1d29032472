"""The tutor says everything that they have words for, and knows what is true."""

from string import Formatter

import pytest

from kille.dialogue.language import LANGUAGES, understand
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import (
    denial,
    kind_in,
    meaning_at,
    noun,
    predicate_at,
    set_at,
)
from kille.dialogue.robust_reading.situations import Situation
from kille.dialogue.robust_reading.text_hearing import hear_in_parts
from kille.lab.study import Theory
from kille.lab.theories.meanings import meanings_of
from kille.lab.tutors.answering import is_true
from kille.lab.tutors.exploring import exploring_tutor
from kille.lab.tutors.happenings import happenings
from kille.lab.tutors.heard_sayings import IN_PARTS
from kille.lab.tutors.tested_game import roles_in
from kille.lab.worlds.dialogue_properties import OF_TUTORING
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.sayings import WorldTalk
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.worlds import Thing, World, draw_world
from ttr import RecordType
from ttr.testing import Suite

WORLD = draw_world(1)
ENGLISH = vocabulary("en")


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_move_is_said_and_understood(language):
    for act in WorldTalk(vocabulary(language), WORLD).acts:
        said = WorldTalk(vocabulary(language), WORLD).sayings(act)
        assert said, f"the tutor never says {act}"
        for one in said[::7]:
            heard = understand(one.text, language)
            if act in IN_PARTS:
                known = frozenset(it.form for it in vocabulary(language).nouns.values())
                situation = Situation(things=1, known=known)
                heard = hear_in_parts(heard, situation, language).moves
            found = {
                predicate_at(it.type, "e").name
                for sentence in heard
                for it in sentence.readings
            }
            assert act in found, one.text


@pytest.mark.parametrize("language", LANGUAGES)
def test_all_slots_are_filled(language):
    for act, wordings in lexicon(language).tells.items():
        slots = {it for text in wordings for _, it, _, _ in Formatter().parse(text)}
        texts = [
            one.text for one in WorldTalk(vocabulary(language), WORLD).sayings(act)
        ]
        assert not any("{" in text for text in texts)
        assert len(texts) > 1 or not slots - {None, "by"}


def test_he_knows_what_is_true():
    world = World(
        (Thing("cup", "red", place=(2, 3)), Thing("box", "red", place=(5, 3)))
    )

    def naming(form, x):
        content = set_at(meaning_at(noun(form), "Naming"), "target.x", x)
        assert kind_in("Naming") == "noun"
        assert isinstance(content, RecordType)
        return content

    assert is_true(WorldTalk(ENGLISH, world), naming("cup", "o1"))
    assert not is_true(WorldTalk(ENGLISH, world), naming("cup", "o2"))
    assert is_true(WorldTalk(ENGLISH, world), denial(naming("cup", "o2")))
    assert not is_true(WorldTalk(ENGLISH, world.move(1, None)), naming("cup", "o1"))


def test_things_are_put_taken_moved_and_pointed_at():
    after = happenings(WORLD)
    views = {it.in_view for it in after}
    assert any(len(view) < len(WORLD.in_view) for view in views)
    assert any(len(view) > len(WORLD.in_view) for view in views)
    assert {it.focus for it in after} >= set(WORLD.in_view)
    assert any(not it.deep for it in after)
    assert () in views
    assert happenings(WORLD) == after


def test_games_of_another_theory_are_explored_in_its_types():
    types = meanings_of(Theory("deictic", meanings={"It": "[look : Look, x : Ind]"}))
    suite = Suite(
        simulated_game(WORLD, types=types),
        exploring_tutor("en", types),
        properties=OF_TUTORING,
        roles=roles_in("en", types),
        turns=6,
        examples=10,
        seed=0,
    )
    assert suite.played().explain_failure() == ""
