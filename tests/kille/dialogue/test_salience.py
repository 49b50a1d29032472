"""Which thing "it", "this" and "that" are: by what is seen, and by what was said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from kille.dialogue.games import TUTORING
from kille.dialogue.games.attending import weigh_salience
from kille.dialogue.meanings import (
    adjective,
    noun,
    record_type,
    relation,
    theory,
    value_at,
    word_of,
)
from kille.dialogue.reference import set_salience
from kille.dialogue.reference.salience import saliences
from kille.dialogue.rules import rule
from kille.dialogue.state import blank_model
from kille.dialogue.strategies import strategy
from kille.dialogue.tutoring import tutoring
from kille.lab.study import Theory
from kille.lab.theories import game_of
from kille.lab.worlds.games import simulated_game
from kille.lab.worlds.perception import glance_event, look_event, sights
from kille.lab.worlds.worlds import Thing, World
from ttr import Record, RecordType, record, replace
from ttr.updates import Game, Run, replace_rules

SIGNS = (noun("cup"), noun("book"), adjective("red"), relation("behind"))
KNOWN = {("cup", "o1"): 0.9, ("book", "o2"): 0.9, ("behind", "o2", "o1"): 0.9}

BIG, SMALL, LIKE = (0.9, 0.9, 1.0), (0.1, 0.1, 0.4), (0.5, 0.5, 0.5)
"""How things look: size, centrality and nearness."""


def degree(word: str, arity: int, *args: str) -> float:
    return KNOWN.get((word, *args[:arity]), 0.0)


class Table:
    """Things in view that look in these ways, and a robot that is spoken to."""

    def __init__(
        self, *looks: tuple[float, float, float] | None, game: Game | None = None
    ) -> None:
        self.names = [f"o{n}" for n in range(1, len(looks) + 1)]
        self.looks = looks
        self.game = tutoring(SIGNS, model=self._model()) if game is None else game
        self.now: Run = replace_model(self.game, self._model())
        self.look()

    def _model(self) -> Any:
        model = blank_model().given("look1", theory()["Look"])
        for x in self.names:
            model = model.given(x, theory()["Ind"])
        for sign in SIGNS:
            arity = 2 if sign.kind == "relation" else 1
            word = word_of(sign)
            model = model.witnessed(word, by=partial(degree, word.name, arity))
        return model

    def look(
        self, *pointed: str, focus: str = "o1", kept: Sequence[str] | None = None
    ) -> None:
        """Look, while these things are pointed at; others than `kept` are new."""
        view = record(
            look="look1",
            things=self.names,
            placed=self.names,
            focus=pointed or (focus,),
            pointed=pointed,
        )
        seen = [
            record(x=x, size=it[0], centrality=it[1], nearness=it[2])
            for x, it in zip(self.names, self.looks, strict=True)
            if it is not None
        ]
        stayed = self.names if kept is None else kept
        looks = {"sights": seen} if seen else {}
        self.take(record(view=view, kept=stayed, floor="tutor", **looks))

    def take(self, event: object) -> list[str]:
        turn = self.game.take(self.now, event)
        self.now = turn.run
        assert self.game.say is not None
        return [self.game.say(move) for move in turn.said]

    def hear(self, *texts: str) -> list[str]:
        """What the robot says to these texts."""
        assert self.game.hear is not None
        return [said for text in texts for said in self.take(self.game.hear(text))]

    @property
    def state(self) -> Record:
        return self.now.state

    @property
    def degrees(self) -> Mapping[str, float]:
        return saliences(self.state)

    def taught(self) -> list[str]:
        """The things of the lessons, in order."""
        return [thing_of(it.content) for it in self.state.private.lessons]


def replace_model(game: Game, model: Any) -> Run:
    return game.begin()._replace(model=model)


def thing_of(content: RecordType) -> str:
    target = content["target"]
    assert isinstance(target, RecordType)
    return str(value_at(target, "x"))


# --- what is seen --------------------------------------------------------------------


def test_without_talk_it_is_what_stands_out_most() -> None:
    for looks, x in (((SMALL, BIG), "o2"), ((BIG, SMALL), "o1")):
        table = Table(*looks)
        table.hear("It is red.")
        assert table.taught() == [x]


def test_where_two_things_stand_out_alike_a_lesson_is_asked_about() -> None:
    for looks in ((LIKE, LIKE), (None, None), (BIG, (0.8, 0.9, 0.9)), (None, LIKE)):
        table = Table(*looks)
        [asked] = table.hear("It is red.")
        assert asked.endswith("?")
        assert table.taught() == []
        table.hear("The book.")
        assert table.taught() == ["o2"]


def test_a_question_about_what_is_not_plain_is_about_the_focus() -> None:
    for focus, answer in (("o1", "This is a cup."), ("o2", "This is a book.")):
        table = Table(LIKE, LIKE)
        table.look(focus=focus)
        assert table.hear("What is it?") == [answer]


def test_what_is_new_stands_out_more() -> None:
    table = Table(LIKE, LIKE, LIKE)
    table.look(kept=["o1", "o3"], focus="o1")
    table.hear("It is red.")
    assert table.degrees["o2"] > table.degrees["o1"] == table.degrees["o3"]


def test_facts_that_are_missing_make_no_difference() -> None:
    table = Table(None, None, None)
    table.hear("It is red.")
    assert table.state.shared.sights == ()
    assert len(set(table.degrees.values())) == 1


def test_what_is_pointed_at_is_meant() -> None:
    table = Table(BIG, SMALL)
    table.hear("The cup is red.")
    table.look("o2")
    table.hear("It is red.")
    assert table.taught() == ["o1", "o2"]
    assert table.degrees["o2"] == 1.0


def test_pointing_that_was_not_taken_up_fades() -> None:
    table = Table(LIKE, LIKE)
    table.look("o2")
    table.hear("The cup is red.", "It is old.")
    assert table.taught() == ["o1", "o1"]


# --- what is said --------------------------------------------------------------------


def test_what_was_talked_about_last_is_meant_however_it_looks() -> None:
    table = Table(BIG, SMALL)
    table.hear("The cup is red.", "The book is red.", "It is old.")
    assert table.taught() == ["o1", "o2", "o2"]


def test_the_target_is_meant_rather_than_the_landmark() -> None:
    table = Table(BIG, SMALL)
    table.hear("The book is behind the cup.", "It is red.")
    assert table.taught() == ["o2", "o2"]


def test_what_was_said_long_ago_gives_way_to_what_is_seen() -> None:
    for moves, x in ((2, "o2"), (12, "o1")):
        table = Table(BIG, SMALL)
        table.hear("The book is red.", *["Hello."] * moves, "It is old.")
        assert table.taught() == ["o2", x]


def test_in_between_the_robot_asks() -> None:
    table = Table(BIG, SMALL)
    said = table.hear("The book is red.", *["Hello."] * 7, "It is old.")
    assert said[-1].endswith("?")
    assert table.taught() == ["o2"]


def test_the_robot_mentions_things_as_well() -> None:
    """What it has told of several things leaves open which one it is."""
    table = Table(LIKE, LIKE, LIKE)
    table.look("o1")
    table.hear("This is old.")
    table.look("o3")
    table.hear("This is old.", "Where are the old ones?")
    [asked] = table.hear("Is it red?")
    assert asked.endswith("?")


def test_it_is_another_thing_than_the_one_it_is_beside() -> None:
    table = Table(BIG, SMALL)
    table.hear("The cup is red.")
    assert table.hear("Is it behind the cup?") == ["Yes, it is behind the cup."]


def test_one_and_the_same_thing_is_not_beside_itself() -> None:
    table = Table(LIKE)
    said = table.hear("The cup is red.", "It is behind the cup.")
    assert said[-1] == "That would be one and the same thing."


# --- "this" and "that" ---------------------------------------------------------------


def test_that_is_farther_away_than_this() -> None:
    near, middle, far = (0.5, 0.5, 1.0), (0.5, 0.5, 0.8), (0.5, 0.5, 0.5)
    for text, x in (("What is this?", "o1"), ("What is that?", "o3")):
        table = Table(near, middle, far)
        table.hear(text)
        assert table.state.shared.topic == (x,)


def test_where_two_things_are_as_far_away_the_robot_asks() -> None:
    table = Table(LIKE, LIKE, LIKE)
    [asked] = table.hear("What is that?")
    assert asked.endswith("?")


def test_this_and_that_of_questions_are_two_things() -> None:
    table = Table(LIKE, LIKE)
    said = table.hear("What is this?", "What is that?", "What is this?")
    assert said == ["This is a cup.", "This is a book.", "This is a cup."]
    assert table.hear("Hello.", "What is that?") == ["Hello.", "This is a cup."]


def test_both_are_what_is_pointed_at() -> None:
    for word in ("this", "that"):
        table = Table(LIKE, LIKE)
        table.look("o2")
        assert table.hear(f"What is {word}?") == ["This is a book."]


@pytest.mark.parametrize("word", ["This", "That", "It"])
def test_nothing_is_learned_of_what_is_not_plain(word: str) -> None:
    table = Table((0.5, 0.5, 1.0), (0.5, 0.5, 0.8))
    [asked] = table.hear(f"{word} is old.")
    assert asked.endswith("?")
    assert table.taught() == []


# --- in the state, and elsewhere -----------------------------------------------------


def test_the_facts_and_the_degrees_are_in_the_state() -> None:
    table = Table(BIG, SMALL)
    table.look("o2")
    table.hear("This is old.", "Is it red?")
    shared = table.state.shared
    assert [it.x for it in shared.sights] == ["o1", "o2"]
    noticed = [(it.x, it.role, it.move) for it in shared.noticed]
    assert noticed == [("o2", "target", 2.0), ("o2", "shown", 0.5)]
    assert [it.x for it in shared.salience] == ["o1", "o2"]
    model = table.now.model
    assert model.judge(table.state, record_type("State")).holds
    for name in ("sights", "noticed", "salience"):
        wrong = replace(table.state, {f"shared.{name}": [record(x="o1")]})
        assert not model.judge(wrong, record_type("State")).holds


def test_degrees_are_computed_only_where_a_word_needs_them() -> None:
    table = Table(BIG, SMALL)
    table.hear("The cup is red.", "What do you see?", "Where is the book?")
    assert table.state.shared.salience == ()


def test_what_is_gone_is_forgotten() -> None:
    table = Table(BIG, SMALL)
    table.hear("The cup is red.")
    table.look(kept=["o2"])
    assert {it.role for it in table.state.shared.noticed if it.x == "o1"} == {"new"}


WORLD = World((Thing("cup", "red", 0.9, (5, 0)), Thing("box", "blue", 0.1, (0, 9))))


def test_a_simulated_world_says_how_things_look() -> None:
    big, small = sights(WORLD)
    assert (big.size, small.size) == (0.9, 0.1)
    assert big.centrality > small.centrality
    assert big.nearness > small.nearness
    flat = sights(WORLD.flip_depth())
    assert [it.nearness for it in flat] == [0.5, 0.5]


def test_pointing_in_a_simulated_world() -> None:
    game, shown = simulated_game(WORLD), WORLD.point_at(2)
    now = game.take(game.begin(), look_event(WORLD.point_at(1), WORLD)).run
    now = game.take(now, game.hear("This is a cup.")).run  # type: ignore[misc]
    now = game.take(now, glance_event(shown, WORLD)).run
    now = game.take(now, game.hear("It is a box.")).run  # type: ignore[misc]
    assert [thing_of(it.content) for it in now.state.private.lessons] == ["o1", "o2"]


# --- other theories ------------------------------------------------------------------


@rule(when="State", on="Heard")
def by_talk_alone(s: Record, said: Record) -> Record:
    """Only the order counts in which things were talked about."""
    return set_salience(s, lambda it, weights: it.linguistic**0.1)


LONG_AGO = ("The book is red.", *["Hello."] * 12, "It is old.")


def test_another_rule_weighs_otherwise() -> None:
    table = Table(BIG, SMALL)
    table.hear(*LONG_AGO)
    assert table.taught() == ["o2", "o1"]
    rules = replace_rules(TUTORING, {weigh_salience.name: by_talk_alone})
    game = tutoring(SIGNS, rules=rules, model=table._model())
    other = Table(BIG, SMALL, game=game)
    other.hear(*LONG_AGO)
    assert other.taught() == ["o2", "o2"]


OWN = """\
from kille.dialogue.reference import set_salience
from kille.dialogue.rules import rule

