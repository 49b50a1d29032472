"""Islands: the stretches of a sentence that the grammar can read, and what is between.

A sentence that the grammar does not read as a whole may have parts that it does. A
cover is a choice of such parts that do not overlap; the words that it leaves out are
missed, unless they are harmless ones, such as "well" and "you know". The best covers
leave out little, are made of few islands, and these fit what the talk is about.

Source: Carroll and Charniak 1991 and Ward 1991 for parsing the islands of spontaneous
speech; Lison 2013 for weighing readings by the state of the dialogue.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from heapq import nlargest
from types import MappingProxyType
from typing import NamedTuple

from kille.dialogue.parsing import Grammar, Tree, parts
from kille.dialogue.word_lists import WordLists

START = "island"
"""The rule of the grammar for what may be an island."""

MISSED = 0.4
"""The factor for every word that a cover leaves out."""

APART = 0.8
"""The factor for every island: one long one is better than several short ones."""

ACROSS = 0.7
"""The factor for an island that goes on after a comma."""

BLANKED = 0.9
"""The factor for an island that leaves out harmless words within."""

COVERS = 12
"""How many covers of the rest of a sentence are kept: the best ones."""

BOUND = 4
"""How many of those that begin with an island that has to follow another."""

_MOST = 48
"""Words; what is longer is no sentence that a tutor says to a robot."""

_WORD = re.compile(r"[^\W_]+(?:['’´-][^\W_]+)*")
_BREAK = re.compile(r"[,;:.!?…()\"“”]|\s[-–—]+\s")


class Word(NamedTuple):
    """A word of a sentence: where it stands, and in which clause, counted from 0."""

    begin: int
    end: int
    form: str
    clause: int
    is_harmless: bool
    joins: bool = False
    """Whether it joins clauses: it may be left out, but not from within an island."""


class Island(NamedTuple):
    """A stretch from one word to before another, and how the grammar can read it.

    `rule` is the move that it is, or the name that the grammar gives the island.
    """

    first: int
    after: int
    rule: str
    trees: tuple[Tree, ...]
    weight: float


class Cover(NamedTuple):
    """Islands of a sentence from left to right, and the words that they leave out."""

    islands: tuple[Island, ...]
    missed: tuple[Word, ...]
    weight: float

    def missed_near(self, island: Island, words: Sequence[Word]) -> tuple[Word, ...]:
        """The words that are left out of the clauses in which an island stands."""
        clauses = {it.clause for it in words[island.first : island.after]}
        return tuple(it for it in self.missed if it.clause in clauses)


Weigh = Callable[[Tree], float]
"""How well a reading of an island fits what the talk is about, from 0 to 1."""


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
    harmless = {at for run in lists.harmless_runs(forms) for at in run}
    breaks = {
        at
        for at in range(1, len(found))
        if _BREAK.search(text, found[at - 1][1], found[at][0])
    }
    for run in lists.harmless_runs(forms):
        if {run.start, run.stop} <= breaks:
            breaks -= {run.start, run.stop}
    words: list[Word] = []
    clause = 0
    for at, ((begin, end, _), form) in enumerate(zip(found, forms, strict=True)):
        joins = form in lists.joining
        clause += at > 0 and (joins or at in breaks)
        words.append(Word(begin, end, form, clause, joins or at in harmless, joins))
    return tuple(words)


def blank_harmless(text: str, words: Iterable[Word]) -> str:
    """The text with spaces in place of its harmless words.

    >>> from kille.dialogue.word_lists import word_lists
    >>> text = "it is really quite red"
    >>> " ".join(blank_harmless(text, words_of(text, word_lists("en"))).split())
    'it is red'
    """
    for it in words:
        if it.is_harmless and not it.joins:
            text = text[: it.begin] + " " * (it.end - it.begin) + text[it.end :]
    return text


def repair(text: str, lists: WordLists) -> tuple[str, bool]:
    """The text with what its speaker has set right in place of what they said first.

    What follows "sorry" or "I mean" between commas takes the place of what was said
    from where it begins alike, or else of the last word: then that is not certain.

    >>> from kille.dialogue.word_lists import word_lists
    >>> english = word_lists("en")
    >>> repair("the red, I mean the blue one is a cup", english)
    ('the blue one is a cup', True)
    >>> repair("This is a bottel, sorry, bottle.", english)
    ('This is a bottle.', False)
    >>> repair("Sorry, this is a cup.", english)
    ('Sorry, this is a cup.', True)
    """
    words = words_of(text, lists)
    for run in lists.repair_runs([it.form for it in words]):
        before, after = words[: run.start], words[run.stop :]
        if not after:
            before, after = _last_clause_apart(before)
        if not before or not after:
            continue
        between = min(words[run.start].begin, after[0].begin)
        if not _BREAK.search(text, before[-1].end, between):
            continue
        same = {after[0].form}
        if same <= lists.articles:
            same = {*lists.articles}
        alike = [n for n, it in enumerate(before) if it.form in same]
        kept = text[: before[alike[-1] if alike else -1].begin]
        return kept + text[after[0].begin :], bool(alike)
    return text, True


def _last_clause_apart(words: Sequence[Word]) -> tuple[tuple[Word, ...], ...]:
    """The words before the last clause, and those in it: "a cub, a cup I mean"."""
    before = tuple(it for it in words if it.clause < words[-1].clause)
    return before, tuple(words[len(before) :])


Follows = Mapping[str, Set[str]]
"""The islands that make sense only right after others, by their rules: "and soft"."""


def best_covers(
    text: str,
    words: Sequence[Word],
    grammar: Grammar,
    weigh: Weigh,
    lists: WordLists,
    follows: Follows = MappingProxyType({}),
) -> list[Cover]:
    """The best covers of a text by the islands of a grammar, the best one first."""
    if not words or len(words) > _MOST:
        return []
    islands = _islands(text, words, grammar, weigh, lists)
    before = _before_last_aside(words)
    if before:
        blank = blank_harmless(text, words)
        islands += [
            it._replace(weight=BLANKED * it.weight)
            for it in _islands(blank, words, grammar, weigh, lists, before)
        ]
    by_first: dict[int, list[Island]] = {}
    for island in islands:
        by_first.setdefault(island.first, []).append(island)
    rest: list[list[Cover]] = [[] for _ in words] + [[Cover((), (), 1.0)]]
    for at in reversed(range(len(words))):
        here = by_first.get(at, ())
        rest[at] = _covers_from(at, words[at], here, rest, follows)
    return [it for it in rest[0] if it.islands and it.islands[0].rule not in follows]


def _before_last_aside(words: Sequence[Word]) -> int:
    """How many words stand before the last harmless one that others surround."""
    said = [n for n, it in enumerate(words) if not it.is_harmless]
    inner = range(said[0], said[-1]) if said else range(0)
    return max((n for n in inner if words[n].is_harmless), default=0)


def _covers_from(
    at: int,
    word: Word,
    islands: Iterable[Island],
    rest: Sequence[Sequence[Cover]],
    follows: Follows,
) -> list[Cover]:
    """The best covers of what stands from a word on, from those of what follows."""
    if word.is_harmless:
        found = list(rest[at + 1])
    else:
        found = [
            Cover(it.islands, (word, *it.missed), MISSED * it.weight)
            for it in rest[at + 1]
            if not it.islands or it.islands[0].rule not in follows
        ]
    for island in islands:
        found += [
            Cover(
                (island, *it.islands),
                it.missed,
                APART * island.weight * it.weight,
            )
            for it in rest[island.after]
            if not it.islands
            or island.rule in follows.get(it.islands[0].rule, (island.rule,))
        ]
    best: dict[object, Cover] = {}
    for it in found:
        key = tuple(one[:3] for one in it.islands)
        if key not in best or best[key].weight < it.weight:
            best[key] = it
    bound = [it for it in best.values() if it.islands and it.islands[0].rule in follows]
    free = [it for it in best.values() if it not in bound]
    return [
        *nlargest(COVERS, free, key=lambda it: it.weight),
        *nlargest(BOUND, bound, key=lambda it: it.weight),
    ]


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
            while before and after > first + 1 and _is_aside(words[after - 1]):
                after -= 1
            by_rule: dict[str, list[tuple[float, Tree]]] = {}
            for tree in trees:
                if _is_sound(tree, lists):
                    by_rule.setdefault(_rule(tree), []).append((weigh(tree), tree))
            inner = words[first:after]
            across = ACROSS ** (inner[-1].clause - inner[0].clause)
            for rule, fits in by_rule.items():
                likely = max(fit for fit, _ in fits)
                if likely <= 0.0:
                    continue
                best = tuple(tree for fit, tree in fits if fit > likely / 2)
                found.append(Island(first, after, rule, best, likely * across))
    return found


def _rule(tree: Tree) -> str:
    """The move that an island is, or the name that the grammar gives the island."""
    return parts(tree)[0].rule if tree.rule == START else tree.rule


def _is_aside(word: Word) -> bool:
    return word.is_harmless and not word.joins


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
    for child in tree.children:
        if isinstance(child, Tree):
            if not _is_sound(child, lists):
                return False
        elif child.terminal in OPEN and lists.is_closed(child.text.lower()):
            return False
    return True


OPEN = frozenset(
    {"WORD", "PLURAL", "DEFINITE", "NEUTER", "WEAK", "PLAIN_PLURAL", "BARE"}
)
"""The terminals that find any word; others than these find the words they list."""
