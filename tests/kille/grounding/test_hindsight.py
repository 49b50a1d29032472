"""What the robot would have said before each lesson."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from kille.grounding.hindsight import PastLesson, was_right
from kille.perception.descriptor_index import View
from kille.perception.features import NONE

LOOKS = [np.random.default_rng(n).random(512) for n in range(3)]


def lesson_of(number: int, about: tuple[str, int, bool]) -> PastLesson:
    """A lesson in a noun about a thing of one of three looks, or a denial."""
    label, look, holds = about
    traits = {"texture": LOOKS[look] / np.linalg.norm(LOOKS[look])}
    return PastLesson(View(number, label, NONE.descriptors, traits), holds)


ABOUT = st.tuples(st.sampled_from(["cup", "book"]), st.integers(0, 2), st.booleans())
LESSONS = st.lists(ABOUT, max_size=7).map(
    lambda them: [lesson_of(*it) for it in enumerate(them)]
)


@settings(max_examples=25)
@given(LESSONS, st.integers(1, 4))
def test_the_latest_answers_do_not_depend_on_how_many_are_asked_for(
    lessons: list[PastLesson], latest: int
) -> None:
    every = list(was_right(lessons, "cup", 100))
    assert len(every) == sum(it.view.label == "cup" for it in lessons)
    assert list(was_right(lessons, "cup", latest)) == every[-latest:]


def test_a_word_is_not_known_before_its_first_lesson() -> None:
    about = [("book", 1, True), ("cup", 0, True), ("cup", 0, True), ("cup", 1, False)]
    lessons = [lesson_of(*it) for it in enumerate(about)]
    assert list(was_right(lessons, "cup", 9)) == [False, True, True]
    assert list(was_right(lessons, "jug", 9)) == []
