"""Laws of rule indexes: what they leave out could not be, so nothing else changes."""

from unittest.mock import patch

import pytest
from generators import models, objects, types
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.dialogue.meanings import adjective, noun, relation, theory, word_of
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from ttr import Ind, Model, Pred, record, rectype
from ttr.judging.certainty import is_certain
from ttr.judging.rule_index import RuleIndex, demands_of
from ttr.semantics.gameboards import kos
from ttr.semantics.questions import which
from ttr.updates import First

# --- what an index leaves out ---------------------------------------------------------


@given(st.lists(types(), min_size=1, max_size=5), objects(), models())
def test_what_is_left_out_is_certainly_not_so(several, a, M):
    left = RuleIndex(map(demands_of, several)).possible_demands(a, M.facts)
    assert list(left) == sorted(set(left))
    for number, T in enumerate(several):
        assert number in left or not is_certain(M.facts, a, T)


def test_what_is_open_is_left():
    ask, tell = Pred("ask", Ind), Pred("tell", Ind)
    asks, tells = rectype(e=ask("a")), rectype(e=tell("a"))
    index = RuleIndex(map(demands_of, (asks, tells)))
    told = Model().given("a", Ind).given("s1", ask("a"))
    assert list(index.possible_demands(record(e="s1"), told.facts)) == [0]
    assert list(index.possible_demands(record(e="s2"), told.facts)) == []
    assert list(index.possible_demands(record(x="s1"), told.facts)) == []
    seen = told.witnessed(tell, by=lambda x: 1.0)
    assert list(index.possible_demands(record(e="s1"), seen.facts)) == [0, 1]


# --- the games go on as they would without --------------------------------------------


def without_indexes():
    """Every part is tried, of strategies and of joins."""
    return patch.object(
        RuleIndex, "possible_demands", lambda self, sit, facts: range(len(self._wanted))
    )


def traced(game, events):
    """The rules of each turn and the states that they led to."""
    return [
        [(step.rule.name, step.before, step.after) for step in turn.trace]
        for turn in game.play(events)
    ]


SIGNS = (noun("cup"), noun("book"), adjective("red"), relation("behind"))
DEGREES = {("cup", "o1"): 0.9, ("book", "o2"): 0.8, ("is_red", "o1"): 0.7}


def degree(name):
    return lambda x, *rest: DEGREES.get((name, x), 0.1)


@pytest.fixture(scope="module")
def lessons():
    """The game of tutoring, with two things to see."""
    model = blank_model()
    for x in ("o1", "o2"):
        model = model.given(x, theory()["Ind"])
    model = model.given("look1", theory()["Look"])
    for word in map(word_of, SIGNS):
        model = model.witnessed(word, by=degree(word.name))
    return tutoring(SIGNS, model=model)


VIEW = record(
    look="look1",
    things=["o1", "o2"],
    placed=["o1", "o2"],
    focus=["o1"],
    pointed=[],
)
GLANCE = record(view=VIEW, kept=[], floor="tutor")
SAYINGS = st.sampled_from(
    (
        "What is this?",
        "This is a cup.",
        "No, this is a book.",
        "Is this red?",
        "Where is the cup?",
        "The cup is behind the book.",
        "Yes.",
        "No.",
        "Why?",
        "Hello.",
        "What is the other one?",
        "Forget that.",
        "This is a cupp.",
        "What do you see?",
        "How sure are you?",
    )
)


@settings(max_examples=15, deadline=None)
@given(texts=st.lists(SAYINGS, min_size=1, max_size=6))
def test_lessons_go_on_as_without_indexes(lessons, texts):
    events = [GLANCE, *map(lessons.hear, texts)]
    with without_indexes():
        expected = traced(lessons, events)
    assert traced(lessons, events) == expected


LEFT = which(Pred("leave", Ind))
MOVES = st.sampled_from(
    (
        kos.greet("a", "b"),
        kos.counter_greet("b", "a"),
        kos.ask("a", "b", LEFT),
        kos.answer("b", "a", "kim"),
        kos.assert_that("a", "b", rectype(e=Pred("leave", Ind)("kim"))),
        kos.accept("b", "a", rectype(e=Pred("leave", Ind)("kim"))),
        kos.part("a", "b"),
    )
)


@given(st.lists(MOVES, min_size=1, max_size=6))
def test_gameboards_go_on_as_without_indexes(moves):
    model = Model()
    for name in ("a", "b", "kim"):
        model = model.given(name, Ind)
    board = kos.game(model, "a", "b")
    events = list(map(kos.utterance, moves))
    with without_indexes():
        expected = traced(board, events)
    assert traced(board, events) == expected


def test_most_rules_of_the_lessons_are_left_out(lessons):
    answering = next(
        part.part
        for part in lessons.algorithm.parts[0].parts
        if isinstance(getattr(part, "part", None), First)
        and len(part.part.parts) > len(SIGNS) * 3
    )
    said = lessons.take(lessons.begin(), lessons.hear("Hello."))
    left = answering.rule_index.possible_demands(
        said.trace[0].after, said.trace[0].model.facts
    )
    assert 0 < len(left) < len(answering.parts) / 2
