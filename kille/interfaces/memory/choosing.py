"""Find the lessons that a user means by a word or a number."""

from __future__ import annotations

import re
from collections.abc import Sequence

from kille.memory import Lesson, MemoryReader, NoSuchLessonError
from ttr.errors import suggestion

_NUMBER = re.compile(r"#?([0-9]{1,18})")


def lessons_named(memory: MemoryReader, named: str) -> tuple[Lesson, ...]:
    """The lessons in a word, oldest first, or the one with a number.

    A word is meant as it was said ("can of paint") or as it is kept (can_of_paint).
    Raises NoSuchLessonError with a way out.
    """
    lessons = memory.lessons()
    wanted = " ".join(named.split())
    found = [it for it in lessons if wanted in (it.word.surface, it.word.name)]
    if not found and (number := _NUMBER.fullmatch(wanted)):
        found = [it for it in lessons if it.key == int(number[1])]
    if not found:
        raise NoSuchLessonError(_no_lesson_line(memory.place, wanted, lessons))
    return tuple(found)


def latest(memory: MemoryReader) -> tuple[Lesson, ...]:
    """The newest lesson. Raises NoSuchLessonError if there is none."""
    lessons = memory.lessons()
    if not lessons:
        raise NoSuchLessonError(f"{memory.place} holds no lessons")
    return lessons[-1:]


def _no_lesson_line(place: str, wanted: str, lessons: Sequence[Lesson]) -> str:
    """The message that no lesson is named so, with a suggestion."""
    if _NUMBER.fullmatch(wanted):
        return (
            f"there is no lesson {wanted.lstrip('#')} in {place}: "
            "kille memory show WORD lists the numbers of those in a word"
        )
    words = sorted({it.word.surface for it in lessons})
    way_out = suggestion(wanted, words) or "kille memory list tells all"
    return f"nobody taught {wanted} in {place}: {way_out}"
