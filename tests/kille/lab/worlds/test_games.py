"""The games in a simulated world: what is learned is in state and model alone."""

import pytest

from kille.dialogue.meanings import noun, word_of
from kille.lab.worlds.games import learned_words, simulated_game, word, world_of
from kille.lab.worlds.perception import glance_event
from kille.lab.worlds.worlds import Thing, World, draw_world
from ttr.testing.strategies import play

WORLD = World(
    (
        Thing("cup", "red", 0.5, (2, 3)),
        Thing("book", "blue", 0.9, (6, 3)),
        Thing("cup", "blue", 0.5, (2, 8)),
        Thing("car", "green", 0.5, None, "left"),
    )
)


class Talk:
    """A dialogue in a simulated world."""

    def __init__(self, world=WORLD, **settings):
        self.game = simulated_game(world, **settings)
        self.now = self.game.begin()

    def hear(self, text):
        turn = self.game.take(self.now, self.game.hear(text))
        self.now = turn.run
        return "\n".join(map(self.game.say, turn.said))

    def see(self, change):
        before = world_of(self.now.state)
        turn = self.game.take(self.now, glance_event(change(before), before))
        self.now = turn.run

    def degree(self, form, x):
        found = word(self.now.model, word_of(noun(form)))
        return None if found is None else found(x, self.now.state.view.look)


def test_it_learns_to_name_things_from_one_example():
    talk = Talk()
    assert talk.hear("This is a cup.") == "OK, the one on the left (#1) is a cup."
    talk.see(lambda world: world.point_at(2))
    assert talk.hear("This is a book.") == "OK, the one on the right (#2) is a book."
    talk.see(lambda world: world.point_at(3))
    assert talk.hear("What is this?") == "This is a cup."


def test_it_learns_relations_and_says_where_things_are():
    talk = Talk()
    talk.hear("This is a cup.")
    talk.hear("The blue book is a book.")
    talk.see(lambda world: world.move(3, None).point_at(2))
    talk.hear("This is a book.")
    assert "to the left of" in talk.hear("The cup is to the left of the book.")
    talk.see(lambda world: world.move(1, (3, 3)))
    assert talk.hear("Where is the cup?") == "The cup is to the left of the book."


@pytest.mark.parametrize("moved", [1, 2])
def test_what_was_said_of_where_a_thing_was_still_holds_of_that_place(moved):
    talk = Talk()
    talk.hear("This is a cup.")
    talk.see(lambda world: world.move(3, None).point_at(2))
    talk.hear("This is a book.")
    talk.see(lambda world: world.point_at(1))
    talk.hear("This is to the left of the book.")
    talk.see(lambda world: world.move(moved, (9, 9) if moved == 1 else (0, 0)))
    said = talk.hear("No, this is to the right of the book.")
    assert "OK" in said
    held = [it.sign.form for it in talk.now.state.private.lessons]
    assert held.count("to the left of") == held.count("to the right of") == 1


def test_what_is_corrected_of_things_that_stand_still_is_unlearned():
    talk = Talk()
    talk.hear("This is a cup.")
    talk.see(lambda world: world.move(3, None).point_at(2))
    talk.hear("This is a book.")
    talk.see(lambda world: world.point_at(1))
    talk.hear("This is behind the book.")
    talk.see(lambda world: world.look_again())
    talk.hear("No, this is to the left of the book.")
    held = {it.sign.form for it in talk.now.state.private.lessons}
    assert held >= {"to the left of"}
    assert "behind" not in held


def test_what_is_forgotten_was_never_learned():
    talk = Talk()
    talk.hear("This is a cup.")
    before = [talk.degree("cup", x) for x in ("o1", "o2", "o3")]
    talk.hear("This is a cup.")
    assert [talk.degree("cup", x) for x in ("o1", "o2", "o3")] != before
    talk.hear("Forget the last thing.")
    assert [talk.degree("cup", x) for x in ("o1", "o2", "o3")] == before
    talk.hear("Forget cup.")
    assert not talk.now.state.private.nouns
    assert not talk.now.state.private.lessons


def test_what_was_learned_is_in_the_model():
    game = simulated_game(WORLD)
    begun = game.begin()
    after = game.take(begun, game.hear("This is a cup.")).run
    assert [it.sign.form for it in learned_words(after.model) if it.lessons] == ["cup"]
    assert not any(it.lessons for it in learned_words(begun.model))
    again = game.take(begun, game.hear("This is a cup.")).run
    assert again.state == after.state


def test_a_dialogue_is_the_same_when_it_is_played_again():
    texts = ["This is a cup.", "What is this?", "That is correct.", "Forget cup."]
    game = simulated_game(WORLD)
    assert play(game, texts).states == play(game, texts).states


@pytest.mark.parametrize("mode", ["driven", "assisted", "autonomous"])
@pytest.mark.parametrize("wording", ["paper", "four"])
def test_it_plays_every_strategy(mode, wording):
    talk = Talk(mode=mode, wording=wording)
    assert talk.hear("This is a cup.")
    assert talk.now.state.private.nouns


def test_it_talks_swedish():
    talk = Talk(language="sv")
    assert "kopp" in talk.hear("Det här är en kopp.")
    assert "kopp" in talk.hear("Vad är det här?")


def test_drawn_worlds_differ_in_what_things_look_like():
    one, other = draw_world(1), draw_world(2)
    assert one.name != other.name
    assert one.traits != other.traits


def test_asked_why_something_is_not_so_it_says_when_it_was_told():
    talk = Talk(WORLD.point_at(2))
    talk.hear("This is not a cup.")
    talk.hear("Is this a cup?")
    assert talk.hear("Why?") == 'Because you said so a moment ago ("cup").'


def test_where_no_places_are_seen_only_the_name_is_learned_of_what_is_asked_together():
    talk = Talk(World(WORLD.things[:2], deep=False).point_at(1))
    talk.hear("This is a cup.")
    assert "And that" in talk.hear("The red one is to the left of the book.")
    answer = talk.hear("Yes.")
    assert "is a book" in answer
    assert not talk.now.state.private.relations


def test_who_has_something_else_forgotten_does_not_take_back_what_is_asked_about():
    talk = Talk(World(WORLD.things[:2]).point_at(1))
    for text in (
        "This is a cup.",
        "The blue one is big.",
        "No, this is not a mug.",
        "The blue one is a mug.",
        "A cup is a kind of mug.",
    ):
        talk.hear(text)
    assert talk.now.state.shared.qud[0].ask == "AskKindStill"
    answer = talk.hear("Forget that the blue one is big.")
    assert answer == "OK, I forgot that this is big."
