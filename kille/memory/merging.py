"""Merge one memory into another, so that nothing is learned twice.

A dialogue of the other is one of ours if both began at the same time and all turns that
both have are the same. A lesson is one of ours if it teaches the same of the same word
in the same turn. Where ours is empty, everything keeps its number.
"""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from kille.memory import reading, writing
from kille.memory.lessons import (
    Dialogue,
    Lesson,
    SeenLesson,
    Turn,
)

Identity = tuple[int, int, str, str, bool]
Said = Mapping[int, Turn]
"""The turns of one dialogue by their number, without the dialogue's own number."""


class MergeSource(Protocol):
    """A memory to be merged; its turns and lessons refer to its own dialogues."""

    @property
    def dialogues(self) -> Sequence[Dialogue]:
        """All dialogues, in order."""

    @property
    def turns(self) -> Sequence[Turn]:
        """Everything that was said."""

    def lessons(self) -> Iterator[SeenLesson]:
        """All lessons, oldest first."""


@dataclass(frozen=True)
class MergeResult:
    """What a memory gained from a merge."""

    dialogues: int
    turns: int
    lessons: tuple[int, ...]
    """The keys of the new lessons."""
    known: int
    """The number of lessons that it had already."""


def merge(connection: sqlite3.Connection, source: MergeSource) -> MergeResult:
    """Add what is new, inside the caller's transaction."""
    before = _counts(connection)
    numbers = _add_dialogues(connection, source)
    for turn in source.turns:
        writing.add_turn(connection, replace(turn, dialogue=numbers[turn.dialogue]))
    learned, known = _add_lessons(connection, source, numbers)
    dialogues, turns = _counts(connection)
    return MergeResult(dialogues - before[0], turns - before[1], tuple(learned), known)


def _add_dialogues(
    connection: sqlite3.Connection, source: MergeSource
) -> dict[int, int]:
    """The number here of each dialogue there; new ones are added."""
    ours = {it.number: it for it in reading.dialogues(connection)}
    keeps = not ours
    said_here = _by_dialogue(reading.turns(connection))
    said_there = _by_dialogue(source.turns)
    numbers: dict[int, int] = {}
    for other in source.dialogues:
        said = said_there.get(other.number, {})
        alike = {
            number: shared
            for number, it in ours.items()
            if it.began == other.began
            and (shared := _count_shared_turns(said_here.get(number, {}), said))
            is not None
        }
        if alike:
            found = max(alike, key=lambda number: alike[number])
            del ours[found]
        else:
            number = other.number if keeps else None
            found = writing.add_dialogue(connection, other.began, number)
        numbers[other.number] = found
    return numbers


def _add_lessons(
    connection: sqlite3.Connection, source: MergeSource, numbers: Mapping[int, int]
) -> tuple[list[int], int]:
    """Add the new lessons; returns their keys, and how many were known."""
    ours = Counter(map(_identity, reading.lessons(connection)))
    keeps = writing.never_taught(connection)
    learned, known = [], 0
    for lesson in source.lessons():
        turn = replace(lesson.turn, dialogue=numbers[lesson.turn.dialogue])
        identity = _identity(replace(lesson, turn=turn))
        if ours[identity]:
            ours[identity] -= 1
            known += 1
            continue
        key = lesson.key if keeps else None
        learned.append(
            writing.add_lesson(
                connection,
                turn,
                lesson.word,
                lesson.seen,
                holds=lesson.holds,
                key=key,
            )
        )
    return learned, known


def _identity(lesson: Lesson) -> Identity:
    turn, word = lesson.turn, lesson.word
    return turn.dialogue, turn.number, word.kind, word.name, lesson.holds


def _by_dialogue(turns: Iterable[Turn]) -> dict[int, dict[int, Turn]]:
    found: dict[int, dict[int, Turn]] = {}
    for turn in turns:
        unplaced = replace(turn, dialogue=0)
        found.setdefault(turn.dialogue, {})[turn.number] = unplaced
    return found


def _count_shared_turns(ours: Said, others: Said) -> int | None:
    """How many turns both dialogues have; None if they differ in one."""
    both = ours.keys() & others.keys()
    return len(both) if all(ours[it] == others[it] for it in both) else None


def _counts(connection: sqlite3.Connection) -> tuple[int, int]:
    dialogues, turns = connection.execute(
        "SELECT (SELECT count(*) FROM dialogues), (SELECT count(*) FROM turns)"
    ).fetchone()
    return dialogues, turns
