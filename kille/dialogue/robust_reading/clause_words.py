"""The words of a sentence: where each stands, and which may be left out."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from kille.dialogue.word_lists import WordLists

_WORD = re.compile(r"(?:#(?=\d))?[^\W_]+(?:['’´-][^\W_]+)*")
BREAK = re.compile(r"[,;:.!?…()\"“”]|\s[-–—]+\s")
"""What ends a clause, between two words."""


class Word(NamedTuple):
    """A word of a sentence: where it stands, and in which clause, counted from 0."""

    begin: int
    end: int
    form: str
    clause: int
    is_harmless: bool
    joins: bool = False
    """Whether it joins clauses: it may be left out, but not from within an island."""
    phrase: int = 1
    """How many words the harmless phrase has in which it stands: "no problem"."""
    is_auxiliary: bool = False
    """Whether the words before it are its subject: "a real bear would eat you"."""
    is_of_robot: bool = False
    """Whether it says what the robot is: the verb in "you are a gem"."""


def words_of(text: str, lists: WordLists) -> tuple[Word, ...]:
    """The words of a text, with those that are harmless marked.

    The commas around an aside end no clause.

    >>> from kille.dialogue.word_lists import word_lists
    >>> text = "Hello, this is, you know, a cup and"
    >>> found = words_of(text, word_lists("en"))
    >>> [it.form for it in found if it.is_harmless]
    ['you', 'know', 'and']
    >>> [it.clause for it in found]
    [0, 1, 1, 1, 1, 1, 1, 2]
    """
    found = [(it.start(), it.end(), it[0]) for it in _WORD.finditer(text)]
    forms = [it.lower().replace("’", "'").replace("´", "'") for _, _, it in found]
    runs = list(lists.harmless_runs(forms))
    harmless = {at: len(run) for run in runs for at in run}
    breaks = {
        at
        for at in range(1, len(found))
        if BREAK.search(text, found[at - 1][1], found[at][0])
    }
    for run in runs:
        if {run.start, run.stop} <= breaks:
            breaks -= {run.start, run.stop}
    words: list[Word] = []
    clause = 0
    for at, ((begin, end, _), form) in enumerate(zip(found, forms, strict=True)):
        joins = form in lists.joining
        clause += at > 0 and (joins or at in breaks)
        is_harmless, phrase = joins or at in harmless, harmless.get(at, 1)
        verb = form in lists.auxiliaries
        beside = {form, *forms[max(at - 1, 0) : at + 2]}
        of_robot = lists.has_copula(form) and not lists.addressees.isdisjoint(beside)
        words.append(
            Word(begin, end, form, clause, is_harmless, joins, phrase, verb, of_robot)
        )
    return tuple(words)


def blank_harmless(text: str, words: Iterable[Word]) -> str:
    """The text with spaces in place of its harmless words.

    >>> from kille.dialogue.word_lists import word_lists
    >>> text = "it is really quite red"
    >>> " ".join(blank_harmless(text, words_of(text, word_lists("en"))).split())
    'it is red'
    """
    for it in words:
        if is_aside(it):
            text = text[: it.begin] + " " * (it.end - it.begin) + text[it.end :]
    return text


def is_aside(word: Word) -> bool:
    """Whether a word may be left out from within an island."""
    return word.is_harmless and not word.joins


def are_harmless(words: Iterable[Word]) -> bool:
    """Whether all of these words may be left out."""
    return all(it.is_harmless for it in words)


def words_before_last_aside(words: Sequence[Word]) -> int:
    """How many words stand before the last harmless one that others surround."""
    said = [n for n, it in enumerate(words) if not it.is_harmless]
    inner = range(said[0], said[-1]) if said else range(0)
    return max((n for n in inner if words[n].is_harmless), default=0)
