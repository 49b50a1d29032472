"""Forgetting: which lesson is unlearned, and what is left."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from kille.dialogue.meanings import noun, word_of
from ttr import Model, Record, replace
from ttr.types import TypeNode


def taught(s: Record) -> list[str]:
    return [str(it.sign.form) for it in s.private.lessons]


@pytest.fixture
def table(scene: Callable[..., Any]) -> Any:
    return scene(things=2, nouns=["cup", "book"], known={("book", "o2"): 0.9})


def test_the_latest_lesson_about_what_is_talked_of(table: Any) -> None:
    table.hear("This is a cup.")
    table.hear("This is red.")
    table.hear("The book is blue.")
    table.hear("What is this?")
    assert table.hear("Forget that.") == "OK, I forgot that this is red."
    assert taught(table.state) == ["cup", "blue"]


def test_what_is_talked_of_need_not_be_what_is_looked_at(table: Any) -> None:
    table.hear("This is red.")
    table.hear("The book is blue.")
    table.hear("This is a cup.")
    table.hear("Where is the book?")
    assert table.hear("Forget that.") == "OK, I forgot that this is blue."
    assert taught(table.state) == ["red", "cup"]


def test_the_latest_lesson(table: Any) -> None:
    table.hear("This is red.")
    table.hear("The book is blue.")
    assert table.hear("Forget the last thing.") == "OK, I forgot that this is blue."
    assert taught(table.state) == ["red"]


def test_a_lesson_that_something_is_not_so(table: Any) -> None:
    table.hear("This is not a book.")
    assert table.hear("Forget that.") == "OK, I forgot that this is not a book."
    assert taught(table.state) == []


@pytest.mark.parametrize(
    ("taught_it", "forget_it", "said"),
    [
        ("This is a cup.", "Forget that this is a cup.", "this is a cup"),
        ("This is red.", "Forget that it is red.", "this is red"),
        ("This is not a cup.", "Forget that this isn't a cup.", "this is not a cup"),
    ],
)
def test_what_is_to_be_forgotten_may_be_said(
    table: Any, taught_it: str, forget_it: str, said: str
) -> None:
    for text in (taught_it, "This is green.", taught_it):
        table.hear(text)
    assert table.hear(forget_it) == f"OK, I forgot that {said}."
    assert taught(table.state) == ["green"]
    assert table.acts(forget_it) == ["forget_nothing"]


def test_what_was_agreed_on_of_something_else_stays(table: Any) -> None:
    table.hear("The book is blue.")
    before = table.state.shared.commitments
    table.hear("This is red.")
    table.hear("Forget that.")
    assert table.state.shared.commitments == before


def test_nothing_to_forget(table: Any) -> None:
    assert table.acts("Forget that.") == ["forget_nothing"]
    assert table.acts("Forget the last thing.") == ["forgot_last"]
    table.hear("The book is blue.")
    table.hear("What is this?")
    assert table.acts("Forget it.") == ["forget_nothing"]


def test_what_is_forgotten_is_no_more_said_of_what_is_in_view(table: Any) -> None:
    table.hear("This is red.")
    table.hear("This is a mug.")
    table.hear("Forget that.")
    assert [str(it["a"].pred.name) for it in table.state.shared.here] == ["is_red"]
    table.hear("Forget the last thing.")
    assert table.state.shared.here == ()


def test_what_is_gone_is_not_what_is_talked_of(table: Any) -> None:
    table.hear("This is red.")
    table._take(replace(table.seen(), {"kept": ()}))
    assert table.acts("Forget that.") == ["forget_nothing"]
    assert table.acts("Forget the last thing.") == ["forgot_quality"]


@pytest.mark.parametrize(
    "text", ["Forget cup.", "Forget the word cup.", "Forget cups."]
)
def test_a_word_is_dropped(table: Any, text: str) -> None:
    [move] = table._take(table._read(text))
    assert [word_of(it) for it in move.sit.drops] == [word_of(noun("cup"))]


def test_a_word_that_is_not_known(table: Any) -> None:
    assert table.hear("Forget unicorn.") == 'I do not know the word "unicorn".'


def forgetting_all(planned: TypeNode, model: Model) -> tuple[Record, Model]:
    """A body that has kept the first lesson in the word that it is told to drop."""
    move, model = model.create(planned)
    dropped = ["lesson1"] if move.drops else []
    return replace(move, {"dropped": dropped, "lost": list(move.drops)}), model


def test_a_word_goes_with_its_lessons(scene: Callable[..., Any]) -> None:
    one = scene(nouns=["book"], act=forgetting_all)
    one.hear("This is a cup.")
    one.hear("This is red.")
    assert one.hear("Forget cup.") == 'OK, I no longer know the word "cup".'
    assert taught(one.state) == ["red"]
    assert [it.form for it in one.state.private.nouns] == ["book"]
    assert len(one.state.shared.commitments) == 1


@pytest.mark.parametrize("no", ["No.", "That's wrong.", "No, it isn't."])
def test_a_no_straight_after_a_lesson_takes_it_back(table: Any, no: str) -> None:
    table.hear("This is red.")
    table.hear("The book is blue.")
    assert table.hear(no).startswith("OK, I forgot that")
    assert taught(table.state) == ["red"]
    assert table.acts(no) == ["wonder"]
    assert taught(table.state) == ["red"]


def test_a_no_later_on_takes_nothing_back(table: Any) -> None:
    table.hear("The book is blue.")
    table.hear("Thanks.")
    assert table.acts("No.") == ["wonder"]
    assert taught(table.state) == ["blue"]


@pytest.mark.parametrize("text", ["Forget everything.", "Forget all that you know."])
def test_all_that_was_taught_is_forgotten_after_a_yes(table: Any, text: str) -> None:
    table.hear("This is red.")
    assert table.acts(text) == ["ask_forget_all"]
    assert table.acts("Yes.") == ["forgot_all"]
    assert not table.state.shared.qud


def test_where_nothing_was_taught_nothing_is_asked(scene: Callable[..., Any]) -> None:
    table = scene(things=1)
    assert table.acts("Forget everything.") == ["forget_nothing"]
    assert not table.state.shared.qud


@pytest.mark.parametrize("text", ["No.", "Hello.", "What is this?"])
def test_without_a_yes_nothing_is_forgotten(table: Any, text: str) -> None:
    table.hear("This is red.")
    table.hear("Forget everything.")
    table.hear(text)
    assert taught(table.state) == ["red"]
    assert not table.state.shared.qud
