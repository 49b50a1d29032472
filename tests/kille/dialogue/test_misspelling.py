"""A slip of the hand: the nearest known word is offered, and never taken silently."""

from __future__ import annotations

from collections.abc import Iterable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.lexicon import lexicon
from kille.dialogue.meanings import noun, packaged_types, theory, word_of
from kille.dialogue.state import blank_model
from kille.dialogue.tutoring import tutoring
from kille.dialogue.typos import is_slip, nearest, slip
from kille.dialogue.wording import did_not_understand
from ttr import record

WORDS = ("cup", "book")
TRUE = {("cup", "o1"), ("book", "o2")}


def talk(said: Iterable[str], language: str = "en") -> tuple[list[str], list[str]]:
    """What the robot says to this, and the nouns that it knows then."""
    known = [noun(word) for word in WORDS]
    model = blank_model().given("look1", theory()["Look"])
    for x in ("o1", "o2"):
        model = model.given(x, theory()["Ind"])
    for sign in known:

        def by(x: str, _look: str, form: str = sign.form) -> float:
            return 0.9 if (form, x) in TRUE else 0.0

        model = model.witnessed(word_of(sign), by=by)
    game = tutoring(known, language=language, model=model)
    things = ["o1", "o2"]
    view = record(
        look="look1", things=things, placed=things, focus=["o1"], pointed=["o1"]
    )
    seen = record(view=view, kept=[], floor="tutor")
    now = game.take(game.begin(), seen).run
    answers = []
    for text in said:
        turn = game.take(now, game.hear(text))
        answers += [game.say(move) for move in turn.said]
        now = turn.run
    return answers, [it.form for it in now.state.private.nouns]


def test_yes_takes_the_known_word() -> None:
    said, nouns = talk(["This is a cupp.", "Yes."])
    assert said == ["Do you mean a cup?", "OK, the one on the left (#1) is a cup."]
    assert nouns == ["cup", "book"]


def test_no_takes_the_word_as_it_was_said() -> None:
    said, nouns = talk(["This is a cupp.", "No."])
    assert said == ["Do you mean a cup?", "OK, the one on the left (#1) is a cupp."]
    assert nouns == ["cup", "book", "cupp"]


def test_anything_else_drops_the_question() -> None:
    said, nouns = talk(["This is a cupp.", "Hello.", "Yes."])
    assert said[:2] == ["Do you mean a cup?", "Hello."]
    assert nouns == ["cup", "book"]


def test_of_what_is_asked_more_may_be_a_slip_than_of_what_is_taught() -> None:
    said, _ = talk(["This is a bouk."])
    assert said == ["OK, the one on the left (#1) is a bouk."]
    said, _ = talk(["Is this a bouk?"])
    assert said == ["Do you mean a book?"]


def test_a_word_of_its_own_is_not_questioned() -> None:
    said, nouns = talk(["This is a cap.", "The other one is a mug."])
    assert said == [
        "OK, the one on the left (#1) is a cap.",
        "OK, the one on the right (#2) is a mug.",
    ]
    assert nouns == ["cup", "book", "cap", "mug"]


@pytest.mark.parametrize(
    ("text", "like"),
    [
        ("What colour this?", 'You could say "What colour is this?";'),
        ("Where is your book?", 'You could say "Where is the book?";'),
        ("What sees you?", '"Help" lists'),
    ],
)
def test_what_is_not_understood_is_answered_by_what_is_like_it(
    text: str, like: str
) -> None:
    assert like in did_not_understand(lexicon(), text, types=packaged_types())


def test_what_is_asked_for_is_nearly_known() -> None:
    said, _ = talk(["What is the boook?", "Yes"])
    assert said == ["Do you mean a book?", "This is a book."]


@pytest.mark.parametrize(
    ("form", "word"),
    [("appel", "apple"), ("aple", "apple"), ("bananna", "banana"), ("baer", "bear")],
)
def test_slips(form: str, word: str) -> None:
    assert nearest(form, ["cup", word, "shoe"]) == word


@given(st.text("abco", min_size=1, max_size=8), st.text("abco", min_size=1, max_size=8))
def test_a_slip_goes_both_ways(one: str, other: str) -> None:
    assert (slip(one, other) is None) == (slip(other, one) is None)
    assert is_slip(one, other) <= (slip(one, other) is not None)
    assert slip(one, one) is None
    assert nearest(one, [one, other]) is None
