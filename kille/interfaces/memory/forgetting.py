"""`kille memory forget`: forget a word or a lesson for good."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from kille.interfaces.memory.choosing import latest, lessons_named
from kille.interfaces.memory.describing import describe_turn, title
from kille.interfaces.terminal import (
    FAILED,
    FINE,
    ask,
    complain,
    console,
    hang_text,
    memory_path,
    print_json,
)
from kille.memory import (
    Lesson,
    Memory,
    MemoryFileError,
    MemoryReader,
    NoSuchLessonError,
)
from ttr.escapes import terminal_word

Choice = Callable[[MemoryReader], Sequence[Lesson]]
"""Chooses the lessons to forget."""

Consent = Callable[[Sequence[Lesson]], bool]
"""May these lessons be forgotten?"""

Report = Callable[[Sequence[Lesson], Sequence[str]], None]
"""Reports which lessons are gone, and which words with them."""


def forget(given: Path | None, chosen: Choice, may: Consent, report: Report) -> int:
    """Forget the chosen lessons, all or none; returns the exit code."""
    path = memory_path(given)
    try:
        # A memory that is not there is complained of, not made.
        with Memory.open_to_read(path) as memory:
            lessons = chosen(memory)
        with Memory.open(path) as memory:
            if not may(lessons):
                return FAILED
            gone = _forget(memory, lessons)
    except (MemoryFileError, NoSuchLessonError, _NobodyToAsk) as error:
        return complain(error)
    report(lessons, gone)
    return FINE


def _forget(memory: Memory, lessons: Sequence[Lesson]) -> list[str]:
    """Forget the lessons, all or none; returns the words that are gone with them."""
    before = memory.words()
    with memory.together():
        for lesson in lessons:
            memory.forget(lesson.key)
    left = {(word.kind, word.name) for word in memory.words()}
    return [it.surface for it in before if (it.kind, it.name) not in left]


def of(named: str) -> Choice:
    """The lessons in a word, or the one with a number."""
    return lambda memory: lessons_named(memory, named)


def last(memory: MemoryReader) -> Sequence[Lesson]:
    """The newest lesson."""
    return latest(memory)


def sure(_: Sequence[Lesson]) -> bool:
    """Consent without a question."""
    return True


def ask_consent(lessons: Sequence[Lesson]) -> bool:
    """Ask the user in the terminal."""
    if not sys.stdin.isatty():
        raise _NobodyToAsk("forgetting is for good: add --yes if you mean it")
    for lesson in lessons:
        console().print(_line(lesson), markup=False)
    many = "this lesson" if len(lessons) == 1 else f"these {len(lessons)} lessons"
    try:
        answer = ask(f"Forget {many} for good? [y/N] ")
    except EOFError:
        answer = ""
    if answer.strip().lower() in ("y", "yes"):
        return True
    console().print("Nothing was forgotten.")
    return False


def as_json(lessons: Sequence[Lesson], gone: Sequence[str]) -> None:
    """Print what is gone, for machines."""
    forgotten = [
        {"lesson": it.key, "word": it.word.surface, "kind": it.word.kind}
        for it in lessons
    ]
    facts = {"forgotten": forgotten, "words_gone": list(gone)}
    print_json(facts)


def as_text(lessons: Sequence[Lesson], gone: Sequence[str]) -> None:
    """Print what is gone, for people."""
    out = console()
    for lesson in lessons:
        out.print(hang_text("  ", f"Forgotten: {_line(lesson)}").lstrip(), markup=False)
    for word in gone:
        out.print(f"The word {terminal_word(word)} is gone.", markup=False)


def _line(lesson: Lesson) -> str:
    return f"{title(lesson)}; {describe_turn(lesson.turn)}"


class _NobodyToAsk(Exception):
    """A question is needed, but there is nobody to answer it."""
