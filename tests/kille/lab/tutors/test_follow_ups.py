"""What can be said once only, straight after the robot has spoken."""

import pytest

from kille.dialogue.games.confirming import JUST_LEARNED
from kille.dialogue.language import LANGUAGES
from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import predicate_at, record_type
from kille.lab.tutors.follow_ups import follow_ups, sudden_events
from kille.lab.tutors.happenings import SILENCES, interruptions
from kille.lab.tutors.heard_sayings import aside_event
from kille.lab.tutors.leading_kinds import kind_situation, topics_about_known_kinds
from kille.lab.worlds.asides import aside_wordings, asides
from kille.lab.worlds.games import simulated_game, world_of
from kille.lab.worlds.perception import watch_event
from kille.lab.worlds.sayings import WorldTalk
from kille.lab.worlds.vocabulary import vocabulary
from kille.lab.worlds.worlds import Thing, World

WORLD = World(
    (Thing("mug", "red", place=(2, 3)), Thing("book", "blue", place=(6, 3)))
).point_at(1)
ENGLISH = vocabulary("en")


def after(*texts, **strategy):
    game = simulated_game(WORLD, **strategy)
    now = game.begin()
    for text in texts:
        now = game.take(now, game.hear(text)).run
    return now.state


def pressing(*texts):
    state = after(*texts)
    now = kind_situation(WorldTalk(ENGLISH, world_of(state)), state)
    return {one.text for topic in topics_about_known_kinds(now) for one in topic}


def test_of_what_is_named_it_is_denied_that_it_is_something_else():
    assert not pressing()
    assert "No, this is not a cup." in pressing("This is a mug.")


def test_a_kind_is_told_of_which_something_was_said_that_speaks_against_it():
    said = pressing("This is a mug.", "No, this is not a cup.")
    assert "A mug is a kind of cup." in said
    assert "A cup is a kind of mug." not in said


def test_what_is_known_of_kinds_is_denied_and_asked_about():
    told = ("This is a mug.", "A mug is a kind of cup.", "That is correct.")
    said = pressing(*told)
    assert {"A cup is a kind of mug.", "A mug is not a kind of cup."} <= said
    assert {"No, this is not a cup.", "Why is this a cup?"} <= said


def test_a_noun_for_a_part_is_said_of_a_thing():
    assert "This is a shoe." in pressing("This is a mug.", "Mugs always have shoes.")


def test_the_robot_is_cut_off_in_what_it_has_said_and_goes_on_then():
    game = simulated_game(WORLD)
    turn = game.take(game.begin(), game.hear("This is a mug."))
    cut = interruptions(turn.run.state)
    assert [it.uttered for it in cut] == ["…", ""]
    for event in cut:
        now = game.take(turn.run, event).run
        assert now.state.shared.cut
        assert not interruptions(now.state)
        again = game.take(now, game.hear("Go on."))
        assert predicate_at(again.said[0].type, "e").name in JUST_LEARNED


def test_only_a_lively_robot_is_left_in_silence():
    talk = WorldTalk(ENGLISH, WORLD)
    assert not sudden_events(talk, after())
    assert sudden_events(talk, after(turns="lively"))
    assert follow_ups(talk, after())


@pytest.mark.parametrize("silence", SILENCES)
def test_what_is_seen_in_silence_is_such_an_event(silence):
    moved = WORLD.move(1, (8, 8))
    event = watch_event(moved, WORLD, *silence)
    assert (event.came, event.went, event.kept) == (("o1",), ("o1",), ("o2",))
    assert simulated_game(WORLD).model.judge(event, record_type("Watched")).holds


# --- in words of their own -----------------------------------------------------------


def test_the_languages_try_the_same():
    names = [lexicon(language).sections["asides"].keys() for language in LANGUAGES]
    assert all(it == names[0] for it in names)


@pytest.mark.parametrize("language", LANGUAGES)
def test_something_is_heard_of_all_that_is_tried(language):
    state, words = after(language=language), vocabulary(language)
    for name in lexicon(language).sections["asides"]:
        for one in set(asides(words, name)):
            assert "{" not in one.text
            assert aside_event(one, state) is not None, one.text


def test_a_language_of_ones_own_need_try_nothing():
    assert aside_wordings("en", "nothing of the sort") == ()
