"""Islands: the stretches of a sentence that the grammar can read.

Source: Stock, Falcone and Insinnamo 1988, for islands in a chart; Ward 1991 (Phoenix),
for spontaneous speech.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from kille.dialogue.parsing import Grammar, Tree, parts
from kille.dialogue.parsing import words as words_in
from kille.dialogue.robust_reading.clause_words import (
    Word,
    blank_harmless,
    is_aside,
    words_before_last_aside,
)
from kille.dialogue.word_lists import WordLists

START = "island"
"""The rule of the grammar for what may be an island."""

ALONE = "alone"
"""The rule for a name that is all that is said: it never goes on after a comma."""

ACROSS = 0.7
"""The factor for an island that goes on after a comma."""

BLANKED = 0.9
"""The factor for an island that leaves out harmless words within."""

OPEN = frozenset(
    {
        "WORD",
        "NEW_PREP",
        "PLURAL",
        "DEFINITE",
        "SURELY_DEFINITE",
        "NEUTER",
        "WEAK",
        "PLAIN_PLURAL",
        "ZERO_PLURAL",
        "BARE",
        "MASS",
    }
)
"""The terminals that find any word; others than these find the words they list."""


class Island(NamedTuple):
    """A stretch from one word to before another, and how the grammar can read it.

    `rule` is the move that it is, or the name that the grammar gives the island.
    """

    first: int
    after: int
    rule: str
    trees: tuple[Tree, ...]
    weight: float

    @property
    def is_bare(self) -> bool:
        """Whether a lesson only names, without saying what: "a cup"."""
        return len(parts(parts(self.trees[0])[0])) == 1


Weigh = Callable[[Tree], float]
"""How well a reading of an island fits what the talk is about, from 0 to 1."""


def find_islands(
    text: str,
    words: Sequence[Word],
    grammar: Grammar,
    weigh: Weigh,
    lists: WordLists,
) -> list[Island]:
    """The islands of a text, also those that leave out harmless words within."""
    islands = _islands(text, words, grammar, weigh, lists)
    before = words_before_last_aside(words)
    if before:
        blank = blank_harmless(text, words)
        islands += [
            it._replace(weight=BLANKED * it.weight)
            for it in _islands(blank, words, grammar, weigh, lists, before)
        ]
    return islands


def _islands(
    text: str,
    words: Sequence[Word],
    grammar: Grammar,
    weigh: Weigh,
    lists: WordLists,
    before: int | None = None,
) -> list[Island]:
    """The islands of a text that begin with one of its words, before that number."""
    begins = {it.begin: n for n, it in enumerate(words)}
    places = [it.begin for it in words[:before] if text[it.begin] != " "]
    found: list[Island] = []
    for begin, ends in grammar.parse_stretches(text, START, places).items():
        first = begins[begin]
        for end, trees in ends.items():
            after = _word_at(end, words)
            if after is None or after <= first:
                continue
            while before and after > first + 1 and is_aside(words[after - 1]):
                after -= 1
            by_rule: dict[str, list[tuple[float, Tree]]] = {}
            for tree in trees:
                if _is_sound(tree, lists):
                    by_rule.setdefault(rule_of(tree), []).append((weigh(tree), tree))
            inner = words[first:after]
            breaks = inner[-1].clause - inner[0].clause
            across = ACROSS**breaks
            for rule, fits in by_rule.items():
                likely = max(fit for fit, _ in fits)
                if likely <= 0.0 or (breaks and rule == ALONE):
                    continue
                best = tuple(tree for fit, tree in fits if fit > likely / 2)
                found.append(Island(first, after, rule, best, likely * across))
    return found


def rule_of(tree: Tree) -> str:
    """The move that an island is, or the name that the grammar gives the island."""
    return parts(tree)[0].rule if tree.rule == START else tree.rule


def _word_at(end: int, words: Sequence[Word]) -> int | None:
    """The number of the word before which a stretch ends; None within a word."""
    for n, it in enumerate(words):
        if end <= it.begin:
            return n
        if end < it.end:
            return None
    return len(words)


def _is_sound(tree: Tree, lists: WordLists) -> bool:
    """Whether no word that is none of a noun's or an adjective's is read as one."""
    if lists.is_phrase([it.text.lower() for it in words_in(tree)]):
        return True
    for child in tree.children:
        if isinstance(child, Tree):
            if not _is_sound(child, lists):
                return False
        elif child.terminal in OPEN and lists.is_closed(child.text.lower()):
            return False
    return True
