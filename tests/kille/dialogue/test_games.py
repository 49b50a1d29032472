"""The games as rules alone: what is planned, given how probable things are judged."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue import games
from kille.dialogue.language import understand
from kille.dialogue.meanings import named, noun, predicate_at, relation, theory, word_of
from kille.dialogue.state import STATE, blank_model, initial
from kille.dialogue.wording import english
from ttr import Model, Record, RecordType, record, replace
from ttr.updates import Run, run

Degrees = Mapping[tuple[str, ...], float]
"""The degree of a word (its predicate's name) for things: ("cup", "o1")."""

BANDS = english().bands


def degree(known: Degrees, word: str, *things: str) -> float:
    return known.get((word, *things[:-1]), 0.0)


def before(
    things: int = 1,
    placed: int | None = None,
    nouns: tuple[str, ...] = (),
    relations: tuple[str, ...] = (),
    known: Degrees | None = None,
) -> Run:
    """The state in which so many things are in view and these words are known."""
    signs, links = [*map(noun, nouns)], [*map(relation, relations)]
    names = [f"o{n + 1}" for n in range(things)]
    model: Model = blank_model().given("look1", theory()["Look"])
    for x in names:
        model = model.given(x, theory()["Ind"])
    for sign in (*signs, *links):
        word = word_of(sign)
        model = model.witnessed(word, by=partial(degree, known or {}, word.name))
    view = record(look="look1", things=names, placed=names[:placed], focus=names[:1])
    return Run(replace(initial(signs, links, BANDS), view=view), model, ())


def heard(so_far: Run, text: str) -> Run:
    """What the utterance makes of the state: the plan, but not yet the answer."""
    event, model = so_far.model.create(understand(text).type)
    return run(games.HEARD, so_far.state, type=STATE, model=model, events=[event])


def planned(so_far: Run) -> str:
    """The act on the agenda, of which there is one."""
    (move,) = so_far.state.private.agenda
    return predicate_at(move, "e").name


def said(so_far: Run) -> Run:
    """The robot makes the move that it planned."""
    move, model = so_far.model.create(so_far.state.private.agenda[0])
    return run(games.SAID, so_far.state, type=STATE, model=model, events=[move])


# --- how certain it is ---------------------------------------------------------------

CERTAINTY = {"admit_name": 0, "guess_name": 1, "hedge_name": 1, "assert_name": 2}


def answer_for(best: float, second: float) -> str:
    known = {("book", "o1"): best, ("mug", "o1"): second}
    return planned(heard(before(nouns=("book", "mug"), known=known), "What is this?"))


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
def test_the_bands_decide_how_it_answers(best: float, second: float, act: str) -> None:
    assert answer_for(best, second) == act


@given(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1))
def test_stronger_words_need_stronger_reasons(a: float, b: float, c: float) -> None:
    second, low, high = sorted((a, b, c))
    assert CERTAINTY[answer_for(low, second)] <= CERTAINTY[answer_for(high, second)]


@given(st.floats(0.05, 0.5))
def test_a_tie_is_never_asserted(p: float) -> None:
    assert answer_for(p, p) in {"hedge_name", "admit_name"}


def test_a_hedge_names_both_the_more_probable_first() -> None:
    known = {("book", "o1"): 0.3, ("mug", "o1"): 0.4}
    after = heard(before(nouns=("book", "mug"), known=known), "What is this?")
    (move,) = after.state.private.agenda
    assert [sign.form for sign in move["signs"].value] == ["mug", "book"]
    assert len(after.state.shared.pending) == 2
    assert planned(heard(said(after), "Yes.")) == "ask_which"


# --- what is learned, and from what --------------------------------------------------


def test_a_word_is_known_when_the_robot_has_said_so() -> None:
    after = heard(before(), "This is a cup.")
    assert planned(after) == "learned"
    assert after.state.private.nouns == ()
    done = said(after).state
    assert [sign.form for sign in done.private.nouns] == ["cup"]
    assert done.private.agenda == ()
    (agreed,) = done.shared.commitments
    assert agreed <= noun("cup").meaning
    assert str(agreed["x"]) == "Ind@o1"


def test_a_word_heard_twice_is_known_once() -> None:
    twice = said(heard(said(heard(before(), "This is a cup.")), "It's a cup."))
    assert len(twice.state.private.nouns) == 1
    assert len(twice.state.shared.commitments) == 1


def test_only_the_last_claim_can_be_confirmed_and_only_once() -> None:
    known = {("cup", "o1"): 0.9}
    asked = said(heard(before(nouns=("cup",), known=known), "What is this?"))
    confirmed = heard(asked, "That is correct.")
    assert planned(confirmed) == "learned"
    assert planned(heard(said(confirmed), "That is correct.")) == "wonder"
    assert planned(heard(said(heard(asked, "Hello.")), "Yes.")) == "wonder"
    assert planned(heard(said(heard(asked, "No.")), "Yes.")) == "wonder"


