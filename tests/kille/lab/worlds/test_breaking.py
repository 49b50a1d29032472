"""The properties of tutoring find the faults that they are about."""

from dataclasses import replace

import pytest

from kille.dialogue.meanings import noun, set_to, theory, word_of
from kille.lab.tutors.tested_game import roles
from kille.lab.worlds.dialogue_properties import (
    GROUNDED,
    HONEST,
    LOCAL,
    RETRACTED,
    WORDED,
)
from kille.lab.worlds.games import act, simulated_game, word
from kille.lab.worlds.word_learning import LearnedWord
from kille.lab.worlds.worlds import Thing, World
from ttr import replace as changed
from ttr.testing.strategies import Dialogue, play

WORLD = World((Thing("cup", "red", 0.5, (2, 3)), Thing("book", "blue", 0.9, (6, 3))))
GAME = simulated_game(WORLD)
TEXTS = ["This is a cup.", "What is this?", "That is correct.", "What is this?"]


def breach(dialogue, one):
    found = one.breach(dialogue, roles)
    return found and found.why


@pytest.mark.parametrize("one", [GROUNDED, HONEST, LOCAL, RETRACTED, WORDED])
def test_the_games_as_they_are_break_none(one):
    dialogue = play(GAME, [*TEXTS, "Forget that.", "Forget cup."])
    assert breach(dialogue, one) is None


def test_what_was_said_of_a_kind_in_a_forgotten_word_is_forgotten_too():
    told = [*TEXTS, "Cups are usually red.", "Forget red."]
    dialogue = play(GAME, told)
    cup = word(dialogue.now.model, word_of(noun("cup")))
    assert cup is not None
    assert cup.lessons
    assert not cup.criteria
    assert breach(dialogue, LOCAL) is None


def test_who_learns_another_word_as_well_is_found():
    def spilling(planned, model):
        move, model = act(planned, model)
        mug = LearnedWord.without_lessons(noun("mug")).after_lesson("o1", WORLD.name)
        return move, model.witnessed(word_of(noun("mug")), by=mug)

    game = replace(simulated_game(WORLD, [noun("mug")]), act=spilling)
    assert "'mug'" in breach(play(game, TEXTS), LOCAL)


def test_who_learns_about_what_nobody_spoke_of_is_found():
    def guessing(planned, model):
        move, model = act(planned, model)
        elsewhere = set_to(noun("cup").meaning, look=theory()["Look"] @ "look0")
        teaches = [elsewhere for _ in move.teaches]
        return changed(move, teaches=teaches), model

    dialogue = play(replace(GAME, act=guessing), TEXTS)
    assert "a look that was not talked of" in breach(dialogue, GROUNDED)


def test_who_takes_back_what_nobody_named_is_found():
    taught = play(GAME, TEXTS)
    emptied = changed(taught.now.state, {"shared.commitments": []})
    last = taught.trials[-1]
    turn = replace(last.turn, run=last.turn.run._replace(state=emptied))
    forgetful = Dialogue(GAME, (*taught.trials[:-1], replace(last, turn=turn)))
    assert "though nobody named it" in breach(forgetful, RETRACTED)


def test_who_has_no_words_is_found():
    silent = replace(GAME, say=lambda move: "")
    assert "is worded ''" in breach(play(silent, TEXTS), WORDED)


def test_who_is_more_certain_of_less_is_found():
    taught = play(GAME, TEXTS)
    asked = [it for it in taught.trials if it.after.state.private.beliefs]
    doubtful = []
    for p, trial in zip((0.9, 0.8), asked, strict=True):
        (belief, *_) = trial.after.state.private.beliefs
        rival = changed(belief, p=p)
        state = changed(trial.after.state, {"private.beliefs": [rival, rival]})
        turn = replace(trial.turn, run=trial.turn.run._replace(state=state))
        doubtful.append(replace(trial, turn=turn))
    tied = Dialogue(GAME, tuple(doubtful))
    assert "only one is named" in breach(tied, HONEST)
