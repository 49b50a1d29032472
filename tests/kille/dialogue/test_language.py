"""What tutors type, and the judgement that each utterance is."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.language import NotUnderstood, understand
from kille.dialogue.meanings import named, noun, relation
from ttr import merge

CUP = "[look : Look, x : Ind, c : cup(x, look)]"

NAMINGS = {
    "This is a cup.": "cup",
    "this is a cup": "cup",
    "THIS IS A CUP!": "cup",
    "This is the… no": None,
    "It's a cup": "cup",
    "That’s a cup.": "cup",
    "It is called a cup.": "cup",
    "This object is a cup": "cup",
    "The object is a cup.": "cup",
    "We call this a cup.": "cup",
    "Here is a cup.": "cup",
    "A cup.": "cup",
    "OK, now this is a cup, please.": "cup",
    "No, this is a mug.": "mug",
    "Yes, this is a mug.": "mug",
    "This is an apple.": "apple",
    "This is a apple.": "apple",
    "This is a can of paint.": "can of paint",
    "This is a teddy bear.": "teddy bear",
    "This is a shoe-box.": "shoe-box",
    "  This   is\ta Teddy   Bear ": "teddy bear",
    "Das ist eine Tasse.": None,
    "This is a bürste": "bürste",
    "This is a cup to the left of the box.": None,
    "this is cup": None,
    "cup": None,
}

MOVES = {
    "What is this?": "AskName",
    "what's this": "AskName",
    "What's that called?": "AskName",
    "What is it?": "AskName",
    "What object is this?": "AskName",
    "Do you know what this is?": "AskName",
    "Can you tell me what that is?": "AskName",
    "What do you think this is?": "AskName",
    "That is correct.": "Affirm",
    "that's right": "Affirm",
    "Yes.": "Affirm",
    "yes it is": "Affirm",
    "Yes, that's right!": "Affirm",
    "Correct.": "Affirm",
    "Exactly.": "Affirm",
    "You are right.": "Affirm",
    "No.": "Deny",
    "That is wrong.": "Deny",
    "That's not correct.": "Deny",
    "No, it isn't.": "Deny",
    "Wrong.": "Deny",
    "Where is the book?": "AskPlace",
    "where's the can of paint?": "AskPlace",
    "Tell me where the book is.": "AskPlace",
    "The book is to the left of the box.": "Relate",
    "Help": "AskHelp",
    "What can I say?": "AskHelp",
    "What do you understand?": "AskHelp",
    "Hello.": "Greet",
    "good morning": "Greet",
    "Thank you!": "Thank",
    "Goodbye.": "Leave",
    "quit": "Leave",
}

REFUSED = [
    "",
    "   ",
    "...",
    "colourless green ideas sleep furiously",
    "the",
    "this is",
    "what",
    "where is",
    "is the book",
    "The book is left.",
    "The cup is red.",
    "cup cup cup",
    "這是一個杯子",
    "import os; os.remove('x')",
    "this is a very large and quite extraordinarily beautiful cup of tea",
    "\x00",
    "x" * 10_000,
]

RELATIONS = {
    "The book is to the left of the box.": ("book", "to the left of", "box"),
    "the book is on the right of the car": ("book", "on the right of", "car"),
    "The book's behind the box": ("book", "behind", "box"),
    "The can of paint is in front of the shoe-box.": (
        "can of paint",
        "in front of",
        "shoe-box",
    ),
    "The cap is near a teddy bear": ("cap", "near", "teddy bear"),
    "The cup is close to the book.": ("cup", "close to", "book"),
}


@pytest.mark.parametrize(("text", "form"), NAMINGS.items())
def test_naming(text: str, form: str | None) -> None:
    if form is None:
        with pytest.raises(NotUnderstood):
            understand(text)
        return
    heard = understand(text)
    assert heard.type <= named("Heard")
    assert heard.type <= named("Instruct")
    assert heard.content is noun(form).meaning
    assert [sign.form for sign in heard.type["signs"].value] == [form]


def test_a_parse_is_a_judgement_of_the_whole_event() -> None:
    T = understand("This is a cup.").type
    assert str(T["content"]) == f"RecType@{CUP}"
    assert str(T["spkr"]) == "Ind@tutor"
    assert T["text"].value == "This is a cup."


@pytest.mark.parametrize(("text", "move"), MOVES.items())
def test_move(text: str, move: str) -> None:
    assert understand(text).type <= named(move)


@pytest.mark.parametrize("text", REFUSED)
def test_refused(text: str) -> None:
    with pytest.raises(NotUnderstood):
        understand(text)


@pytest.mark.parametrize(("text", "words"), RELATIONS.items())
def test_relating(text: str, words: tuple[str, str, str]) -> None:
    heard = understand(text)
    target, link, landmark = words
    assert [sign.form for sign in heard.type["signs"].value] == list(words)
    content = heard.content
    assert content <= named("Relating")
    assert content["target"] is merge(named("Relating")["target"], noun(target).meaning)
    assert content["rel"].pred is relation(link).meaning["rel"].pred
    assert content["landmark"]["c"].pred is noun(landmark).meaning["c"].pred


def test_what_is_seen_is_looked_for_only_where_it_matters() -> None:
    assert "look" in understand("What is this?").content
    assert "look" in understand("Where is the cup?").content
    assert "look" not in understand("Hello.").content
    assert "look" not in understand("That is correct.").content


@given(st.text(max_size=200))
def test_any_text_is_understood_or_refused(text: str) -> None:
    try:
        heard = understand(text)
    except NotUnderstood:
        return
    assert heard.type <= named("Heard")
