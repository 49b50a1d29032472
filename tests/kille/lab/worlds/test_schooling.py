"""Games that begin when some lessons have been given."""

import pytest

from kille.dialogue.meanings import record_type
from kille.lab.worlds.games import learned_words, simulated_game
from kille.lab.worlds.schooling import (
    continue_game,
    game_after_school,
    game_next_day,
    kinds_told,
)
from kille.lab.worlds.worlds import draw_world

WORLD = draw_world(1)
BLANK = simulated_game(WORLD)
AFTER = game_after_school(BLANK)


@pytest.mark.parametrize("language", ["en", "sv"])
@pytest.mark.parametrize("times", [1, 3])
def test_all_that_is_in_view_was_named_and_placed(language, times):
    game = game_after_school(simulated_game(WORLD, language=language), language, times)
    lessons = [
        len(it.lessons) for it in learned_words(game.model) if it.sign.kind == "noun"
    ]
    assert lessons == [times] * len(WORLD.in_view)
    assert len(game.start.private.relations) > 1
    assert game.model.judge(game.start, record_type("State")).holds


def test_nothing_was_said_of_what_is_in_view_now_but_a_front():
    assert AFTER.start.view.things == BLANK.start.view.things
    assert not AFTER.start.shared.here
    assert len(AFTER.start.shared.turned) == 1


def test_on_another_day_words_are_known_and_talk_is_not():
    game = game_next_day(AFTER)
    private, shared = game.start.private, game.start.shared
    for kind in ("nouns", "adjectives", "relations", "colours"):
        assert private[kind] == AFTER.start.private[kind]
    assert not private.lessons
    assert not shared.commitments
    assert not shared.turned
    taught = {it.sign: it.lessons for it in private.taught}
    assert taught == {
        it.sign: float(len(it.lessons))
        for it in learned_words(game.model)
        if it.lessons
    }


def test_the_latest_lesson_of_another_day_is_taken_back():
    game = game_next_day(AFTER)
    turn = game.take(game.begin(), game.hear("Forget the last thing."))
    (undone,) = turn.said[0].sit.undone
    before, after = (
        [x.key for it in learned_words(model) for x in it.lessons]
        for model in (game.model, turn.model)
    )
    assert set(before) - set(after) == {undone.key}


@pytest.mark.parametrize("language", ["en", "sv"])
def test_on_another_day_it_is_known_what_was_told_of_kinds(language):
    game = game_after_school(simulated_game(WORLD, language=language), language)
    told = kinds_told(language, game.start.private.nouns)
    private = game_next_day(continue_game(game, told)).start.private
    assert [it.after for it in private.kinds] == [-1.0]
    assert [it.after for it in private.criteria] == [-1.0, -1.0]
