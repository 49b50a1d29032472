"""What speakers set right themselves: "a cub, sorry, a cup".

Source: Heeman and Allen 1999, for repairs that begin alike.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from kille.dialogue.lookalikes import replace_lookalikes
from kille.dialogue.robust_reading.clause_words import BREAK, Word, words_of
from kille.dialogue.word_lists import WordLists


class RepairedSentence(NamedTuple):
    """A sentence with what its speaker has set right, and with spoken forms written.

    `words` are those of the `plain` text.
    """

    said: str
    plain: str
    words: tuple[Word, ...]
    is_certain: bool
    """Whether it is certain what was set right."""
    numbers: tuple[str, ...] = ()
    """The words for one, two, three and so on."""

    @property
    def is_question(self) -> bool:
        """Whether it ends with a question mark."""
        return self.plain.rstrip().endswith("?")

    def text_of(self, first: int, after: int) -> str:
        """The stretch of the text from one word to before another."""
        return self.plain[self.words[first].begin : self.words[after - 1].end]


def repair_sentence(text: str, lists: WordLists) -> RepairedSentence:
    """The sentence that a text is, repaired.

    >>> from kille.dialogue.word_lists import word_lists
    >>> repair_sentence("whats this, I mean, that?", word_lists("en")).plain
    'what is that?'
    """
    written = lists.write_out(" ".join(replace_lookalikes(text).split()))
    plain, is_certain = repair(written, lists)
    words = words_of(plain, lists)
    return RepairedSentence(text, plain, words, is_certain, lists.numbers)


def repair(text: str, lists: WordLists) -> tuple[str, bool]:
    """The text with what its speaker has set right in place of what they said first.

    What follows "sorry" or "I mean" between commas, or as the last word, takes the
    place of what was said from where it begins alike, or else of the last word: then
    that is not certain, unless both say how things are.

    >>> from kille.dialogue.word_lists import word_lists
    >>> english = word_lists("en")
    >>> repair("the red, I mean the blue one is a cup", english)
    ('the blue one is a cup', True)
    >>> repair("This is a bottel, sorry, bottle.", english)
    ('This is a bottle.', False)
    >>> repair("this is a bottel sorry bottle", english)
    ('this is a bottle', False)
    >>> repair("Sorry, this is a cup.", english)
    ('Sorry, this is a cup.', True)

    A mere no sets right what a thing is called, or how it is, and may do so again.

    >>> repair("This is a hat, no, a beret, no - a cap!", english)
    ('This is a cap!', True)
    >>> repair("It's not a cup, I mean, a mug.", english)
    ("It's not a cup, I mean, a mug.", True)
    >>> repair("This is a cup, no, it isn't.", english)
    ("This is a cup, no, it isn't.", True)
    """
    words = words_of(text, lists)
    for run in lists.repair_runs([it.form for it in words]):
        before, after = words[: run.start], words[run.stop :]
        if not after:
            before, after = _last_clause_apart(before)
        if not before or not after or _denies(before, lists):
            continue
        between = min(words[run.start].begin, after[0].begin)
        is_apart = BREAK.search(text, before[-1].end, between)
        sets_right = tuple(it.form for it in words[run.start : run.stop])
        if not is_apart and not (
            (sets_right in lists.renewals or lists.fillers.issuperset(sets_right))
            and _is_last_word_anew(before, after, lists)
        ):
            continue
        same = {after[0].form}
        if same <= lists.articles:
            same = {*lists.articles}
        alike = [n for n, it in enumerate(before) if it.form in same]
        kept = text[: before[alike[-1] if alike else -1].begin]
        are_qualities = {before[-1].form, after[0].form} <= lists.qualities
        names = after[0].form in lists.articles and bool(alike)
        if lists.negations.issuperset(sets_right) and not (names or are_qualities):
            continue
        is_certain = bool(alike) or (are_qualities and len(after) == 1)
        again, is_again_certain = repair(kept + text[after[0].begin :], lists)
        return again, is_certain and is_again_certain
    return text, True


def _denies(words: Sequence[Word], lists: WordLists) -> bool:
    """Whether the last clause of these words says what is not so.

    What comes after it is so instead: "It's not a cup, I mean, it's a mug.".
    """
    last = [it.form for it in words if it.clause == words[-1].clause]
    return not lists.negations.isdisjoint(last)


def _is_last_word_anew(
    before: Sequence[Word], after: Sequence[Word], lists: WordLists
) -> bool:
    """Whether the last word is said again, without commas: "a cub sorry a cup"."""
    anew = after[1:] if after[0].form in lists.articles else after
    return len(anew) == 1 and before[-1].form not in lists.articles


def _last_clause_apart(words: Sequence[Word]) -> tuple[tuple[Word, ...], ...]:
    """The words before the last clause, and those in it: "a cub, a cup I mean"."""
    before = tuple(it for it in words if it.clause < words[-1].clause)
    return before, tuple(words[len(before) :])
