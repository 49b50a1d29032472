"""What is set right at once after what looks like the end of a sentence."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kille.dialogue.language import LANGUAGES
from kille.dialogue.restarts import join_repairs
from kille.dialogue.robust_reading.self_repairs import repair_sentence
from kille.dialogue.word_lists import word_lists


@pytest.mark.parametrize(
    ("language", "text", "plain"),
    [
        ("en", "it's a blal. *ball", "it's a ball"),
        ("en", "It's a blal *ball.", "It's a ball."),
        ("en", "It's a blal, ball*", "It's a ball"),
        ("en", "It's a fork. *knife", "It's a knife"),
        ("en", "It's a sppon... spoon", "It's a spoon"),
        ("en", "this is a ba.. ball", "this is a ball"),
        ("en", "It's a hamer - hammer!", "It's a hammer!"),
        ("en", "It's a cap. A cup.", "It's a cup."),
        ("en", "It's a blal. I mean ball.", "It's a ball."),
        ("en", "It's a fork. No, I mean a knife.", "It's a knife."),
        ("sv", "det är en kop.. kopp", "det är en kopp"),
        ("sv", "det är en bol. *boll", "det är en boll"),
        ("sv", "Det är en skde. Sked.", "Det är en Sked."),
        ("sv", "Det är en sked. Jag menar gaffel!", "Det är en gaffel!"),
    ],
)
def test_the_first_form_is_set_right(language: str, text: str, plain: str) -> None:
    lists = word_lists(language)
    assert repair_sentence(join_repairs(text, lists), lists).plain == plain


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("en", "This is a cup. That is red."),
        ("en", "It's a pen. Pencils are longer."),
        ("en", "It's a pen, pencil, ruler."),
        ("en", "A pen. A pencil."),
        ("en", "It's a cup. A mug."),
        ("en", "It's a cup. Thanks!"),
        ("en", "It's a cup. I mean that the mug is red."),
        ("en", "It's red. I mean what?"),
        ("en", "No. Not this. That."),
        ("sv", "Det är en kopp. Den är röd."),
        ("sv", "Det är en kopp... tack"),
        ("sv", "Det är en kopp. Jag menar att den är röd."),
    ],
)
def test_what_sets_nothing_right_stays(language: str, text: str) -> None:
    assert join_repairs(text, word_lists(language)) == text


WORDS = st.sampled_from(
    [
        "this",
        "is",
        "a",
        "cup",
        "cap",
        "mug",
        "red",
        "*ball",
        "I",
        "mean",
        ".",
        ",",
        "..",
        "!",
        "-",
        "?",
        "*",
    ]
)


@given(st.sampled_from(LANGUAGES), st.lists(WORDS, max_size=12).map(" ".join))
def test_no_word_is_added_but_the_mark_of_a_repair(language: str, text: str) -> None:
    lists = word_lists(language)
    said = {it.strip("*,.!-") for it in text.lower().split()}
    kept = {it.strip("*,.!-") for it in join_repairs(text, lists).lower().split()}
    assert kept <= said | {*lists.repair.split(), ""}