@rule(when="State", on="Heard")
def weigh_salience(s, said):
    "Only the order counts in which things were talked about."
    return set_salience(s, lambda it, weights: it.linguistic ** 0.1)
"""


def test_a_theory_of_a_study_weighs_otherwise(tmp_path: Path) -> None:
    (tmp_path / "own.py").write_text(OWN)
    own = Theory("own", rules=f"{tmp_path}/own.py:weigh_salience")
    said = ["This is a box.", *["Hello."] * 14, "It is old."]
    things = {}
    for it in (Theory("usual"), own):
        game = game_of(it, WORLD)
        now = game.take(game.begin(), look_event(WORLD.point_at(2), WORLD)).run
        for text in said:
            now = game.take(now, game.hear(text)).run  # type: ignore[misc]
        lessons = now.state.private.lessons
        things[it.name] = [thing_of(one.content) for one in lessons]
    assert things == {"usual": ["o2", "o1"], "own": ["o2", "o2"]}


def test_a_strategy_may_leave_out_what_is_seen() -> None:
    weighed = replace(strategy(), {"salience.visual": 0.0})
    game = tutoring(SIGNS, model=Table(BIG, SMALL)._model())
    start = replace(game.start, {"private.strategy": weighed})
    table = Table(BIG, SMALL, game=game)
    table.now = table.now._replace(state=start)
    table.look()
    [asked] = table.hear("It is red.")
    assert asked.endswith("?")
    assert table.taught() == []


def test_a_file_of_strategies_may_say_nothing_of_salience(tmp_path: Path) -> None:
    text = Path("grammars/strategies.toml").read_text(encoding="utf-8")
    before, _, _ = text.partition("[salience]")
    (tmp_path / "strategies.toml").write_text(f"{before}[salience]\nmargin = 0.2\n")
    own = strategy(language=f"{tmp_path}/en").salience
    usual = strategy().salience
    assert own == replace(usual, margin=0.2)
