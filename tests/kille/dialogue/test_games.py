"""The paper's games as rules alone: what is said, given how probable things are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import noun, predicate_at, record_type, word_of
from kille.dialogue.tutoring import tutoring

Make = Callable[..., Any]

with_scenes = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])

# --- how certain it is ---------------------------------------------------------------

CERTAINTY = {"admit_name": 0, "guess_name": 1, "hedge_name": 1, "assert_name": 2}


def answer_for(scene: Make, best: float, second: float) -> str:
    known = {("book", "o1"): best, ("mug", "o1"): second}
    [act] = scene(nouns=("book", "mug"), known=known).acts("What is this?")
    return str(act)


@pytest.mark.parametrize(
    ("best", "second", "act"),
    [
        (0.9, 0.05, "assert_name"),
        (0.6, 0.29, "assert_name"),
        (0.6, 0.31, "hedge_name"),
        (0.59, 0.05, "hedge_name"),
        (0.59, 0.04, "guess_name"),
        (0.2, 0.0, "guess_name"),
        (0.19, 0.1, "admit_name"),
        (0.0, 0.0, "admit_name"),
    ],
)
def test_the_bands_decide_how_it_answers(
    scene: Make, best: float, second: float, act: str
) -> None:
    assert answer_for(scene, best, second) == act


@with_scenes
@given(a=st.floats(0, 1), b=st.floats(0, 1), c=st.floats(0, 1))
def test_stronger_words_need_stronger_reasons(
    scene: Make, a: float, b: float, c: float
) -> None:
    second, low, high = sorted((a, b, c))
    weaker, stronger = (answer_for(scene, it, second) for it in (low, high))
    assert CERTAINTY[weaker] <= CERTAINTY[stronger]


@with_scenes
@given(p=st.floats(0.05, 0.5))
def test_a_tie_is_never_asserted(scene: Make, p: float) -> None:
    assert answer_for(scene, p, p) in {"hedge_name", "admit_name"}


def test_a_hedge_names_both_the_more_probable_first(scene: Make) -> None:
    known = {("book", "o1"): 0.3, ("mug", "o1"): 0.4}
    robot = scene(nouns=("book", "mug"), known=known)
    said = robot.hear("What is this?")
    assert said.index("mug") < said.index("book")
    assert len(robot.state.shared.pending) == 2
    assert robot.acts("Yes.") == ["ask_which"]


# --- what is learned, and from what --------------------------------------------------


def test_a_word_is_known_when_the_robot_has_said_so(scene: Make) -> None:
    robot = scene()
    assert robot.acts("This is a cup.") == ["learned"]
    assert [sign.form for sign in robot.state.private.nouns] == ["cup"]
    assert robot.state.private.agenda == ()
    (agreed,) = robot.state.shared.commitments
    assert str(agreed["target"]["x"]) == "Ind@o1"
    assert str(agreed["c"]) == "cup(.target.x, .look)"


def test_a_word_that_it_can_judge_need_not_be_learned(scene: Make) -> None:
    robot = scene(2, nouns=["cup"], known={("cup", "o1"): 0.9})
    assert robot.acts("Where is the mug?") == ["unknown_noun"]
    judged = robot.now.model.witnessed(word_of(noun("mug")), by=lambda x, look: 0.0)
    robot.now = robot.now._replace(model=judged)
    assert robot.acts("Where is the mug?") == ["see_no_such"]


def test_a_word_heard_twice_is_known_once(scene: Make) -> None:
    robot = scene()
    robot.hear("This is a cup.")
    robot.hear("It's a cup.")
    assert len(robot.state.private.nouns) == 1
    assert len(robot.state.shared.commitments) == 1


def test_only_the_last_claim_can_be_confirmed_and_only_once(scene: Make) -> None:
    known = {("cup", "o1"): 0.9}
    robot = scene(nouns=("cup",), known=known)
    robot.hear("What is this?")
    assert robot.acts("That is correct.") == ["learned"]
    assert robot.acts("That is correct.") == ["wonder"]
    robot.hear("What is this?")
    robot.hear("Hello.")
    assert robot.acts("Yes.") == ["wonder"]


def test_nothing_in_view_teaches_nothing(scene: Make) -> None:
    for text in ("This is a cup.", "What is this?"):
        assert scene(things=0).acts(text) == ["see_nothing"]


# --- where things are ----------------------------------------------------------------

TWO = {("book", "o1"): 0.9, ("box", "o2"): 0.9}
KNOWING: dict[str, Any] = {"things": 2, "nouns": ("book", "box")}
SAYING = "The book is to the left of the box."
ASKING = "Where is the book?"


def test_it_asks_where_two_known_things_are_but_only_once(scene: Make) -> None:
    robot = scene(**KNOWING, known=TWO)
    assert robot.look() == ["ask_relation"]
    assert robot.look() == []


@pytest.mark.parametrize(
    "about",
    [
        {"known": {("book", "o1"): 0.9, ("book", "o2"): 0.9}},
        {"known": TWO, "placed": 1},
        {"known": TWO, "placed": 0},
        {"relations": ("near",), "known": TWO | {("near", "o1", "o2"): 0.9}},
    ],
    ids=["both the same", "one placed", "no depth", "it can say"],
)
def test_it_does_not_ask_where_it_should_not(
    scene: Make, about: dict[str, Any]
) -> None:
    assert "ask_relation" not in scene(**KNOWING, **about).look()


def test_a_relation_is_learned_of_the_two_things_that_fit(scene: Make) -> None:
    robot = scene(**KNOWING, known=TWO)
    assert robot.acts(SAYING) == ["learned_relation"]
    (content,) = robot.state.shared.commitments
    assert str(content["target"]["x"]) == "Ind@o1"
    assert str(content["landmark"]["x"]) == "Ind@o2"
    (sign,) = robot.state.private.relations
    assert sign.form == "to the left of"


def test_it_has_no_name_for_what_it_is_asked_the_place_of(scene: Make) -> None:
    assert scene(things=2).acts("Where is this?") == ["admit_name"]


def test_a_new_word_is_asked_about_if_one_thing_is_left(scene: Make) -> None:
    one_noun = KNOWING | {"nouns": ("box",), "known": TWO}
    assert scene(**one_noun).acts(ASKING) == ["unknown_noun"]
    robot = scene(**one_noun)
    assert robot.acts(SAYING) == ["ask_meant", "ask_meant_too"]
    assert not robot.state.private.lessons
    assert robot.acts("Yes.") == ["learned", "learned_relation"]


@pytest.mark.parametrize("text", [SAYING, ASKING])
@pytest.mark.parametrize(
    ("about", "act"),
    [
        ({"known": {("box", "o2"): 0.9}}, "see_no_such"),
        ({"known": TWO, "placed": 0}, "need_depth"),
    ],
    ids=["not in view", "no depth"],
)
def test_a_place_that_cannot_be_talked_of(
    scene: Make, about: dict[str, Any], act: str, text: str
) -> None:
    assert scene(**(KNOWING | about)).acts(text) == [act]


@pytest.mark.parametrize(
    ("left", "right", "act"),
    [
        (0.9, 0.0, "assert_place"),
        (0.4, 0.3, "hedge_place"),
        (0.3, 0.0, "guess_place"),
        (0.1, 0.1, "admit_place"),
    ],
)
def test_it_says_where_things_are_as_certainly_as_it_knows(
    scene: Make, left: float, right: float, act: str
) -> None:
    known = TWO | {
        ("to_the_left_of", "o1", "o2"): left,
        ("to_the_right_of", "o1", "o2"): right,
    }
    relations = ("to the left of", "to the right of")
    robot = scene(**KNOWING, relations=relations, known=known)
    assert robot.acts(ASKING) == [act]
    expected = {"hedge_place": 2, "admit_place": 0}.get(act, 1)
    assert len(robot.state.shared.pending) == expected


@pytest.mark.parametrize(
    ("asked", "noun"), [("the book", "book"), ("the first one", "mug")]
)
def test_a_thing_whose_place_is_asked_keeps_the_tutors_noun(
    scene: Make, asked: str, noun: str
) -> None:
    known = TWO | {("mug", "o1"): 0.95, ("near", "o1", "o2"): 0.9}
    robot = scene(2, nouns=("book", "box", "mug"), relations=("near",), known=known)
    assert robot.hear(f"Where is {asked}?") == f"The {noun} is near the box."


def test_a_thing_is_not_placed_beside_what_is_called_the_same(scene: Make) -> None:
    """The word is the same with another article, as a Swedish question has it."""
    known = {("bok", "o1"): 0.9, ("bok", "o2"): 0.8, ("nära", "o1", "o2"): 0.9}
    robot = scene(2, nouns=("bok",), relations=("nära",), known=known, language="sv")
    assert robot.acts("Var är den första boken?") == ["need_landmark"]
    assert robot.hear("Visa mig den första boken.") == "Det här är boken: #1."


def test_a_thing_is_not_placed_beside_what_is_hardly_known(scene: Make) -> None:
    known = {("book", "o1"): 0.9, ("box", "o2"): 0.1, ("near", "o1", "o2"): 0.9}
    robot = scene(2, nouns=("book", "box"), relations=("near",), known=known)
    assert robot.acts(ASKING) == ["need_landmark"]


def test_what_is_alone_stands_nowhere(scene: Make) -> None:
    robot = scene(things=1, nouns=("book",), known=TWO)
    assert robot.acts(ASKING) == ["need_landmark"]


# --- laws ----------------------------------------------------------------------------

SENTENCES = st.sampled_from(
    [
        "This is a book.",
        "It's a mug.",
        "What is this?",
        "Yes.",
        "No.",
        SAYING,
        ASKING,
        "Hello.",
        "Help.",
        "Thank you.",
        "Goodbye.",
    ]
)

DEGREES = st.dictionaries(
    st.sampled_from(
        [("book", "o1"), ("box", "o2"), ("mug", "o1"), ("to_the_left_of", "o1", "o2")]
    ),
    st.floats(0, 1),
)


@with_scenes
@given(
    texts=st.lists(SENTENCES, max_size=6),
    things=st.integers(0, 2),
    placed=st.integers(0, 2),
    known=DEGREES,
)
def test_every_utterance_is_answered_once(
    scene: Make,
    texts: list[str],
    things: int,
    placed: int,
    known: dict[tuple[str, ...], float],
) -> None:
    robot = scene(
        things=things,
        placed=min(placed, things),
        nouns=("book", "box", "mug"),
        relations=("to the left of",),
        known=known,
    )
    for text in texts:
        assert len(robot.acts(text)) == 1
        assert robot.state.private.agenda == ()
        assert robot.now.model.judge(robot.state, record_type("State")).holds


def test_every_move_of_the_robot_has_its_wording_and_its_type() -> None:
    for act in lexicon().says:
        name = "".join(part.capitalize() for part in act.split("_"))
        assert predicate_at(record_type(name), "e").name == act


# --- the rules themselves -------------------------------------------------------------


def test_every_rule_says_what_it_is_for() -> None:
    assert [rule.name for rule in tutoring([]).rules if not rule.doc] == []