def test_nothing_in_view_teaches_nothing() -> None:
    for text in ("This is a cup.", "What is this?"):
        assert planned(heard(before(things=0), text)) == "see_nothing"


# --- where things are ----------------------------------------------------------------

TWO = {("book", "o1"): 0.9, ("box", "o2"): 0.9}
KNOWING = partial(before, things=2, nouns=("book", "box"))
SAYING = "The book is to the left of the box."
ASKING = "Where is the book?"


def looked(so_far: Run) -> Record:
    seen = record(view=so_far.state.view)
    after = run(
        games.SCENE_CHANGED,
        so_far.state,
        type=STATE,
        model=so_far.model,
        events=[seen],
    )
    return after.state


def test_it_asks_where_two_known_things_are_but_only_once() -> None:
    state = looked(KNOWING(known=TWO))
    assert predicate_at(state.private.agenda[0], "e").name == "ask_relation"
    again = KNOWING(known=TWO)
    again = again._replace(
        state=replace(again.state, {"private.asked": ("book", "box")})
    )
    assert looked(again).private.agenda == ()


@pytest.mark.parametrize(
    "so_far",
    [
        KNOWING(known={("book", "o1"): 0.9, ("box", "o2"): 0.4}),
        KNOWING(known={("book", "o1"): 0.9, ("book", "o2"): 0.9}),
        KNOWING(known=TWO, placed=1),
        KNOWING(known=TWO, placed=0),
        KNOWING(relations=("near",), known=TWO | {("near", "o1", "o2"): 0.9}),
    ],
    ids=["one known", "both the same", "one placed", "no depth", "it can say"],
)
def test_it_does_not_ask_where_it_should_not(so_far: Run) -> None:
    assert looked(so_far).private.agenda == ()


def test_a_relation_is_learned_of_the_two_things_that_fit() -> None:
    after = heard(KNOWING(known=TWO), SAYING)
    assert planned(after) == "learned_relation"
    (move,) = after.state.private.agenda
    content = move["content"].value
    assert isinstance(content, RecordType)
    assert str(content["target"]["x"]) == "Ind@o1"
    assert str(content["landmark"]["x"]) == "Ind@o2"
    (sign,) = said(after).state.private.relations
    assert sign.form == "to the left of"


@pytest.mark.parametrize(
    ("so_far", "act"),
    [
        (before(things=2, nouns=("box",), known=TWO), "unknown_word"),
        (KNOWING(known={("book", "o1"): 0.9}), "see_no_such"),
        (KNOWING(known=TWO, placed=0), "need_depth"),
    ],
    ids=["a new word", "not in view", "no depth"],
)
def test_a_relation_that_cannot_be_learned(so_far: Run, act: str) -> None:
    assert planned(heard(so_far, SAYING)) == act


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
    left: float, right: float, act: str
) -> None:
    known = TWO | {("left_of", "o1", "o2"): left, ("right_of", "o1", "o2"): right}
    so_far = KNOWING(relations=("left of", "right of"), known=known)
    after = heard(so_far, ASKING)
    assert planned(after) == act
    expected = {"hedge_place": 2, "admit_place": 0}.get(act, 1)
    assert len(after.state.shared.pending) == expected


@pytest.mark.parametrize(
    ("so_far", "act"),
    [
        (before(things=1, nouns=("book",), known=TWO), "need_landmark"),
        (before(things=2, nouns=("box",), known=TWO), "unknown_word"),
        (KNOWING(known={("box", "o2"): 0.9}), "see_no_such"),
        (KNOWING(known=TWO, placed=0), "need_depth"),
    ],
    ids=["alone", "a new word", "not in view", "no depth"],
)
def test_a_place_that_cannot_be_said(so_far: Run, act: str) -> None:
    assert planned(heard(so_far, ASKING)) == act


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


@given(
    st.lists(SENTENCES, max_size=6),
    st.integers(0, 2),
    st.integers(0, 2),
    st.dictionaries(
        st.sampled_from(
            [
                ("book", "o1"),
                ("box", "o2"),
                ("mug", "o1"),
                ("to_the_left_of", "o1", "o2"),
            ]
        ),
        st.floats(0, 1),
    ),
)
def test_every_utterance_is_answered_once_and_agreements_stay(
    texts: list[str], things: int, placed: int, known: Degrees
) -> None:
    so_far = before(
        things, min(placed, things), ("book", "box", "mug"), ("to the left of",), known
    )
    for text in texts:
        agreed = so_far.state.shared.commitments
        so_far = heard(so_far, text)
        assert planned(so_far) in english().says
        so_far = said(so_far)
        assert so_far.state.private.agenda == ()
        assert so_far.state.shared.commitments[: len(agreed)] == agreed
        assert so_far.model.judge(so_far.state, STATE).holds


def test_every_move_of_the_robot_has_its_wording_and_its_type() -> None:
    for act in english().says:
        name = "".join(part.capitalize() for part in act.split("_"))
        assert predicate_at(named(name), "e").name == act
