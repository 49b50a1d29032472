"""What the properties of the tested games are told of what a tutor says."""

import pytest

from kille.lab.tutors.tested_game import words
from ttr import record


@pytest.mark.parametrize(
    ("text", "is_read_whole"),
    [
        ("This is a cup.", True),
        ("Forget that.", True),
        ("I am tired.", False),
        ("Forget what I said about it.", False),
        ("Forget what I said about this.", False),
        ("Glöm det jag sa om den röda koppen.", False),
    ],
)
def test_what_is_understood_in_a_part_only_has_no_words(text, is_read_whole):
    assert words(record(text=text)) == (text if is_read_whole else None)


def test_what_happens_has_no_words():
    assert words(record(floor="tutor")) is None
